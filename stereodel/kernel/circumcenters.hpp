// Circumcentres: from differences of the given coordinates, in about twice the precision, rounded once.
#pragma once

#include <cstddef>
#include <vector>

#include "tally.hpp"
#include "threads.hpp"

namespace stereodel {

// Triangles by three point numbers each; the centre of row k goes to place[k], or to k if `place` is null.
struct TriangleRows {
    const Index *corners, *place;
    std::size_t count;

    std::size_t to(std::size_t k) const { return place == nullptr ? k : static_cast<std::size_t>(place[k]); }
};

// Returns the rows that are left open, in order: triangles so flat that twice the precision is not enough.
//
// Plane: two coordinates a centre. Sphere: the unit normals on the side from which the corners appear counterclockwise.
std::vector<Index> circumcenters_plane(const double* points, const TriangleRows& rows, double* centers, int workers,
                                       Stop stop);
std::vector<Index> circumcenters_sphere(const double* points, std::size_t size, const TriangleRows& rows,
                                        double* centers, int workers, Stop stop);

}  // namespace stereodel
