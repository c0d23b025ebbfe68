// Unit vectors of given directions to about twice the precision, and their differences.
//
// Rounded unit vectors of two directions 1e-12 apart have a difference that is wrong from its fifth digit on. Two kinds
// are kept: `UnitVector`, off by less than 2^-101 in each component, for most work, and `Ray`, whose differences have a
// relative error, for what is closer together than that allows.
#pragma once

#include <algorithm>
#include <cmath>

#include "arithmetic/double_double.hpp"
#include "arithmetic/pair_arithmetic.hpp"
#include "predicates/ray_forms.hpp"
#include "predicates/ray_stages.hpp"

// Compilers put loops into vector registers only if nothing is called in them. STEREODEL_FLATTEN before a function:
// what it calls becomes part of it; STEREODEL_INLINE in place of `inline` before what that calls in turn, as clang goes
// no deeper than one call.
#if defined(__GNUC__)
#define STEREODEL_FLATTEN __attribute__((flatten))
#define STEREODEL_INLINE inline __attribute__((always_inline))
#else
#define STEREODEL_FLATTEN
#define STEREODEL_INLINE inline
#endif

namespace stereodel::voronoi {

namespace rays = predicates::rays;
using arithmetic::DoubleDouble;
using arithmetic::Pair;
using arithmetic::fast_two_sum;
using arithmetic::sqrt;
using arithmetic::two_difference;
using arithmetic::two_sum;

// hi + lo, |lo| <= ulp(hi)/2.
struct UnitVector {
    double hi[3];
    double lo[3];
};

// (1 + s)^(-1/2) - 1 for |s| <= 2^-47: the next term is below 2^-142.
inline double inverse_root_less_one(double s) {
    return s * (0.375 * s - 0.5);
}

// |v|^2 - 1 of a vector of length 1 within 2^-48. The squares, their sums and the difference are exact but for some
// 10u^2, and what is left is rounded once: off by 12u^2 < 2^-102.
STEREODEL_INLINE double excess(const Pair* v) {
    const Pair square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    return (square.h - 1.0) + square.l;
}

// An exact multiple of the vector, of length 1 within 2^-49: most vectors are that themselves.
inline void near_unit(const double* vector, Pair* v) {
    if (rays::is_unit(vector)) {
        for (int k = 0; k < 3; ++k) {
            v[k] = {vector[k], 0.0};
        }
        return;
    }
    const rays::Direction d(vector);
    for (int k = 0; k < 3; ++k) {
        v[k] = {d.hi[k], d.lo[k]};
    }
}

// c is the correction of the length: hi + (lo + c hi). The last term is at most 2^-48, rounded twice, and half the
// error of `excess`: 2^-102 for each of the two.
inline UnitVector unit_vector(const double* vector) {
    Pair v[3];
    near_unit(vector, v);
    const double correction = inverse_root_less_one(excess(v));
    UnitVector unit;
    for (int k = 0; k < 3; ++k) {
        const DoubleDouble sum = fast_two_sum(v[k].h, v[k].l + correction * v[k].h);
        unit.hi[k] = sum.hi;
        unit.lo[k] = sum.lo;
    }
    return unit;
}

// A difference as pairs: off by 2^-100 and 4u^2 of itself.
struct PairedEdge {
    Pair v[3];

    PairedEdge(const UnitVector& from, const UnitVector& to) {
        for (int k = 0; k < 3; ++k) {
            const DoubleDouble high = two_difference(to.hi[k], from.hi[k]);
            const DoubleDouble sum = two_sum(high.hi, high.lo + (to.lo[k] - from.lo[k]));
            v[k] = {sum.hi, sum.lo};
        }
    }
};

inline void cross(const DoubleDouble* a, const DoubleDouble* b, DoubleDouble* result) {
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        result[k] = a[i] * b[j] - a[j] * b[i];
    }
}

// An exact multiple of a vector, of length 1 within 2^-49, and its length.
struct Ray {
    DoubleDouble v[3], length;

    explicit Ray(const double* vector) {
        const rays::Direction d(vector);
        for (int k = 0; k < 3; ++k) {
            v[k] = {d.hi[k], d.lo[k]};
        }
        length = sqrt(rays::dot_form(v, v));
    }
};

// A difference of unit vectors, v 2^exponent with v of length 1 or so:
//     q/|q| - p/|p| = E = (G - q (|q| - |p|)/|q|) / |p|,  G = q - p,  |q| - |p| = G.(q + p)/(|q| + |p|).
// Sums and differences in double-double are relatively right even where they cancel, and G is brought to length 1
// first: off by less than 2^-98 |G|, `loss` = |G|/|E| times that of itself. That is 1 or so but where the directions
// differ by less than the lengths, 2^-48.
struct RayEdge {
    DoubleDouble v[3];
    int exponent;
    double loss;

    RayEdge(const Ray& p, const Ray& q) {
        DoubleDouble difference[3], sum[3];
        for (int k = 0; k < 3; ++k) {
            difference[k] = q.v[k] - p.v[k];
            sum[k] = q.v[k] + p.v[k];
        }
        exponent = normalize(difference);
        const DoubleDouble growth = rays::dot_form(difference, sum) / (q.length * (q.length + p.length));
        for (int k = 0; k < 3; ++k) {
            v[k] = (difference[k] - q.v[k] * growth) / p.length;
        }
        const int more = normalize(v);
        exponent += more;
        loss = std::ldexp(2.0, -more);
    }

    // Brings the longest component to [1/2, 1); returns the exponent that was taken out.
    static int normalize(DoubleDouble* vector) {
        int taken = 0;
        std::frexp(std::max({std::fabs(vector[0].hi), std::fabs(vector[1].hi), std::fabs(vector[2].hi)}), &taken);
        for (int k = 0; k < 3; ++k) {
            vector[k] = {std::ldexp(vector[k].hi, -taken), std::ldexp(vector[k].lo, -taken)};
        }
        return taken;
    }
};

inline double length_squared(const Pair* v) {
    return v[0].h * v[0].h + v[1].h * v[1].h + v[2].h * v[2].h;
}

// v/|v| rounded once, for v of length between 2^-300 and 2^300, known to twice the precision, with low parts of less
// than 2^-29 |v|: |w|^2 is 1 within 2^-27, so that less than 2^-56 is lost where low parts meet the correction.
inline void round_unit(const Pair* v, double* result) {
    const double factor = 1.0 / std::sqrt(length_squared(v));
    Pair w[3];
    for (int k = 0; k < 3; ++k) {
        w[k] = factor * v[k];
    }
    const double correction = inverse_root_less_one(excess(w));
    for (int k = 0; k < 3; ++k) {
        result[k] = w[k].h + (w[k].l + correction * w[k].h) + 0.0;  // no negative zero
    }
}

}  // namespace stereodel::voronoi
