// The numbers that define a map are doubles, and so integers over a power of two. As cosh(eta/2) : sinh(eta/2) is
// S + 1 : S - 1, eta = ln S, the quaternions L (S + 1 - i (S - 1) z) R are integers up to a common factor. So are their
// products, and their determinants are positive. Double-doubles would lose a product of magnifications of 1e16 that
// cancel each other, as its terms are that much larger than their sum.
//
// For q = L fisheye(S) R the two parts are a = cosh(eta/2) L R and b = -sinh(eta/2) L z R: S, L and R come from them
// without loss, however large S is.

#include "conformal/group.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

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
using Vector = std::array<DoubleDouble, 3>;

// (real + i imag)/sqrt(determinant).
struct IntegerElement {
    Integers real, imag;
    BigInteger determinant;
};

template <class Number>
std::array<Number, 4> product(const std::array<Number, 4>& p, const std::array<Number, 4>& q) {
    const auto& [a, b, c, d] = p;
    const auto& [w, x, y, z] = q;
    return {a * w - b * x - c * y - d * z, a * x + b * w + c * z - d * y, a * y - b * z + c * w + d * x,
            a * z + b * y - c * x + d * w};
}

template <class Number>
std::array<Number, 4> conjugate(const std::array<Number, 4>& q) {
    return {q[0], -q[1], -q[2], -q[3]};
}

template <class Number, std::size_t Size>
Number dot(const std::array<Number, Size>& a, const std::array<Number, Size>& b) {
    Number total = a[0] * b[0];
    for (std::size_t k = 1; k < Size; ++k) {
        total = total + a[k] * b[k];
    }
    return total;
}

Integers operator*(const BigInteger& factor, const Integers& q) {
    return {factor * q[0], factor * q[1], factor * q[2], factor * q[3]};
}

Integers operator+(const Integers& p, const Integers& q) {
    return {p[0] + q[0], p[1] + q[1], p[2] + q[2], p[3] + q[3]};
}

Integers operator-(const Integers& p, const Integers& q) {
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2], p[3] - q[3]};
}

// A quaternion of doubles times a power of two.
Integers whole(const std::array<double, 4>& q) {
    const int unit = std::min(std::min(lowest_exponent(q[0]), lowest_exponent(q[1])),
                              std::min(lowest_exponent(q[2]), lowest_exponent(q[3])));
    return {BigInteger::from_double(q[0], unit), BigInteger::from_double(q[1], unit),
            BigInteger::from_double(q[2], unit), BigInteger::from_double(q[3], unit)};
}

IntegerElement exactly(const StoredMap& map) {
    const Integers left = whole(map.left), right = whole(map.right);
    const int unit = std::min(0, lowest_exponent(map.magnification));
    const BigInteger size = BigInteger::from_double(map.magnification, unit);
    const BigInteger one = BigInteger(1).shifted(static_cast<std::size_t>(-unit));
    const Integers along_z = {left[3], -left[2], left[1], -left[0]};  // left times -z
    return {product((size + one) * left, right), product((size - one) * along_z, right),
            (size * one).shifted(2) * dot(left, left) * dot(right, right)};
}

IntegerElement product(const IntegerElement& p, const IntegerElement& q) {
    return {product(p.real, q.real) - product(p.imag, q.imag), product(p.real, q.imag) + product(p.imag, q.real),
            p.determinant * q.determinant};
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

template <std::size_t Size>
std::array<DoubleDouble, Size> over(const std::array<DoubleDouble, Size>& vector, DoubleDouble divisor) {
    std::array<DoubleDouble, Size> result;
    std::transform(vector.begin(), vector.end(), result.begin(), [divisor](DoubleDouble x) { return x / divisor; });
    return result;
}

template <std::size_t Size>
std::array<DoubleDouble, Size> normalized(const std::array<DoubleDouble, Size>& vector) {
    return over(vector, sqrt(dot(vector, vector)));
}

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The shortest rotation from unit vector a to b, as a quaternion of any length: (1 + a.b, a x b), with 1 + a.b =
// |a + b|^2/2 and a x b = a x (b -+ a), so that nothing cancels. Opposite vectors: half a turn about a x e, e the axis
// along which a is shortest.
Quaternion between(const Vector& a, const Vector& b) {
    const Vector total = {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
    const DoubleDouble square = dot(total, total);
    if (square.hi <= 0x1p-200) {
        const auto shorter = [](DoubleDouble x, DoubleDouble y) { return std::abs(x.hi) < std::abs(y.hi); };
        Vector axis{};
        axis[static_cast<std::size_t>(std::min_element(a.begin(), a.end(), shorter) - a.begin())].hi = 1.0;
        const Vector turn = cross(a, axis);
        return {DoubleDouble{}, turn[0], turn[1], turn[2]};
    }
    const Vector difference = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const Vector turn = cross(a, dot(a, b).hi < 0 ? total : difference);
    return {square * DoubleDouble{0.5}, turn[0], turn[1], turn[2]};
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
    return stored(rounded(product(exactly(then), exactly(first))));
}

}  // namespace stereodel::conformal
