// The search for the nearest point of one query after another, by one thread: see nearest.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "index_set.hpp"
#include "mesh/walk.hpp"
#include "queries/queries.hpp"

namespace stereodel::queries {

using mesh::WalkEnd;
using mesh::walk;

template <class Query>
class NearestFinder {
  public:
    NearestFinder(const TriangleArrays& triangles, Stop stop)
        : triangles_(triangles), query_(triangles.points()), stop_(stop) {}

    // The nearest point of a query, looked for from the triangle `near` on, which becomes one close to it.
    Index find(const double* query, Index& near) {
        const Near here = settle(query, near);
        Index lowest = here.point;
        visit_equal(here, [&](Near other) { lowest = std::min(lowest, other.point); });
        return lowest;
    }

    // One of the nearest points, from which `visit_equal` goes on.
    Near settle(const double* query, Index& near) {
        query_.take(query);
        const WalkEnd end = walk(triangles_, near, [this](Index u, Index v) { return query_.side(u, v); }, stop_);
        Near best = nearest_corner(end.triangle);
        Near here;
        do {
            here = best;
            best = nearest_neighbor(here);
        } while (best.point != here.point);
        near = triangles_.may_enter(here.triangle) ? here.triangle : end.triangle;
        return here;
    }

    // Calls visit(near) for all other points that are as near as one that was settled, reached along edges; `equal_`
    // holds the first ones.
    template <class Visit>
    void visit_equal(Near here, Visit&& visit) {
        if (equal_.empty()) {
            return;
        }
        seen_.clear();
        seen_.insert(here.point);
        while (!equal_.empty()) {
            const Near next = equal_.back();
            equal_.pop_back();
            if (!seen_.insert(next.point)) {
                continue;
            }
            check(stop_);
            visit(next);
            triangles_.neighbors_around(next, [&](Near other) {
                if (query_.compare(other.point, here.point) == 0) {
                    equal_.push_back(other);
                }
            });
        }
    }

    Query& query() { return query_; }

  private:
    Near nearest_corner(Index t) {
        const Index* const c = triangles_.corners(t);
        Index best = query_.compare(c[1], c[0]) < 0 ? c[1] : c[0];
        best = query_.compare(c[2], best) < 0 ? c[2] : best;
        return {best, t};
    }

    // The nearest of a point and its neighbours. If that is the point itself, `equal_` holds those that are as near. A
    // look along the star to the largest gain mostly tells that this is so, however large the star is.
    Near nearest_neighbor(Near here) {
        const Near top = climb(here);
        const int sign = top.point < 0 ? -1 : query_.compare(top.point, here.point);
        equal_.clear();
        if (sign < 0) {
            return nearest_of_star(here);
        }
        if (sign == 0) {
            equal_.push_back(top);
        }
        return here;
    }

    // The neighbour of largest gain, -1 if that is not certain.
    Near climb(Near here) {
        const std::size_t place = triangles_.place(here.triangle, here.point);
        const Index* const c = triangles_.corners(here.triangle);
        Near now{c[(place + 1) % 3], here.triangle};
        Gain behind = query_.gain(c[(place + 2) % 3], here.point), gain = query_.gain(now.point, here.point);
        std::size_t turn = 2;  // clockwise
        if (behind.value > gain.value) {
            now.point = c[(place + 2) % 3];
            std::swap(behind, gain);
            turn = 1;
        }
        for (;;) {
            const Near next = neighbor_after(here.point, now.triangle, turn);
            const Gain ahead = next.point < 0 ? GHOST_GAIN : query_.gain(next.point, here.point);
            if (next.point < 0 || !(ahead.value > gain.value)) {
                const bool certain = gain.certainly_exceeds(behind) && gain.certainly_exceeds(ahead);
                return {certain ? now.point : -1, now.triangle};
            }
            behind = gain;
            gain = ahead;
            now = next;
        }
    }

    // The neighbour of a point beyond the two in a triangle, counterclockwise (1) or clockwise (2); -1 if there is
    // none.
    Near neighbor_after(Index point, Index triangle, std::size_t turn) const {
        const Index t = triangles_.neighbors(triangle)[(triangles_.place(triangle, point) + turn) % 3];
        return {t < 0 ? -1 : triangles_.corners(t)[(triangles_.place(t, point) + 3 - turn) % 3], t};
    }

    Near nearest_of_star(Near here) {
        Near best = here;
        triangles_.neighbors_around(here, [&](Near other) {
            const int sign = query_.compare(other.point, best.point);
            if (sign < 0) {
                best = other;
            } else if (sign == 0) {
                equal_.push_back(other);
            }
        });
        return best;
    }

    const TriangleArrays& triangles_;
    Query query_;
    std::vector<Near> equal_;
    IndexSet seen_;  // by `visit_equal`
    Stop stop_;
};

}  // namespace stereodel::queries
