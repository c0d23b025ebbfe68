// Ball arithmetic with exponents of its own: twice the precision of a double at any size, and a bound of the error
// that is carried along.
//
// A ball holds every number within `radius` * 2^exponent of (hi + lo) * 2^exponent, and its operations hold whatever
// the operation gives for numbers in the operands. The larger of |hi| and the radius lies in [1, 2), but for the exact
// zero: so nothing overflows, and neither do the products of polynomials of any degree.
//
// Errors, u = 2^-53: those of double_double.hpp, with one u^2 more for the roundings of the bound, and TINY for
// underflow. That needs care where an operand is far smaller than the other or than its own radius: a part below
// 2^-1022 is rounded by 2^-1075 at most, a product of such parts by two_product's 2^-1072, a few of these in an
// operation. Radii are sums of a few positive products: INFLATED covers their roundings, and |hi| in place of
// |hi + lo|.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "arithmetic/double_double.hpp"
#include "tally.hpp"

namespace stereodel::arithmetic {

class Ball {
  public:
    Ball() = default;  // exactly zero

    explicit Ball(double value) {
        middle_.hi = std::frexp(value, &exponent_);
        normalise();
    }

    // 0 only of the exact zero; OPEN where the ball holds zero and other numbers.
    Sign sign() const {
        if (is_zero()) {
            return 0;
        }
        return decide(middle_.hi, (radius_ + 4 * U * std::fabs(middle_.hi)) * INFLATED);  // |lo| <= u |hi|
    }

    // The size by powers of two: of numbers below 2^(exponent + 2) in absolute value, that are mostly above
    // 2^(exponent - 1). FAR_BELOW for the exact zero.
    int exponent() const { return is_zero() ? FAR_BELOW : exponent_; }

    // The numbers within `radius` of `middle`, both times 2^power.
    DoubleDouble middle() const { return middle_; }
    double radius() const { return radius_; }
    int power() const { return exponent_; }

    // The middle divided by 2^exponent, which is no less than its own. Below 2^-960 it may lose digits to underflow.
    DoubleDouble middle(int exponent) const {
        const int shift = exponent_ - exponent;
        return {std::ldexp(middle_.hi, shift), std::ldexp(middle_.lo, shift)};
    }

    // Whether the number is known to 2^-58 of itself, and is no subnormal; if so, the double next to it, or infinity.
    bool round(double& result) const {
        if (!(radius_ <= 0x1p-58 * std::fabs(middle_.hi)) || (!is_zero() && exponent_ < -1000)) {
            return false;
        }
        result = std::ldexp(middle_.hi, exponent_) + 0.0;  // no negative zero
        return true;
    }

    // Whether |a| < |b|, up to their errors.
    friend bool is_shorter(const Ball& a, const Ball& b) {
        return a.exponent() != b.exponent() ? a.exponent() < b.exponent()
                                            : std::fabs(a.middle_.hi) < std::fabs(b.middle_.hi);
    }

    friend Ball operator-(const Ball& a) { return {-a.middle_, a.radius_, a.exponent_}; }
    friend Ball operator-(const Ball& a, const Ball& b) { return a + -b; }

    friend Ball operator+(const Ball& a, const Ball& b) {
        if (a.is_zero() || b.is_zero()) {
            return a.is_zero() ? b : a;
        }
        return a.exponent_ >= b.exponent_ ? sum(a, b) : sum(b, a);
    }

    friend Ball operator*(const Ball& a, const Ball& b) {
        if (a.is_zero() || b.is_zero()) {
            return {};
        }
        const DoubleDouble product = a.middle_ * b.middle_;
        const double size = std::fabs(a.middle_.hi);
        const double radius = size * b.radius_ + a.radius_ * (std::fabs(b.middle_.hi) + b.radius_);
        // Two doubles have an exact product; |hi| >= 1 in both, so that nothing underflows.
        const double rounding = a.is_double() && b.is_double() ? 0.0 : 8 * U * U * std::fabs(product.hi) + TINY;
        return Ball(product, (radius + rounding) * INFLATED, a.exponent_ + b.exponent_).normalised();
    }

    // With a = a' + r, b = b' + s and q' = a'/b': a/b - q' = (r - q' s)/b, and |b| >= |b'| - |s|.
    friend Ball operator/(const Ball& a, const Ball& b) {
        const double least = (std::fabs(b.middle_.hi) * (1 - 4 * U) - b.radius_) * (1 - 4 * U);
        if (!(least > 0x1p-100)) {
            return {{}, 1.0, ANYTHING};
        }
        if (a.is_zero()) {
            return {};
        }
        const DoubleDouble quotient = a.middle_ / b.middle_;
        const double size = std::fabs(quotient.hi), radius = (a.radius_ + size * b.radius_) / least;
        const double rounding = 12 * U * U * size + TINY;
        return Ball(quotient, (radius + rounding) * INFLATED, a.exponent_ - b.exponent_).normalised();
    }

  private:
    static constexpr double U = 0x1p-53, TINY = 0x1p-300, INFLATED = 1 + 0x1p-48;
    static constexpr int FAR = 200;  // a number so many powers of two below another one is part of its radius
    static constexpr int FAR_BELOW = -(1 << 28);
    static constexpr int ANYTHING = 1 << 24;  // the exponent of a ball that tells nothing, nor what is made of it

    Ball(DoubleDouble middle, double radius, int exponent) : middle_(middle), radius_(radius), exponent_(exponent) {}

    bool is_zero() const { return middle_.hi == 0.0 && radius_ == 0.0; }
    bool is_double() const { return middle_.lo == 0.0 && radius_ == 0.0; }

    static double power_of_two(int exponent) {
        const std::uint64_t bits = static_cast<std::uint64_t>(exponent + 1023) << 52;
        double power;
        std::memcpy(&power, &bits, sizeof power);
        return power;
    }

    // a.exponent_ >= b.exponent_. The middles' sum is off by 3u^2 of itself, however much cancels; that of two doubles
    // is exact. Exact products and sums have no part below 2^-500 that scaling could push out of range.
    static Ball sum(const Ball& a, const Ball& b) {
        const int distance = a.exponent_ - b.exponent_;
        if (distance > FAR) {
            return {a.middle_, (a.radius_ + 4 * power_of_two(-FAR)) * INFLATED, a.exponent_};
        }
        const double scale = power_of_two(-distance);
        const DoubleDouble total = a.middle_ + DoubleDouble{scale * b.middle_.hi, scale * b.middle_.lo};
        const double radius = a.radius_ + scale * b.radius_;
        const bool doubles = a.is_double() && b.is_double();
        const double rounding = doubles ? 0.0 : 4 * U * U * std::fabs(total.hi) + (radius > 0.0 ? TINY : 0.0);
        return Ball(total, (radius + rounding) * INFLATED, a.exponent_).normalised();
    }

    Ball normalised() const {
        Ball result = *this;
        result.normalise();
        return result;
    }

    void normalise() {
        const double size = std::max(std::fabs(middle_.hi), radius_);
        if (size == 0.0) {
            return;
        }
        std::uint64_t bits;
        std::memcpy(&bits, &size, sizeof bits);
        const int shift = static_cast<int>(bits >> 52) - 1023;
        const double scale = power_of_two(-shift);
        middle_ = {scale * middle_.hi, scale * middle_.lo};
        radius_ *= scale;
        exponent_ += shift;
    }

    DoubleDouble middle_;
    double radius_ = 0.0;
    int exponent_ = 0;
};

}  // namespace stereodel::arithmetic
