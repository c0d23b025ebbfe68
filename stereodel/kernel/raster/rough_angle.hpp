// The rough angle of a vector, for pixels (arithmetic/arc_tangent.hpp has the precise one), in plain double arithmetic,
// without the platform's mathematics: the same bits on every machine, and without a call, so that a loop over many
// vectors becomes vector instructions.
//
// With m <= M the lesser and the greater of |x| and |y|, t = m/M: arctan t, or pi/4 + arctan((m - M)/(m + M)) where
// t > tan(pi/8), so that the argument r of the series has |r| <= tan(pi/8) < 0.41422. The series
// r - r^3/3 + ... alternates, and its first term left out bounds what is left out: |r|^21/21 < 4.4e-10 rad.
#pragma once

#include <cmath>

#include "arithmetic/arc_tangent.hpp"

namespace stereodel::raster {

using arithmetic::PI;

// Of (x, y) in [-pi, pi]: within 4.5e-10 rad of the exact angle; 0 for the zero vector.
inline double rough_angle(double y, double x) {
    constexpr double TAN_PI_8 = 0x1.a827999fcef32p-2;
    const double ax = std::abs(x), ay = std::abs(y);
    const double lesser = ax < ay ? ax : ay, greater = ax < ay ? ay : ax;
    const bool turned = lesser > TAN_PI_8 * greater;
    const double numerator = turned ? lesser - greater : lesser;
    const double denominator = turned ? lesser + greater : greater;
    const double r = numerator / (denominator > 0.0 ? denominator : 1.0), q = r * r;
    double sum = -1.0 / 19.0;
    sum = 1.0 / 17.0 + q * sum;
    sum = -1.0 / 15.0 + q * sum;
    sum = 1.0 / 13.0 + q * sum;
    sum = -1.0 / 11.0 + q * sum;
    sum = 1.0 / 9.0 + q * sum;
    sum = -1.0 / 7.0 + q * sum;
    sum = 1.0 / 5.0 + q * sum;
    sum = -1.0 / 3.0 + q * sum;
    const double first = (turned ? PI / 4.0 : 0.0) + (r + r * q * sum);
    const double upper = ax < ay ? PI / 2.0 - first : first;
    return std::copysign(x < 0.0 ? PI - upper : upper, y);
}

}  // namespace stereodel::raster
