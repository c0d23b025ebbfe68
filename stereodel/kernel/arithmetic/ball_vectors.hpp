// Vectors of balls, and vector products of vectors of doubles of any length.
#pragma once

#include <algorithm>

#include "arithmetic/ball.hpp"

namespace stereodel::arithmetic {

struct BallVector {
    Ball v[3];

    BallVector() = default;
    explicit BallVector(const double* p) : v{Ball(p[0]), Ball(p[1]), Ball(p[2])} {}

    int exponent() const { return std::max({v[0].exponent(), v[1].exponent(), v[2].exponent()}); }
    bool is_zero() const { return v[0].sign() == 0 && v[1].sign() == 0 && v[2].sign() == 0; }
    // Of a vector other than zero, the first component that is not zero.
    int first_axis() const { return v[0].sign() != 0 ? 0 : v[1].sign() != 0 ? 1 : 2; }
};

inline Ball cross_component(const BallVector& p, const BallVector& q, int k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    return p.v[i] * q.v[j] - p.v[j] * q.v[i];
}

// Of doubles each component is one difference of exact products: known to 2^-103 of itself however much cancels, and so
// its sign is proven.
inline BallVector cross(const BallVector& p, const BallVector& q) {
    BallVector product;
    for (int k = 0; k < 3; ++k) {
        product.v[k] = cross_component(p, q, k);
    }
    return product;
}

inline BallVector cross(const double* p, const double* q) {
    return cross(BallVector(p), BallVector(q));
}

}  // namespace stereodel::arithmetic
