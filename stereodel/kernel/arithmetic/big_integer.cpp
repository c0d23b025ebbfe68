#include "arithmetic/big_integer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stereodel::arithmetic {

namespace {

constexpr std::uint64_t LOW = 0xffffffffU;
constexpr std::size_t LIMB_BITS = 32;

std::uint32_t low(std::uint64_t value) {
    return static_cast<std::uint32_t>(value & LOW);
}

int compare_magnitudes(const Limbs& a, const Limbs& b) {
    if (a.size() != b.size()) {
        return a.size() < b.size() ? -1 : 1;
    }
    for (std::size_t k = a.size(); k-- > 0;) {
        if (a[k] != b[k]) {
            return a[k] < b[k] ? -1 : 1;
        }
    }
    return 0;
}

Limbs add_magnitudes(const Limbs& longer, const Limbs& shorter) {
    Limbs result(longer.size() + 1);
    const std::uint32_t *x = longer.data(), *y = shorter.data();
    std::uint32_t* out = result.data();
    std::uint64_t carry = 0;
    for (std::size_t k = 0; k < longer.size(); ++k) {
        carry += std::uint64_t{x[k]} + (k < shorter.size() ? y[k] : 0);
        out[k] = low(carry);
        carry >>= 32;
    }
    out[longer.size()] = low(carry);
    return result;
}

// larger >= smaller
Limbs subtract_magnitudes(const Limbs& larger, const Limbs& smaller) {
    Limbs result(larger.size());
    const std::uint32_t *x = larger.data(), *y = smaller.data();
    std::uint32_t* out = result.data();
    std::uint64_t borrow = 0;
    for (std::size_t k = 0; k < larger.size(); ++k) {
        const std::uint64_t difference = std::uint64_t{x[k]} - (k < smaller.size() ? y[k] : 0) - borrow;
        out[k] = low(difference);
        borrow = difference >> 63;
    }
    return result;
}

}  // namespace

Limbs::Limbs(std::size_t size) : size_(size) {
    if (size > INLINE) {
        far_.reset(new std::uint32_t[size]);
    }
}

Limbs::Limbs(const Limbs& other) : Limbs(other.size_) {
    std::copy_n(other.data(), size_, data());
}

Limbs::Limbs(Limbs&& other) noexcept : size_(other.size_), far_(std::move(other.far_)) {
    if (!far_) {
        std::copy_n(other.near_.data(), size_, near_.data());
    }
    other.size_ = 0;
}

Limbs& Limbs::operator=(const Limbs& other) {
    return *this = Limbs(other);
}

Limbs& Limbs::operator=(Limbs&& other) noexcept {
    size_ = std::exchange(other.size_, 0);
    far_ = std::move(other.far_);
    if (!far_) {
        std::copy_n(other.near_.data(), size_, near_.data());
    }
    return *this;
}

void Limbs::trim() {
    const std::uint32_t* limbs = data();
    while (size_ > 0 && limbs[size_ - 1] == 0) {
        --size_;
    }
}

BigInteger::BigInteger(int sign, Limbs&& limbs) : limbs_(std::move(limbs)) {
    limbs_.trim();
    sign_ = limbs_.size() ? sign : 0;
}

BigInteger::BigInteger(std::int64_t value) : sign_((value > 0) - (value < 0)), limbs_(2) {
    const std::uint64_t size = value < 0 ? ~static_cast<std::uint64_t>(value) + 1 : static_cast<std::uint64_t>(value);
    limbs_.data()[0] = low(size);
    limbs_.data()[1] = low(size >> 32);
    limbs_.trim();
}

BigInteger BigInteger::from_double(double value, int exponent) {
    if (value == 0.0) {
        return {};
    }
    int shift = 0;
    const double fraction = std::frexp(value, &shift);
    BigInteger mantissa(static_cast<std::int64_t>(std::ldexp(fraction, 53)));
    shift -= 53 + exponent;
    if (shift >= 0) {
        return mantissa.shifted(static_cast<std::size_t>(shift));
    }
    // The bits below 2^exponent are zeros: the quotient is exact, and so is this division of a small integer.
    return BigInteger(static_cast<std::int64_t>(std::ldexp(fraction, 53 + shift)));
}

