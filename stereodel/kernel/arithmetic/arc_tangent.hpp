// Angles of vectors in doubles, relatively accurate, without the platform's mathematics: the same bits on every
// machine. (raster/rough_angle.hpp is a rough one, for pixels.)
//
// Of (x, y) with l <= g the lesser and the greater of |x| and |y|, the angle is arctan(l/g), and one subtraction from
// pi/2 or pi or both. With c = k/32 next to l/g, or c = 0 for l/g < 1/16,
//     arctan(l/g) = arctan c + arctan t,    t = (l - c g)/(g + c l),
// |t| < 1/63 for k > 0: the argument reduction of P. T. P. Tang, "Table-lookup algorithms for elementary functions and
// their error analysis", ARITH 10 (1991).
//
// Errors, u = 2^-53. The series r - r^3/3 + ... is cut where less than 2^-59 of r is left out, and its other terms are
// below 2^-9 |r|: their last sum apart, its roundings and the cut are below 0.03u |r|. Multiples of pi/2 and the values
// of the table are added to twice the precision.
// * k = 0: the quotient, and the series' last sum: 2.03u of the angle.
// * k = 2, 3, ...: l is within a quarter of c g, so that l - c g is exact, but for c g, which rounds by u c g; that is
//   u c/(1 + c l/g) of t. g + c l is off by 1.5u of itself, since c l <= g, and the quotient rounds: 2.5u |t|. The
//   series' last sum and that with the table's low part are off by u |t| each, the one with its high part by u of the
//   angle. With |t| <= 1/(64 (1 + c l/g)) that is the most at c = 3/32, l/g = 5/64 (c = 2/32 rounds nothing):
//   1.20u + 2.5 * 0.20u + 2 * 0.20u + 1u of arctan(l/g).
// * A multiple of pi/2 is added: arctan(l/g) is off by less than 0.6u as above, of angles of pi/4 and more, and the
//   last sum rounds: 1.8u.
// Together off by less than 3.1u of the angle; 2.41u is the most that was found. (Angles below 2^-1022 round as
// subnormal numbers do.)
#pragma once

#include <algorithm>
#include <cmath>

#include "arithmetic/double_double.hpp"

namespace stereodel::arithmetic {

inline constexpr double PI = 0x1.921fb54442d18p1;

// arctan(k/32).
inline constexpr DoubleDouble ARC_TANGENTS[33] = {
    {0.0, 0.0}, {0x1.ffd55bba97625p-6, -0x1.5ec431444912cp-60},
    {0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60}, {0x1.7ee182602f10fp-4, -0x1.cfb654c0c3d98p-58},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59}, {0x1.3d6eee8c6626cp-3, 0x1.61a3b0ce9281bp-57},
    {0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58}, {0x1.b90d7529260a2p-3, 0x1.17b10d2e0e5abp-61},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57}, {0x1.18bf5a30bf178p-2, 0x1.30ca4748b1bf9p-57},
    {0x1.362773707ebccp-2, -0x1.963a544b672d8p-57}, {0x1.530ad9951cd4ap-2, -0x1.2566480884082p-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56}, {0x1.8b24d394a1b25p-2, 0x1.b6d0ba3748fa8p-56},
    {0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56}, {0x1.c0db4c94ec9fp-2, -0x1.cc1ce70934c34p-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56}, {0x1.f40dd0b541418p-2, -0x1.a3992dc382a23p-57},
    {0x1.0657e94db30dp-1, -0x1.d5b495f6349e6p-56}, {0x1.1255d9bfbd2a9p-1, -0x1.2bdaee1c0ee35p-58},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58}, {0x1.2958e59308e31p-1, -0x1.09e73b0c6c087p-56},
    {0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55}, {0x1.3f13fb89e96f4p-1, 0x1.ecf8b492644fp-56},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56}, {0x1.538f57b89061fp-1, -0x1.1bb74abda520cp-55},
    {0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57}, {0x1.66d663923e087p-1, -0x1.6ea6febe8bbbap-56},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56}, {0x1.78f6bbd5d315ep-1, 0x1.406a08980374p-55},
    {0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56}, {0x1.89ff5ff57f1f8p-1, -0x1.55b9a5e177a1bp-55},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}
};

