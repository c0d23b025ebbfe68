#include "arithmetic/big_ball.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace stereodel::arithmetic {
namespace {

constexpr double UP = 1.0 + 0x1p-50;  // more than the roundings of an operation on magnitudes
constexpr std::int64_t NEVER = std::int64_t{1} << 60;

std::int64_t clamped(std::int64_t exponent) {
    return std::clamp<std::int64_t>(exponent, -5000, 5000);
}

double scaled(double value, std::int64_t exponent) {
    return std::ldexp(value, static_cast<int>(clamped(exponent)));
}

// floor(a/32) and the rest.
std::int64_t whole_limbs(std::int64_t bits) {
    return (bits >= 0 ? bits : bits - 31) / 32;
}

}  // namespace

Magnitude Magnitude::of(double m, std::int64_t e) {
    if (m == 0.0) {
        return {};
    }
    if (!std::isfinite(m)) {
        return {0.5, NEVER};
    }
    int more = 0;
    const double fraction = std::frexp(m, &more);
    return {fraction, std::min(e + more, NEVER)};
}

Magnitude operator+(const Magnitude& a, const Magnitude& b) {
    if (a.is_zero() || b.is_zero()) {
        return a.is_zero() ? b : a;
    }
    const Magnitude &large = a.e < b.e ? b : a, &small = a.e < b.e ? a : b;
    const std::int64_t apart = large.e - small.e;
    return Magnitude::of((large.m + (apart > 60 ? 0x1p-60 : scaled(small.m, -apart))) * UP, large.e);
}

Magnitude operator*(const Magnitude& a, const Magnitude& b) {
    return Magnitude::of(a.m * b.m * UP, a.e + b.e);
}

Magnitude operator/(const Magnitude& a, const Magnitude& b) {
    return Magnitude::of(a.m / b.m * UP, a.e - b.e);
}

Magnitude Magnitude::root() const {
    const bool odd = e % 2 != 0;
    return of(std::sqrt(odd ? 2.0 * m : m) * UP, (odd ? e - 1 : e) / 2);
}

double Magnitude::times_power(std::int64_t exponent) const {
    return is_zero() ? 0.0 : scaled(m, e + exponent) + std::numeric_limits<double>::denorm_min();
}

BigFloat::BigFloat(double value) {
    if (value == 0.0) {
        return;
    }
    sign_ = value < 0.0 ? -1 : 1;
    int exponent = 0;
    const auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::fabs(value), &exponent), 53));
    exponent_ = whole_limbs(exponent - 53);
    const auto shift = static_cast<unsigned>(exponent - 53 - 32 * exponent_);
    const std::uint64_t low = (mantissa & 0xffffffffU) << shift, high = (mantissa >> 32) << shift;
    const std::uint64_t middle = (low >> 32) + (high & 0xffffffffU);
    limbs_ = {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(middle),
              static_cast<std::uint32_t>((high >> 32) + (middle >> 32))};
    trim(3, nullptr);
}

// Drops zeros at both ends, and limbs below the first so many.
void BigFloat::trim(std::size_t limbs, Magnitude* lost) {
    while (!limbs_.empty() && limbs_.back() == 0) {
        limbs_.pop_back();
    }
    std::size_t drop = limbs_.size() > limbs ? limbs_.size() - limbs : 0;
    if (drop > 0 && lost != nullptr && std::any_of(limbs_.begin(), limbs_.begin() + static_cast<std::ptrdiff_t>(drop),
                                                   [](std::uint32_t limb) { return limb != 0; })) {
        *lost = *lost + Magnitude{0.5, 32 * (exponent_ + static_cast<std::int64_t>(drop)) + 1};
    }
    while (drop < limbs_.size() && limbs_[drop] == 0) {
        ++drop;
    }
    limbs_.erase(limbs_.begin(), limbs_.begin() + static_cast<std::ptrdiff_t>(drop));
    exponent_ += static_cast<std::int64_t>(drop);
}

std::int64_t BigFloat::top() const {
    return exponent_ + static_cast<std::int64_t>(limbs_.size());
}

// The first three limbs, rounded four times: within 2^-51 of the value.
double BigFloat::leading(std::int64_t& exponent) const {
    double value = 0.0;
    exponent = top() - 1;
    for (std::size_t k = 0; k < 3 && k < limbs_.size(); ++k) {
        value += std::ldexp(static_cast<double>(limbs_[limbs_.size() - 1 - k]), -32 * static_cast<int>(k));
    }
    return value;
}

double BigFloat::to_double(std::int64_t exponent) const {
    std::int64_t whole = 0;
    const double value = leading(whole);
    return limbs_.empty() ? 0.0 : sign_ * scaled(value, 32 * whole + exponent);
}

Magnitude BigFloat::upper() const {
    std::int64_t whole = 0;
    const double value = leading(whole);
    return Magnitude::of(value * UP, 32 * whole);
}

