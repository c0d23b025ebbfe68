// Real numbers of many digits that know their error: the last stage of what is measured, not decided.
//
// A `BigBall` is a midpoint of up to so many limbs of 32 bits and a radius: the true value is no farther from the
// midpoint than that. Every operation cuts its midpoint to the precision of its operands and widens the radius by what
// it cut off, so that a formula carries its own bound; where that is too large, it is evaluated again with more limbs.
// (F. Johansson, "Arb: efficient arbitrary-precision midpoint-radius interval arithmetic", IEEE Trans. Computers 66,
// 2017.) Exponents have 64 bits: nothing overflows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stereodel::arithmetic {

// A size of no more than m 2^e, m in [1/2, 1) or 0; all results are rounded up.
struct Magnitude {
    double m = 0.0;
    std::int64_t e = 0;

    static Magnitude of(double m, std::int64_t e);
    friend Magnitude operator+(const Magnitude& a, const Magnitude& b);
    friend Magnitude operator*(const Magnitude& a, const Magnitude& b);
    friend Magnitude operator/(const Magnitude& a, const Magnitude& b);  // b > 0
    Magnitude root() const;
    bool is_zero() const { return m == 0.0; }
    double times_power(std::int64_t exponent) const;  // times 2^exponent as a double, at least 2^-1074 unless zero
};

// sum limbs[k] 2^(32 (k + exponent)), the first and the last limb not zero; zero has none.
class BigFloat {
  public:
    BigFloat() = default;
    explicit BigFloat(double value);  // exact

    int sign() const { return limbs_.empty() ? 0 : sign_; }
    BigFloat negated() const;
    BigFloat times_power(std::int64_t bits) const;    // times 2^bits, exactly
    double to_double(std::int64_t exponent) const;    // times 2^exponent, within two ulps
    std::int64_t top() const;                         // |value| < 2^(32 top)
    Magnitude upper() const;                          // at least |value|
    Magnitude lower() const;                          // at most |value|

    // Cut to so many limbs; `lost` grows by what was cut off.
    static BigFloat sum(const BigFloat& a, const BigFloat& b, std::size_t limbs, Magnitude& lost);
    static BigFloat product(const BigFloat& a, const BigFloat& b, std::size_t limbs, Magnitude& lost);

    // Approximations without a bound, of numbers above 0.
    static BigFloat reciprocal(const BigFloat& a, std::size_t limbs);
    static BigFloat reciprocal_root(const BigFloat& a, std::size_t limbs);

  private:
    void trim(std::size_t limbs, Magnitude* lost);
    double leading(std::int64_t& exponent) const;  // value within 2^-60 or so, over 2^(32 exponent)

    int sign_ = 0;
    std::int64_t exponent_ = 0;
    std::vector<std::uint32_t> limbs_;
};

class BigBall {
  public:
    BigBall() = default;
    BigBall(double value, std::size_t limbs) : middle_(value), limbs_(limbs) {}

    BigBall like(double value) const { return {value, limbs_}; }  // of the same precision
    int sign() const { return middle_.sign(); }                // of the midpoint
    bool is_zero() const { return sign() == 0 && radius_.is_zero(); }
    double digits() const { return 32.0 * static_cast<double>(limbs_); }  // binary ones, of the precision
    BigBall times_power(std::int64_t bits) const;
    BigBall error_alone() const;  // zero within its absolute value

    // The exponent of a power of two above the midpoint, a multiple of 32: up to 32 more than needed. And both parts
    // over such a power.
    std::int64_t exponent() const { return 32 * middle_.top(); }
    double middle(std::int64_t exponent) const { return middle_.to_double(-exponent); }
    double radius(std::int64_t exponent) const;

    BigBall operator-() const;
    friend BigBall operator+(const BigBall& a, const BigBall& b);
    friend BigBall operator-(const BigBall& a, const BigBall& b) { return a + -b; }
    friend BigBall operator*(const BigBall& a, const BigBall& b);
    friend BigBall operator/(const BigBall& a, const BigBall& b);  // of infinite radius where b may be zero
    friend BigBall sqrt(const BigBall& a);                      // of a number that is not negative

  private:
    BigBall(BigFloat&& middle, const Magnitude& radius, std::size_t limbs);

    BigFloat middle_;
    Magnitude radius_;
    std::size_t limbs_ = 0;
};

}  // namespace stereodel::arithmetic
