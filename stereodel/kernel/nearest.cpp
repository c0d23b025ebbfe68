#include "nearest.hpp"

#include <algorithm>
#include <unordered_set>
#include <vector>

#include "query_pieces.hpp"
#include "walk.hpp"

namespace stereodel {
namespace {

template <class Query>
class NearestFinder {
  public:
    NearestFinder(const TriangleArrays& triangles, Stop stop)
        : triangles_(triangles), query_(triangles.points()), stop_(stop) {}

    // The nearest point of a query, looked for from the triangle `near` on, which becomes one close to it.
    Index find(const double* query, Index& near) {
        query_.take(query);
        const WalkEnd end = walk(triangles_, near, [this](Index u, Index v) { return query_.side(u, v); }, stop_);
        Near best = nearest_corner(end.triangle);
        Near here;
        do {
            here = best;
            best = nearest_neighbor(here);
        } while (best.point != here.point);
        near = triangles_.may_enter(here.triangle) ? here.triangle : end.triangle;
        return equal_.empty() ? here.point : lowest_equal(here);
    }

    Index scan(const double* query, std::size_t size) {
        query_.take(query);
        Index best = 0;
        for (Index p = 1; p < static_cast<Index>(size); ++p) {
            best = query_.compare(p, best) < 0 ? p : best;
        }
        return best;
    }

  private:
    // A point and a triangle that has it.
    struct Near {
        Index point, triangle;
    };

    Near nearest_corner(Index t) {
        const Index* const c = triangles_.corners(t);
        Index best = query_.compare(c[1], c[0]) < 0 ? c[1] : c[0];
        best = query_.compare(c[2], best) < 0 ? c[2] : best;
        return {best, t};
    }

    // Calls visit(near) for all points that an edge joins to one.
    template <class Visit>
    void neighbors(Near here, Visit&& visit) {
        triangles_.around(here.point, here.triangle, [&](Index t) {
            const std::size_t place = triangles_.place(t, here.point);
            visit(Near{triangles_.corners(t)[(place + 1) % 3], t});
            if (triangles_.neighbors(t)[(place + 1) % 3] < 0) {
                visit(Near{triangles_.corners(t)[(place + 2) % 3], t});  // the last one of an open fan
            }
        });
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
        neighbors(here, [&](Near other) {
            const int sign = query_.compare(other.point, best.point);
            if (sign < 0) {
                best = other;
            } else if (sign == 0) {
                equal_.push_back(other);
            }
        });
        return best;
    }

    // The lowest of all points that are equally near, reached along edges; `equal_` holds the first ones.
    Index lowest_equal(Near here) {
        std::unordered_set<Index> seen{here.point};
        Index lowest = here.point;
        while (!equal_.empty()) {
            const Near next = equal_.back();
            equal_.pop_back();
            if (!seen.insert(next.point).second) {
                continue;
            }
            check(stop_);
            lowest = std::min(lowest, next.point);
            neighbors(next, [&](Near other) {
                if (query_.compare(other.point, here.point) == 0) {
                    equal_.push_back(other);
                }
            });
        }
        return lowest;
    }

    const TriangleArrays& triangles_;
    Query query_;
    std::vector<Near> equal_;
    Stop stop_;
};

template <class Query>
void scan_all(const TriangleArrays& triangles, std::size_t size, const double* queries, std::size_t count, Index* found,
              int workers, Stop stop) {
    constexpr std::size_t grain = 16;
    Crew crew(useful_workers(workers, count, grain));
    in_grains(count, grain, crew, [&](std::size_t begin, std::size_t end) {
        NearestFinder<Query> finder(triangles, stop);
        for (std::size_t k = begin; k < end; ++k) {
            check(stop);
            found[k] = finder.scan(queries + Query::Chart::dimension * k, size);
        }
    });
}

template <class Query>
void find_nearest(const TriangleArrays& triangles, std::size_t size, const double* queries, std::size_t count,
                  Index* found, int workers, Stop stop) {
    if (triangles.count() == 0) {
        scan_all<Query>(triangles, size, queries, count, found, workers, stop);
        return;
    }
    for_queries<typename Query::Chart>(triangles, first_open(triangles), queries, count, workers, stop, [&] {
        return [found, finder = NearestFinder<Query>(triangles, stop)](
                   std::size_t k, const double* query, Index& near) mutable { found[k] = finder.find(query, near); };
    });
}

}  // namespace

void nearest_plane(const TriangleArrays& triangles, std::size_t size, const double* queries, std::size_t count,
                   Index* found, int workers, Stop stop) {
    find_nearest<PlaneQuery>(triangles, size, queries, count, found, workers, stop);
}

void nearest_sphere(const TriangleArrays& triangles, std::size_t size, const double* queries, std::size_t count,
                    Index* found, int workers, Stop stop) {
    find_nearest<SphereQuery>(triangles, size, queries, count, found, workers, stop);
}

}  // namespace stereodel
