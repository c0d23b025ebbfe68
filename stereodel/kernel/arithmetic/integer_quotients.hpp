// Quotients and square roots of integers, rounded: what constructions by integers end with.
#pragma once

#include <cstddef>

#include "arithmetic/big_integer.hpp"

namespace stereodel::arithmetic {

// The double nearest to numerator/denominator * 2^exponent, ties to even, subnormal and infinite ones included; +0 for
// zero. The denominator is not zero.
double round_quotient(const BigInteger& numerator, const BigInteger& denominator, std::ptrdiff_t exponent = 0);

// A square root within 2^exponent: root * 2^exponent, `root` of as many bits as were asked or a few more.
struct IntegerRoot {
    BigInteger root;
    std::ptrdiff_t exponent;
};

// Of a positive integer; bits >= 54.
IntegerRoot integer_root(const BigInteger& square, std::size_t bits);

// The unit vector of an integer vector that is not zero, each component the nearest double but for 2^-126 of itself.
void round_unit(const BigInteger* vector, double* result);

}  // namespace stereodel::arithmetic
