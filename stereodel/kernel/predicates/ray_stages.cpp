#include "predicates/ray_stages.hpp"

#include <algorithm>

#include "arithmetic/pair_arithmetic.hpp"

namespace stereodel::predicates::rays {

using arithmetic::DoubleDouble;
using arithmetic::ErrorCount;
using arithmetic::Pair;
using arithmetic::PlainCount;
using arithmetic::pair_difference;
using arithmetic::two_difference;
using arithmetic::two_product;
using arithmetic::two_sum;

namespace {

constexpr double U2 = UNIT_ROUNDOFF * UNIT_ROUNDOFF;

// Difference vectors as pairs: exact where the vectors are plain doubles.
struct PairEdge {
    Pair v[3];

    PairEdge(const double* from, const double* to) {
        for (int k = 0; k < 3; ++k) {
            v[k] = pair_difference(to[k], from[k]);
        }
    }

    // h + r + e1 + e2 is exact, with e1 = 0 unless |h| exceeds 2^51 times the low parts, and |e2| <= 2^-106. Adding up
    // the small ones rounds by less than 4u^2 |h| and 2^-157, an absolute error; the last line makes |l| <= u|h|.
    PairEdge(const Direction& from, const Direction& to) {
        for (int k = 0; k < 3; ++k) {
            const DoubleDouble high = two_difference(to.hi[k], from.hi[k]), low = two_difference(to.lo[k], from.lo[k]);
            const DoubleDouble sum = two_sum(high.hi, low.hi);
            const DoubleDouble result = two_sum(sum.hi, sum.lo + (high.lo + low.lo));
            v[k] = {result.hi, result.lo};
        }
    }
};

struct Plain {
    const double* v;

    explicit Plain(const double* vector) : v(vector) {}
};

struct Paired {
    Pair v[3];

    explicit Paired(const Direction& d) : v{{d.hi[0], d.lo[0]}, {d.hi[1], d.lo[1]}, {d.hi[2], d.lo[2]}} {}
};

constexpr PlainCount PLAIN[3] = {};
constexpr ErrorCount PAIRED[3] = {{1, 0}, {1, 0}, {1, 0}};
constexpr ErrorCount EDGE[3] = {{1, 5}, {1, 5}, {1, 5}};  // of directions; those of plain vectors are exact

constexpr double BUBBLE_ERROR = 460;
static_assert(bubble_bound(PLAIN, EDGE) <= BUBBLE_ERROR && bubble_bound(PAIRED, EDGE) <= BUBBLE_ERROR);
constexpr double TURN_ERROR = 120;
static_assert(turn_bound(PLAIN, EDGE) <= TURN_ERROR && turn_bound(PAIRED, EDGE) <= TURN_ERROR);

template <class Scalar>
constexpr double growth_bound(const Scalar* a) {
    return growth_form(dot_form(EDGE, EDGE), dot_form(a, EDGE)).bound();
}

// The e_i, where their squares matter: e_i = (|i|^2 - |a|^2)/(|i| + |a|), and the denominator is 2 within 2^-49 of
// itself. The numerator |D|^2 + 2a.D has a majorant below 4.1 |D_i| and so is known within 2^-97 |D_i| (and 2^-154 of
// the directions). With |e_i| <= 2^-48 and |D_i| < 2.1, e_i^2 is known within
//     2^-96 * 2^-47.9 + 2 * 2^-48 * 2^-98 * 2.1 < 2^-142.8,
// times the determinants, summed in doubles, within 2^-142.5 times the lj lk, whose sum is at most B + C + P.
static_assert(4.1 * growth_bound(PLAIN) <= 0x1p9 && 4.1 * growth_bound(PAIRED) <= 0x1p9);
constexpr double LENGTHS_KNOWN = 0x1p-142;

template <class Scalar>
double length_difference_squared(const Scalar* a, const Pair* edge, const Pair& square) {
    const Pair growth = growth_form(square, dot_form(a, edge));
    const double difference = 0.5 * (growth.h + growth.l);
    return difference * difference;
}

// The curvature form in pairs, the e_i first neglected, then added.
template <class Scalar>
Sign bubble_in_pairs(const Scalar* a, const Pair* db, const Pair* dc, const Pair* dp, double floor) {
    const Pair bb = dot_form(db, db), cc = dot_form(dc, dc), pp = dot_form(dp, dp);
    const Pair at_b = determinant_form(a, dc, dp), at_c = determinant_form(a, dp, db);
    const Pair at_p = determinant_form(a, db, dc);
    const Pair value = weighted_form(bb, at_b, cc, at_c, pp, at_p);
    const double sum = bb.h + (cc.h + pp.h), permanent = bb.h * (cc.h + pp.h) + cc.h * pp.h;
    const double bound = BUBBLE_ERROR * U2 * permanent + floor;
    const Sign sign = decide(-(value.h + value.l), bound + LENGTHS * sum);
    if (sign != OPEN) {
        return sign;
    }
    const double lengths = length_difference_squared(a, db, bb) * at_b.h +
                           length_difference_squared(a, dc, cc) * at_c.h +
                           length_difference_squared(a, dp, pp) * at_p.h;
    const DoubleDouble rest = two_difference(lengths, value.h);
    return decide(rest.hi + (rest.lo - value.l), bound + LENGTHS_KNOWN * sum);
}

// lb lc <= 2^-530 may underflow to zero under the root.
constexpr double TURN_FLOOR = 0x1p-500;

// |v|^2 - 1 within 2^-76, for |v|^2 within 2^-47.9 of 1. Components are rounded to multiples of 2^-26, whose squares
// and the sum of them are multiples of 2^-52 below 2: exact. The rests, at most 2^-27, are exact too. Their products
// with sums, which add up to 2^-27 * 2 * 1.733 at most, are rounded twice, and twice more as they are added: less than
// 4 * 2^-53 * 2^-25.2 = 2^-76.2. The result is so small that its own rounding is nothing beside that.
double square_less_one(const double* v) {
    constexpr double TO_GRID = 1.5 * 0x1p26;  // its neighbours are 2^-26 apart
    double squares = -1.0, rests = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double near = (v[k] + TO_GRID) - TO_GRID;
        squares += near * near;
        rests += (v[k] - near) * (v[k] + near);
    }
    return squares + rests;
}

struct Heads {
    double v[3];

