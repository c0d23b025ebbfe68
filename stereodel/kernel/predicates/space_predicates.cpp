#include "predicates/space_predicates.hpp"

#include <algorithm>
#include <cmath>

#include "arithmetic/big_integer.hpp"
#include "arithmetic/error_counts.hpp"
#include "arithmetic/pair_arithmetic.hpp"
#include "predicates/plane_stages.hpp"
#include "predicates/ray_forms.hpp"

namespace stereodel::predicates::space {

using arithmetic::BigInteger;
using arithmetic::EVERY_EXPONENT;
using arithmetic::ErrorCount;
using arithmetic::Pair;
using arithmetic::RoundingCount;
using arithmetic::UNIT_ROUNDOFF;
using arithmetic::lowest_exponent;
using arithmetic::pair_difference;

namespace {

using rays::determinant_form;

constexpr RoundingCount ROUNDED[3] = {{1}, {1}, {1}};
constexpr double ROUNDING = 9;
static_assert(determinant_form(ROUNDED, ROUNDED, ROUNDED).bound() <= ROUNDING);

constexpr ErrorCount EXACT[3] = {{1, 0}, {1, 0}, {1, 0}};
constexpr double ERROR = 64;
static_assert(determinant_form(EXACT, EXACT, EXACT).bound() <= ERROR);

// What the bounds are multiples of, and what underflow may add: products of v and w meet the components of u, the last
// products meet nothing.
struct Size {
    double permanent, floor;

    Size(const double* u, const double* v, const double* w) : permanent(0.0), floor(1.0) {
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            permanent += std::fabs(u[i]) * (std::fabs(v[j] * w[k]) + std::fabs(v[k] * w[j]));
            floor += std::fabs(u[i]);
        }
        floor *= plane::FLOOR;
    }
};

struct SpaceEdge {
    Pair v[3];
    double high[3];

    SpaceEdge(const double* from, const double* to) {
        for (int k = 0; k < 3; ++k) {
            v[k] = pair_difference(to[k], from[k]);
            high[k] = v[k].h;
        }
    }
};

}  // namespace

Sign orient_filter(const double* a, const double* b, const double* c, const double* d) {
    const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const double w[3] = {d[0] - a[0], d[1] - a[1], d[2] - a[2]};
    const Size size(u, v, w);
    return decide(determinant_form(u, v, w), ROUNDING * UNIT_ROUNDOFF * size.permanent + size.floor);
}

Sign orient_double_double(const double* a, const double* b, const double* c, const double* d) {
    const SpaceEdge u(a, b), v(a, c), w(a, d);
    const Size size(u.high, v.high, w.high);
    const Pair value = determinant_form(u.v, v.v, w.v);
    return decide(value.h + value.l, ERROR * UNIT_ROUNDOFF * UNIT_ROUNDOFF * size.permanent + size.floor);
}

int orient_exact(const double* a, const double* b, const double* c, const double* d) {
    int exponent = EVERY_EXPONENT;
    for (const double* p : {a, b, c, d}) {
        exponent = std::min({exponent, lowest_exponent(p[0]), lowest_exponent(p[1]), lowest_exponent(p[2])});
    }
    const double* const ends[3] = {b, c, d};
    BigInteger edges[3][3];
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            edges[i][k] = BigInteger::from_double(ends[i][k], exponent) - BigInteger::from_double(a[k], exponent);
        }
    }
    return determinant_form(edges[0], edges[1], edges[2]).sign();
}

int orient(const double* a, const double* b, const double* c, const double* d) {
    Sign sign = orient_filter(a, b, c, d);
    if (sign == OPEN) {
        sign = orient_double_double(a, b, c, d);
    }
    return sign != OPEN ? sign : orient_exact(a, b, c, d);
}

}  // namespace stereodel::predicates::space
