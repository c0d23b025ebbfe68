// The folder `arithmetic`: numbers that hold more than a double, and the error bounds of those that do not.
// Reading order: double_double; pair_arithmetic, the same with unnormalised halves; error_counts, bounds that the
// compiler counts; bounded and ball, double-doubles that carry their error, and ball_vectors; wrapping_integer,
// big_integer, roots (signs of sums of square roots), integer_quotients; big_ball, many digits with their error;
// arc_tangent.
//
// Double-double arithmetic: a value is the unevaluated sum hi + lo, |lo| <= ulp(hi)/2, about 106 bits.
//
// The error-free transformations are Knuth's (two_sum) and Dekker's and Veltkamp's (two_product: no fused
// multiply-add, so that every processor rounds alike). Relative errors of the operations, u = 2^-53:
//   sum, difference  3u^2 + 13u^3   (M. Joldes, J.-M. Muller, V. Popescu, "Tight and rigorous error bounds for basic
//   product          7u^2            building blocks of double-word arithmetic", ACM TOMS 44 (2017): algorithms 6, 10)
//   quotient         11u^2          (derived at the operator)
//   root             5u^2           (derived at the function)
// for magnitudes between 2^-480 and 2^480; below, the error is absolute, under 2^-1022. The same operations in the same
// order as stereodel/_double_double.py: the same bits.
#pragma once

#include <cmath>

namespace stereodel::arithmetic {

struct DoubleDouble {
    double hi = 0.0;
    double lo = 0.0;
};

// a + b = hi + lo exactly.
inline DoubleDouble two_sum(double a, double b) {
    const double s = a + b;
    const double shadow = s - a;
    return {s, (a - (s - shadow)) + (b - shadow)};
}

inline DoubleDouble two_difference(double a, double b) {
    const double s = a - b;
    const double shadow = s - a;
    return {s, (a - (s - shadow)) - (b + shadow)};
}

// The same as two_sum in three operations, for |a| >= |b| or a = 0.
inline DoubleDouble fast_two_sum(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
}

// Veltkamp: a = hi + lo with at most 26 bits each.
inline DoubleDouble split(double a) {
    constexpr double SPLITTER = 134217729.0;  // 2^27 + 1
    const double scaled = SPLITTER * a;
    const double high = scaled - (scaled - a);
    return {high, a - high};
}

// a * b = hi + lo exactly, if no part underflows; else up to 2^-1072 (five halves of a smallest subnormal) beside it.
inline DoubleDouble two_product(double a, double b) {
    const double p = a * b;
    const DoubleDouble x = split(a), y = split(b);
    return {p, ((x.hi * y.hi - p) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
}

inline DoubleDouble operator-(DoubleDouble a) {
    return {-a.hi, -a.lo};
}

inline DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
    const DoubleDouble s = two_sum(a.hi, b.hi), t = two_sum(a.lo, b.lo);
    const DoubleDouble v = fast_two_sum(s.hi, s.lo + t.hi);
    return fast_two_sum(v.hi, v.lo + t.lo);
}

inline DoubleDouble operator-(DoubleDouble a, DoubleDouble b) {
    return a + -b;
}

inline DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
    const DoubleDouble p = two_product(a.hi, b.hi);
    return fast_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

// Long division. The first digit is off by 3u (two operands cut to hi, one rounding); what it leaves, at most 3.1u|a|,
// is known up to the product's 7u^2|a|; the second digit is off by 3.1u of that and the third makes this third order.
// With the last sum: 7u^2 + 3u^2 and terms of third order.
inline DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
    const double first = a.hi / b.hi;
    DoubleDouble rest = a - b * DoubleDouble{first, 0.0};
    const double second = rest.hi / b.hi;
    rest = rest - b * DoubleDouble{second, 0.0};
    return fast_two_sum(first, second) + DoubleDouble{rest.hi / b.hi, 0.0};
}

// Square root; 0 at 0, NaN below. One Newton step: a - root^2 is at most 3u*a, so that its rounding and that of the
// quotient cost 1.5u^2 each, the neglected square (3u)^2/8, the error of the difference is of third order.
inline DoubleDouble sqrt(DoubleDouble a) {
    const double root = std::sqrt(a.hi);
    const DoubleDouble rest = a - two_product(root, root);
    return fast_two_sum(root, root == 0.0 ? 0.0 : rest.hi / (2 * root));
}

}  // namespace stereodel::arithmetic
