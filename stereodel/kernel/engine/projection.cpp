#include "engine/projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "arithmetic/double_double.hpp"
#include "arithmetic/roots.hpp"
#include "predicates/ray_integers.hpp"

namespace stereodel::engine {

namespace rays = predicates::rays;
using arithmetic::BigInteger;
using arithmetic::DoubleDouble;
using arithmetic::RootTerm;
using arithmetic::lowest_exponent;
using arithmetic::sign_of_roots;
using arithmetic::sqrt;
using arithmetic::two_product;
using arithmetic::two_sum;

namespace {

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();

// Which component is X, and which Y.
int component_of(Pole pole, int coordinate) {
    return (pole.axis + (pole.sign < 0 ? 1 + coordinate : 2 - coordinate)) % 3;
}

// A vector as the projection sees it: scaled by a power of two to ordinary size, height = sign * p_k.
struct Seen {
    double flat[2], height;

    Seen(const double* p, Pole pole)
        : flat{p[component_of(pole, 0)], p[component_of(pole, 1)]}, height(pole.sign * p[pole.axis]) {
        const double largest = std::max({std::fabs(flat[0]), std::fabs(flat[1]), std::fabs(height)});
        if (!(largest > 0x1p-20 && largest < 0x1p20)) {
            int exponent = 0;
            std::frexp(largest, &exponent);
            flat[0] = scaled(flat[0], -exponent);
            flat[1] = scaled(flat[1], -exponent);
            height = std::ldexp(height, -exponent);
        }
    }

  private:
    // Zero stays the mark of a zero: what underflows is too small for any promise all the same.
    static double scaled(double value, int exponent) {
        const double result = std::ldexp(value, exponent);
        return result == 0.0 && value != 0.0 ? std::numeric_limits<double>::denorm_min() : result;
    }
};

// The factor of a promise: 1, or NaN for a numerator that is not zero and too small for it.
double promise(double numerator, double limit) {
    return numerator == 0.0 || std::fabs(numerator) > limit ? 1.0 : NOT_A_NUMBER;
}

}  // namespace

// For height <= 0, X = x / (|p| - height): the square holds three roundings, halved by the root, the root one, the sum
// one, the quotient one: 4.5u. For height > 0 without cancellation X = x (|p| + height) / (x^2 + y^2): 3.5u, a product,
// two roundings of x^2 + y^2, a quotient: 7.5u. Scaled vectors lie between 2^-20 and 2^20: with numerators and x^2 +
// y^2 above 2^-900 no result is below 2^-970, and no square that underflows counts.
void project(const double* p, Pole pole, double out[2]) {
    const Seen v(p, pole);
    const double square = v.flat[0] * v.flat[0] + v.flat[1] * v.flat[1];
    const double reach = std::sqrt(square + v.height * v.height) + std::fabs(v.height);
    const double safe = square > 0x1p-900 ? square : NOT_A_NUMBER;
    for (int k = 0; k < 2; ++k) {
        const double image = v.height > 0.0 ? v.flat[k] * reach / safe : v.flat[k] / reach;
        out[k] = image * promise(v.flat[k], 0x1p-900);
    }
}

// The same in double-double. Squares are exact; the sums 3.1u^2 each, all terms positive; the root of that 3.1u^2 +
// 5u^2, the reach 11.2u^2, the product 18.3u^2, the quotient by x^2 + y^2 (3.1u^2) 11u^2 more: below 33u^2 < 2^-100.
// With numerators above 2^-400, squares above 2^-800, nothing underflows that the operations' bounds build upon.
void project_double_double(const double* p, Pole pole, double out[4]) {
    const Seen v(p, pole);
    const DoubleDouble square = two_product(v.flat[0], v.flat[0]) + two_product(v.flat[1], v.flat[1]);
    const DoubleDouble reach =
        sqrt(square + two_product(v.height, v.height)) + DoubleDouble{std::fabs(v.height), 0.0};
    for (int k = 0; k < 2; ++k) {
        const DoubleDouble x = {v.flat[k], 0.0};
        const DoubleDouble image = v.height > 0.0 ? x * reach / square : x / reach;
        const double factor = promise(v.flat[k], 0x1p-400);
        out[2 * k] = image.hi * factor;
        out[2 * k + 1] = image.lo * factor;
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

}  // namespace stereodel::engine
