// The shortest forest among given edges: J. Kruskal, "On the shortest spanning subtree of a graph and the traveling
// salesman problem" (1956), lengths compared exactly.
//
// Equally long edges come in the order of their ends as points: the lexicographically lower ends first, then the
// others. So lengths are as if all were different, and the tree does not depend on the numbers of the points.
#pragma once

#include <cstddef>

#include "duplicates.hpp"
#include "threads.hpp"

namespace stereodel::graphs {

// `edges` between `size` points, no two of which are the same, if an edge ends there. Returns the edges of the forest,
// lower number first, in lexicographic order. Throws std::bad_alloc, Cancelled.
template <std::size_t Width>
Pairs spanning_tree(const double* points, std::size_t size, const Pairs& edges, Stop stop);

}  // namespace stereodel::graphs