Magnitude BigFloat::lower() const {
    std::int64_t whole = 0;
    const double value = leading(whole);
    return Magnitude::of(value * (2.0 - UP), 32 * whole);
}

BigFloat BigFloat::negated() const {
    BigFloat result(*this);
    result.sign_ = -sign_;
    return result;
}

BigFloat BigFloat::times_power(std::int64_t bits) const {
    BigFloat result(*this);
    if (limbs_.empty()) {
        return result;
    }
    const std::int64_t whole = whole_limbs(bits);
    const auto rest = static_cast<unsigned>(bits - 32 * whole);
    result.exponent_ += whole;
    std::uint64_t carry = 0;
    for (std::uint32_t& limb : result.limbs_) {
        carry |= std::uint64_t{limb} << rest;
        limb = static_cast<std::uint32_t>(carry);
        carry >>= 32;
    }
    result.limbs_.push_back(static_cast<std::uint32_t>(carry));
    result.trim(result.limbs_.size(), nullptr);
    return result;
}

// Added or subtracted limb by limb from the lowest that counts on; one more than wanted, as the first may cancel. What
// lies below that limb is left out.
BigFloat BigFloat::sum(const BigFloat& a, const BigFloat& b, std::size_t limbs, Magnitude& lost) {
    if (a.limbs_.empty() || b.limbs_.empty()) {
        BigFloat result = a.limbs_.empty() ? b : a;
        result.trim(limbs, &lost);
        return result;
    }
    const std::int64_t top = std::max(a.top(), b.top());
    const std::int64_t bottom =
        std::max(std::min(a.exponent_, b.exponent_), top - static_cast<std::int64_t>(limbs) - 1);
    // Of each number what stands at or above `bottom`; the rest of a and b together is less than two units there.
    const auto limb = [bottom](const BigFloat& x, std::size_t k) -> std::uint64_t {
        const std::int64_t place = bottom + static_cast<std::int64_t>(k) - x.exponent_;
        const bool holds = place >= 0 && place < static_cast<std::int64_t>(x.limbs_.size());
        return holds ? x.limbs_[static_cast<std::size_t>(place)] : 0;
    };
    for (const BigFloat* x : {&a, &b}) {
        if (x->exponent_ < bottom) {
            lost = lost + Magnitude{0.5, 32 * bottom + 1};
        }
    }
    const auto size = static_cast<std::size_t>(top - bottom);
    BigFloat result;
    result.exponent_ = bottom;
    result.limbs_.resize(size + 1);
    const bool subtract = a.sign_ != b.sign_;
    std::uint64_t carry = 0;  // or borrow
    for (std::size_t k = 0; k < size; ++k) {
        const std::uint64_t value = subtract ? limb(a, k) - limb(b, k) - carry : limb(a, k) + limb(b, k) + carry;
        result.limbs_[k] = static_cast<std::uint32_t>(value);
        carry = subtract ? value >> 63 : value >> 32;
    }
    result.sign_ = a.sign_;
    if (!subtract) {
        result.limbs_[size] = static_cast<std::uint32_t>(carry);
    } else if (carry != 0) {  // b is the larger one: the two's complement
        result.sign_ = b.sign_;
        std::uint64_t one = 1;
        for (std::size_t k = 0; k < size; ++k) {
            one += static_cast<std::uint32_t>(~result.limbs_[k]);
            result.limbs_[k] = static_cast<std::uint32_t>(one);
            one >>= 32;
        }
    }
    result.trim(limbs, &lost);
    return result;
}

BigFloat BigFloat::product(const BigFloat& a, const BigFloat& b, std::size_t limbs, Magnitude& lost) {
    const std::size_t m = a.limbs_.size(), n = b.limbs_.size();
    BigFloat result;
    if (m == 0 || n == 0) {
        return result;
    }
    result.sign_ = a.sign_ * b.sign_;
    result.exponent_ = a.exponent_ + b.exponent_;
    result.limbs_.assign(m + n, 0);
    const std::uint32_t *x = a.limbs_.data(), *y = b.limbs_.data();
    for (std::size_t i = 0; i < m; ++i) {
        std::uint32_t* out = result.limbs_.data() + i;
        std::uint64_t carry = 0;
        for (std::size_t j = 0; j < n; ++j) {
            carry += std::uint64_t{x[i]} * y[j] + out[j];
            out[j] = static_cast<std::uint32_t>(carry);
            carry >>= 32;
        }
        out[n] = static_cast<std::uint32_t>(carry);
    }
    result.trim(limbs, &lost);
    return result;
}

// Newton: x (2 - a x) doubles the digits.
BigFloat BigFloat::reciprocal(const BigFloat& a, std::size_t limbs) {
    std::int64_t whole = 0;
    const double value = a.leading(whole);
    BigFloat x(1.0 / value);
    x.exponent_ -= whole;
    Magnitude lost;
    for (std::size_t known = 1; known < limbs; known *= 2) {
        const std::size_t work = std::min(2 * known, limbs) + 2;
        BigFloat cut(a);
        cut.sign_ = 1;
        cut.trim(work, &lost);
        const BigFloat rest = sum(BigFloat(2.0), product(cut, x, work, lost).negated(), work, lost);
        x = product(x, rest, work, lost);
    }
    x.sign_ = a.sign_;
    return x;
}

