// Longitude and latitude to unit vectors in two stages: a table and short sums with a bounded error; where that leaves
// the rounding open, in about one row of 500, the double-double series of degrees.cpp. Both give the same double.
//
// Source of the first stage: P. T. P. Tang, "Table-driven implementation of the exponential function in IEEE
// floating-point arithmetic", ACM TOMS 15 (1989), for the table; A. Ziv, "Fast evaluation of elementary mathematical
// functions with correctly rounded last bit", ACM TOMS 17 (1991), for the test of the rounding.
//
// Notation: u = 2^-53; a rest of up to 45 degrees is k steps of 45/256 degrees and r more, r exact (Sterbenz; k = 0 is
// no subtraction); S, C = sine and cosine of the k steps; t = r in radians, |t| < 0.0015340 = T; q = t^2 < 2^-18.69.
//   t = t0 + t1, t0 rounded, |t1| <= 2u|t|: one product with pi/180 in double-double, error 4u^2|t|
//   a = sin t - t = t q (q/120 - 1/6): |a| < 2^-21.2 |t|; relative 12u (q 5u, t 2u, five more) and t q^3/5040 left out:
//       2^-70.7 + 2^-68.3, together below 2^-68 |t|
//   b = cos t - 1 = q (q (1/24 - q/720) - 1/2): |b| < 2^-19.6; relative 8u and q^4/40320 left out: below 2^-69.6
//   sine = S + C t + (S b + C a), cosine = C - S t + (C b - S a)
// w = sine: for k > 0 it is at least sin T and at least S/2, so that S <= 2w, |C t| <= 1.001w. The first two terms are
// added exactly; everything else is below 2^-18.3 w and is summed with at most 7 roundings of that size: 7u 2^-18.3 w
// < 2^-68.4 w. With 2w 2^-69.6 for b, 1.001w 2^-68 for a and 2^-71 w for what is left out (C.lo t1, S.lo b, C.lo a):
// below 2^-66.2 w. For k = 0 only a counts. The cosine is at least 0.707 and better off.
// The product of two such values: 2^-65.2, and terms below 2^-100. DECIDED = 2^-64 also covers the test's own rounding
// and the second stage's 2^-100: where the test decides, both stages round to the same double.

#include "coordinates/lonlat.hpp"

#include <algorithm>
#include <cmath>

#include "coordinates/degrees.hpp"
#include "coordinates/plain_degrees.hpp"

