// The order of points without triangles: along their line, around their great circle. Exact.
#pragma once

#include <cstddef>
#include <vector>

#include "tally.hpp"
#include "threads.hpp"

namespace stereodel::order {

// The different points of a line, the first of equal ones, in lexicographic order. Throws Cancelled.
std::vector<Index> line_order(const double* xy, std::size_t count, Stop stop);

// The different directions of a great circle, the first of equal ones, around it, from the lowest on. Of three or more,
// the three lowest are counterclockwise seen from the first end of the axis (of `GreatCircle`); two are in the order of
// their numbers. Throws std::invalid_argument unless they lie on one great circle, which is known if `checked`;
// Cancelled.
std::vector<Index> circle_order(const double* xyz, std::size_t count, bool checked, Stop stop);

}  // namespace stereodel::order
