// Right-angled spherical triangles p, m, v with the legs h from p to m and l from m to v: areas and moments.
//
// The area is w with tan(w/2) = tan(h/2) tan(l/2), for legs below pi. The moment, the integral of x over the
// triangle, is half the sum of each side times the normal of its plane towards the inside (from the theorem of Stokes;
// for example J. Arvo, "Applications of irradiance tensors", 1995). With r the hypotenuse and f its angle at p, it is
// along p, towards m, and along m -> v:
//     l sin h / 2,    (r sin f - l cos h) / 2,    (h - r cos f) / 2,
//     sin r sin f = sin l,  sin r cos f = cos l sin h,  cos r = cos h cos l.
// Both l and v may be on the other side of m, l negative: area, first and second component are then negative.
#pragma once

#include <cmath>

#include "double_double.hpp"

namespace stereodel {

constexpr double PI = 3.14159265358979323846;

// A leg as l = atan2(across, along), of a vector of any length.
template <class Number>
struct Leg {
    Number across{}, along{};
};

// l of a leg, in [-pi, pi): at the very antipode of m it is -pi.
inline double leg_angle(const Leg<double>& leg) {
    return leg.across == 0.0 && leg.along < 0.0 ? -PI : std::atan2(leg.across, leg.along);
}

// Half the area as the angle of a vector with m >= 0.
struct HalfArea {
    DoubleDouble m, n;
};

// tan(l/2) = Y/(X + H) = (H - X)/Y with X = along, Y = across, H their length, and tan(h/2) = |D|/2/(1 + cos h), where
// |D| = 2 sin h.
inline HalfArea half_area(DoubleDouble length, DoubleDouble cosine, const Leg<DoubleDouble>& leg) {
    const DoubleDouble hypotenuse = sqrt(leg.along * leg.along + leg.across * leg.across);
    const DoubleDouble both = DoubleDouble{2.0, 0.0} + cosine + cosine;
    DoubleDouble m = both * leg.across, n = length * (hypotenuse - leg.along);
    if (leg.along.hi >= 0.0) {
        m = both * (leg.along + hypotenuse);
        n = length * leg.across;
    } else if (leg.across.hi <= 0.0) {
        m = -m;
        n = -n;
    }
    // Both may be as short as D.
    int exponent = 0;
    std::frexp(std::fmax(std::fabs(m.hi), std::fabs(n.hi)), &exponent);
    const auto scaled = [exponent](DoubleDouble x) {
        return DoubleDouble{std::ldexp(x.hi, -exponent), std::ldexp(x.lo, -exponent)};
    };
    return {scaled(m), scaled(n)};
}

// Both legs of a ridge have angles in [-pi, pi), and their sum should be its length, in (0, pi]: if the antipode of m
// lies on the ridge it is 2 pi less.
inline bool is_turned(const Leg<double>& left, const Leg<double>& right) {
    return (left.along < 0.0 || right.along < 0.0) && leg_angle(left) + leg_angle(right) < -PI / 2;
}

// atan t; for |t| < 2^-8 by its series, whose first term left out is t^9/9 < 2^-67 t.
inline double arc_tangent(double t) {
    const double s = t * t;
    return s < 0x1p-16 ? t - t * s * (1.0 / 3 - s * (1.0 / 5 - s * (1.0 / 7))) : std::atan(t);
}

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

struct TriangleMoment {
    double radial, towards, along;
};

// Small triangles: the cancellations of the formulas above, of up to the third order, are carried out first. With B(s)
// the series and [a, b] its divided difference
//     r sin f - l cos h = sin l sin^2 h (cos^2 l [s_r, s_l] + B(s_l)/(1 + cos h))
//     h - r cos f       = sin h sin^2 l (B(s_r)/(1 + cos l) - cos^2 h [s_r, s_h]).
inline TriangleMoment small_moment(double sin_h, double cos_h, double sin_l, double cos_l) {
    const double s_h = sin_h * sin_h, s_l = sin_l * sin_l, s_r = s_l + cos_l * cos_l * s_h;
    const ArcOverSine of_l(s_l, s_r), of_r(s_r, s_h);
    return {0.5 * sin_l * of_l.value * sin_h,
            0.5 * sin_l * s_h * (cos_l * cos_l * of_l.slope + of_l.value / (1 + cos_h)),
            0.5 * sin_h * s_l * (of_r.value / (1 + cos_l) - cos_h * cos_h * of_r.slope)};
}

// Large ones. Where h is small beside l, r - |l| = d is taken from cos l - cos r = cos l (1 - cos h), and
// r/sin r - l/sin l = (d sin l - 2 l cos(l + d/2) sin(d/2))/(sin r sin l).
inline TriangleMoment large_moment(double sin_h, double cos_h, double sin_l, double cos_l, double l) {
    const double h = std::atan2(sin_h, cos_h), side = std::fabs(l), sine = std::fabs(sin_l);
    const double sin_r = std::sqrt(sine * sine + cos_l * cos_l * sin_h * sin_h), r = std::atan2(sin_r, cos_h * cos_l);
    const double less = sin_h * sin_h / (1 + cos_h);  // 1 - cos h
    const double over = sin_r > 0.0 ? r / sin_r : 0.0;
    double towards = 0.5 * (over * sine - side * cos_h);
    if (side > 0.0 && side < 2.5) {
        const double d = 2 * std::asin(cos_l * less / (2 * std::sin((r + side) / 2)));
        const double grown = (d * sine - 2 * side * std::cos(side + d / 2) * std::sin(d / 2)) / sin_r;
        towards = 0.5 * (grown + side * less);
    }
    return {0.5 * l * sin_h, l < 0.0 ? -towards : towards, 0.5 * (h - over * cos_l * sin_h)};
}

// length: |D|.
inline TriangleMoment moment(double length, double cosine, const Leg<double>& leg) {
    const double hypotenuse = std::sqrt(leg.along * leg.along + leg.across * leg.across);
    const double sin_l = leg.across / hypotenuse, cos_l = leg.along / hypotenuse, sin_h = length / 2;
    if (leg.along > 0.0 && sin_l * sin_l < 0x1p-7 && sin_h * sin_h < 0x1p-7) {
        return small_moment(sin_h, cosine, sin_l, cos_l);
    }
    return large_moment(sin_h, cosine, sin_l, cos_l, leg_angle(leg));
}

}  // namespace stereodel
