// The folder `engine`: Delaunay triangulation from scratch.
// Reading order: edges, divide_and_conquer, curve_sites (sorting, tasks, threads), triangles (edges to rows), plane;
// for the sphere projection, projected_sites (the same questions about projected directions), sphere.
//
// Delaunay triangulation by divide and conquer over points in the order of a space-filling curve.
//
// L. Guibas, J. Stolfi, "Primitives for the manipulation of general subdivisions and the computation of Voronoi
// diagrams", ACM Transactions on Graphics 4 (1985), with the alternating cuts of R. Dwyer, "A faster divide-and-conquer
// algorithm for constructing Delaunay triangulations", Algorithmica 2 (1987). The highest bit in which the first and
// the last key of a range differ is the cut.
//
// The sites answer three questions, always exactly: the orientation of three points, whether a point lies in the circle
// of three, and the order of two points along an axis. The two sides of a cut must lie on two sides of a line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "engine/edges.hpp"
#include "threads.hpp"

namespace stereodel::engine {

enum class Axis { x, y };

// A triangulated range of points: a counterclockwise edge of its hull, or a single point, which has none.
struct Part {
    Index edge = -1;
    Index vertex = -1;  // of a single point
    FreeBlocks free;
};

// Sites must offer
//   int orient(a, b, c), bool in_circle(a, b, c, d)     for places in the curve's order
//   bool before(a, b, axis)                             along the axis, ties along the other one
//   std::uint32_t key(a)                                sorted; refined where it is equal for many
//   bool refine(low, high)                              new, sorted keys for equal ones; false if all stay equal
//   void sort_few(low, high)                            sort different points along x
//   Index sort_distinct(low, high)                      sort along x; the different points come first: their number
template <class Sites>
class DivideAndConquer {
  public:
    // `sites` is this thread's own view.
    DivideAndConquer(Edges& edges, Sites& sites, Stop stop) : edges_(edges), sites_(sites), stop_(stop) {}

    Part solve(Index low, Index high) {
        check(stop_);
        const std::uint32_t first = sites_.key(low), last = sites_.key(high - 1);
        if (high - low == 1) {
            return single(low);
        }
        if (first == last) {
            return crowded(low, high);
        }
        if (high - low <= 3 && (high - low == 2 || (sites_.key(low + 1) != first && sites_.key(low + 1) != last))) {
            return leaf(low, high, high);
        }
        if (high - low <= few_ && keys_differ(low, high)) {
            sites_.sort_few(low, high);
            return strips(low, high, high);
        }
        const Cut cut(sites_, low, high);
        const Part left = solve(low, cut.place), right = solve(cut.place, high);
        return merge(left, right, cut.axis);
    }

    struct Cut {
        Index place;
        Axis axis;

        Cut(Sites& sites, Index low, Index high) {
            std::uint32_t differ = sites.key(low) ^ sites.key(high - 1);
            int bit = 0;
            while (differ >>= 1) {
                ++bit;
            }
            const std::uint32_t limit = sites.key(high - 1) >> bit << bit;
            axis = bit % 2 == 1 ? Axis::x : Axis::y;
            place = low;
            for (Index rest = high - low; rest > 0;) {
                const Index half = rest / 2;
                if (sites.key(place + half) < limit) {
                    place += half + 1;
                    rest -= half + 1;
                } else {
                    rest = half;
                }
            }
        }
    };

    // The rising bubble: join two parts on two sides of a line, `left` before `right` along the axis.
    Part merge(Part left, Part right, Axis axis) {
        Part whole;
        whole.free = edges_.chain(left.free, right.free);
        Index base = tangent(left, right, axis, whole.free);  // from right to left
        whole.edge = base ^ 1;
        for (;;) {
            const Index l = edges_.target(base), r = edges_.origin(base);
            const Index from_left = candidate<Side::left>(base, l, r, whole.free);
            const Index from_right = candidate<Side::right>(base, l, r, whole.free);
            if (from_left < 0 && from_right < 0) {
                return whole;
            }
            base = rise(base, from_left, from_right, whole.free);
        }
    }

  private:
    enum class Side { left, right };

    static constexpr Index few_ = 10;  // so many points are cut along x alone, into halves

    bool keys_differ(Index low, Index high) const {
        bool differ = true;
        for (Index a = low + 1; a < high; ++a) {
            differ &= sites_.key(a) != sites_.key(a - 1);
        }
        return differ;
    }

    Part single(Index low) {
        Part part;
        part.vertex = low;
        part.free = edges_.block(6 * low, 6 * low + 6);
        return part;
    }

    // Two or three different points, at the beginning of a range of places.
    Part leaf(Index low, Index end, Index high) {
        Part part;
        part.free = edges_.block(6 * low, 6 * high);
        const Index a = low, b = low + 1, c = low + 2;
        if (end - low == 2) {
            part.edge = edges_.make(part.free, a, b);
            return part;
        }
        const int turn = sites_.orient(a, b, c);
        if (turn > 0) {
            part.edge = triangle(a, b, c, part.free);
        } else if (turn < 0) {
            part.edge = triangle(a, c, b, part.free);
        } else {
            part.edge = path(part.free, low);
        }
        return part;
    }

    Index triangle(Index a, Index b, Index c, FreeBlocks& free) {
        const Index ab = edges_.make(free, a, b), bc = edges_.make(free, b, c), ca = edges_.make(free, c, a);
        edges_.insert_after(bc, ab ^ 1);
        edges_.insert_after(ca, bc ^ 1);
        edges_.insert_after(ca ^ 1, ab);
        return ab;
    }

