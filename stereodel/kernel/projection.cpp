#include "projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "double_double.hpp"
#include "ray_integers.hpp"
#include "roots.hpp"

namespace stereodel {

namespace {

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();

// Which component is X, and which Y.
int component_of(Pole pole, int coordinate) {
    return (pole.axis + (pole.sign < 0 ? 1 + coordinate : 2 - coordinate)) % 3;
}

// A vector as the projection sees it: scaled by a power of two to ordinary size, height = sign * p_k.
struct Seen {
    double x, y, height;

    Seen(const double* p, Pole pole)
        : x(p[component_of(pole, 0)]), y(p[component_of(pole, 1)]), height(pole.sign * p[pole.axis]) {
        const double largest = std::max({std::fabs(x), std::fabs(y), std::fabs(height)});
        if (!(largest > 0x1p-20 && largest < 0x1p20)) {
            scale(largest);
        }
    }

  private:
    void scale(double largest) {
        int exponent = 0;
        std::frexp(largest, &exponent);
        x = scaled(x, -exponent);
        y = scaled(y, -exponent);
        height = std::ldexp(height, -exponent);
    }

    // A component that loses bits among the subnormals breaks the promise of a relative error.
    static double scaled(double value, int exponent) {
        const double result = std::ldexp(value, exponent);
        return value != 0.0 && std::fabs(result) < 0x1p-1000 ? NOT_A_NUMBER : result;
    }
};

// value, if no bits of it or of what it was computed from can have been lost to underflow.
double in_range(double value, double numerator, double limit) {
    return numerator == 0.0 || std::fabs(value) > limit ? value : NOT_A_NUMBER;
}

}  // namespace

// For height <= 0, X = x / (|p| - height): the square holds three roundings, halved by the root, the root one, the sum one,
// the quotient one: 4.5u. For height > 0 without cancellation X = x (|p| + height) / (x^2 + y^2): 3.5u, a product, two
// roundings of x^2 + y^2, a quotient: 7.5u. Squares that underflow matter in x^2 + y^2 alone: below 2^-900 it is refused.
void project(const double* p, Pole pole, double out[2]) {
    const Seen v(p, pole);
    const double flat = v.x * v.x + v.y * v.y;
    const double reach = std::sqrt(flat + v.height * v.height) + std::fabs(v.height);
    if (v.height > 0.0) {
        const double safe = flat > 0x1p-900 ? flat : NOT_A_NUMBER;
        out[0] = in_range(v.x * reach / safe, v.x, 0x1p-1000);
        out[1] = in_range(v.y * reach / safe, v.y, 0x1p-1000);
    } else {
        out[0] = in_range(v.x / reach, v.x, 0x1p-1000);
        out[1] = in_range(v.y / reach, v.y, 0x1p-1000);
    }
}

// The same in double-double. Squares are exact; the sums 3.1u^2 each, all terms positive; the root of that 3.1u^2 + 5u^2,
// the reach 11.2u^2, the product 18.3u^2, the quotient by x^2 + y^2 (3.1u^2) 11u^2 more: below 33u^2 < 2^-100. The
// operations keep their relative bounds for magnitudes from 2^-480 to 2^480; a lost square of a far smaller component beside
// the other counts below 2^-200. Components below 2^-400 are refused.
void project_double_double(const double* p, Pole pole, double out[4]) {
    const Seen v(p, pole);
    const DoubleDouble flat = two_product(v.x, v.x) + two_product(v.y, v.y);
    const DoubleDouble reach =
        sqrt(flat + two_product(v.height, v.height)) + DoubleDouble{std::fabs(v.height), 0.0};
    const double safe = v.height > 0.0 && !(flat.hi > 0x1p-400) ? NOT_A_NUMBER : 1.0;
    for (int k = 0; k < 2; ++k) {
        const double numerator = k == 0 ? v.x : v.y;
        const DoubleDouble image =
            v.height > 0.0 ? DoubleDouble{numerator, 0.0} * reach / flat : DoubleDouble{numerator, 0.0} / reach;
        const double promise = safe * in_range(1.0, numerator, 0.0) * (numerator == 0.0 || std::fabs(numerator) > 0x1p-400 ? 1.0 : NOT_A_NUMBER);
        out[2 * k] = image.hi * promise;
        out[2 * k + 1] = image.lo * promise;
    }
}

Sign compare_projected_filter(const double* p, const double* q, Pole pole, int coordinate) {
    double x[2], y[2];
    project(p, pole, x);
    project(q, pole, y);
    // 8u each, and a little for the roundings here.
    return decide(x[coordinate] - y[coordinate], 9 * 0x1p-53 * (std::fabs(x[coordinate]) + std::fabs(y[coordinate])));
}

Sign compare_projected_double_double(const double* p, const double* q, Pole pole, int coordinate) {
    double x[4], y[4];
    project_double_double(p, pole, x);
    project_double_double(q, pole, y);
    const DoubleDouble u = {x[2 * coordinate], x[2 * coordinate + 1]}, v = {y[2 * coordinate], y[2 * coordinate + 1]};
    return decide((u - v).hi, 0x1p-96 * (std::fabs(u.hi) + std::fabs(v.hi)));
}

// X(p) - X(q) = x/(|p| - h) - y/(|q| - k) has the sign of x(|q| - k) - y(|p| - h).
int compare_projected_exact(const double* p, const double* q, Pole pole, int coordinate) {
    const int i = component_of(pole, coordinate), k = pole.axis;
    const rays::IntegerRay rp(p), rq(q);
    const BigInteger cross = rq.v[i] * rp.v[k] - rp.v[i] * rq.v[k];
    const std::array<RootTerm, 3> terms = {RootTerm{rp.v[i], rq.squared()}, RootTerm{-rq.v[i], rp.squared()},
                                           RootTerm{pole.sign > 0 ? cross : -cross, BigInteger(1)}};
    return sign_of_roots(terms.data(), 3);
}

int compare_projected(const double* p, const double* q, Pole pole, int coordinate) {
    const int i = component_of(pole, coordinate);
    if (const int sign_p = sign_of(p[i]), sign_q = sign_of(q[i]); sign_p != sign_q || sign_p == 0) {
        return sign_of(sign_p - sign_q);
    }
    Sign sign = compare_projected_filter(p, q, pole, coordinate);
    if (sign == OPEN) {
        sign = compare_projected_double_double(p, q, pole, coordinate);
    }
    return sign != OPEN ? sign : compare_projected_exact(p, q, pole, coordinate);
}

Sign compare_to_line_filter(const double* p, Pole pole, int coordinate, double hi, double lo) {
    double x[2];
    project(p, pole, x);
    const double line = hi + lo;
    return decide(x[coordinate] - line, 9 * 0x1p-53 * std::fabs(x[coordinate]) + 2 * 0x1p-53 * std::fabs(line));
}

Sign compare_to_line_double_double(const double* p, Pole pole, int coordinate, double hi, double lo) {
    double x[4];
    project_double_double(p, pole, x);
    const DoubleDouble image = {x[2 * coordinate], x[2 * coordinate + 1]}, line = two_sum(hi, lo);
    return decide((image - line).hi, 0x1p-96 * (std::fabs(image.hi) + std::fabs(line.hi)));
}

// x/(|p| - h) - b has the sign of x + b h - b|p|; b is an integer times 2^-e.
int compare_to_line_exact(const double* p, Pole pole, int coordinate, double hi, double lo) {
    const rays::IntegerRay r(p);
    const int exponent = std::min({lowest_exponent(hi), lowest_exponent(lo), 0});
    const BigInteger line = BigInteger::from_double(hi, exponent) + BigInteger::from_double(lo, exponent);
    const BigInteger height = pole.sign > 0 ? r.v[pole.axis] : -r.v[pole.axis];
    const BigInteger x = r.v[component_of(pole, coordinate)].shifted(static_cast<std::size_t>(-exponent));
    const std::array<RootTerm, 2> terms = {RootTerm{x + line * height, BigInteger(1)}, RootTerm{-line, r.squared()}};
    return sign_of_roots(terms.data(), 2);
}

int compare_to_line(const double* p, Pole pole, int coordinate, double hi, double lo) {
    Sign sign = compare_to_line_filter(p, pole, coordinate, hi, lo);
    if (sign == OPEN) {
        sign = compare_to_line_double_double(p, pole, coordinate, hi, lo);
    }
    return sign != OPEN ? sign : compare_to_line_exact(p, pole, coordinate, hi, lo);
}

}  // namespace stereodel
