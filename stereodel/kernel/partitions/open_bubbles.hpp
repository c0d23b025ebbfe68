// Which triangles of some points are not certainly triangles of all points.
#pragma once

#include <cstddef>

#include "partitions/box_tree.hpp"
#include "tally.hpp"
#include "threads.hpp"

namespace stereodel::partitions {

// `is_open`: of each bubble whether it may touch a block with unread points; never false where it does. `depth`: of
// each block with unread points how deep an open bubble reaches into it, as a rough length, 0 if none does: that of the
// first bubble that does.
struct Openness {
    bool* is_open;
    double* depth;
};

// Triangles, rows of three points, counterclockwise; in the plane (u, v, -1) is an edge of the hull with everything to
// its left. `wanted`: of each point whether its triangles matter, or null; triangles without a wanted corner are not
// looked at, and not open. Rows of near triangles should stand near each other.
struct Faces {
    const double* points;
    std::size_t size;
    const Index* corners;
    std::size_t count;
    const bool* wanted;
};

void open_bubbles(const Faces& faces, const BoxTree<2>& tree, const Openness& openness, Stop stop);
void open_bubbles(const Faces& faces, const BoxTree<3>& tree, const Openness& openness, Stop stop);

// Of discs around centers, through the points beside them: all points no farther from a target than its k-th nearest.
struct Discs {
    const double *centers, *rims;
    std::size_t count;
};

void open_discs(const Discs& discs, const BoxTree<2>& tree, const Openness& openness, Stop stop);
void open_discs(const Discs& discs, const BoxTree<3>& tree, const Openness& openness, Stop stop);

}  // namespace stereodel::partitions
