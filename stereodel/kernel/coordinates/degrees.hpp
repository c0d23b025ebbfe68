// Sine and cosine of degrees in double-double: no platform mathematics, so the same bits on every machine.
//
// An angle is reduced by fmod (exact) and by the nearest multiple of 90 degrees (exact, Sterbenz), so that multiples of
// 90 degrees give 0 and +-1 exactly and mirrored angles give mirrored values. The series and their bound: degrees.cpp.
#pragma once

#include <array>
#include <cmath>

#include "arithmetic/double_double.hpp"

namespace stereodel::coordinates {

using arithmetic::DoubleDouble;

// pi/180 to 107 bits.
inline constexpr DoubleDouble RADIAN{0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};

struct SineCosine {
    DoubleDouble sine;
    DoubleDouble cosine;
};

// angle = 90 * quarter + rest modulo 360, exactly, |rest| <= 45 and |quarter| <= 4.
struct Quarters {
    double rest;
    int quarter;
};

inline Quarters nearest_quarter(double angle) {
    constexpr double ROUNDER = 0x1.8p52;  // adding and subtracting it rounds to the nearest integer, ties to even
    const double turn = std::abs(angle) < 360.0 ? angle : std::fmod(angle, 360.0);
    const double quarter = (turn / 90.0 + ROUNDER) - ROUNDER;
    return {turn - 90.0 * quarter, static_cast<int>(quarter)};
}

// Of rest + 90 * quarter degrees from those of rest.
inline SineCosine turn_quarters(const SineCosine& rest, int quarter) {
    const DoubleDouble sine_sign{(quarter & 2) != 0 ? -1.0 : 1.0, 0.0};
    const DoubleDouble cosine_sign{((quarter + 1) & 2) != 0 ? -1.0 : 1.0, 0.0};
    if ((quarter & 1) != 0) return {rest.cosine * sine_sign, rest.sine * cosine_sign};
    return {rest.sine * sine_sign, rest.cosine * cosine_sign};
}

// |rest| <= 45. Relative errors below 2^-101.
SineCosine sin_cos_rest(double rest);

// Those of 0, 45/256, ..., 45 degrees, multiples of 45/256 being exact doubles.
constexpr int DEGREE_STEPS = 256;
using DegreeTable = std::array<SineCosine, DEGREE_STEPS + 1>;
const DegreeTable& degree_table();

// Any finite number of degrees. Relative errors below 2^-101 (for tiny angles those of double_double.hpp).
inline SineCosine sin_cos_degrees(double angle) {
    const Quarters reduced = nearest_quarter(angle);
    return turn_quarters(sin_cos_rest(reduced.rest), reduced.quarter);
}

}  // namespace stereodel::coordinates
