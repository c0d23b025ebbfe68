// A closed bubble as the points where a quadratic function is not positive, in doubles, with its error.
//
// With T = x - a, B = b - a, C = c - a and the normal n (the unit vector a on the sphere, e_z in the plane), a site x
// lies in the closed bubble of a counterclockwise triangle a b c if and only if
//     f(T) = D T.T + G.T <= 0,    D = n.(B x C),    G = B.B (n x C) - C.C (n x B),
// the curvature form of the predicate (ray_stages.hpp; in the plane the incircle form relative to a), as a function of
// x. D > 0: the inside of a ball; D < 0, as of closing facets: the outside; D = 0: a side of a plane, and so is, with
// G = n x (v - u), what lies beyond the edge u v of the plane's hull. A disc around q through p is D = 1, G = 0 and a
// constant -|p - q|^2. As f is a sum over the axes, its least value in a box is the sum of three (two) least values.
//
// Errors, u = 2^-53. With B, C, T in the box no longer than lb, lc, M, products expanded, the permanents of D M^2 and
// of G.T are at most P = lb lc M^2 and Q = lb lc (lb + lc) M in the plane, and ROOT_TWO (1 + u) times that on the
// sphere: by Cauchy, as of the minors |n_i C_j| + |n_j C_i| <= sqrt(2) |n||C|, also as a vector. So roundings count
//     ROUNDING u (P + Q),
// in which the counts of D, G and of f at a corner of the box are added by the compiler. A least value inside the box
// is taken at -G/(2D), rounded: a place off by u of itself, where f is level, so that it counts in second order.
//
// On the sphere vectors are `UnitVector`s, off by 2^-101 in each component, by less than 2^-100 in all: so B, C and T
// are off by less than ABSENT = 2^-99 beside their roundings (two: Difference), and the high part of a stands for n,
// which is one more. A form of differences that are off by h moves by at most h (L S + 3 lb lc M) <= (4/3) h L S with
// L = lb + lc + M, S = lb lc + lc M + M lb (see ray_stages.hpp); it is given twice as much, for terms of second order,
// which the lengths, 2 ABSENT longer than computed, cover too.
//
// Underflow: in the plane coordinates are multiplied by a power of two that brings B and C to a length of 1 or so; what
// products lose, a few times 2^-1074, meets factors of at most 4 and T: FLOOR (plane_stages.hpp). Squares of lengths
// below 2^-537 are lost too: LENGTH_FLOOR is added to lengths. Overflow, of boxes 2^500 times as far away as the
// triangle is large, makes the margin infinite or NaN, and nothing is decided.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "arithmetic/error_counts.hpp"
#include "predicates/plane_forms.hpp"
#include "predicates/ray_forms.hpp"
#include "predicates/ray_stages.hpp"
#include "tally.hpp"
#include "voronoi/unit_vectors.hpp"

namespace stereodel::partitions {

namespace plane = predicates::plane;
namespace rays = predicates::rays;
using arithmetic::RoundingCount;
using arithmetic::UNIT_ROUNDOFF;
using voronoi::UnitVector;

// The forms, for any kind of number ---------------------------------------------------------------------------------

// D and G of differences of the plane or, with the normal, of directions.
template <class Number>
constexpr void quadratic_form(const Number* b, const Number* c, Number& square, Number* linear) {
    const Number bb = plane::square_form(b[0], b[1]), cc = plane::square_form(c[0], c[1]);
    square = plane::cross_form(b[0], b[1], c[0], c[1]);
    linear[0] = cc * b[1] - bb * c[1];
    linear[1] = bb * c[0] - cc * b[0];
}

template <class Scalar, class Number>
constexpr void quadratic_form(const Scalar* n, const Number* b, const Number* c, Number& square, Number* linear) {
    const Number bb = rays::dot_form(b, b), cc = rays::dot_form(c, c);
    square = rays::determinant_form(n, b, c);
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        linear[k] = bb * (n[i] * c[j] - n[j] * c[i]) - cc * (n[i] * b[j] - n[j] * b[i]);
    }
}

// The part of f that one axis has.
template <class Number>
constexpr Number axis_form(const Number& t, const Number& square, const Number& linear) {
    return t * (square * t + linear);
}

