// Right-angled spherical triangles p, m, v with the legs h from p to m and l from m to v: areas and moments.
//
// The area is w with tan(w/2) = tan(h/2) tan(l/2); h is below pi/4, l below pi/2. The moment, the integral of x over
// the triangle, is half the sum of each side times the normal of its plane towards the inside (from the theorem of
// Stokes; for example J. Arvo, "Applications of irradiance tensors", 1995). With r the hypotenuse and f its angle at p,
// it is along p, towards m, and along m -> v:
//     l sin h / 2,    (r sin f - l cos h) / 2,    (h - r cos f) / 2,
//     sin r sin f = sin l,  sin r cos f = cos l sin h,  cos r = cos h cos l.
// v may be on the other side of m, l negative: area, first and second component are then negative.
#pragma once

#include <cmath>

#include "arithmetic/arc_tangent.hpp"
#include "arithmetic/error_counts.hpp"
#include "voronoi/cell_ridges.hpp"

namespace stereodel::voronoi {

using arithmetic::UNIT_ROUNDOFF;

// y/sin y as a power series in s = sin^2 y, and its divided difference between s and other: for s up to 2^-6 the first
// term left out is below 2^-63.
struct ArcOverSine {
    double value, slope;

    ArcOverSine(double s, double other) : value(0.0), slope(0.0) {
        constexpr double COEFFICIENTS[] = {1.0,           1.0 / 6,         3.0 / 40,         5.0 / 112,
                                           35.0 / 1152,   63.0 / 2816,     231.0 / 13312,    143.0 / 10240,
                                           6435.0 / 557056, 12155.0 / 1245184};
        for (int k = 9; k >= 0; --k) {
            slope = value + other * slope;
            value = COEFFICIENTS[k] + s * value;
        }
    }
};

// bound: of the errors of `towards` and `along`.
struct TriangleMoment {
    double radial, towards, along, bound;
};

// Small triangles: the cancellations of the formulas above, of up to the third order, are carried out first. With B(s)
// the series and [a, b] its divided difference
//     r sin f - l cos h = sin l sin^2 h (cos^2 l [s_r, s_l] + B(s_l)/(1 + cos h))
//     h - r cos f       = sin h sin^2 l (B(s_r)/(1 + cos l) - cos^2 h [s_r, s_h]).
// Of the terms in brackets the first is below half the second's, or the second below half the first's: some 20
// roundings of positive terms count twice.
inline TriangleMoment small_moment(double sin_h, double cos_h, double sin_l, double cos_l) {
    const double s_h = sin_h * sin_h, s_l = sin_l * sin_l, s_r = s_l + cos_l * cos_l * s_h;
    const ArcOverSine of_l(s_l, s_r), of_r(s_r, s_h);
    const double towards = 0.5 * sin_l * s_h * (cos_l * cos_l * of_l.slope + of_l.value / (1 + cos_h));
    const double along = 0.5 * sin_h * s_l * (of_r.value / (1 + cos_l) - cos_h * cos_h * of_r.slope);
    return {0.5 * sin_l * of_l.value * sin_h, towards, along,
            40 * UNIT_ROUNDOFF * (std::fabs(towards) + std::fabs(along))};
}

// Large ones. r - |l| = d is taken from cos l - cos r = cos l (1 - cos h) = 2 sin(l + d/2) sin(d/2), and
//     r/sin r - l/sin l = (d sin l - 2 l cos(l + d/2) sin(d/2))/(sin r sin l).
// All angles come from their sines and cosines; r + |l| is below pi, and the sine of half of it from that of the whole
// where it is below pi/2. Terms are at most h and |l| and have some 10 roundings each.
inline TriangleMoment large_moment(double sin_h, double cos_h, double sin_l, double cos_l) {
    const double sine = std::fabs(sin_l), sin_r = std::sqrt(sine * sine + cos_l * cos_l * sin_h * sin_h);
    const double cos_r = cos_h * cos_l, h = vector_angle(sin_h, cos_h), side = vector_angle(sine, cos_l);
    const double r = vector_angle(sin_r, cos_r), over = sin_r > 0.0 ? r / sin_r : 0.0;
    const double less = sin_h * sin_h / (1 + cos_h);  // 1 - cos h
    const double sum_sine = sin_r * cos_l + cos_r * sine, sum_cosine = cos_r * cos_l - sin_r * sine;
    const double half_sine = sum_cosine > 0.0 ? sum_sine / std::sqrt(2 + 2 * sum_cosine)
                                              : std::sqrt((1 - sum_cosine) / 2);
    const double half_d = half_sine > 0.0 ? cos_l * less / (2 * half_sine) : 0.0;  // its sine
    const double half_cosine = std::sqrt(1 - half_d * half_d), d = 2 * vector_angle(half_d, half_cosine);
    const double middle = cos_l * half_cosine - sine * half_d;  // cos(l + d/2)
    const double grown = sin_r > 0.0 ? (d * sine - 2 * side * middle * half_d) / sin_r : 0.0;
    const double towards = 0.5 * (grown + side * less);
    return {0.5 * std::copysign(side, sin_l) * sin_h, std::copysign(towards, sin_l),
            0.5 * (h - over * cos_l * sin_h), 16 * UNIT_ROUNDOFF * (h + side)};
}

// length: |D|.
inline TriangleMoment moment(double length, double cosine, const Leg<double>& leg) {
    const double hypotenuse = std::sqrt(leg.along * leg.along + leg.across * leg.across);
    const double sin_l = leg.across / hypotenuse, cos_l = leg.along / hypotenuse, sin_h = length / 2;
    if (sin_l * sin_l < 0x1p-7 && sin_h * sin_h < 0x1p-7) {
        return small_moment(sin_h, cosine, sin_l, cos_l);
    }
    return large_moment(sin_h, cosine, sin_l, cos_l);
}

}  // namespace stereodel::voronoi