// Newton: x (3 - a x^2)/2.
BigFloat BigFloat::reciprocal_root(const BigFloat& a, std::size_t limbs) {
    std::int64_t whole = 0;
    double value = a.leading(whole);
    if (whole % 2 != 0) {
        value *= 0x1p32;
        --whole;
    }
    BigFloat x(1.0 / std::sqrt(value));
    x.exponent_ -= whole / 2;
    Magnitude lost;
    for (std::size_t known = 1; known < limbs; known *= 2) {
        const std::size_t work = std::min(2 * known, limbs) + 2;
        BigFloat cut(a);
        cut.trim(work, &lost);
        const BigFloat square = product(cut, product(x, x, work, lost), work, lost);
        x = product(x, sum(BigFloat(3.0), square.negated(), work, lost).times_power(-1), work, lost);
    }
    return x;
}

BigBall::BigBall(BigFloat&& middle, const Magnitude& radius, std::size_t limbs)
    : middle_(std::move(middle)), radius_(radius), limbs_(limbs) {}

BigBall BigBall::times_power(std::int64_t bits) const {
    return {middle_.times_power(bits), Magnitude{radius_.m, radius_.is_zero() ? 0 : radius_.e + bits}, limbs_};
}

BigBall BigBall::error_alone() const {
    return {BigFloat(), middle_.upper() + radius_, limbs_};
}

double BigBall::radius(std::int64_t exponent) const {
    return radius_.times_power(-exponent);
}

BigBall BigBall::operator-() const {
    return {middle_.negated(), radius_, limbs_};
}

BigBall operator+(const BigBall& a, const BigBall& b) {
    Magnitude radius = a.radius_ + b.radius_;
    const std::size_t limbs = std::max(a.limbs_, b.limbs_);
    BigFloat middle = BigFloat::sum(a.middle_, b.middle_, limbs, radius);
    return {std::move(middle), radius, limbs};
}

BigBall operator*(const BigBall& a, const BigBall& b) {
    Magnitude radius;
    if (!a.radius_.is_zero()) {
        radius = a.radius_ * (b.middle_.upper() + b.radius_);
    }
    if (!b.radius_.is_zero()) {
        radius = radius + b.radius_ * a.middle_.upper();
    }
    const std::size_t limbs = std::max(a.limbs_, b.limbs_);
    BigFloat middle = BigFloat::product(a.middle_, b.middle_, limbs, radius);
    return {std::move(middle), radius, limbs};
}

// With q for a/b, whatever it is, |q - A/B| <= (|a - q b| + r_a + |q| r_b)/|B|.
BigBall operator/(const BigBall& a, const BigBall& b) {
    const std::size_t limbs = std::max(a.limbs_, b.limbs_);
    const Magnitude least = b.middle_.lower();
    const double share = b.radius_.is_zero() ? 0.0 : (b.radius_ / least).times_power(0);
    if (b.sign() == 0 || !(share < 0.5)) {
        return {BigFloat(), Magnitude{0.5, NEVER}, limbs};
    }
    Magnitude lost, unknown;
    BigFloat q = BigFloat::product(a.middle_, BigFloat::reciprocal(b.middle_, limbs), limbs, lost);
    const BigFloat back = BigFloat::product(q, b.middle_, 2 * limbs + 2, unknown).negated();
    const Magnitude rest = BigFloat::sum(a.middle_, back, 2 * limbs + 2, unknown).upper();
    unknown = unknown + rest + a.radius_ + q.upper() * b.radius_;
    return {std::move(q), unknown / least * Magnitude::of(1.0 / (1.0 - share) * UP, 0), limbs};
}

// With s for the root, |s - root A| <= (|a - s^2| + r)/s, and at most root(r) more than that of a - s^2.
BigBall sqrt(const BigBall& a) {
    if (a.sign() <= 0) {
        return {BigFloat(), (a.middle_.upper() + a.radius_).root(), a.limbs_};
    }
    Magnitude lost, unknown;
    BigFloat s = BigFloat::product(a.middle_, BigFloat::reciprocal_root(a.middle_, a.limbs_), a.limbs_, lost);
    const BigFloat square = BigFloat::product(s, s, 2 * a.limbs_ + 2, unknown).negated();
    const Magnitude rest = BigFloat::sum(a.middle_, square, 2 * a.limbs_ + 2, unknown).upper();
    unknown = unknown + rest + a.radius_;
    const Magnitude radius = unknown / s.lower();
    return {std::move(s), radius, a.limbs_};
}

}  // namespace stereodel::arithmetic
