#include "predicates/plane_predicates.hpp"

#include <algorithm>
#include <cmath>

#include "arithmetic/big_integer.hpp"

namespace stereodel::predicates {

using arithmetic::lowest_exponent;

namespace {

bool before(const double* p, const double* q) {
    return p[0] < q[0] || (p[0] == q[0] && p[1] < q[1]);
}

int orient_signs(const double* a, const double* b, const double* c) {
    const plane::Estimate e = plane::orient_estimate(a, b, c);
    Sign sign = decide(e.value, e.bound);
    if (sign == OPEN) {
        sign = plane::orient_double_double(a, b, c);
    }
    return sign != OPEN ? sign : plane::orient_exact(a, b, c);
}

}  // namespace

double common_granularity(const double* xy, std::size_t count) {
    constexpr int LIMIT = 240;
    int lowest = LIMIT;
    double modulus = std::ldexp(1.0, LIMIT), inverse = std::ldexp(1.0, -LIMIT);
    for (std::size_t k = 0; k < 2 * count; ++k) {
        // The common cases once a small one came: 2^52 times the modulus or more, where all doubles are multiples, or a
        // multiple that tells by its quotient, which adding 2^52 does not round. One that underflows tells nothing.
        const double size = std::fabs(xy[k]), quotient = size * inverse;
        if (size < 0x1p52 * modulus && !((quotient + 0x1p52) - 0x1p52 == quotient && (quotient > 0 || size == 0))) {
            lowest = std::min(lowest, lowest_exponent(xy[k]));
            if (lowest < -LIMIT) {
                return 0.0;
            }
            modulus = std::ldexp(1.0, lowest);
            inverse = std::ldexp(1.0, -lowest);
        }
    }
    return modulus;
}

int PlanePoints::orient_open(const double* a, const double* b, const double* c, const plane::Estimate& e,
                             double exact) {
    ++tally.filter;
    if (plane::on_axis_line(a, b, c)) {
        return counted(0);
    }
    if (e.permanent <= exact) {
        return counted(sign_of(e.value));
    }
    const Sign sign = plane::orient_double_double(a, b, c);
    if (sign != OPEN) {
        return sign;
    }
    ++tally.double_double;
    return counted(plane::orient_exact(a, b, c));
}

int PlanePoints::incircle_open(const double* a, const double* b, const double* c, const double* d,
                               const plane::Estimate& e) {
    ++tally.filter;
    const Sign sign = incircle_known(a, b, c, d, e);
    return counted(sign != OPEN ? sign : incircle_close(a, b, c, d));
}

int PlanePoints::incircle_close(const double* a, const double* b, const double* c, const double* d) {
    const Sign sign = plane::incircle_double_double(a, b, c, d);
    if (sign != OPEN) {
        return sign;
    }
    ++tally.double_double;
    return incircle_last(a, b, c, d);
}

int PlanePoints::incircle_last(const double* a, const double* b, const double* c, const double* d) const {
    const Sign sign = per_unit_ > 0.0 ? plane::incircle_last_digits(a, b, c, d, per_unit_) : OPEN;
    return sign != OPEN ? sign : plane::incircle_exact(a, b, c, d);
}

bool PlanePoints::in_circle_open(Index a, Index b, Index c, Index d, const plane::Estimate& e) {
    // A repeated point makes the value exactly zero: it always comes here.
    if (d == a || d == b || d == c) {
        return false;
    }
    ++tally.filter;
    Sign sign = incircle_known(at(a), at(b), at(c), at(d), e);
    if (sign == OPEN && circles_.knows(a, b, c, d)) {
        ++tally.double_double;  // as it would have been: counts do not depend on what is remembered
        sign = 0;
    } else if (sign == OPEN) {
        sign = incircle_close(at(a), at(b), at(c), at(d));
        if (sign == 0 && remembers_) {
            circles_.learn(a, b, c, d, [this](Index i, Index j, Index k, Index l) {
                return plane::incircle_double_double(at(i), at(j), at(k), at(l)) == OPEN &&
                       incircle_last(at(i), at(j), at(k), at(l)) == 0;
            });
        }
    }
    counted(sign);
    return (sign != 0 ? sign : incircle_tie(at(a), at(b), at(c), at(d))) > 0;
}

int PlanePoints::compare_distances(const double* p, const double* a, const double* q, const double* b) {
    const plane::Estimate e = plane::distance_estimate(p, a, q, b);
    Sign sign = decide(e.value, e.bound);
    if (sign != OPEN) {
        return sign;
    }
    ++tally.filter;
    sign = plane::distances_double_double(p, a, q, b);
    if (sign != OPEN) {
        return sign;
    }
    ++tally.double_double;
    return counted(plane::distances_exact(p, a, q, b));
}

// The height of row i of the determinant with rows (x, y, x^2 + y^2, 1) has the cofactor (-1)^i times the orientation
// of the others. Three points of a circle are not collinear, so the first point, whose height grows most, always
// decides.
int incircle_tie(const double* a, const double* b, const double* c, const double* d) {
    const bool a_first = before(a, b), c_first = before(c, d);
    if (before(a_first ? a : b, c_first ? c : d)) {
        return a_first ? orient_signs(b, c, d) : -orient_signs(a, c, d);
    }
    return c_first ? orient_signs(a, b, d) : -orient_signs(a, b, c);
}

}  // namespace stereodel::predicates
