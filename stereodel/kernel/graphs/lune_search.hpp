// Whether the lune of an edge is empty: whether no point is strictly nearer to both ends than these are to each other.
//
// The points nearer to a than b is hang together: each of them but a has a Delaunay neighbour that is strictly nearer
// to a (see k_nearest.hpp). So whatever lies in the lune of ab is reached from a along edges between such points, and
// likewise from b. Both searches go on in turn, triangle by triangle; the lune is empty as soon as one of them is
// through. So an edge between a large cluster and a small one costs no more than the small one.
#pragma once

#include <cstddef>
#include <vector>

#include "index_set.hpp"
#include "queries/queries.hpp"

namespace stereodel::graphs {

using queries::TriangleArrays;

// For one edge after another, by one thread.
template <class Sites>
class LuneSearch {
  public:
    LuneSearch(const TriangleArrays& triangles, const Sites& sites, Stop stop)
        : triangles_(triangles), sites_(sites), stop_(stop) {}

    // The edge opposite corner k of triangle t.
    bool is_empty(Index t, std::size_t k) {
        const Index* const corner = triangles_.corners(t);
        const Index a = corner[(k + 1) % 3], b = corner[(k + 2) % 3];
        square_ = sites_.square(a, b);
        sides_[0].begin(a, b, t);
        sides_[1].begin(b, a, t);
        for (std::size_t turn = 0;; turn ^= 1) {
            check(stop_);
            Side& side = sides_[turn];
            if (side.next == side.queue.size()) {
                return true;
            }
            if (finds(side, side.queue[side.next++])) {
                return false;
            }
        }
    }

  private:
    // The triangles that were reached from one end.
    struct Side {
        Index from, to;
        std::vector<Index> queue;
        std::size_t next;
        IndexSet seen;

        void begin(Index near_end, Index far_end, Index t) {
            from = near_end;
            to = far_end;
            queue.assign(1, t);
            next = 0;
            seen.clear();
            seen.insert(t);
        }
    };

    // Whether a triangle has a corner in the lune; if not, the search goes on across its edges that have an end nearer
    // than the far end.
    bool finds(Side& side, Index t) {
        const Index* const corner = triangles_.corners(t);
        bool is_near[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const Index p = corner[k];
            is_near[k] = p == side.from || (p != side.to && is_nearer(p, side.from, side.to));
            if (is_near[k] && p != side.from && is_nearer(p, side.to, side.from)) {
                return true;
            }
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const Index other = triangles_.neighbors(t)[k];
            if (other >= 0 && (is_near[(k + 1) % 3] || is_near[(k + 2) % 3]) && side.seen.insert(other)) {
                side.queue.push_back(other);
            }
        }
        return false;
    }

    // Whether p is strictly nearer to one end than the other end is.
    bool is_nearer(Index p, Index end, Index other) const {
        const Sign sign = sites_.compare_squares(sites_.square(end, p), square_);
        return (sign != OPEN ? sign : sites_.compare_lengths(end, p, end, other)) < 0;
    }

    const TriangleArrays& triangles_;
    const Sites& sites_;
    Stop stop_;
    Side sides_[2];
    double square_ = 0.0;  // of the edge's length
};

}  // namespace stereodel::graphs
