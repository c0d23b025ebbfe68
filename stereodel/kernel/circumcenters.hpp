// Circumcentres: from differences of the given coordinates, in about twice the precision, rounded once.
#pragma once

#include <cstddef>
#include <vector>

#include "tally.hpp"
#include "threads.hpp"

namespace stereodel {

// Centres of `count` triangles, given by three point numbers each. Returns the rows that it leaves open, in order:
// triangles so flat that twice the precision is not enough.
//
// Plane: two coordinates a centre. Sphere: the unit normals on the side from which the corners appear counterclockwise.
std::vector<Index> circumcenters_plane(const double* points, const Index* triangles, std::size_t count, double* centers,
                                       int workers, Stop stop);
std::vector<Index> circumcenters_sphere(const double* points, std::size_t size, const Index* triangles,
                                        std::size_t count, double* centers, int workers, Stop stop);

}  // namespace stereodel
