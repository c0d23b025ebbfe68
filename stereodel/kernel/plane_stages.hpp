// The stages of orientation and incircle in the plane, cheap first: doubles, the grid of the input, about twice the
// precision, integers. Each answers with a proven sign or leaves it open; the last always answers.
//
// J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", Discrete &
// Computational Geometry 18 (1997), for the idea of stages; the bounds are derived here.
//
// How bounds are counted: in an expanded sum of products every term passes through at most N roundings, each a factor
// 1 + d with |d| <= u = 2^-53, so the computed sum is off by at most ((1+u)^N - 1) times the permanent, the sum of the
// absolute values of the exact terms. Bounds are stated with N + 1 in place of N: the whole u between them is far more
// than what (1+u)^N - 1 - Nu and the roundings in the permanent and in the bound itself add.
//
// Underflow: a product of doubles is off by 2^-1075 more, sums and differences never are. A bound gets FLOOR = 2^-1000
// for each factor that such an error meets, thousands of times what the few dozen products can lose. Overflow makes the
// permanent infinite or NaN, and the sign stays open.
#pragma once

#include <cmath>

#include "tally.hpp"

namespace stereodel::plane {

constexpr double UNIT_ROUNDOFF = 0x1p-53;
constexpr double FLOOR = 0x1p-1000;

// A computed value and the permanent (or something larger) that its bound is a multiple of.
struct Estimate {
    double value;
    double bound;
    double permanent;
};

// Twice the signed area of abc. A term: two differences, a product, a subtraction: N = 4.
inline Estimate orient_estimate(const double* a, const double* b, const double* c) {
    const double left = (b[0] - a[0]) * (c[1] - a[1]);
    const double right = (b[1] - a[1]) * (c[0] - a[0]);
    const double permanent = std::fabs(left) + std::fabs(right);
    return {left - right, 5 * UNIT_ROUNDOFF * permanent + FLOOR, permanent};
}

// The incircle determinant of abc and d. A term: four differences, a square, a sum, a product, a subtraction, a product,
// two sums: N = 11. With A = |a-d|^2 and so on, |bx cy| + |by cx| <= sqrt(BC) <= (B + C)/2 (Cauchy, then the two means),
// so the permanent is at most AB + BC + CA. Underflow in A, B, C meets factors like |bx cy| <= (B + C)/2, underflow in
// the products bx cy meets A, B, C, that of the last products meets nothing: FLOOR times A + B + C + 1.
inline Estimate incircle_estimate(const double* a, const double* b, const double* c, const double* d) {
    const double ax = a[0] - d[0], ay = a[1] - d[1], bx = b[0] - d[0], by = b[1] - d[1], cx = c[0] - d[0],
                 cy = c[1] - d[1];
    const double aa = ax * ax + ay * ay, bb = bx * bx + by * by, cc = cx * cx + cy * cy;
    const double value = aa * (bx * cy - by * cx) + bb * (cx * ay - cy * ax) + cc * (ax * by - ay * bx);
    const double permanent = aa * (bb + cc) + bb * cc;
    return {value, 12 * UNIT_ROUNDOFF * permanent + FLOOR * (aa + (bb + cc) + 1), permanent};
}

// |qa|^2 - |qb|^2. A term: twice a difference, a product, a sum, a subtraction: N = 5.
inline Estimate distance_estimate(const double* q, const double* a, const double* b) {
    const double ax = a[0] - q[0], ay = a[1] - q[1], bx = b[0] - q[0], by = b[1] - q[1];
    const double aa = ax * ax + ay * ay, bb = bx * bx + by * by;
    return {aa - bb, 6 * UNIT_ROUNDOFF * (aa + bb) + FLOOR, aa + bb};
}

// About twice the precision.
Sign orient_double_double(const double* a, const double* b, const double* c);
Sign incircle_double_double(const double* a, const double* b, const double* c, const double* d);
Sign distances_double_double(const double* q, const double* a, const double* b);

// Integers: always right, never open.
int orient_exact(const double* a, const double* b, const double* c);
int incircle_exact(const double* a, const double* b, const double* c, const double* d);
int distances_exact(const double* q, const double* a, const double* b);

// Whether the four points are the corners of a rectangle with sides along the axes (or fewer than four different ones
// of them): then incircle is exactly zero. Grids consist of these.
bool is_rectangle(const double* a, const double* b, const double* c, const double* d);

// Whether two points are the same or all three share a coordinate: then orient is exactly zero.
inline bool on_axis_line(const double* a, const double* b, const double* c) {
    return (a[0] == b[0] && b[0] == c[0]) || (a[1] == b[1] && b[1] == c[1]);
}

}  // namespace stereodel::plane
