// The stages of the predicates on directions: doubles, about twice the precision, integers with roots.
//
// The test of four directions is the sign of
//     W = |a| det[b c p] - |b| det[a c p] + |c| det[a b p] - |p| det[a b c],
// 1 if p lies in the open bubble of abc. With D_i = i - a and e_i = |i| - |a|, for vectors of any length,
//     -2|a| W = (|Db|^2 - eb^2) det[a Dc Dp] + (|Dc|^2 - ec^2) det[a Dp Db] + (|Dp|^2 - ep^2) det[a Db Dc].
// Proof. Expanding the determinant with rows (i, |i|) by its last column, |i| = |a| + e_i, gives
//     W = |a| det[Db Dc Dp] - eb det[a Dc Dp] - ec det[a Dp Db] - ep det[a Db Dc];
// by Cramer's rule
//     |a|^2 det[Db Dc Dp] = (a.Db) det[a Dc Dp] + (a.Dc) det[a Dp Db] + (a.Dp) det[a Db Dc];
// and 2 a.D_i = |i|^2 - |a|^2 - |D_i|^2 = e_i^2 + 2|a| e_i - |D_i|^2.
// This is the curvature form of the paper's idea to lift flat regions (row P6 of the ledger): differences first,
// nothing cancels but what an incircle test cancels. The lengths enter squared: vectors within 2^-49 of length one can
// be taken as they stand. All others are multiplied by a double near 1/|p|, without rounding: see `Direction`.
//
// Rounding errors are counted as in error_counts.hpp, underflow as in plane_stages.hpp.
#pragma once

#include <cmath>

#include "arithmetic/error_counts.hpp"
#include "predicates/plane_stages.hpp"
#include "predicates/ray_forms.hpp"
#include "tally.hpp"

namespace stereodel::predicates::rays {

using arithmetic::RoundingCount;
using arithmetic::UNIT_ROUNDOFF;

using plane::Estimate;

// A multiple of a vector, hi + lo in each component, of length 1 within 2^-49. The factor is a double (and a power of
// two) and the products are exact, but for underflow: off by less than 2^-1070. So the direction is exact.
struct Direction {
    double hi[3];
    double lo[3];

    explicit Direction(const double* vector);
};

// A difference of vectors hi + lo, in doubles. Where the difference of the high parts rounds at all (it does not
// between a/2 and 2a) it exceeds the low parts by 2^51 or more and counts as one relative rounding; the last sum is a
// second one. The difference of the low parts, at most 2^-52, rounds by at most 2^-106: an absolute error,
// beside which the vectors may have their own.
struct Difference {
    double v[3];

