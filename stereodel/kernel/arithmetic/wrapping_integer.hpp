// Integers modulo 2^128: the last digits of a number that is known to be small, at a fraction of what all its digits
// cost.
#pragma once

#include <cstdint>

namespace stereodel::arithmetic {

class WrappingInteger {
  public:
    explicit WrappingInteger(std::int64_t value)
        : high_(value < 0 ? ~std::uint64_t{0} : 0), low_(static_cast<std::uint64_t>(value)) {}

    friend WrappingInteger operator+(WrappingInteger a, WrappingInteger b) {
        const std::uint64_t low = a.low_ + b.low_;
        return {a.high_ + b.high_ + (low < a.low_ ? 1 : 0), low};
    }
    friend WrappingInteger operator-(WrappingInteger a, WrappingInteger b) {
        return {a.high_ - b.high_ - (a.low_ < b.low_ ? 1 : 0), a.low_ - b.low_};
    }
    friend WrappingInteger operator*(WrappingInteger a, WrappingInteger b) {
        return {upper_half(a.low_, b.low_) + a.high_ * b.low_ + a.low_ * b.high_, a.low_ * b.low_};
    }

    // Of the number itself if it lies between -2^127 and 2^127.
    int sign() const { return high_ >> 63 != 0 ? -1 : (high_ | low_) != 0 ? 1 : 0; }

  private:
    WrappingInteger(std::uint64_t high, std::uint64_t low) : high_(high), low_(low) {}

    // The upper 64 bits of a product, by halves.
    static std::uint64_t upper_half(std::uint64_t a, std::uint64_t b) {
        constexpr std::uint64_t half = 0xFFFFFFFFu;
        const std::uint64_t ah = a >> 32, al = a & half, bh = b >> 32, bl = b & half;
        const std::uint64_t cross = ah * bl + (al * bl >> 32);  // fits
        const std::uint64_t other = al * bh + (cross & half);
        return ah * bh + (cross >> 32) + (other >> 32);
    }

    std::uint64_t high_, low_;
};

}  // namespace stereodel::arithmetic
