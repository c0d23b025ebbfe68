// Double-doubles that know their error: the sibling of `BigBall` (big_ball.hpp), with the same operations, for formulas
// that are evaluated in either. Unlike `Ball` they have no exponent of their own, which makes them cheap.
//
// Bounds of the operations are those of double_double.hpp, rounded up: 3u^2 < 2^-104 for sums, 7u^2 < 2^-103 for
// products, 11u^2 < 2^-102 for quotients, 5u^2 < 2^-103 for roots, of the result; 2^-1060 covers products that
// underflow. The errors themselves are computed in doubles, each operation off by a few u of a positive number: after
// some hundred operations by less than 2^-40 of it, for which whoever uses them leaves room.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "arithmetic/double_double.hpp"

namespace stereodel::arithmetic {

class Bounded {
  public:
    Bounded() = default;
    explicit Bounded(DoubleDouble value, double error = 0.0) : value_(value), error_(error) {}

    Bounded like(double value) const { return Bounded({value, 0.0}); }
    int sign() const { return (value_.hi > 0.0) - (value_.hi < 0.0); }
    double digits() const { return 106.0; }
    Bounded error_alone() const { return Bounded({}, std::fabs(value_.hi) * (1.0 + 0x1p-50) + error_); }

    Bounded times_power(std::int64_t bits) const {
        return Bounded({scaled(value_.hi, bits), scaled(value_.lo, bits)}, scaled(error_, bits) + FLOOR);
    }

    std::int64_t exponent() const {
        int result = 0;
        std::frexp(value_.hi, &result);
        return result;
    }
    double middle(std::int64_t exponent) const { return scaled(value_.hi, -exponent); }
    double radius(std::int64_t exponent) const { return scaled(error_, -exponent) + FLOOR; }

    Bounded operator-() const { return Bounded(-value_, error_); }
    friend Bounded operator+(const Bounded& a, const Bounded& b) {
        const DoubleDouble sum = a.value_ + b.value_;
        return Bounded(sum, a.error_ + b.error_ + 0x1p-104 * std::fabs(sum.hi));
    }
    friend Bounded operator-(const Bounded& a, const Bounded& b) { return a + -b; }
    friend Bounded operator*(const Bounded& a, const Bounded& b) {
        const DoubleDouble product = a.value_ * b.value_;
        return Bounded(product, std::fabs(a.value_.hi) * b.error_ + (std::fabs(b.value_.hi) + b.error_) * a.error_ +
                                    (0x1p-103 * std::fabs(product.hi) + FLOOR));
    }
    friend Bounded operator/(const Bounded& a, const Bounded& b) {
        const double least = std::fabs(b.value_.hi) - 2 * b.error_;
        if (!(least > 0x1p-960)) {
            return Bounded({}, HUGE_VAL);
        }
        const DoubleDouble quotient = a.value_ / b.value_;
        const double size = std::fabs(quotient.hi);
        // What underflows in the residual is divided; the quotient itself may underflow too.
        return Bounded(quotient, (a.error_ + size * b.error_ + FLOOR) / least + (0x1p-102 * size + FLOOR));
    }
    // Of a number that is not negative.
    friend Bounded sqrt(const Bounded& a) {
        if (!(a.value_.hi > 0x1p-900)) {
            return Bounded({}, std::sqrt(std::fabs(a.value_.hi) + a.error_ + 0x1p-900));
        }
        const DoubleDouble root = arithmetic::sqrt(a.value_);
        return Bounded(root, a.error_ / root.hi + 0x1p-103 * root.hi);
    }

  private:
    static constexpr double FLOOR = 0x1p-1060;

    // x 2^exponent. Not by the slower std::ldexp where the power itself is a double.
    static double scaled(double x, std::int64_t exponent) {
        if (exponent == 0) {
            return x;
        }
        if (exponent < -1022 || exponent > 1023) {
            return std::ldexp(x, static_cast<int>(exponent));
        }
        const std::uint64_t bits = static_cast<std::uint64_t>(exponent + 1023) << 52;
        double power = 0.0;
        std::memcpy(&power, &bits, sizeof power);
        return x * power;
    }

    DoubleDouble value_;
    double error_ = 0.0;
};

}  // namespace stereodel::arithmetic