    template <class Vector>
    Difference(const Vector& from, const Vector& to) {
        for (int k = 0; k < 3; ++k) {
            v[k] = (to.hi[k] - from.hi[k]) + (to.lo[k] - from.lo[k]);
        }
    }
};

// Whether |p| is certainly within 2^-49 of 1. The computed square is off by less than 3.1u = 0.78 * 2^-51, the
// difference by nothing, and ||p|^2 - 1| <= 2^-48 - 2^-98 suffices.
inline bool is_unit(const double* p) {
    return std::fabs(dot_form(p, p) - 1.0) <= 0x1p-48 - 0x1p-51;
}

// (2^-48)^2 for the neglected e_i^2, and twice that for all that is far smaller.
constexpr double LENGTHS = 0x1p-95;

// The curvature form without the e_i, from a and rounded differences, and the error's bound `rounding` * (BC + CP + PB)
// + LENGTHS * (B + C + P) + floor with B = |Db|^2 and so on.
//
// Its permanent is at most sqrt(2) (1 + 2^-49) lb lc lp (lb + lc + lp), the l being lengths of differences, and so at
// most ROOT_TWO (BC + CP + PB), as lb^2 lc lp <= B (C + P)/2 and so on. Neglected: e_i^2 <= 2^-96 times |det[a Dj Dk]|
// <= (1 + 2^-49) lj lk, and the sum of the lj lk is at most B + C + P.
inline Estimate curvature_form(const double* a, const double* db, const double* dc, const double* dp, double rounding,
                               double floor) {
    const double bb = dot_form(db, db), cc = dot_form(dc, dc), pp = dot_form(dp, dp);
    const double value = weighted_form(bb, determinant_form(a, dc, dp), cc, determinant_form(a, dp, db), pp,
                                       determinant_form(a, db, dc));
    const double permanent = bb * (cc + pp) + cc * pp;
    return {-value, rounding * permanent + (LENGTHS * (bb + (cc + pp)) + floor), permanent};
}

constexpr double ROOT_TWO = 1.4143;

template <class Scalar, class Number>
constexpr double bubble_bound(const Scalar* a, const Number* edge) {
    const Number square = dot_form(edge, edge), determinant = determinant_form(a, edge, edge);
    return ROOT_TWO * weighted_form(square, determinant, square, determinant, square, determinant).bound();
}

template <class Scalar, class Number>
constexpr double turn_bound(const Scalar* a, const Number* edge) {
    return ROOT_TWO * determinant_form(a, edge, edge).bound();
}

constexpr RoundingCount EXACT[3] = {{0}, {0}, {0}}, ROUNDED[3] = {{1}, {1}, {1}}, TWICE_ROUNDED[3] = {{2}, {2}, {2}};

// Of vectors of length one as they stand. Underflow: all factors are at most 4 or so.
constexpr double BUBBLE_ROUNDING = 23;
static_assert(bubble_bound(EXACT, ROUNDED) <= BUBBLE_ROUNDING);

inline Estimate bubble_estimate(const double* a, const double* b, const double* c, const double* p) {
    const double db[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double dc[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const double dp[3] = {p[0] - a[0], p[1] - a[1], p[2] - a[2]};
    return curvature_form(a, db, dc, dp, BUBBLE_ROUNDING * UNIT_ROUNDOFF, plane::FLOOR);
}

// The same test as the side of the plane of a, b, c on which p lies: a third of the work, less sharp, and half of that
// is done once for all p. It is open where points are 2^-22 or so apart.
//
// The three differences from a have lengths of at most 2.01 and are off by their roundings, u of that, and by the
// lengths of the vectors, 2^-49 twice: by less than e = 1.1 * 2^-48. With S the sum of their squares this moves the
// determinant by at most e (|b||c| + |c||p| + |p||b|) + e^2 (|b| + |c| + |p|) + e^3 <= 1.5 e S + 2.5 e^3, since
// e |b| <= (e^2 + |b|^2)/2. Each of its six terms is rounded five times: at most 5.01u ROOT_TWO |b||c||p| <= 7.3u S.
// Together less than 1.9 * 2^-48 S + 2^-141, and what underflow loses is far below the constant.
class BubblePlane {
  public:
    BubblePlane() = default;
    BubblePlane(const double* a, const double* b, const double* c) {
        const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        const double v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
        normal_[0] = u[1] * v[2] - u[2] * v[1];
        normal_[1] = u[2] * v[0] - u[0] * v[2];
        normal_[2] = u[0] * v[1] - u[1] * v[0];
        squares_ = dot_form(u, u) + dot_form(v, v);
    }

    // The test of a, b, c and p, a being the first corner.
    Sign side(const double* a, const double* p) const {
        const double d[3] = {p[0] - a[0], p[1] - a[1], p[2] - a[2]};
        return decide(dot_form(d, normal_), 0x1p-47 * (squares_ + dot_form(d, d)) + 0x1p-140);
    }

  private:
    double normal_[3], squares_;
};

// Of normalised directions.
Estimate bubble_estimate(const Direction& a, const Direction& b, const Direction& c, const Direction& p);

// det[a b c] = det[a Db Dc] of vectors with lengths between 1/2 and 2, as they stand: the error is below
// TURN_ROUNDING u lb lc |a|, and compared by its square. What underflow loses, some 2^-1070, is nothing beside the root
// of FLOOR, what it takes from the bound nothing beside FLOOR.
constexpr double TURN_ROUNDING = 12;
static_assert(turn_bound(EXACT, ROUNDED) <= TURN_ROUNDING);

inline Sign turn_filter(const double* a, const double* b, const double* c) {
    const double db[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double dc[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const double value = determinant_form(a, db, dc);
    constexpr double ROUNDING = TURN_ROUNDING * UNIT_ROUNDOFF;
    const double lengths = dot_form(a, a) * (dot_form(db, db) * dot_form(dc, dc));
    return value * value > ROUNDING * ROUNDING * lengths + plane::FLOOR ? sign_of(value) : OPEN;
}

// Of normalised directions.
Sign turn_filter(const Direction& a, const Direction& b, const Direction& c);

// About twice the precision: of vectors of length one as they stand, and of normalised directions.
Sign bubble_double_double(const double* a, const double* b, const double* c, const double* p);
Sign bubble_double_double(const Direction& a, const Direction& b, const Direction& c, const Direction& p);
Sign turn_double_double(const double* a, const double* b, const double* c);
Sign turn_double_double(const Direction& a, const Direction& b, const Direction& c);

}  // namespace stereodel::predicates::rays
