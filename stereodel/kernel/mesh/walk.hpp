// The visibility walk: from triangle to triangle across edges that have the query on their other side.
//
// It ends in every Delaunay triangulation (H. Edelsbrunner, "An acyclicity theorem for cell complexes in d dimensions",
// Combinatorica 10, 1990). On the sphere the same follows from the hull: let f be the linear function that is 1 on the
// plane of a facet; across an edge u v that has the query q on its far side, f(q) grows, because the difference of the
// two functions vanishes on u and v and is positive at the third corner of the new facet. This holds for facets that
// the centre does not see (the walk never enters others), and for several facets of one plane after the displacement
// outward that cut it into triangles: it moves no point across a plane through the centre.
#pragma once

#include <array>
#include <cstddef>

#include "mesh/corners.hpp"
#include "tally.hpp"
#include "threads.hpp"

namespace stereodel::mesh {

struct WalkEnd {
    Index triangle;  // the last one entered
    int exit;        // place opposite the edge beyond which the query lies and nothing may be entered; -1: none
    std::array<int, 3> side;  // without exit: which side of each edge, by opposite place: 1 inside, 0 on its line

    bool on_line() const { return side[0] == 0 || side[1] == 0 || side[2] == 0; }
};

// `triangles`: corners(t) and neighbors(t), arrays of three, and may_enter(t); `start` may be entered.
// `side(u, v)`: the side of u -> v on which the query lies, 1 left.
template <class Triangles, class Side>
WalkEnd walk(const Triangles& triangles, Index start, Side&& side, Stop stop) {
    WalkEnd here{start, -1, {}};
    std::size_t entry = 3;  // place opposite the edge just crossed
    for (std::size_t steps = 1;; ++steps) {
        if (steps % 4096 == 0) {
            check(stop);
        }
        const Index* const corner = triangles.corners(here.triangle);
        std::size_t exit = 3;
        for (std::size_t k = 0; k < 3; ++k) {
            if (k == entry) {
                here.side[k] = 1;
                continue;
            }
            here.side[k] = side(corner[(k + 1) % 3], corner[(k + 2) % 3]);
            if (here.side[k] < 0) {
                exit = k;
                break;
            }
        }
        if (exit == 3) {
            return here;
        }
        const Index next = triangles.neighbors(here.triangle)[exit];
        if (!triangles.may_enter(next)) {
            here.exit = static_cast<int>(exit);
            return here;
        }
        const Index u = corner[(exit + 1) % 3], v = corner[(exit + 2) % 3];
        entry = place_opposite(triangles.corners(next), u, v);
        here.triangle = next;
    }
}

}  // namespace stereodel::mesh
