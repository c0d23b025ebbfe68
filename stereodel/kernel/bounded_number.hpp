// Numbers in about twice the precision with an exponent of their own and a bound of their error, which the operations
// carry along: for expressions whose cancellation nobody knows before, of values of any size.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "double_double.hpp"

namespace stereodel {

// A number within error * 2^exponent of v * 2^exponent. v is zero, or its size lies in [1/2, 1).
class BoundedNumber {
  public:
    explicit BoundedNumber(double value) { v_.hi = std::frexp(value, &exponent_); }

    friend BoundedNumber operator+(const BoundedNumber& a, const BoundedNumber& b) {
        return a.exponent_ >= b.exponent_ ? a.plus_lesser(b) : b.plus_lesser(a);
    }
    friend BoundedNumber operator-(const BoundedNumber& a, const BoundedNumber& b) { return a + b.negative(); }
    friend BoundedNumber operator*(const BoundedNumber& a, const BoundedNumber& b) {
        return {a.v_ * b.v_, a.exponent_ + b.exponent_, a.error_ + b.error_ + a.error_ * b.error_};
    }
    // With A, B the true values times powers of two, |A/B - a/b| = |(A - a) - (B - b) a/b| / |B|, where |a/b| < 2 and
    // |B| > 1/4.
    friend BoundedNumber operator/(const BoundedNumber& a, const BoundedNumber& b) {
        if (!(std::fabs(b.v_.hi) - b.error_ > 0.25)) {
            return unknown();
        }
        return {a.v_ / b.v_, a.exponent_ - b.exponent_, 4 * (a.error_ + 2 * b.error_)};
    }

    // Whether |a| < |b|, up to their errors.
    friend bool is_shorter(const BoundedNumber& a, const BoundedNumber& b) {
        return a.exponent_ != b.exponent_ ? a.exponent_ < b.exponent_ : std::fabs(a.v_.hi) < std::fabs(b.v_.hi);
    }

    // Whether the number is known to 2^-58 of itself, and is no subnormal; if so, the double next to it, or infinity.
    bool round(double& result) const {
        if (!(error_ <= 0x1p-58 * std::fabs(v_.hi)) || (v_.hi != 0.0 && exponent_ < -1000)) {
            return false;
        }
        result = std::ldexp(v_.hi, exponent_) + 0.0;  // no negative zero
        return true;
    }

  private:
    // Every operation on double-doubles is off by at most 11u^2 < 2^-102 of its result. The sums above round by a few
    // u of themselves.
    BoundedNumber(DoubleDouble v, int exponent, double error) {
        int shift = 0;
        const double high = std::frexp(v.hi, &shift);
        v_ = {high, std::ldexp(v.lo, -shift)};
        error_ = high == 0.0 ? error : std::ldexp(error * (1 + 0x1p-49), -shift) + 0x1p-102;
        exponent_ = high == 0.0 ? exponent : exponent + shift;
    }

    static BoundedNumber unknown() { return {{}, 0, std::numeric_limits<double>::infinity()}; }

    BoundedNumber negative() const {
        BoundedNumber result(*this);
        result.v_ = -v_;
        return result;
    }

    // For |exponents| in this order; what is more than 2^200 times smaller counts as an error. A zero has any exponent.
    BoundedNumber plus_lesser(const BoundedNumber& b) const {
        if (v_.hi == 0.0 && error_ == 0.0) {
            return b;
        }
        const int shift = exponent_ - b.exponent_;
        if (shift > 200) {
            const double lost = b.v_.hi == 0.0 ? b.error_ : 1 + b.error_;
            return {v_, exponent_, error_ + std::ldexp(lost, -200)};
        }
        const DoubleDouble lesser{std::ldexp(b.v_.hi, -shift), std::ldexp(b.v_.lo, -shift)};
        return {v_ + lesser, exponent_, error_ + std::ldexp(b.error_, -shift)};
    }

    DoubleDouble v_;
    int exponent_ = 0;
    double error_ = 0.0;
};

}  // namespace stereodel
