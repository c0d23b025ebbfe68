// Which point is nearest to a query: exact, for many queries at once, on plain arrays that nobody changes meanwhile.
//
// From the triangle of a query greedily along Delaunay edges: a point whose Voronoi cell does not hold the query has a
// neighbour that is nearer. Points equally near lie on an empty circle around the query; Delaunay edges join each to
// the next around it.
#pragma once

#include <cstddef>

#include "queries/queries.hpp"

namespace stereodel::queries {

// For each of `count` queries the nearest point, the lowest one of several; on the sphere that of the least angle.
// There must be triangles (see nearest_flat.hpp). The result does not depend on `workers`. Throws std::bad_alloc,
// Cancelled.
template <std::size_t Width>
void nearest(const TriangleArrays& triangles, const double* queries, std::size_t count, Index* found,
                    int workers, Stop stop);

}  // namespace stereodel::queries
