// The k nearest points of queries where there are no triangles: all points equal, or on one line or great circle.
// Exact.
//
// Along a line the distance from a query falls and then rises. Around a great circle the angle does so too, once,
// unless the query is an end of the axis and all points are equally near. So binary search finds a nearest point: by
// rounded distances first, and by exact ones where the point found is not nearest beside its neighbours. The next
// nearest one is always the next to the left or to the right of those that are known.
#pragma once

#include <cstddef>

#include "duplicates.hpp"
#include "threads.hpp"

namespace stereodel::queries {

// `count` queries, `k` points for each (at most as many as there are), to `found`, rows of k. `order`: the different
// points, `size` of them, as in flat_order.hpp, from any start. `duplicates`: pairs (dropped, kept); both count.
struct NearestFlatTask {
    const double* points;
    const Index* order;
    std::size_t size;
    const Pairs& duplicates;
    const double* queries;
    std::size_t count;
    std::size_t k;
    Index* found;
};

// By distance, equally near ones by number; on the sphere by angle. The result does not depend on `workers`. Throws
// std::bad_alloc, Cancelled.
template <std::size_t Width>
void nearest_flat(const NearestFlatTask& task, int workers, Stop stop);

}  // namespace stereodel::queries
