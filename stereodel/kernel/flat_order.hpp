// The order of the points of a flat set, which has no triangles: along their line, around their great circle. Exact.
#pragma once

#include <cstddef>
#include <vector>

#include "duplicates.hpp"
#include "threads.hpp"

namespace stereodel {

// `size` points of one line, without those that were dropped as duplicates. Throws std::bad_alloc, Cancelled.
std::vector<Index> flat_order_plane(const double* xy, std::size_t size, const Pairs& duplicates, Stop stop);

// Directions of one great circle: counterclockwise seen from one of the ends of its axis.
std::vector<Index> flat_order_sphere(const double* xyz, std::size_t size, const Pairs& duplicates, Stop stop);

}  // namespace stereodel
