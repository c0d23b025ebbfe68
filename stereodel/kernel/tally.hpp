// What every predicate shares: point numbers, signs that may stay open, and the count of the tests left open.
#pragma once

#include <cstdint>

namespace stereodel {

using Index = std::int32_t;

// A stage of a predicate answers -1, 0, 1, or OPEN where its error bound does not tell.
using Sign = int;
constexpr Sign OPEN = 2;

// How many tests each stage left open: `filter` the one in doubles, `curvature` the curvature form of the sphere,
// `double_double` the one of twice the precision; `exact` counts exact zeros, which the tie rule decides.
struct Tally {
    std::uint64_t filter = 0;
    std::uint64_t curvature = 0;
    std::uint64_t double_double = 0;
    std::uint64_t exact = 0;

    Tally& operator+=(const Tally& other) {
        filter += other.filter;
        curvature += other.curvature;
        double_double += other.double_double;
        exact += other.exact;
        return *this;
    }
};

template <class Number>
constexpr int sign_of(const Number& value) {
    return (value > Number(0)) - (value < Number(0));
}

// The sign of `value`, known up to `bound`; NaN and infinite bounds leave it open.
inline Sign decide(double value, double bound) {
    return value > bound ? 1 : value < -bound ? -1 : OPEN;
}

}  // namespace stereodel
