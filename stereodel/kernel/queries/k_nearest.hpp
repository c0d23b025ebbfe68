// The k nearest points of queries: exact, for many queries at once, on plain arrays that nobody changes meanwhile.
//
// From the nearest point outward: every other point has a Delaunay neighbour that is strictly nearer to the query,
// unless it is one of the nearest itself. For in the lifted picture (plane: on the paraboloid; sphere: the hull) the
// distance is a linear function on a convex surface, and from a corner where such a function is not least an edge leads
// down; all edges of the surface are edges of any triangulation of it. So once the first j are known, the next one is
// one of the nearest or a neighbour of a known one: M. Dickerson, R. Drysdale, J.-R. Sack, "Simple algorithms for
// enumerating interpoint distances and finding k nearest neighbors" (1992).
#pragma once

#include <cstddef>

#include "duplicates.hpp"
#include "queries/queries.hpp"

namespace stereodel::queries {

// `count` queries, `k` points for each (at most as many as there are), to `found`, rows of k. `duplicates`: pairs
// (dropped, kept); both count.
struct KNearestTask {
    const TriangleArrays& triangles;
    const Pairs& duplicates;
    const double* queries;
    std::size_t count;
    std::size_t k;
    Index* found;
};

// By distance, equally near ones by number; on the sphere by angle. There must be triangles (see nearest_flat.hpp). The
// result does not depend on `workers`. Throws std::bad_alloc, Cancelled.
template <std::size_t Width>
void k_nearest(const KNearestTask& task, int workers, Stop stop);

}  // namespace stereodel::queries