    explicit Heads(const PairEdge& e) : v{e.v[0].h, e.v[1].h, e.v[2].h} {}
};

struct Tails {
    double v[3];

    explicit Tails(const PairEdge& e) : v{e.v[0].l, e.v[1].l, e.v[2].l} {}
    bool any() const { return v[0] != 0.0 || v[1] != 0.0 || v[2] != 0.0; }
};

// det[b c p] of exact edges within 2^-98 lb lc lp. Most differences of neighbours are doubles. Of the heads in pairs:
// HEADS_ERROR u^2. Tails are at most u times heads: three determinants of at most ROOT_TWO u each with one tail vector
// in it, which are rounded at most ten times until all are added; 4u^2 and less for two or three tail vectors in one.
constexpr ErrorCount PRODUCT = {1, 0}, MINOR = PRODUCT - PRODUCT, TERM = PlainCount{} * MINOR;
constexpr double HEADS_ERROR = 36;
static_assert(ROOT_TWO * (TERM + TERM + TERM).bound() <= HEADS_ERROR);
static_assert((HEADS_ERROR + 3 * 10 * ROOT_TWO + 3 * 4 * ROOT_TWO) * U2 < 0x1p-98);

Pair volume(const PairEdge& db, const PairEdge& dc, const PairEdge& dp) {
    const Heads b(db), c(dc), p(dp);
    const auto minor = [&](int i, int j) {
        const DoubleDouble left = two_product(c.v[i], p.v[j]), right = two_product(c.v[j], p.v[i]);
        return Pair{left.hi, left.lo} - Pair{right.hi, right.lo};
    };
    Pair result = b.v[0] * minor(1, 2) + b.v[1] * minor(2, 0) + b.v[2] * minor(0, 1);
    const Tails rb(db), rc(dc), rp(dp);
    if (rb.any() || rc.any() || rp.any()) {
        result.l += determinant_form(rb.v, c.v, p.v) + determinant_form(b.v, rc.v, p.v) +
                    determinant_form(b.v, c.v, rp.v);
    }
    return result;
}

// The side of the plane, as of a `BubblePlane`, with the lengths: a third of the work of the curvature form, but
// open where points are very close. Of vectors of length one as they stand.
//
// The first line of the proof in ray_stages.hpp, divided by |a|, is
//     W/|a| = det[Db Dc Dp] - fb det[a Dc Dp] - fc det[a Dp Db] - fp det[a Db Dc]   with
//     f_i = e_i/|a| = (|i|^2 - |a|^2)/(|a| (|i| + |a|)),
// where the denominator is 2 within 2^-47.9 of itself. Half of the numerator is known within 2^-76 and at most 2^-47.9:
// so is f_i, but for 2^-95. The determinants beside it are at most (1 + 2^-49) lj lk. They are computed in doubles, off
// by TURN_ROUNDING u lj lk, and three more roundings follow: times f_i less than 2^-96 lj lk. So the error of these
// terms is below 1.1 * 2^-76 times the sum of the lj lk, which is at most B + C + P. The first determinant and the last
// line add less than 2^-97 lb lc lp and 2^-105 (B + C + P); and lb lc lp < B + C + P.
Sign bubble_plane(const double* a, const double* b, const double* c, const double* p, const PairEdge& ab,
                  const PairEdge& ac, const PairEdge& ap) {
    const Heads db(ab), dc(ac), dp(ap);
    const double sum = dot_form(db.v, db.v) + (dot_form(dc.v, dc.v) + dot_form(dp.v, dp.v));
    if (sum < 0x1p-36) {  // rounding the vectors moves the value by 2^-53 of a length cubed: too little to be seen
        return OPEN;
    }
    const double one = square_less_one(a);
    const double lengths = (square_less_one(b) - one) * determinant_form(a, dc.v, dp.v) +
                           (square_less_one(c) - one) * determinant_form(a, dp.v, db.v) +
                           (square_less_one(p) - one) * determinant_form(a, db.v, dc.v);
    const Pair solid = volume(ab, ac, ap);
    const DoubleDouble rest = two_difference(solid.h, 0.5 * lengths);
    return decide(rest.hi + (rest.lo + solid.l), 0x1p-75 * sum);
}

// `directions`: sqrt(3) times the absolute error of the D-vectors' components, `floor` that times itself, or
// TURN_FLOOR.
template <class Scalar>
Sign turn_in_pairs(const Scalar* a, const Pair* db, const Pair* dc, double directions, double floor) {
    const Pair value = determinant_form(a, db, dc);
    const double bb = dot_form(db, db).h, cc = dot_form(dc, dc).h;
    return decide(value.h + value.l,
                  TURN_ERROR * U2 * std::sqrt(bb * cc) + directions * (std::sqrt(bb) + std::sqrt(cc)) + floor);
}

// Absolute errors of D-vectors, each component off by h: with l the computed lengths + 4h, the form moves by at most
// sqrt(3) h (LM + 3 lb lc lp) <= 2.4 h LM, L the sum of the l and M that of their products in pairs; L <= 6 and M is at
// most 2 (B + C + P) + 100 h^2. For h = 2^-106 that is below 2^-100 (B + C + P), inside the room of LENGTHS, and
// 2^-300; for h = 2^-157 below 2^-151 (B + C + P), inside that of LENGTHS_KNOWN, and 2^-450.
constexpr double DIRECTIONS_FLOOR = 0x1p-300, DIRECTIONS_FLOOR_KNOWN = 0x1p-440;

}  // namespace