// arctan t by its series, for |t| < 1/16; the tiny cells of large diagrams need a few terms.
inline double small_arc_tangent(double t) {
    const double q = t * t;
    if (q < 0x1p-16) {
        return t - t * q * (1.0 / 3.0 - q * (1.0 / 5.0 - q * (1.0 / 7.0)));
    }
    double sum = 1.0 / 13.0;
    sum = 1.0 / 11.0 - q * sum;
    sum = 1.0 / 9.0 - q * sum;
    sum = 1.0 / 7.0 - q * sum;
    sum = 1.0 / 5.0 - q * sum;
    sum = 1.0 / 3.0 - q * sum;
    return t - t * q * sum;
}

// The angle of (x, y) in [-pi, pi], with the signs of zeros as std::atan2 has them.
inline double vector_angle(double y, double x) {
    constexpr double ROUNDER = 0x1.8p52, PI_LOW = 0x1.1a62633145c07p-53;
    double ax = std::fabs(x), ay = std::fabs(y);
    const bool steep = ax < ay, back = std::signbit(x);
    const double greater = steep ? ay : ax;
    if (!(greater > 0x1p-900 && greater < 0x1p1000)) {
        if (greater == 0.0) {
            return std::copysign(back ? PI : 0.0, y);
        }
        const double scale = greater < 1.0 ? 0x1p120 : 0x1p-120;
        ax *= scale;
        ay *= scale;
    }
    const double l = steep ? ax : ay, g = steep ? ay : ax, quotient = l / g;
    if (quotient < 0x1p-4 && !steep && !back) {
        return std::copysign(small_arc_tangent(quotient), y);
    }
    const double k = quotient >= 0x1p-4 ? (32.0 * quotient + ROUNDER) - ROUNDER : 0.0, c = k / 32.0;
    const double rest = small_arc_tangent(k == 0.0 ? quotient : (l - c * g) / (g + c * l));
    const DoubleDouble& table = ARC_TANGENTS[static_cast<int>(k)];
    const double sign = steep != back ? -1.0 : 1.0, turn = steep ? 0.5 : back ? 1.0 : 0.0;
    const DoubleDouble sum = fast_two_sum(turn * PI, sign * table.hi);
    const double low = sum.lo + (turn * PI_LOW + sign * table.lo);
    return std::copysign(turn == 0.0 ? table.hi + (table.lo + rest) : sum.hi + (low + sign * rest), y);
}

inline double arc_tangent(double t) {
    return std::fabs(t) < 0x1p-4 ? small_arc_tangent(t) : vector_angle(t, 1.0);
}

// arctan t for 0 <= t <= 1 in numbers that know their error (Bounded or BigBall): halved until t is small,
// arctan t = 2 arctan(t/(1 + root(1 + t^2))), then the series.
template <class Number>
Number arc_tangent_series(Number t) {
    const Number one = t.like(1.0);
    const double small = std::ldexp(1.0, -static_cast<int>(std::sqrt(t.digits()) / 2));
    int halved = 0;
    for (; t.middle(0) > small; ++halved) {
        t = t / (one + sqrt(one + t * t));
    }
    const double size = std::max(t.middle(0), 0x1p-900);
    const int terms = static_cast<int>(t.digits() / (-2.0 * std::ilogb(size) - 2.0)) + 1;
    const Number square = t * t;
    Number power = t, sum = t;
    for (int k = 1; k <= terms; ++k) {
        power = power * square;
        const Number term = power / t.like(2 * k + 1);
        sum = k % 2 == 0 ? sum + term : sum - term;
    }
    return (sum + (power * square).error_alone()).times_power(halved);
}

}  // namespace stereodel::arithmetic
