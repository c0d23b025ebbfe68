// The numbers that define a map are doubles, and so integers over a power of two. As cosh(eta/2) : sinh(eta/2) is
// S + 1 : S - 1, eta = ln S, the quaternions L (S + 1 - i (S - 1) z) R are integers up to a common factor. So are their
// products, and their determinants are positive. Double-doubles would lose a product of magnifications of 1e16 that
// cancel each other, as its terms are that much larger than their sum.
//
// For q = L fisheye(S) R the two parts are a = cosh(eta/2) L R and b = -sinh(eta/2) L z R: S, L and R come from them
// without loss, however large S is.

#include "conformal/group.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>

#include "arithmetic/big_integer.hpp"
#include "arithmetic/integer_quotients.hpp"

namespace stereodel::conformal {

using arithmetic::BigInteger;
using arithmetic::DoubleDouble;
using arithmetic::IntegerRoot;
using arithmetic::integer_root;
using arithmetic::lowest_exponent;
using arithmetic::round_quotient;

namespace {

using Integers = std::array<BigInteger, 4>;

// (real + i imag)/sqrt(determinant).
struct IntegerElement {
    Integers real, imag;
    BigInteger determinant;
};

Quaternion conjugate(const Quaternion& q) {
    return {q[0], -q[1], -q[2], -q[3]};
}

Integers operator*(const BigInteger& factor, const Integers& q) {
    Integers result;
    std::transform(q.begin(), q.end(), result.begin(), [&](const BigInteger& part) { return factor * part; });
    return result;
}

Integers sum(const Integers& p, const Integers& q) {
    Integers result;
    std::transform(p.begin(), p.end(), q.begin(), result.begin(), std::plus<>());
    return result;
}

// A quaternion of doubles times a power of two.
Integers whole(const std::array<double, 4>& q) {
    int unit = lowest_exponent(q[0]);
    for (const double part : q) {
        unit = std::min(unit, lowest_exponent(part));
    }
    Integers result;
    std::transform(q.begin(), q.end(), result.begin(),
                   [unit](double part) { return BigInteger::from_double(part, unit); });
    return result;
}

IntegerElement exactly(const StoredMap& map) {
    const Integers left = whole(map.left), right = whole(map.right);
    const int unit = std::min(0, lowest_exponent(map.magnification));
    const BigInteger size = BigInteger::from_double(map.magnification, unit);
    const BigInteger one = BigInteger(1).shifted(static_cast<std::size_t>(-unit));
    Integers down;  // -z, S - 1 times as long
    down[3] = one - size;
    return {product((size + one) * left, right), product(product(left, down), right),
            (size * one).shifted(2) * dot(left, left) * dot(right, right)};
}

IntegerElement after(const IntegerElement& p, const IntegerElement& q) {
    return {sum(product(p.real, q.real), product(BigInteger(-1) * p.imag, q.imag)),
            sum(product(p.real, q.imag), product(p.imag, q.real)), p.determinant * q.determinant};
}

// numerator/denominator 2^exponent as a double and what that leaves, rounded once each.
DoubleDouble quotient(const BigInteger& numerator, const BigInteger& denominator, std::ptrdiff_t exponent) {
    const double high = round_quotient(numerator, denominator, exponent);
    if (high == 0.0) {
        return {};
    }
    const std::ptrdiff_t place = lowest_exponent(high), unit = std::min(place, exponent);
    const auto over_unit = [unit](const BigInteger& value, std::ptrdiff_t at) {
        return value.shifted(static_cast<std::size_t>(at - unit));
    };
    const BigInteger digits = BigInteger::from_double(high, static_cast<int>(place));
    const BigInteger rest = over_unit(numerator, exponent) - over_unit(digits * denominator, place);
    return {high, round_quotient(rest, denominator, unit)};
}

Quaternion over(const Integers& q, const IntegerRoot& root) {
    Quaternion result;
    for (std::size_t k = 0; k < 4; ++k) {
        result[k] = quotient(q[k], root.root, -root.exponent);
    }
    return result;
}

Element rounded(const IntegerElement& element) {
    // Of a square the root is exact; of others it is off by less than any double-double shows.
    const std::size_t bits = std::max<std::size_t>(256, element.determinant.bit_length() / 2 + 1);
    const IntegerRoot root = integer_root(element.determinant, bits);
    return {over(element.real, root), over(element.imag, root)};
}

std::array<double, 4> rounded(const Quaternion& q) {
    return {q[0].hi + q[0].lo, q[1].hi + q[1].lo, q[2].hi + q[2].lo, q[3].hi + q[3].lo};
}

}  // namespace

KnownElement element_of(const StoredMap& map) {
    const IntegerElement exact = exactly(map);
    const std::array<BigInteger, 3> v = {exact.real[1], exact.real[2], exact.real[3]};
    const std::array<BigInteger, 3> w = {exact.imag[1], exact.imag[2], exact.imag[3]};
    return {rounded(exact),
            {quotient(dot(v, v) - dot(w, w), exact.determinant, 0), quotient(dot(v, w), exact.determinant, 1)}};
}

StoredMap stored(const Element& element) {
    const auto& [real, imag] = element;
    // sinh(eta/2) is |imag|, and cosh(eta/2) its sqrt(1 + |imag|^2) rather than |real|: the determinant of a power is 1
    // up to a rounding of doubles, which must not magnify where imag is 0.
    const DoubleDouble square = dot(imag, imag);
    const DoubleDouble root = sqrt(square) + sqrt(square + DoubleDouble{1.0});
    const DoubleDouble size = root * root;
    const double magnification = size.hi + size.lo;
    if (magnification <= 1.0) {
        return {{1.0, 0.0, 0.0, 0.0}, 1.0, rounded(real)};
    }
    const Quaternion turned = product(imag, conjugate(real));
    const Vector axis = {-turned[1], -turned[2], -turned[3]};
    const Vector z = {DoubleDouble{}, DoubleDouble{}, DoubleDouble{1.0}};
    const Quaternion left = normalized(between(z, normalized(axis)));
    return {rounded(left), magnification, rounded(product(conjugate(left), normalized(real)))};
}

StoredMap composed(const StoredMap& then, const StoredMap& first) {
    return stored(rounded(after(exactly(then), exactly(first))));
}

}  // namespace stereodel::conformal
