#include "predicates/ray_order.hpp"

#include <algorithm>
#include <cmath>

#include "arithmetic/error_counts.hpp"
#include "arithmetic/pair_arithmetic.hpp"
#include "predicates/ray_integers.hpp"
#include "predicates/ray_lengths.hpp"

namespace stereodel::predicates::rays {

using arithmetic::ErrorCount;
using arithmetic::Pair;
using arithmetic::sqrt;
using arithmetic::two_product;

namespace {

// a_k^2 (b_i^2 + b_j^2) - b_k^2 (a_i^2 + a_j^2): the squares compared, without the common term a_k^2 b_k^2.
template <class Number>
constexpr Number component_form(const Number* a, const Number* b, int k, int i, int j) {
    return (a[k] * a[k]) * (b[i] * b[i] + b[j] * b[j]) - (b[k] * b[k]) * (a[i] * a[i] + a[j] * a[j]);
}

constexpr ErrorCount PAIRED[3] = {{1, 0}, {1, 0}, {1, 0}};
constexpr RoundingCount EXACT[3] = {{0}, {0}, {0}};
constexpr double COMPONENT_ROUNDING = 6, COMPONENT_ERROR = 112;
static_assert(component_form(EXACT, EXACT, 0, 1, 2).bound() <= COMPONENT_ROUNDING);
static_assert(component_form(PAIRED, PAIRED, 0, 1, 2).bound() <= COMPONENT_ERROR);

// Equal by symmetry: the case of mirrored points, lattices and circles of latitude, and of most exact ties.
bool same_component(const double* a, const double* b, int k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    if (a[k] == 0.0 || b[k] == 0.0) {
        return a[k] == b[k];
    }
    const double ai = std::fabs(a[i]), aj = std::fabs(a[j]), bi = std::fabs(b[i]), bj = std::fabs(b[j]);
    return a[k] == b[k] && ((ai == bi && aj == bj) || (ai == bj && aj == bi));
}

// Mirror images have the same largest component: cheaper to compare than all of them.
double largest(const double* a) {
    return std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])});
}

// x_k -> -x_k
bool opposite_along(const double* a, const double* b, int k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    return a[k] == -b[k] && a[i] == b[i] && a[j] == b[j];
}

// x_i <-> s x_j, s = 1 or -1
bool exchanged_around(const double* a, const double* b, int k, double s) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    return a[k] == b[k] && a[i] == s * b[j] && a[j] == s * b[i];
}

// Chords between mirror images are normal to the mirror: two of them are parallel, and their ends in one plane.
bool are_mirrored(const double* a, const double* b, const double* c, const double* d) {
    for (int k = 0; k < 3; ++k) {
        if ((opposite_along(a, b, k) && opposite_along(c, d, k)) ||
            (exchanged_around(a, b, k, 1.0) && exchanged_around(c, d, k, 1.0)) ||
            (exchanged_around(a, b, k, -1.0) && exchanged_around(c, d, k, -1.0))) {
            return true;
        }
    }
    return false;
}

}  // namespace

bool cocircular_by_symmetry(const double* a, const double* b, const double* c, const double* p) {
    const double la = largest(a), lb = largest(b), lc = largest(c), lp = largest(p);
    if ((la == lb && lc == lp && are_mirrored(a, b, c, p)) || (la == lc && lb == lp && are_mirrored(a, c, b, p)) ||
        (la == lp && lb == lc && are_mirrored(a, p, b, c))) {
        return true;
    }
    for (int k = 0; k < 3; ++k) {
        const bool equal = a[k] == b[k] && a[k] == c[k] && a[k] == p[k];  // cheap, and seldom true
        if (equal && same_component(a, b, k) && same_component(a, c, k) && same_component(a, p, k)) {
            return true;
        }
    }
    return false;
}

bool on_mirror(const double* a, const double* b, const double* c) {
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        if ((a[k] == 0.0 && b[k] == 0.0 && c[k] == 0.0) || (a[i] == a[j] && b[i] == b[j] && c[i] == c[j]) ||
            (a[i] == -a[j] && b[i] == -b[j] && c[i] == -c[j])) {
            return true;
        }
    }
    return false;
}

namespace {

// Whether a_i b_j = a_j b_i, as far as exact products in doubles tell.
bool minor_vanishes(const double* a, const double* b, int i, int j) {
    const DoubleDouble left = two_product(a[i], b[j]), right = two_product(a[j], b[i]);
    const double size = std::fabs(left.hi);
    if (a[i] == 0.0 || b[j] == 0.0) {
        return a[j] == 0.0 || b[i] == 0.0;
    }
    return size > 0x1p-900 && size < 0x1p1000 && left.hi == right.hi && left.lo == right.lo;
}

}  // namespace

int shadow(const double* a, const double* b, const double* c, int axis, bool unit) {
    for (int k = 0; k < 3; ++k) {
        if (k != axis && same_component(a, b, k) && same_component(a, c, k)) {
            return 0;
        }
    }
    const Sign sign = unit ? shadow_filter(a, b, c, axis) : shadow_of_rounded(a, b, c, axis);
    if (sign != OPEN) {
        return sign;
    }
    // A great circle seen from its side: each term is zero.
    const int i = axis == 0 ? 1 : 0, j = axis == 2 ? 1 : 2;
    const bool flat = minor_vanishes(a, b, i, j) && minor_vanishes(b, c, i, j) && minor_vanishes(a, c, i, j);
    return flat ? 0 : shadow_exact(a, b, c, axis);
}

