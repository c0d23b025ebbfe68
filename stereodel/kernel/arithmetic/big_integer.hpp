// Signed integers of any size: the last stage of every predicate.
//
// Sign and magnitude, limbs of 32 bits, schoolbook multiplication. Up to INLINE limbs live in the object itself:
// coordinates of ordinary size never reach the heap.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace stereodel::arithmetic {

// Magnitude: little-endian limbs without leading zeros.
class Limbs {
  public:
    static constexpr std::size_t INLINE = 64;

    Limbs() = default;
    explicit Limbs(std::size_t size);  // contents undefined
    Limbs(const Limbs& other);
    Limbs(Limbs&& other) noexcept;
    Limbs& operator=(const Limbs& other);
    Limbs& operator=(Limbs&& other) noexcept;
    ~Limbs() = default;

    std::size_t size() const { return size_; }
    std::uint32_t* data() { return far_ ? far_.get() : near_.data(); }
    const std::uint32_t* data() const { return far_ ? far_.get() : near_.data(); }
    std::uint32_t operator[](std::size_t k) const { return data()[k]; }
    void trim();  // drops leading zeros

  private:
    std::size_t size_ = 0;
    std::unique_ptr<std::uint32_t[]> far_;
    std::array<std::uint32_t, INLINE> near_;
};

class BigInteger {
  public:
    BigInteger() = default;
    explicit BigInteger(std::int64_t value);

    // value * 2^-exponent for a finite double; that must be an integer (exponent <= lowest_exponent(value)).
    static BigInteger from_double(double value, int exponent);

    int sign() const { return sign_; }
    BigInteger operator-() const;
    BigInteger shifted(std::size_t bits) const;  // times 2^bits
    BigInteger cut(std::size_t bits) const;      // without the lowest bits of the magnitude, times 2^-bits
    std::size_t bit_length() const;              // of the magnitude; 0 for zero
    std::int64_t to_int64() const;               // for a bit length below 64

    friend BigInteger operator+(const BigInteger& a, const BigInteger& b) { return sum(a, b, b.sign_); }
    friend BigInteger operator-(const BigInteger& a, const BigInteger& b) { return sum(a, b, -b.sign_); }
    friend BigInteger operator*(const BigInteger& a, const BigInteger& b);
    friend bool operator==(const BigInteger& a, const BigInteger& b);

  private:
    BigInteger(int sign, Limbs&& limbs);
    static BigInteger sum(const BigInteger& a, const BigInteger& b, int b_sign);

    int sign_ = 0;
    Limbs limbs_;
};

// The exponent of the lowest bit that is set: value = odd * 2^result. EVERY_EXPONENT for zero: every power divides it.
constexpr int EVERY_EXPONENT = 1 << 20;
int lowest_exponent(double value);

}  // namespace stereodel::arithmetic
