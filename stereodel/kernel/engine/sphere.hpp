// Delaunay triangulation of directions: the convex hull of the unit vectors, exact on the rays through the given
// doubles.
#pragma once

#include <cstddef>

#include "engine/plane.hpp"
#include "engine/projection.hpp"

namespace stereodel::engine {

// `xyz` holds finite numbers, `count` vectors of three, none of them zero. The result depends neither on `pole`, the
// point from which the sphere is projected, nor on `workers`. Throws std::bad_alloc, std::length_error, Cancelled.
Triangulation triangulate_sphere(const double* xyz, std::size_t count, bool with_neighbors, int workers, Pole pole,
                                 Stop stop);

// Of each of `count` facets a b c, counterclockwise seen from outside: whether det[a b c] <= 0, so that its empty
// bubble is a hemisphere or more. `size`: number of points.
void closing_facets(const double* xyz, std::size_t size, const Index* simplices, std::size_t count, bool* closing,
                    Stop stop);

}  // namespace stereodel::engine