template <std::size_t Width>
constexpr double form_bound(RoundingCount edge) {
    RoundingCount edges[3] = {edge, edge, edge}, linear[3] = {{0}, {0}, {0}}, square = {0}, sum = {0};
    if (Width == 2) {
        quadratic_form(edges, edges, square, linear);
    } else {
        const RoundingCount normal[3] = {{1}, {1}, {1}};
        quadratic_form(normal, edges, edges, square, linear);
    }
    for (std::size_t k = 0; k < Width; ++k) {
        sum = sum + axis_form(edge, square, linear[k]);
    }
    return (Width == 2 ? 1.0 : rays::ROOT_TWO) * sum.bound();
}

constexpr double PLANE_ROUNDING = 13, SPHERE_ROUNDING = 32;
static_assert(form_bound<2>({1}) <= PLANE_ROUNDING && form_bound<3>({2}) <= SPHERE_ROUNDING);

constexpr double ABSENT = 0x1p-99, FLOOR = plane::FLOOR, LENGTH_FLOOR = 0x1p-530;

// In doubles --------------------------------------------------------------------------------------------------------

// f relative to the pivot a = hi + lo, times powers of `scale`, and its error: at most
// by_square M^2 + by_length M + alone.
template <std::size_t Width>
struct BubbleForm {
    double hi[Width], lo[Width] = {}, scale = 1.0;
    double square = 0.0, linear[Width] = {}, constant = 0.0;
    double by_square = FLOOR, by_length = FLOOR, alone = FLOOR;
    double lowest_at[Width] = {};  // of each axis, if `square` is positive

    void find_lowest() {
        for (std::size_t k = 0; k < Width && square > 0.0; ++k) {
            lowest_at[k] = -linear[k] / (2 * square);
        }
    }

    double from_pivot(double x, std::size_t k) const { return ((x - hi[k]) - lo[k]) * scale; }
};

// The least value in a box, and what it may be off by.
struct LowestValue {
    double value, margin;

    bool is_positive() const { return value > margin; }
    bool is_negative() const { return value < -margin; }
};

template <std::size_t Width>
LowestValue lowest_value(const BubbleForm<Width>& form, const double* low, const double* high) {
    double value = form.constant, reach = 0.0;
    for (std::size_t k = 0; k < Width; ++k) {
        const double l = form.from_pivot(low[k], k), h = form.from_pivot(high[k], k);
        if (form.square > 0.0) {
            value += axis_form(std::min(std::max(form.lowest_at[k], l), h), form.square, form.linear[k]);
        } else {
            value += std::min(axis_form(l, form.square, form.linear[k]), axis_form(h, form.square, form.linear[k]));
        }
        reach += std::max(l * l, h * h);
    }
    return {value, form.by_square * reach + form.by_length * (std::sqrt(reach) + LENGTH_FLOOR) + form.alone};
}

// Of a triangle or, if c is null, an edge of the hull.
inline BubbleForm<2> bubble_form(const double* a, const double* b, const double* c) {
    BubbleForm<2> form;
    double edges[4] = {b[0] - a[0], b[1] - a[1], c == nullptr ? 0.0 : c[0] - a[0], c == nullptr ? 0.0 : c[1] - a[1]};
    double largest = 0.0;
    for (const double x : edges) {
        largest = std::max(largest, std::fabs(x));
    }
    int exponent = 0;
    std::frexp(largest, &exponent);
    form.scale = std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
    for (double& x : edges) {
        x *= form.scale;
    }
    const double *to_b = edges, *to_c = edges + 2;
    std::copy_n(a, 2, form.hi);
    const double lb = std::sqrt(plane::square_form(to_b[0], to_b[1])) + LENGTH_FLOOR;
    constexpr double ROUNDING = PLANE_ROUNDING * UNIT_ROUNDOFF;
    if (c == nullptr) {
        form.linear[0] = -to_b[1];
        form.linear[1] = to_b[0];
        form.by_length += ROUNDING * lb;
        return form;
    }
    const double lc = std::sqrt(plane::square_form(to_c[0], to_c[1])) + LENGTH_FLOOR;
    quadratic_form(to_b, to_c, form.square, form.linear);
    form.by_square += ROUNDING * lb * lc;
    form.by_length += ROUNDING * lb * lc * (lb + lc);
    form.find_lowest();
    return form;
}