BigInteger BigInteger::operator-() const {
    BigInteger result(*this);
    result.sign_ = -sign_;
    return result;
}

BigInteger BigInteger::shifted(std::size_t bits) const {
    if (sign_ == 0) {
        return {};
    }
    const std::size_t whole = bits / 32, rest = bits % 32;
    Limbs result(limbs_.size() + whole + 1);
    std::uint32_t* out = std::fill_n(result.data(), whole, 0U);
    std::uint64_t carry = 0;
    for (std::size_t k = 0; k < limbs_.size(); ++k) {
        carry |= std::uint64_t{limbs_[k]} << rest;
        out[k] = low(carry);
        carry >>= 32;
    }
    out[limbs_.size()] = low(carry);
    return {sign_, std::move(result)};
}

BigInteger BigInteger::sum(const BigInteger& a, const BigInteger& b, int b_sign) {
    if (b_sign == 0) {
        return a;
    }
    if (a.sign_ == 0 || a.sign_ == b_sign) {
        const bool swap = a.limbs_.size() < b.limbs_.size();
        return {b_sign, swap ? add_magnitudes(b.limbs_, a.limbs_) : add_magnitudes(a.limbs_, b.limbs_)};
    }
    const int order = compare_magnitudes(a.limbs_, b.limbs_);
    if (order == 0) {
        return {};
    }
    return order > 0 ? BigInteger(a.sign_, subtract_magnitudes(a.limbs_, b.limbs_))
                     : BigInteger(b_sign, subtract_magnitudes(b.limbs_, a.limbs_));
}

BigInteger operator*(const BigInteger& a, const BigInteger& b) {
    const int sign = a.sign_ * b.sign_;
    if (sign == 0) {
        return {};
    }
    const std::size_t m = a.limbs_.size(), n = b.limbs_.size();
    const std::uint32_t *x = a.limbs_.data(), *y = b.limbs_.data();
    Limbs result(m + n);
    std::uint32_t* out = result.data();
    std::fill_n(out, m + n, 0U);
    for (std::size_t i = 0; i < m; ++i) {
        std::uint64_t carry = 0;
        for (std::size_t j = 0; j < n; ++j) {
            carry += std::uint64_t{x[i]} * y[j] + out[i + j];  // at most (2^32-1)^2 + 2 (2^32-1) = 2^64 - 1
            out[i + j] = low(carry);
            carry >>= 32;
        }
        out[i + n] = low(carry);
    }
    return {sign, std::move(result)};
}

bool operator==(const BigInteger& a, const BigInteger& b) {
    return a.sign_ == b.sign_ && compare_magnitudes(a.limbs_, b.limbs_) == 0;
}

BigInteger BigInteger::cut(std::size_t bits) const {
    const std::size_t whole = bits / LIMB_BITS, rest = bits % LIMB_BITS;
    if (limbs_.size() <= whole) {
        return {};
    }
    Limbs result(limbs_.size() - whole);
    for (std::size_t k = 0; k < result.size(); ++k) {
        const auto above = rest == 0 || k + whole + 1 == limbs_.size() ? 0 : limbs_[k + whole + 1];
        result.data()[k] = limbs_[k + whole] >> rest | above << (LIMB_BITS - rest) % LIMB_BITS;
    }
    return {sign_, std::move(result)};
}

std::size_t BigInteger::bit_length() const {
    if (sign_ == 0) {
        return 0;
    }
    std::size_t length = LIMB_BITS * (limbs_.size() - 1);
    for (auto rest = limbs_[limbs_.size() - 1]; rest != 0; rest >>= 1) {
        ++length;
    }
    return length;
}

std::int64_t BigInteger::to_int64() const {
    std::uint64_t magnitude = 0;
    for (std::size_t k = 0; k < limbs_.size(); ++k) {
        magnitude |= std::uint64_t{limbs_[k]} << LIMB_BITS * k;
    }
    return sign_ * static_cast<std::int64_t>(magnitude);
}

int lowest_exponent(double value) {
    if (value == 0.0) {
        return EVERY_EXPONENT;
    }
    int exponent = 0;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    return exponent - 53 + std::ilogb(static_cast<double>(mantissa & -mantissa));
}

}  // namespace stereodel::arithmetic
