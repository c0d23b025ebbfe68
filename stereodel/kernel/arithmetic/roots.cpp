#include "arithmetic/roots.hpp"

#include <array>

namespace stereodel::arithmetic {

namespace {

struct RootSum {
    std::array<RootTerm, 4> terms;
    int count = 0;

    // Collects equal radicands: vectors of one length, which most exact ties have, then cost no squaring at all.
    void add(const BigInteger& coefficient, const BigInteger& radicand) {
        if (coefficient.sign() == 0 || radicand.sign() == 0) {
            return;
        }
        for (int k = 0; k < count; ++k) {
            if (terms[static_cast<std::size_t>(k)].radicand == radicand) {
                merge(static_cast<std::size_t>(k), coefficient);
                return;
            }
        }
        terms[static_cast<std::size_t>(count++)] = {coefficient, radicand};
    }

  private:
    void merge(std::size_t k, const BigInteger& coefficient) {
        terms[k].coefficient = terms[k].coefficient + coefficient;
        if (terms[k].coefficient.sign() == 0) {
            const auto last = static_cast<std::size_t>(--count);
            if (k != last) {
                terms[k] = terms[last];
            }
        }
    }
};

BigInteger square(const RootTerm& term) {
    return term.coefficient * term.coefficient * term.radicand;
}

int sign_of_two(const RootTerm& first, const RootTerm& second) {
    const int sign = first.coefficient.sign();
    if (sign == second.coefficient.sign()) {
        return sign;
    }
    return sign * (square(first) - square(second)).sign();
}

// The square of c sqrt(n) + d sqrt(m) is a whole number and one root, 2cd sqrt(nm).
RootTerm mixed_product(const RootTerm& a, const RootTerm& b) {
    return {(a.coefficient * b.coefficient).shifted(1), a.radicand * b.radicand};
}

}  // namespace

// Two halves of opposite sign are compared by their squares, which leaves one root fewer: four terms become three,
// three become two, and two become one comparison of integers. No nested root ever appears.
int sign_of_roots(const RootTerm* given, int given_count) {
    RootSum sum;
    for (int k = 0; k < given_count; ++k) {
        sum.add(given[k].coefficient, given[k].radicand);
    }
    const auto& t = sum.terms;
    if (sum.count <= 1) {
        return sum.count == 0 ? 0 : t[0].coefficient.sign();
    }
    if (sum.count == 2) {
        return sign_of_two(t[0], t[1]);
    }
    const bool four = sum.count == 4;
    const int first = sign_of_two(t[0], t[1]);
    const int second = four ? sign_of_two(t[2], t[3]) : t[2].coefficient.sign();
    if (first * second >= 0) {
        return first != 0 ? first : second;
    }
    const BigInteger whole = square(t[0]) + square(t[1]) - square(t[2]);
    std::array<RootTerm, 3> squared = {RootTerm{four ? whole - square(t[3]) : whole, BigInteger(1)},
                                       mixed_product(t[0], t[1]), {}};
    if (four) {
        const RootTerm product = mixed_product(t[2], t[3]);
        squared[2] = {-product.coefficient, product.radicand};
    }
    return first * sign_of_roots(squared.data(), 3);
}

}  // namespace stereodel::arithmetic