inline BubbleForm<3> bubble_form(const UnitVector& a, const UnitVector& b, const UnitVector& c) {
    BubbleForm<3> form;
    const rays::Difference to_b(a, b), to_c(a, c);
    std::copy_n(a.hi, 3, form.hi);
    std::copy_n(a.lo, 3, form.lo);
    quadratic_form(a.hi, to_b.v, to_c.v, form.square, form.linear);
    const double lb = std::sqrt(rays::dot_form(to_b.v, to_b.v)) + 2 * ABSENT;
    const double lc = std::sqrt(rays::dot_form(to_c.v, to_c.v)) + 2 * ABSENT;
    constexpr double ROUNDING = SPHERE_ROUNDING * UNIT_ROUNDOFF;
    const double sum = lb + lc, product = lb * lc;
    form.by_square += ROUNDING * product + 2 * ABSENT * sum;
    form.by_length += ROUNDING * product * sum + 2 * ABSENT * (sum * sum + product);
    form.alone += 2 * ABSENT * product * sum;
    form.find_lowest();
    return form;
}

// Of the disc around q through p. R^2 has two roundings of each difference, a square and sums: at most 7u of it; f has
// the same of T. On the sphere both differences are off by ABSENT, so f by 2 ABSENT (M + R) and that squared.
inline BubbleForm<2> disc_form(const double* q, const double* p) {
    BubbleForm<2> form;
    const double largest = std::max(std::fabs(p[0] - q[0]), std::fabs(p[1] - q[1]));
    int exponent = 0;
    std::frexp(largest, &exponent);
    form.scale = std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
    std::copy_n(q, 2, form.hi);
    form.square = 1.0;
    form.constant = -plane::square_form((p[0] - q[0]) * form.scale, (p[1] - q[1]) * form.scale);
    form.by_square += 16 * UNIT_ROUNDOFF;
    form.alone += -16 * UNIT_ROUNDOFF * form.constant;
    return form;
}

inline BubbleForm<3> disc_form(const UnitVector& q, const UnitVector& p) {
    BubbleForm<3> form;
    const rays::Difference to_p(q, p);
    std::copy_n(q.hi, 3, form.hi);
    std::copy_n(q.lo, 3, form.lo);
    form.square = 1.0;
    form.constant = -rays::dot_form(to_p.v, to_p.v);
    form.by_square += 16 * UNIT_ROUNDOFF;
    form.by_length += 4 * ABSENT;
    form.alone += -16 * UNIT_ROUNDOFF * form.constant + 4 * ABSENT * std::sqrt(-form.constant) + ABSENT * ABSENT * 64;
    return form;
}

// Widens a box around others so that it holds the bubble, certainly: false if that is large or not well known. With the
// centre m = -G/(2D) and the constant k, the ball has the squared radius r^2 = m^2 - k/D. Where f is not certainly
// positive, |T| is at most M = (|G| + by_length)/(D - by_square) + root((alone - k)/(D - by_square)), and
// |T - m|^2 at most r^2 + e/D, e = by_square M^2 + by_length M + alone. The centre is rounded.
template <std::size_t Width>
bool widen_by_ball(const BubbleForm<Width>& form, double* low, double* high) {
    constexpr double ROOM = 0x1p-20;
    if (!(form.by_square < ROOM * form.square)) {
        return false;
    }
    double center_square = 0.0;
    for (std::size_t k = 0; k < Width; ++k) {
        center_square += form.lowest_at[k] * form.lowest_at[k];
    }
    const double radius_square = center_square - form.constant / form.square, radius = std::sqrt(radius_square);
    const double least = form.square - form.by_square;
    const double longest = 2.1 * std::sqrt(center_square) + 2 * form.by_length / least +
                           2 * std::sqrt((form.alone - form.constant) / least);
    const double error = form.by_square * longest * longest + form.by_length * longest + form.alone;
    if (!(error < ROOM * form.square * radius_square) || !(radius_square > 0x1p-900)) {
        return false;
    }
    for (std::size_t k = 0; k < Width; ++k) {
        const double center = form.hi[k] + form.lowest_at[k] / form.scale;
        const double wide = (1 + 2 * ROOM) * radius / form.scale;
        const double rounding = 0x1p-50 * (std::fabs(form.hi[k]) + wide);
        low[k] = std::min(low[k], center - wide - rounding);
        high[k] = std::max(high[k], center + wide + rounding);
    }
    return true;
}

}  // namespace stereodel::partitions