namespace stereodel::coordinates {

using arithmetic::fast_two_sum;
using arithmetic::sqrt;
using arithmetic::two_product;

namespace {

constexpr double DECIDED = 0x1p-64;

// large + product + small, the first two added exactly, |large| >= |product| or large = 0.
DoubleDouble gather(double large, DoubleDouble product, double small) {
    const DoubleDouble sum = fast_two_sum(large, product.hi);
    return fast_two_sum(sum.hi, sum.lo + (product.lo + small));
}

// Of |rest| <= 45 degrees; 0 < |r| < 2^-400 is left to the second stage by a NaN, which no test decides.
SineCosine sin_cos_table(double rest, const DegreeTable& table) {
    constexpr double ROUNDER = 0x1p52;
    const double size = std::abs(rest);
    const double k = (size * (DEGREE_STEPS / 45.0) + ROUNDER) - ROUNDER;
    const double r = size - k * (45.0 / DEGREE_STEPS);
    if (std::abs(r) < 0x1p-400 && r != 0.0) return {{NAN, NAN}, {NAN, NAN}};
    const auto& [S, C] = table[static_cast<std::size_t>(k)];

    const DoubleDouble product = two_product(r, RADIAN.hi);
    const double t0 = product.hi, t1 = product.lo + r * RADIAN.lo;
    const double q = t0 * t0;
    const double a = t0 * q * (q * (1.0 / 120.0) - 1.0 / 6.0);
    const double b = q * (q * (1.0 / 24.0 - q * (1.0 / 720.0)) - 0.5);
    const double sine_rest = ((C.lo * t0 + C.hi * t1) + S.lo) + (S.hi * b + C.hi * a);
    const double cosine_rest = (C.lo - (S.lo * t0 + S.hi * t1)) + (C.hi * b - S.hi * a);
    const DoubleDouble sine = gather(S.hi, two_product(C.hi, t0), sine_rest);
    const DoubleDouble cosine = gather(C.hi, two_product(-S.hi, t0), cosine_rest);
    return {rest < 0 ? -sine : sine, cosine};
}

SineCosine sin_cos_fast(double angle, const DegreeTable& table) {
    const Quarters reduced = nearest_quarter(angle);
    return turn_quarters(sin_cos_table(reduced.rest, table), reduced.quarter);
}

// The rounded value without -0, and whether everything within the error bound rounds to it.
bool decide(DoubleDouble value, double& rounded) {
    const double slack = DECIDED * std::abs(value.hi);
    rounded = value.hi + (value.lo + slack) + 0.0;
    return rounded == value.hi + (value.lo - slack);
}

bool first_stage(const double* lonlat, double* xyz, const DegreeTable& table) {
    const SineCosine lon = sin_cos_fast(lonlat[0], table), lat = sin_cos_fast(lonlat[1], table);
    const bool x = decide(lat.cosine * lon.cosine, xyz[0]);
    const bool y = decide(lat.cosine * lon.sine, xyz[1]);
    const bool z = decide(lat.sine, xyz[2]);
    return x && y && z;
}

void second_stage(const double* lonlat, double* xyz) {
    const SineCosine lon = sin_cos_degrees(lonlat[0]), lat = sin_cos_degrees(lonlat[1]);
    const DoubleDouble vector[3] = {lat.cosine * lon.cosine, lat.cosine * lon.sine, lat.sine};
    for (int k = 0; k < 3; ++k) xyz[k] = vector[k].hi + vector[k].lo + 0.0;
}

// The angle of (x, y) in degrees: a plain one, corrected by what it leaves of the vector turned back. The turned sine
// is off by 2^-64 of the length and for small angles of itself: the sum is rounded once, but for 2^-10 of an ulp.
double angle_degrees(DoubleDouble y, DoubleDouble x, const DegreeTable& table) {
    const double guess = plain_angle(y.hi, x.hi, table);
    SineCosine turn = sin_cos_fast(guess, table);
    if (std::isnan(turn.sine.hi)) turn = sin_cos_degrees(guess);
    const DoubleDouble across = y * turn.cosine - x * turn.sine, along = x * turn.cosine + y * turn.sine;
    if (along.hi == 0.0) return guess;
    return guess + (across.hi + across.lo) / (along.hi + along.lo) * (1.0 / RADIAN.hi);
}

// A vector over powers of two: as a whole with components below 1, and its horizontal part on its own, so that a
// longitude survives one subnormal step away from the pole.
struct ScaledVector {
    double x, y, z;
    int horizontal;  // exponent that x and y have lost beside z

    explicit ScaledVector(const double* v) : x(v[0]), y(v[1]), z(v[2]), horizontal(0) {
        const double across = std::max(std::abs(x), std::abs(y)), size = std::max(across, std::abs(z));
        // Squares and their errors are then far from the ends of the range, and a power of two changes no bit.
        if (across >= 0x1p-200 && size <= 0x1p200) return;
        int whole = 0, own = 0;
        std::frexp(size, &whole);
        std::frexp(across, &own);
        if (across == 0.0) own = whole;
        x = std::ldexp(x, -own);
        y = std::ldexp(y, -own);
        z = std::ldexp(z, -whole);
        horizontal = own - whole;
    }
};

void place_of(const double* xyz, double* lonlat, const DegreeTable& table) {
    const ScaledVector v(xyz);
    const double lon = angle_degrees({v.y, 0.0}, {v.x, 0.0}, table);
    DoubleDouble rho = sqrt(two_product(v.x, v.x) + two_product(v.y, v.y));
    if (v.horizontal != 0) rho = {std::ldexp(rho.hi, v.horizontal), std::ldexp(rho.lo, v.horizontal)};
    lonlat[0] = lon == 180.0 ? -180.0 : lon + 0.0;
    lonlat[1] = angle_degrees({v.z, 0.0}, rho, table) + 0.0;
}

}  // namespace

void lonlat_to_xyz(const double* lonlat, std::size_t count, double* xyz, int workers, Stop stop) {
    const DegreeTable& values = degree_table();
    Crew crew(useful_workers(workers, count));
    for_all(count, crew, stop, [&](std::size_t i) {
        if (!first_stage(lonlat + 2 * i, xyz + 3 * i, values)) second_stage(lonlat + 2 * i, xyz + 3 * i);
    });
}

void xyz_to_lonlat(const double* xyz, std::size_t count, double* lonlat, int workers, Stop stop) {
    const DegreeTable& values = degree_table();
    Crew crew(useful_workers(workers, count));
    for_all(count, crew, stop, [&](std::size_t i) { place_of(xyz + 3 * i, lonlat + 2 * i, values); });
}

}  // namespace stereodel::coordinates
