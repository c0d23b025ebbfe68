// Sums of products in about twice the precision: pairs h + l that are never normalised, for stages of predicates.
//
// A pair stands for a polynomial X of the input with the majorant M (its permanent: the same polynomial with every
// product replaced by its absolute value). It satisfies
//     |l| <= k u M,    |h + l - X| <= e u^2 M,    hence |h| <= (1 + k u + e u^2) M,    u = 2^-53,
// where k and e follow from the operations alone; `ErrorCount` counts them:
//     sum       h + h' is split exactly into s + r, |r| <= u|s|; l" = r + (l + l') rounds twice:
//               k" = K + 1, e" = E + K + (K + 1), with K = max(k, k'), E = max(e, e')
//     product   h h' is split exactly into p + r; l" = r + (h l' + l h') rounds four times and drops l l':
//               k" = k + k' + 1, e" = e + e' + k k' + k + k' + (k + k') + (k + k' + 1)
//     multiple  by a double (k = e = 0): l" = r + a l rounds twice: k" = k + 1, e" = e + k + (k + 1)
// Terms of third order are below k e u < 2^-38 of e while k < 64 and e < 1000. A bound of (e + 1) u^2 times the
// permanent covers them, the permanent's own roundings and that of the last sum h + l: relative changes of a few u.
// Underflow is the caller's: each two_product may be off by 2^-1072 more.
#pragma once

#include "arithmetic/double_double.hpp"

namespace stereodel::arithmetic {

struct Pair {
    double h = 0.0;
    double l = 0.0;
};

// The exact difference of two doubles: k = 1, e = 0.
inline Pair pair_difference(double a, double b) {
    const DoubleDouble d = two_difference(a, b);
    return {d.hi, d.lo};
}

inline Pair operator+(Pair a, Pair b) {
    const DoubleDouble s = two_sum(a.h, b.h);
    return {s.hi, s.lo + (a.l + b.l)};
}

inline Pair operator-(Pair a, Pair b) {
    const DoubleDouble s = two_difference(a.h, b.h);
    return {s.hi, s.lo + (a.l - b.l)};
}

inline Pair operator*(Pair a, Pair b) {
    const DoubleDouble p = two_product(a.h, b.h);
    return {p.hi, p.lo + (a.h * b.l + a.l * b.h)};
}

inline Pair operator*(double a, Pair b) {
    const DoubleDouble p = two_product(a, b.h);
    return {p.hi, p.lo + a * b.l};
}

}  // namespace stereodel::arithmetic
