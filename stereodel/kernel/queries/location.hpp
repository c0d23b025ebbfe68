// Which triangle holds a query: exact, for many queries at once, on plain arrays that nobody changes meanwhile.
//
// Queries are sorted along a curve; each walk begins where the last one ended.
#pragma once

#include <cstddef>

#include "queries/queries.hpp"

namespace stereodel::queries {

// For each of `count` queries a triangle that holds it, the lowest one of several (on a common edge or vertex); -1 if
// it lies in none that may be entered. The result does not depend on `workers`. Throws std::bad_alloc, Cancelled.
//
// Plane: queries are points; sphere: directions, and `closing` must be given unless there are no closing triangles.
template <std::size_t Width>
void find_simplex(const TriangleArrays& triangles, const double* queries, std::size_t count, Index* found,
                         int workers, Stop stop);

}  // namespace stereodel::queries
