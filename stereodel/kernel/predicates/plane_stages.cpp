#include "predicates/plane_stages.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "arithmetic/big_integer.hpp"
#include "arithmetic/pair_arithmetic.hpp"
#include "arithmetic/wrapping_integer.hpp"

namespace stereodel::predicates::plane {

using arithmetic::BigInteger;
using arithmetic::EVERY_EXPONENT;
using arithmetic::ErrorCount;
using arithmetic::Pair;
using arithmetic::WrappingInteger;
using arithmetic::lowest_exponent;
using arithmetic::pair_difference;

namespace {

constexpr ErrorCount EXACT_EDGE = {1, 0};
constexpr double ORIENT_ERROR = 16, INCIRCLE_ERROR = 112, DISTANCE_ERROR = 25;
static_assert(cross_form(EXACT_EDGE, EXACT_EDGE, EXACT_EDGE, EXACT_EDGE).bound() <= ORIENT_ERROR);
static_assert(dot_form(EXACT_EDGE, EXACT_EDGE, EXACT_EDGE, EXACT_EDGE).bound() <= ORIENT_ERROR);
static_assert(incircle_form(EXACT_EDGE, EXACT_EDGE, EXACT_EDGE, EXACT_EDGE, EXACT_EDGE, EXACT_EDGE).bound() <=
              INCIRCLE_ERROR);
static_assert((square_form(EXACT_EDGE, EXACT_EDGE) - square_form(EXACT_EDGE, EXACT_EDGE)).bound() <= DISTANCE_ERROR);

constexpr double U2 = UNIT_ROUNDOFF * UNIT_ROUNDOFF;

Sign decide_pair(Pair value, double bound) {
    return decide(value.h + value.l, bound);
}

struct Edge {
    Pair x, y;

    Edge(const double* from, const double* to)
        : x(pair_difference(to[0], from[0])), y(pair_difference(to[1], from[1])) {}
};

struct IntegerPoint {
    BigInteger x, y;
};

int common_exponent(std::initializer_list<const double*> points) {
    int exponent = EVERY_EXPONENT;
    for (const double* p : points) {
        exponent = std::min({exponent, lowest_exponent(p[0]), lowest_exponent(p[1])});
    }
    return exponent;
}

IntegerPoint integer_edge(const double* from, const double* to, int exponent) {
    return {BigInteger::from_double(to[0], exponent) - BigInteger::from_double(from[0], exponent),
            BigInteger::from_double(to[1], exponent) - BigInteger::from_double(from[1], exponent)};
}

// Points multiplied by a power of two, so that the largest coordinate has a size near one. That is exact but for
// numbers below 2^-1000 of it, which lose 2^-1074: FLOOR covers that as it does the underflow of products.
template <std::size_t COUNT>
struct Scaled {
    double xy[COUNT][2];

