// The folder `predicates`: exact signs, in stages: a filter in doubles, double-double, integers.
// Reading order, for points of the plane: plane_forms, the formulas for any kind of number; plane_stages, their bounds;
// plane_predicates, points by number and ties; circle_memo. For directions: ray_forms, ray_stages, ray_integers,
// ray_order, ray_lengths, ray_predicates. For space: space_predicates. Then predicate_rows, the public predicates on
// arrays, and symmetry, ties that need no arithmetic.
//
// Orientation and incircle of points of the plane by number, y up: the answers of exact arithmetic on their doubles.
//
// orient > 0: counterclockwise; incircle > 0: inside a counterclockwise triangle. Ties of `in_circle` are decided by
// infinitesimal displacement: the heights x^2 + y^2 grow by e, the more the earlier the point stands in lexicographic
// order (tests/reference.py).
#pragma once

#include <cstddef>

#include "predicates/circle_memo.hpp"
#include "predicates/plane_stages.hpp"
#include "tally.hpp"

namespace stereodel::predicates {

// The largest power of two of which all coordinates are multiples; 0 if it is outside 2^-240 .. 2^240.
double common_granularity(const double* xy, std::size_t count);

// A cheap view of the points; every thread has its own, with its own tally.
class PlanePoints {
  public:
    // xy[2i], xy[2i+1]; granularity: any power of two that divides all coordinates, 0 if none is known.
    PlanePoints(const double* xy, double granularity)
        : xy_(xy),
          exact_orient_(exact_up_to(granularity, 2)),
          exact_incircle_(exact_up_to(granularity, 4)),
          per_unit_(granularity > 0.0 ? 1.0 / granularity : 0.0) {}

    // From now on points keep their numbers and coordinates: ties of `in_circle` may be remembered.
    void remember_circles() { remembers_ = true; }

    const double* at(Index a) const { return xy_ + 2 * static_cast<std::ptrdiff_t>(a); }

    // Sign of (b-a) x (c-a), 0 for collinear and repeated points.
    int orient(Index a, Index b, Index c) {
        const plane::Estimate e = plane::orient_estimate(at(a), at(b), at(c));
        const Sign sign = decide(e.value, e.bound);
        return sign != OPEN ? sign : orient_open(at(a), at(b), at(c), e, exact_orient_);
    }

    int orient(Index a, Index b, const double* query) {
        const plane::Estimate e = plane::orient_estimate(at(a), at(b), query);
        const Sign sign = decide(e.value, e.bound);
        return sign != OPEN ? sign : orient_open(at(a), at(b), query, e, NOTHING);
    }

    // Whether d lies strictly inside the circle of abc, counterclockwise; d != a, b, c as points. Ties are displaced.
    bool in_circle(Index a, Index b, Index c, Index d) {
        const plane::Estimate e = plane::incircle_estimate(at(a), at(b), at(c), at(d));
        if (e.value > e.bound) {
            return true;
        }
        return !(e.value < -e.bound) && in_circle_open(a, b, c, d, e);
    }

    // Sign of the incircle determinant, ties stay 0.
    int incircle(Index a, Index b, Index c, Index d) {
        const plane::Estimate e = plane::incircle_estimate(at(a), at(b), at(c), at(d));
        const Sign sign = decide(e.value, e.bound);
        return sign != OPEN ? sign : incircle_open(at(a), at(b), at(c), at(d), e);
    }

    int incircle(Index a, Index b, Index c, const double* query) {
        const plane::Estimate e = plane::incircle_estimate(at(a), at(b), at(c), query);
        const Sign sign = decide(e.value, e.bound);
        return sign != OPEN ? sign : incircle_open(at(a), at(b), at(c), query, e);
    }

    // Sign of |q-a| - |q-b|.
    int compare_distances(const double* query, Index a, Index b) {
        return compare_distances(query, at(a), query, at(b));
    }

    // Sign of |p-a| - |q-b|.
    int compare_distances(const double* p, const double* a, const double* q, const double* b);

    Tally tally;

  private:
    // Differences of multiples of g are multiples of g, products of k of them multiples of g^k: exact while at most
    // 2^53 g^k. With 2^52 for the permanent, its own roundings do not count, and no factor can have been rounded: it
    // would exceed 2^53 g, the product 2^53 g^k, unless another factor is zero and the product exact.
    static double exact_up_to(double g, int k) {
        return g > 0.0 ? 0x1p52 * (k == 2 ? g * g : g * g * (g * g)) : NOTHING;
    }

    // Without a grid a permanent of zero may have underflowed and proves nothing.
    static constexpr double NOTHING = -1.0;

    int orient_open(const double* a, const double* b, const double* c, const plane::Estimate& e, double exact);
    int incircle_open(const double* a, const double* b, const double* c, const double* d, const plane::Estimate& e);
    // By a rectangle, or products that are exact.
    Sign incircle_known(const double* a, const double* b, const double* c, const double* d,
                        const plane::Estimate& e) const {
        if (plane::is_rectangle(a, b, c, d)) {
            return 0;
        }
        return e.permanent <= exact_incircle_ ? sign_of(e.value) : OPEN;
    }
    int incircle_close(const double* a, const double* b, const double* c, const double* d);
    int incircle_last(const double* a, const double* b, const double* c, const double* d) const;
    bool in_circle_open(Index a, Index b, Index c, Index d, const plane::Estimate& e);
    int counted(int sign) {
        tally.exact += sign == 0;
        return sign;
    }

    const double* xy_;
    double exact_orient_;
    double exact_incircle_;
    double per_unit_;  // 0 if no grid is known
    bool remembers_ = false;
    CircleMemo circles_;
};

// in_circle for four different cocircular points, as vectors: 1 or -1.
int incircle_tie(const double* a, const double* b, const double* c, const double* d);

}  // namespace stereodel::predicates