// Rounded to length one, components are off by 4.5u of themselves, and small ones by underflow: far less than what the
// filter allows for.
Sign shadow_of_rounded(const double* a, const double* b, const double* c, int axis) {
    double unit[3][3];
    int i = 0;
    for (const double* p : {a, b, c}) {
        const double square = dot_form(p, p);
        if (!(square > 0x1p-900 && square < 0x1p900)) {
            return OPEN;
        }
        const double factor = 1.0 / std::sqrt(square);
        for (int k = 0; k < 3; ++k) {
            unit[i][k] = p[k] * factor;
        }
        ++i;
    }
    return shadow_filter(unit[0], unit[1], unit[2], axis);
}

// Components of the unit vectors are within 1.01 * 2^-49 of those given, differences, at most 2.01, within 2^-47.8 of
// the computed ones. Two products of two of them: 4 * 2.01 * 2^-47.8 and less than 2^-49 of roundings.
Sign shadow_filter(const double* a, const double* b, const double* c, int axis) {
    const int i = axis == 0 ? 1 : 0, j = axis == 2 ? 1 : 2;
    return decide((b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]), 0x1p-44);
}

int compare_component(const double* a, const double* b, int k, bool unit) {
    if (same_component(a, b, k)) {
        return 0;
    }
    const int sign_a = sign_of(a[k]), sign_b = sign_of(b[k]);
    if (sign_a != sign_b) {
        return sign_a < sign_b ? -1 : 1;
    }
    Sign sign = unit ? compare_component_filter(a, b, k) : compare_component_squares(a, b, k);
    if (sign == OPEN) {
        sign = compare_component_double_double(a, b, k);
    }
    return sign != OPEN ? sign : compare_component_exact(a, b, k);
}

// Lengths change the components by factors within 1.01 * 2^-49 of 1: two numbers of one sign keep their order if they
// differ by more than 2^-48 of their larger one (with some room for the roundings here). Nothing underflows that
// counts: a difference of doubles is at least 2^-1074.
Sign compare_component_filter(const double* a, const double* b, int k) {
    return decide(a[k] - b[k], 0x1p-47 * (std::fabs(a[k]) + std::fabs(b[k])));
}

// Underflow in a square or sum of squares of a meets factors at most |b|^2, and the other way round; what the last
// products lose meets nothing.
Sign compare_component_squares(const double* a, const double* b, int k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double aa = dot_form(a, a), bb = dot_form(b, b);
    const double permanent = a[k] * a[k] * bb + b[k] * b[k] * aa;
    const double bound = COMPONENT_ROUNDING * UNIT_ROUNDOFF * permanent + plane::FLOOR * (aa + bb + 1);
    const Sign squares = decide(component_form(a, b, k, i, j), bound);
    return squares == OPEN ? OPEN : sign_of(a[k]) * squares;
}

Sign compare_component_double_double(const double* a, const double* b, int k) {
    const Direction da(a), db(b);
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const Pair pa[3] = {{da.hi[0], da.lo[0]}, {da.hi[1], da.lo[1]}, {da.hi[2], da.lo[2]}};
    const Pair pb[3] = {{db.hi[0], db.lo[0]}, {db.hi[1], db.lo[1]}, {db.hi[2], db.lo[2]}};
    const Pair value = component_form(pa, pb, k, i, j);
    const double permanent =
        dot_form(db.hi, db.hi) * da.hi[k] * da.hi[k] + dot_form(da.hi, da.hi) * db.hi[k] * db.hi[k];
    const Sign squares =
        decide(value.h + value.l, COMPONENT_ERROR * UNIT_ROUNDOFF * UNIT_ROUNDOFF * permanent + plane::FLOOR);
    const int sign_a = sign_of(a[k]), sign_b = sign_of(b[k]);
    if (sign_a != sign_b) {
        return sign_a < sign_b ? -1 : 1;
    }
    return squares == OPEN ? OPEN : sign_a * squares;
}

int compare(const double* a, const double* b, bool unit) {
    for (int k = 0; k < 3; ++k) {
        if (const int sign = compare_component(a, b, k, unit)) {
            return sign;
        }
    }
    return 0;
}

Sign compare_angles_filter(const Direction& q, const Direction& a, const Direction& b) {
    return compare_squared_chords(squared_chord(q, a), squared_chord(q, b));
}

// (q.b)|a| - (q.a)|b| in double-double. A dot product of vectors of length one is off by less than 7u^2 + 2 * 3.1u^2 <
// 14u^2, a length by (7 + 6.2)/2 u^2 + 5u^2 < 12u^2, their product by 14 + 12 + 7 = 33u^2; twice that, and 3.1u^2 of a
// difference of at most 2 for the last operation: below 80u^2. Underflow is nothing beside it.
Sign compare_angles_double_double(const Direction& q, const Direction& a, const Direction& b) {
    const DoubleDouble value = dot(q, b) * sqrt(dot(a, a)) - dot(q, a) * sqrt(dot(b, b));
    return decide(value.hi, 80 * UNIT_ROUNDOFF * UNIT_ROUNDOFF);
}

}  // namespace stereodel::predicates::rays