    explicit Scaled(const std::array<const double*, COUNT>& points) {
        double largest = 0.0;
        for (const double* p : points) {
            largest = std::max({largest, std::fabs(p[0]), std::fabs(p[1])});
        }
        int exponent = 0;
        std::frexp(largest, &exponent);
        const int half = -exponent / 2;  // 2^1074 is no double
        const double first = std::ldexp(1.0, half), second = std::ldexp(1.0, -exponent - half);
        for (std::size_t k = 0; k < COUNT; ++k) {
            xy[k][0] = points[k][0] * first * second;
            xy[k][1] = points[k][1] * first * second;
        }
    }
};

// Whether FLOOR is nothing beside the bounds, and nothing overflowed.
bool in_range(double permanent) {
    return permanent > 0x1p-800 && permanent < HUGE_VAL;
}

// What the pairs say about the points, or the first stage and the pairs about the scaled ones.
template <class EstimateOf, class InPairs, std::size_t... K, std::size_t COUNT = sizeof...(K)>
Sign in_pairs_or_scaled(const EstimateOf& estimate, const InPairs& in_pairs, std::index_sequence<K...>,
                        const std::array<const double*, COUNT>& points) {
    const Estimate plain = estimate(points[K]...);
    if (in_range(plain.permanent)) {
        return in_pairs(plain.permanent, points[K]...);
    }
    const Scaled<COUNT> scaled(points);
    const Estimate again = estimate(scaled.xy[K]...);
    const Sign sign = decide(again.value, again.bound);
    return sign != OPEN ? sign : in_pairs(again.permanent, scaled.xy[K]...);
}

Sign orient_in_pairs(double permanent, const double* a, const double* b, const double* c) {
    const Edge ab(a, b), ac(a, c);
    return decide_pair(cross_form(ab.x, ab.y, ac.x, ac.y), ORIENT_ERROR * U2 * permanent + FLOOR);
}

Sign incircle_in_pairs(double, const double* a, const double* b, const double* c, const double* d) {
    const Edge da(d, a), db(d, b), dc(d, c);
    const double aa = square_form(da.x.h, da.y.h), bb = square_form(db.x.h, db.y.h), cc = square_form(dc.x.h, dc.y.h);
    const double permanent = aa * (bb + cc) + bb * cc;
    return decide_pair(incircle_form(da.x, da.y, db.x, db.y, dc.x, dc.y),
                       INCIRCLE_ERROR * U2 * permanent + FLOOR * (aa + (bb + cc) + 1));
}

Sign diametral_in_pairs(double permanent, const double* a, const double* b, const double* p) {
    const Edge pa(p, a), pb(p, b);
    return decide_pair(dot_form(pa.x, pa.y, pb.x, pb.y), ORIENT_ERROR * U2 * permanent + FLOOR);
}

Sign distances_in_pairs(double permanent, const double* p, const double* a, const double* q, const double* b) {
    const Edge pa(p, a), qb(q, b);
    return decide_pair(square_form(pa.x, pa.y) - square_form(qb.x, qb.y), DISTANCE_ERROR * U2 * permanent + FLOOR);
}

using Three = std::make_index_sequence<3>;
using Four = std::make_index_sequence<4>;

}  // namespace

Sign orient_double_double(const double* a, const double* b, const double* c) {
    return in_pairs_or_scaled(orient_estimate, orient_in_pairs, Three{}, {a, b, c});
}

Sign incircle_double_double(const double* a, const double* b, const double* c, const double* d) {
    return in_pairs_or_scaled(incircle_estimate, incircle_in_pairs, Four{}, {a, b, c, d});
}

Sign diametral_double_double(const double* a, const double* b, const double* p) {
    return in_pairs_or_scaled(diametral_estimate, diametral_in_pairs, Three{}, {a, b, p});
}

Sign distances_double_double(const double* p, const double* a, const double* q, const double* b) {
    return in_pairs_or_scaled(distance_estimate, distances_in_pairs, Four{}, {p, a, q, b});
}

// The stage before found |value| at most its own bound, so the true value is at most twice that. In units of the grid
// it is an integer; below 2^126 nothing is lost modulo 2^128. Coordinates below 2^61 units have differences that fit in
// 64 bits.
Sign incircle_last_digits(const double* a, const double* b, const double* c, const double* d, double per_unit) {
    const Estimate e = incircle_estimate(a, b, c, d);
    const double square = per_unit * per_unit;
    double largest = 0.0;
    for (const double* p : {a, b, c, d}) {
        largest = std::max({largest, std::fabs(p[0]), std::fabs(p[1])});
    }
    if (!(largest * per_unit < 0x1p61) || !(2.1 * INCIRCLE_ERROR * U2 * e.permanent * square * square < 0x1p126)) {
        return OPEN;
    }
    const auto edge = [&](const double* p, int k) {
        const auto units = [&](double x) { return static_cast<std::int64_t>(x * per_unit); };
        return WrappingInteger(units(p[k]) - units(d[k]));
    };
    return incircle_form(edge(a, 0), edge(a, 1), edge(b, 0), edge(b, 1), edge(c, 0), edge(c, 1)).sign();
}

int orient_exact(const double* a, const double* b, const double* c) {
    const int exponent = common_exponent({a, b, c});
    const IntegerPoint ab = integer_edge(a, b, exponent), ac = integer_edge(a, c, exponent);
    return cross_form(ab.x, ab.y, ac.x, ac.y).sign();
}

int incircle_exact(const double* a, const double* b, const double* c, const double* d) {
    const int exponent = common_exponent({a, b, c, d});
    const IntegerPoint da = integer_edge(d, a, exponent), db = integer_edge(d, b, exponent),
                       dc = integer_edge(d, c, exponent);
    return incircle_form(da.x, da.y, db.x, db.y, dc.x, dc.y).sign();
}

int diametral_exact(const double* a, const double* b, const double* p) {
    const int exponent = common_exponent({a, b, p});
    const IntegerPoint pa = integer_edge(p, a, exponent), pb = integer_edge(p, b, exponent);
    return dot_form(pa.x, pa.y, pb.x, pb.y).sign();
}

int distances_exact(const double* p, const double* a, const double* q, const double* b) {
    const int exponent = common_exponent({p, a, q, b});
    const IntegerPoint pa = integer_edge(p, a, exponent), qb = integer_edge(q, b, exponent);
    return (square_form(pa.x, pa.y) - square_form(qb.x, qb.y)).sign();
}

bool is_rectangle_beside(const double* a, const double* b, const double* c, const double* d) {
    // o is the corner opposite to d, s and t are the other two.
    const auto opposite = [d](const double* o, const double* s, const double* t) {
        const bool s_beside = s[0] == d[0] && s[1] == o[1] && t[0] == o[0] && t[1] == d[1];
        const bool t_beside = t[0] == d[0] && t[1] == o[1] && s[0] == o[0] && s[1] == d[1];
        return s_beside || t_beside;
    };
    return opposite(a, b, c) || opposite(b, c, a) || opposite(c, a, b);
}

}  // namespace stereodel::predicates::plane