Direction::Direction(const double* vector) {
    const double largest = std::max({std::fabs(vector[0]), std::fabs(vector[1]), std::fabs(vector[2])});
    double v[3] = {vector[0], vector[1], vector[2]};
    if (!(largest > 0x1p-300 && largest < 0x1p300)) {
        int exponent = 0;
        std::frexp(largest, &exponent);
        for (double& component : v) {
            component = std::ldexp(component, -exponent);
        }
    }
    // Off by 3.5u: 1.5u of the square, the root, the quotient. Any double near serves.
    const double factor = 1.0 / std::sqrt(dot_form(v, v));
    for (int k = 0; k < 3; ++k) {
        const DoubleDouble product = two_product(v[k], factor);
        hi[k] = product.hi;
        lo[k] = product.lo;
    }
}

// The differences hold two roundings each and a.hi one.
constexpr double BUBBLE_ROUNDING_OF_DIRECTIONS = 30, TURN_ROUNDING_OF_DIRECTIONS = 16;
static_assert(bubble_bound(ROUNDED, TWICE_ROUNDED) <= BUBBLE_ROUNDING_OF_DIRECTIONS);
static_assert(turn_bound(ROUNDED, TWICE_ROUNDED) <= TURN_ROUNDING_OF_DIRECTIONS);

Estimate bubble_estimate(const Direction& a, const Direction& b, const Direction& c, const Direction& p) {
    const Difference db(a, b), dc(a, c), dp(a, p);
    return curvature_form(a.hi, db.v, dc.v, dp.v, BUBBLE_ROUNDING_OF_DIRECTIONS * UNIT_ROUNDOFF, DIRECTIONS_FLOOR);
}

// D-vectors off by h = 2^-106 in each component: sqrt(3) h (lb + lc + 2h).
Sign turn_filter(const Direction& a, const Direction& b, const Direction& c) {
    const Difference db(a, b), dc(a, c);
    const double bb = dot_form(db.v, db.v), cc = dot_form(dc.v, dc.v);
    const double rounding = TURN_ROUNDING_OF_DIRECTIONS * UNIT_ROUNDOFF * std::sqrt(bb * cc);
    const double directions = 0x1p-105 * (std::sqrt(bb) + std::sqrt(cc)) + 0x1p-208;
    return decide(determinant_form(a.hi, db.v, dc.v), rounding + directions);
}

Sign bubble_double_double(const double* a, const double* b, const double* c, const double* p) {
    const PairEdge db(a, b), dc(a, c), dp(a, p);
    const Sign sign = bubble_plane(a, b, c, p, db, dc, dp);
    return sign != OPEN ? sign : bubble_in_pairs(a, db.v, dc.v, dp.v, plane::FLOOR);
}

Sign bubble_double_double(const Direction& a, const Direction& b, const Direction& c, const Direction& p) {
    return bubble_in_pairs(Paired(a).v, PairEdge(a, b).v, PairEdge(a, c).v, PairEdge(a, p).v, DIRECTIONS_FLOOR_KNOWN);
}

Sign turn_double_double(const double* a, const double* b, const double* c) {
    return turn_in_pairs(a, PairEdge(a, b).v, PairEdge(a, c).v, 0.0, TURN_FLOOR);
}

Sign turn_double_double(const Direction& a, const Direction& b, const Direction& c) {
    return turn_in_pairs(Paired(a).v, PairEdge(a, b).v, PairEdge(a, c).v, 0x1p-156, 0x1p-310);
}

}  // namespace stereodel::predicates::rays
