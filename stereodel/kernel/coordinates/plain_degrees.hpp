// Sine, cosine and angle in degrees in plain double arithmetic: a table of steps of 45/256 degrees and short series for
// the rest. The same bits on every machine, off by a few u = 2^-53; degrees.hpp and lonlat.hpp have the exact ones.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "coordinates/degrees.hpp"

namespace stereodel::coordinates {

struct PlainSineCosine {
    double sine, cosine;
};

// Any finite number of degrees; relative errors below 2.1u: the table's u, the last sum's u, and a few u of terms below
// 2^-8. With |t| < 0.00154 the terms left out, t^7/5040 and t^6/720, are below 2^-65.
inline PlainSineCosine plain_sin_cos(double angle, const DegreeTable& table) {
    constexpr double ROUNDER = 0x1p52;
    const Quarters reduced = nearest_quarter(angle);
    const double size = std::abs(reduced.rest);
    const double k = (size * (DEGREE_STEPS / 45.0) + ROUNDER) - ROUNDER;
    const SineCosine& step = table[static_cast<std::size_t>(static_cast<int>(k))];
    const double t = (size - k * (45.0 / DEGREE_STEPS)) * RADIAN.hi, q = t * t;
    const double sine_rest = t + t * q * (q * (1.0 / 120.0) - 1.0 / 6.0);
    const double cosine_less_one = q * (q * (1.0 / 24.0) - 0.5);
    const double upper = step.sine.hi + (step.cosine.hi * sine_rest + step.sine.hi * cosine_less_one);
    const double sine = std::copysign(upper, reduced.rest);
    const double cosine = step.cosine.hi - (step.sine.hi * sine_rest - step.cosine.hi * cosine_less_one);
    const double turned[] = {sine, cosine, -sine, -cosine};
    return {turned[reduced.quarter & 3], turned[(reduced.quarter + 1) & 3]};
}

// The angle of (x, y) in degrees in [-180, 180], 0 for the zero vector, off by less than 6u rad.
//
// k is within one step of arctan t for t = lesser/greater (S. Rajan, S. Wang, R. Inkol, A. Joyal, "Efficient
// approximations for the arctangent function", IEEE Signal Processing Magazine 23 (2006): within 0.0015 rad, half a
// step). Turned back by k steps the vector has the tangent r, |r| < 0.0047: of the series r^7/7 is left out, below
// 2^-49 |r|. The sine of that rest is the difference of two products below 1/2, with errors 2u each, so off by 2.1u,
// everything else counts less. Multiples of 45/256 are exact; the sum is rounded by half an ulp of 45 degrees at most,
// 0.6u rad, the differences from 90 and 180 by those of 64 and 128: 1.2u and 2.3u rad at most.
inline double plain_angle(double y, double x, const DegreeTable& table) {
    constexpr double ROUNDER = 0x1p52;
    const double ax = std::abs(x), ay = std::abs(y);
    const double lesser = std::min(ax, ay), greater = std::max(ax, ay);
    if (greater == 0.0) return 0.0;
    const double t = lesser / greater;
    const double eighths = t * (1.0 - (t - 1.0) * (0.3116 + 0.0844 * t));  // arctan t over pi/4
    const double k = (eighths * DEGREE_STEPS + ROUNDER) - ROUNDER;
    const SineCosine& step = table[static_cast<std::size_t>(static_cast<int>(k))];
    const double across = lesser * step.cosine.hi - greater * step.sine.hi;
    const double along = greater * step.cosine.hi + lesser * step.sine.hi;
    const double r = across / along, q = r * r;
    const double first = k * (45.0 / DEGREE_STEPS) + (r - r * q * (1.0 / 3.0 - q * (1.0 / 5.0))) * (1.0 / RADIAN.hi);
    // Looked up, not branched for: which it is no processor can guess.
    static constexpr double SIGN[] = {1.0, -1.0}, TURNED[] = {0.0, 90.0}, BEHIND[] = {0.0, 180.0};
    const int steep = ax < ay ? 1 : 0, back = x < 0.0 ? 1 : 0;
    const double upper = TURNED[steep] + SIGN[steep] * first;
    return std::copysign(BEHIND[back] + SIGN[back] * upper, y);
}

}  // namespace stereodel::coordinates
