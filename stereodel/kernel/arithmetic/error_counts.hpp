// Error bounds counted by the compiler: a formula written once as a template gives its value in doubles or pairs, its
// sign in integers, and the number of its roundings.
#pragma once

namespace stereodel::arithmetic {

constexpr double UNIT_ROUNDOFF = 0x1p-53;

// The most roundings that a term of an expanded sum of products passes through, each a factor 1 + d with |d| <= u.
//
// The computed sum is then off by at most ((1+u)^n - 1) times the permanent, the sum of the absolute values of the
// exact terms. Bounds are stated with n + 1 in place of n: the whole u between them is far more than what second order
// and the roundings in the permanent and in the bound itself add.
struct RoundingCount {
    int n;

    constexpr double bound() const { return n + 1; }
};

constexpr RoundingCount operator+(RoundingCount a, RoundingCount b) {
    return {(a.n > b.n ? a.n : b.n) + 1};
}

constexpr RoundingCount operator-(RoundingCount a, RoundingCount b) {
    return a + b;
}

constexpr RoundingCount operator*(RoundingCount a, RoundingCount b) {
    return {a.n + b.n + 1};
}

// The same for pairs, in the terms of pair_arithmetic.hpp.
struct ErrorCount {
    double k;
    double e;

    constexpr double bound() const { return e + 1; }
};

struct PlainCount {};  // a double that is exact as it stands

constexpr ErrorCount operator+(ErrorCount a, ErrorCount b) {
    const double k = a.k > b.k ? a.k : b.k, e = a.e > b.e ? a.e : b.e;
    return {k + 1, e + k + (k + 1)};
}

constexpr ErrorCount operator-(ErrorCount a, ErrorCount b) {
    return a + b;
}

constexpr ErrorCount operator*(ErrorCount a, ErrorCount b) {
    return {a.k + b.k + 1, a.e + b.e + a.k * b.k + 2 * (a.k + b.k) + (a.k + b.k + 1)};
}

constexpr ErrorCount operator*(PlainCount, ErrorCount b) {
    return {b.k + 1, b.e + b.k + (b.k + 1)};
}

}  // namespace stereodel::arithmetic
