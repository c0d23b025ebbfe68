// Signs of sums of square roots, by integers alone (the method of tests/reference.py).
#pragma once

#include "arithmetic/big_integer.hpp"

namespace stereodel::arithmetic {

// coefficient * sqrt(radicand), radicand >= 0
struct RootTerm {
    BigInteger coefficient;
    BigInteger radicand;
};

// Sign of a sum of up to four roots, exactly.
int sign_of_roots(const RootTerm* terms, int count);

}  // namespace stereodel::arithmetic
