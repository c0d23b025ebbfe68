#include "arithmetic/integer_quotients.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace stereodel::arithmetic {

namespace {

BigInteger magnitude(const BigInteger& value) {
    return value.sign() < 0 ? -value : value;
}

// value * 2^bits, what is left of it below the point being cut off.
BigInteger scaled(const BigInteger& value, std::ptrdiff_t bits) {
    return bits >= 0 ? value.shifted(static_cast<std::size_t>(bits)) : value.cut(static_cast<std::size_t>(-bits));
}

std::ptrdiff_t length_of(const BigInteger& value) {
    return static_cast<std::ptrdiff_t>(value.bit_length());
}

// An integer near numerator/denominator, both positive or the numerator of any sign, for quotients below 2^62: off by
// 2^-51 of itself and one half. Each operand is cut to 62 bits and rounded to a double.
std::int64_t near_quotient(const BigInteger& numerator, const BigInteger& denominator) {
    const std::ptrdiff_t above = std::max<std::ptrdiff_t>(0, length_of(numerator) - 62);
    const std::ptrdiff_t below = std::max<std::ptrdiff_t>(0, length_of(denominator) - 62);
    const double quotient = static_cast<double>(scaled(numerator, -above).to_int64()) /
                            static_cast<double>(scaled(denominator, -below).to_int64());
    return std::llround(std::ldexp(quotient, static_cast<int>(std::max<std::ptrdiff_t>(above - below, -1100))));
}

struct WholeQuotient {
    std::int64_t quotient;
    bool exact;
};

// The whole part of numerator/denominator, both positive, below 2^62. The second step corrects the first to within one
// or two, and these are counted.
WholeQuotient divide(const BigInteger& numerator, const BigInteger& denominator) {
    std::int64_t quotient = 0;
    BigInteger rest = numerator;
    for (int step = 0; step < 2; ++step) {
        const std::int64_t digits = near_quotient(rest, denominator);
        quotient += digits;
        rest = rest - denominator * BigInteger(digits);
    }
    for (; rest.sign() < 0; --quotient) {
        rest = rest + denominator;
    }
    for (BigInteger next = rest - denominator; next.sign() >= 0; next = rest - denominator) {
        rest = next;
        ++quotient;
    }
    return {quotient, rest.sign() == 0};
}

// quotient * 2^exponent for a quotient above 2^58, to the nearest double. Its last bit says whether anything is below.
double round_binary(std::uint64_t quotient, std::ptrdiff_t exponent) {
    int length = 0;
    for (std::uint64_t rest = quotient; rest != 0; rest >>= 1) {
        ++length;
    }
    // A double has 53 bits, and none below 2^-1074.
    const std::ptrdiff_t dropped = std::max<std::ptrdiff_t>({0, length - 53, -1074 - exponent});
    if (dropped > 63) {
        return 0.0;  // less than half of the least double
    }
    const std::uint64_t unit = std::uint64_t{1} << dropped;
    std::uint64_t kept = quotient >> dropped;
    const std::uint64_t rest = quotient & (unit - 1);
    kept += rest > unit / 2 || (rest == unit / 2 && kept % 2 == 1) ? 1 : 0;
    const std::ptrdiff_t place = std::min<std::ptrdiff_t>(exponent + dropped, 2000);  // beyond all doubles
    return std::ldexp(static_cast<double>(kept), static_cast<int>(place));
}

}  // namespace

double round_quotient(const BigInteger& numerator, const BigInteger& denominator, std::ptrdiff_t exponent) {
    if (numerator.sign() == 0) {
        return 0.0;
    }
    // Scaled so that the quotient lies between 2^58 and 2^60: five bits more than a double has, one more to come.
    const std::ptrdiff_t shift = 59 - (length_of(numerator) - length_of(denominator));
    const BigInteger above = magnitude(numerator), below = magnitude(denominator);
    const WholeQuotient whole = shift >= 0 ? divide(scaled(above, shift), below) : divide(above, scaled(below, -shift));
    const std::uint64_t sticky = static_cast<std::uint64_t>(whole.quotient) << 1 | (whole.exact ? 0U : 1U);
    const double result = round_binary(sticky, exponent - shift - 1);
    return numerator.sign() == denominator.sign() ? result : 0.0 - result;
}

// A few digits at a time: with square = root^2 + rest, the next digits of the root are d = rest/(2 root), and the rest
// becomes the rest shifted, with the next bits of the square, less d (2 root) + d^2. They are rounded from 51 bits, and
// the first 24 or the next 44 of them make d^2 less than 2^-7 of the root: it is off by 1/2 + 2^-7 + 2^-7 after a step.
IntegerRoot integer_root(const BigInteger& square, std::size_t bits) {
    constexpr std::ptrdiff_t start = 30, first = 24, further = 44;
    const std::ptrdiff_t wanted = static_cast<std::ptrdiff_t>(bits) - start - first;
    const std::ptrdiff_t length = start + first + (wanted + further - 1) / further * further;
    const std::ptrdiff_t exponent = (length_of(square) + 1) / 2 - length;
    std::ptrdiff_t hidden = 2 * (length - start);  // bits of the square, scaled to about 2 length bits, still to come
    BigInteger known = scaled(square, -2 * exponent - hidden);
    BigInteger root(std::llround(std::sqrt(static_cast<double>(known.to_int64()))));
    BigInteger rest = known - root * root;
    for (std::ptrdiff_t digits = first; hidden > 0; digits = further) {
        hidden -= 2 * digits;
        BigInteger more = scaled(square, -2 * exponent - hidden);
        const auto step = static_cast<std::size_t>(digits);
        rest = rest.shifted(2 * step) + (more - known.shifted(2 * step));
        known = std::move(more);
        root = root.shifted(step);
        const BigInteger d(near_quotient(rest, root.shifted(1)));
        rest = rest - d * (root.shifted(1) + d);
        root = root + d;
    }
    return {root, exponent};
}

void round_unit(const BigInteger* vector, double* result) {
    std::size_t longest = 0;
    for (int k = 0; k < 3; ++k) {
        longest = std::max(longest, vector[k].bit_length());
    }
    // The least double is 2^-1074 of the length; more than 2^-1074 * 2^-126 tells nothing.
    const std::size_t cut = longest - std::min<std::size_t>(longest, 1202);
    const BigInteger v[3] = {vector[0].cut(cut), vector[1].cut(cut), vector[2].cut(cut)};
    const IntegerRoot length = integer_root(v[0] * v[0] + v[1] * v[1] + v[2] * v[2], 128);
    for (int k = 0; k < 3; ++k) {
        result[k] = round_quotient(v[k], length.root, -length.exponent);
    }
}

}  // namespace stereodel::arithmetic