    // Three points on a line: the middle one is joined to both others.
    Index path(FreeBlocks& free, Index low) {
        Index order[3] = {low, low + 1, low + 2};
        const auto sort_two = [this](Index& a, Index& b) {
            if (sites_.before(b, a, Axis::x)) {
                std::swap(a, b);
            }
        };
        sort_two(order[0], order[1]);
        sort_two(order[1], order[2]);
        sort_two(order[0], order[1]);
        const Index first = edges_.make(free, order[0], order[1]), second = edges_.make(free, order[1], order[2]);
        edges_.insert_after(second, first ^ 1);
        return first;
    }

    // A range of equal keys: refine them; where that is not worth while or not possible, sort and cut along x alone.
    Part crowded(Index low, Index high) {
        constexpr Index few = 8;
        if (high - low > few && sites_.refine(low, high)) {
            return solve(low, high);
        }
        const Index distinct = sites_.sort_distinct(low, high);
        return strips(low, low + distinct, high);
    }

    // Points sorted along x, [low, end), that own the edges of [low, high).
    Part strips(Index low, Index end, Index high) {
        check(stop_);
        if (end - low == 1) {
            Part part = single(low);
            part.free = edges_.chain(part.free, edges_.block(6 * end, 6 * high));
            return part;
        }
        if (end - low <= 3) {
            return leaf(low, end, high);
        }
        const Index middle = low + (end - low) / 2;
        return merge(strips(low, middle, middle), strips(middle, end, high), Axis::x);
    }

    // The lower common tangent as an edge from right to left. Starts at the points next to the cut, so that the line
    // between them meets neither hull.
    Index tangent(Part left, Part right, Axis axis, FreeBlocks& free) {
        Index l = -1, r = -1;  // hull edges with the outside on their left (clockwise) and right (counterclockwise)
        if (left.edge >= 0) {
            l = edges_.prev(extreme(left.edge, axis, true));
            left.vertex = edges_.origin(l);
        }
        if (right.edge >= 0) {
            r = extreme(right.edge, axis, false);
            right.vertex = edges_.origin(r);
        }
        for (bool moved = true; moved;) {
            moved = false;
            while (l >= 0 && sites_.orient(left.vertex, edges_.target(l), right.vertex) > 0) {
                l = edges_.prev(l ^ 1);
                left.vertex = edges_.origin(l);
            }
            while (r >= 0 && sites_.orient(edges_.target(r), right.vertex, left.vertex) > 0) {
                r = edges_.next(r ^ 1);
                right.vertex = edges_.origin(r);
                moved = l >= 0;
            }
        }
        const Index base = edges_.make(free, right.vertex, left.vertex);
        if (r >= 0) {
            edges_.insert_before(base, r);
        }
        if (l >= 0) {
            edges_.insert_after(base ^ 1, l);
        }
        return base;
    }

    // The counterclockwise hull edge out of the last (first) point along the axis, by climbing along the hull from `e`.
    Index extreme(Index e, Axis axis, bool last) {
        const auto better = [&](Index a, Index b) {
            return last ? sites_.before(b, a, axis) : sites_.before(a, b, axis);
        };
        Index here = edges_.origin(e);
        bool forward = false;
        for (;;) {
            const Index there = edges_.target(e);
            if (!better(there, here)) {
                break;
            }
            e = edges_.next(e ^ 1);
            here = there;
            forward = true;
        }
        while (!forward) {
            const Index back = edges_.prev(e) ^ 1;
            const Index there = edges_.origin(back);
            if (!better(there, here)) {
                break;
            }
            e = back;
            here = there;
        }
        return e;
    }

    // The next edge of one side that the bubble meets, after taking out those that it has swallowed; -1 if the rest of
    // the side lies below the base edge.
    template <Side side>
    Index candidate(Index base, Index l, Index r, FreeBlocks& free) {
        constexpr bool is_left = side == Side::left;
        Index e = is_left ? edges_.next(base ^ 1) : edges_.prev(base);
        Index p = edges_.target(e);
        if (e == (is_left ? base ^ 1 : base) || sites_.orient(p, l, r) <= 0) {
            return -1;
        }
        for (;;) {
            const Index f = is_left ? edges_.next(e) : edges_.prev(e);
            if (f == (is_left ? base ^ 1 : base)) {
                return e;
            }
            const Index q = edges_.target(f);
            if (!sites_.in_circle(l, r, p, q)) {
                return e;
            }
            edges_.remove(free, e);
            e = f;
            p = q;
        }
    }

    // The next base edge: from the end of one candidate to the other side, so that the circle is empty.
    Index rise(Index base, Index from_left, Index from_right, FreeBlocks& free) {
        const Index l = edges_.target(base), r = edges_.origin(base);
        const Index p = from_left < 0 ? -1 : edges_.target(from_left);
        const Index q = from_right < 0 ? -1 : edges_.target(from_right);
        if (p < 0 || (q >= 0 && sites_.in_circle(p, l, r, q))) {
            const Index e = edges_.make(free, q, l);
            edges_.insert_before(e, from_right ^ 1);
            edges_.insert_after(e ^ 1, base ^ 1);
            return e;
        }
        const Index e = edges_.make(free, r, p);
        edges_.insert_before(e, base);
        edges_.insert_after(e ^ 1, from_left ^ 1);
        return e;
    }

    Edges& edges_;
    Sites& sites_;
    Stop stop_;
};

}  // namespace stereodel::engine
