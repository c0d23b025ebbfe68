// The stages of orientation and incircle in the plane, cheap first: doubles, the grid of the input, about twice the
// precision, integers. Each answers with a proven sign or leaves it open; the last always answers.
//
// J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", Discrete &
// Computational Geometry 18 (1997), for the idea of stages; the bounds are derived here.
//
// Underflow: a product of doubles is off by 2^-1075 more, sums and differences never are. A bound gets FLOOR = 2^-1000
// for each factor that such an error meets, thousands of times what the few dozen products can lose. Overflow makes the
// permanent infinite or NaN, and the sign stays open.
#pragma once

#include <cmath>

#include "arithmetic/error_counts.hpp"
#include "predicates/plane_forms.hpp"
#include "tally.hpp"

namespace stereodel::predicates::plane {

using arithmetic::RoundingCount;
using arithmetic::UNIT_ROUNDOFF;

constexpr double FLOOR = 0x1p-1000;

// A computed value and the permanent (or something larger) that its bound is a multiple of.
struct Estimate {
    double value;
    double bound;
    double permanent;
};

// What the roundings are multiplied with; a difference of coordinates is rounded once.
constexpr RoundingCount EDGE = {1};
constexpr double ORIENT_ROUNDING = 5, INCIRCLE_ROUNDING = 12, DISTANCE_ROUNDING = 6;
static_assert(cross_form(EDGE, EDGE, EDGE, EDGE).bound() <= ORIENT_ROUNDING);
static_assert(dot_form(EDGE, EDGE, EDGE, EDGE).bound() <= ORIENT_ROUNDING);
static_assert(incircle_form(EDGE, EDGE, EDGE, EDGE, EDGE, EDGE).bound() <= INCIRCLE_ROUNDING);
static_assert((square_form(EDGE, EDGE) - square_form(EDGE, EDGE)).bound() <= DISTANCE_ROUNDING);

// Twice the signed area of abc.
inline Estimate orient_estimate(const double* a, const double* b, const double* c) {
    const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
    const double permanent = std::fabs(bx * cy) + std::fabs(by * cx);
    return {cross_form(bx, by, cx, cy), ORIENT_ROUNDING * UNIT_ROUNDOFF * permanent + FLOOR, permanent};
}

// The incircle determinant of abc and d. Underflow in A, B, C meets factors like |bx cy| <= (B + C)/2, underflow in the
// products bx cy meets A, B, C, that of the last products meets nothing: FLOOR times A + B + C + 1.
inline Estimate incircle_estimate(const double* a, const double* b, const double* c, const double* d) {
    const double ax = a[0] - d[0], ay = a[1] - d[1], bx = b[0] - d[0], by = b[1] - d[1];
    const double cx = c[0] - d[0], cy = c[1] - d[1];
    const double aa = square_form(ax, ay), bb = square_form(bx, by), cc = square_form(cx, cy);
    const double permanent = aa * (bb + cc) + bb * cc;
    return {incircle_form(ax, ay, bx, by, cx, cy),
            INCIRCLE_ROUNDING * UNIT_ROUNDOFF * permanent + FLOOR * (aa + (bb + cc) + 1), permanent};
}

// (a-p).(b-p), at most zero in the disk with the diameter ab.
inline Estimate diametral_estimate(const double* a, const double* b, const double* p) {
    const double ax = a[0] - p[0], ay = a[1] - p[1], bx = b[0] - p[0], by = b[1] - p[1];
    const double permanent = std::fabs(ax * bx) + std::fabs(ay * by);
    return {dot_form(ax, ay, bx, by), ORIENT_ROUNDING * UNIT_ROUNDOFF * permanent + FLOOR, permanent};
}

inline double squared_length(const double* p, const double* q) {
    return square_form(q[0] - p[0], q[1] - p[1]);
}

// Which of two squared lengths so computed is smaller.
inline Sign compare_squares(double aa, double bb) {
    return decide(aa - bb, DISTANCE_ROUNDING * UNIT_ROUNDOFF * (aa + bb) + FLOOR);
}

// |pa|^2 - |qb|^2.
inline Estimate distance_estimate(const double* p, const double* a, const double* q, const double* b) {
    const double aa = squared_length(p, a), bb = squared_length(q, b);
    return {aa - bb, DISTANCE_ROUNDING * UNIT_ROUNDOFF * (aa + bb) + FLOOR, aa + bb};
}

// About twice the precision. Where products leave the range of doubles, the first stage and this one are asked about
// the points multiplied by a power of two.
Sign orient_double_double(const double* a, const double* b, const double* c);
Sign incircle_double_double(const double* a, const double* b, const double* c, const double* d);
// For coordinates that are multiples of 1/`per_unit`, a power of two, and signs that the stage before left open: so the
// value is small, and its last 128 binary digits tell all. Open where they do not.
Sign incircle_last_digits(const double* a, const double* b, const double* c, const double* d, double per_unit);
Sign diametral_double_double(const double* a, const double* b, const double* p);
Sign distances_double_double(const double* p, const double* a, const double* q, const double* b);

// Integers: always right, never open.
int orient_exact(const double* a, const double* b, const double* c);
int incircle_exact(const double* a, const double* b, const double* c, const double* d);
int diametral_exact(const double* a, const double* b, const double* p);
int distances_exact(const double* p, const double* a, const double* q, const double* b);

// Whether the four points are the corners of a rectangle with sides along the axes (or fewer than four different ones
// of them): then incircle is exactly zero. Grids consist of these.
bool is_rectangle_beside(const double* a, const double* b, const double* c, const double* d);
inline bool is_rectangle(const double* a, const double* b, const double* c, const double* d) {
    const bool beside = d[0] == a[0] || d[0] == b[0] || d[0] == c[0];  // one corner is, and mostly there is none
    return beside && is_rectangle_beside(a, b, c, d);
}

// Whether two points are the same or all three share a coordinate: then orient is exactly zero.
inline bool on_axis_line(const double* a, const double* b, const double* c) {
    return (a[0] == b[0] && b[0] == c[0]) || (a[1] == b[1] && b[1] == c[1]);
}

}  // namespace stereodel::predicates::plane
