#include "voronoi/careful_circumcenters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "arithmetic/ball.hpp"
#include "arithmetic/integer_quotients.hpp"
#include "predicates/plane_forms.hpp"
#include "predicates/ray_integers.hpp"
#include "voronoi/unit_vectors.hpp"

namespace stereodel::voronoi {

namespace plane = predicates::plane;
using arithmetic::Ball;
using arithmetic::BigInteger;
using arithmetic::EVERY_EXPONENT;
using arithmetic::IntegerRoot;
using arithmetic::integer_root;
using arithmetic::lowest_exponent;
using arithmetic::round_quotient;
using arithmetic::round_unit;

namespace {

// Of three sides in cyclic order, side k from corner k: the corner opposite to the longest. Differences from there are
// the shorter sides, so that nothing cancels in their product but for flatness.
template <class Side, class IsShorter>
std::size_t opposite_to_longest(const Side* sides, IsShorter&& is_shorter) {
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k) {
        if (is_shorter(sides[longest], sides[k])) {
            longest = k;
        }
    }
    return (longest + 2) % 3;
}

// In ball arithmetic: for triangles of any size, and for those that are flat since their coordinates are of
// very different size.
bool careful_planar_center(const double* const* corners, double* center) {
    struct Side {
        Ball x, y, square;

        Side(const double* from, const double* to)
            : x(Ball(to[0]) - Ball(from[0])), y(Ball(to[1]) - Ball(from[1])),
              square(plane::square_form(x, y)) {}
    };
    const Side sides[3] = {{corners[0], corners[1]}, {corners[1], corners[2]}, {corners[2], corners[0]}};
    const std::size_t base = opposite_to_longest(
        sides, [](const Side& p, const Side& q) { return is_shorter(p.square, q.square); });
    const Side &d = sides[base], &e = sides[(base + 2) % 3];  // e is the way back
    const Ball half = plane::cross_form(e.x, e.y, d.x, d.y), divisor = half + half;
    const Ball x = Ball(corners[base][0]) - (e.y * d.square + d.y * e.square) / divisor;
    const Ball y = Ball(corners[base][1]) + (d.x * e.square + e.x * d.square) / divisor;
    return x.round(center[0]) && y.round(center[1]);
}

// The same by integers, one quotient for each coordinate, rounded once.
void exact_planar_center(const double* a, const double* b, const double* c, double* center) {
    int exponent = EVERY_EXPONENT;
    for (const double* corner : {a, b, c}) {
        exponent = std::min({exponent, lowest_exponent(corner[0]), lowest_exponent(corner[1])});
    }
    const auto integer = [exponent](double x) { return BigInteger::from_double(x, exponent); };
    const BigInteger x = integer(a[0]), y = integer(a[1]);
    const BigInteger d[2] = {integer(b[0]) - x, integer(b[1]) - y}, e[2] = {integer(c[0]) - x, integer(c[1]) - y};
    const BigInteger dd = plane::square_form(d[0], d[1]), ee = plane::square_form(e[0], e[1]);
    const BigInteger divisor = plane::cross_form(d[0], d[1], e[0], e[1]).shifted(1);
    if (divisor.sign() == 0) {
        throw std::invalid_argument("triangles: three corners on one line have no circumcentre");
    }
    center[0] = round_quotient(x * divisor + (e[1] * dd - d[1] * ee), divisor, exponent);
    center[1] = round_quotient(y * divisor + (d[0] * ee - e[0] * dd), divisor, exponent);
}

// From differences of relative accuracy. The product of two of length up to 2 is off by less than 2^-95 of the
// larger loss, and by less than 2^-54 of itself if it is 2^41 times as long. Below 2^-900 the underflow of a
// `Direction`, 2^-1070, would count.
bool normal_of_edges(const RayEdge& d, const RayEdge& e, double* center) {
    DoubleDouble product[3];
    cross(d.v, e.v, product);
    const Pair normal[3] = {
        {product[0].hi, product[0].lo}, {product[1].hi, product[1].lo}, {product[2].hi, product[2].lo}};
    if (!(std::sqrt(length_squared(normal)) > 0x1p-41 * std::max(d.loss, e.loss)) ||
        std::min(d.exponent, e.exponent) < -900) {
        return false;
    }
    round_unit(normal, center);
    return true;
}

// For corners of which two or all are close together. Two long sides are nearly parallel where the third is short: that
// one must be one of the two.
bool close_center(const double* a, const double* b, const double* c, double* center) {
    const Ray ra(a), rb(b), rc(c);
    const RayEdge ab(ra, rb), ca(rc, ra);
    if (normal_of_edges(ca, ab, center)) {
        return true;
    }
    const RayEdge bc(rb, rc);
    return ab.exponent < ca.exponent ? normal_of_edges(ab, bc, center) : normal_of_edges(bc, ca, center);
}

// |a| b x c + |b| c x a + |c| a x b, for integer vectors a, b, c along the directions.
struct IntegerNormal {
    std::array<BigInteger, 3> squares;                  // |a|^2, ...
    std::array<std::array<BigInteger, 3>, 3> products;  // b x c, ...

    IntegerNormal(const double* a, const double* b, const double* c) {
        const rays::IntegerRay rays[3] = {rays::IntegerRay(a), rays::IntegerRay(b), rays::IntegerRay(c)};
        for (std::size_t k = 0; k < 3; ++k) {
            const BigInteger *p = rays[(k + 1) % 3].v, *q = rays[(k + 2) % 3].v;
            squares[k] = rays[k].squared();
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
                products[k][i] = p[j] * q[l] - p[l] * q[j];
            }
            const auto is_zero = [](const BigInteger& x) { return x.sign() == 0; };
            if (std::all_of(products[k].begin(), products[k].end(), is_zero) && rays::dot_form(p, q).sign() > 0) {
                throw std::invalid_argument("triangles: two corners of the same direction have no circumcentre");
            }
        }
    }

    // A multiple of the normal, from lengths of so many bits. Each is off by less than 1, its term by less than the
    // product. Whether every component is known to 2^-66 of itself, or to 2^-1150 of the longest: no subnormal that is.
    // One without products is zero, whatever the lengths are.
    bool sum(std::size_t bits, BigInteger* normal) const {
        std::array<IntegerRoot, 3> lengths;
        std::ptrdiff_t lowest = PTRDIFF_MAX;
        for (std::size_t k = 0; k < 3; ++k) {
            lengths[k] = integer_root(squares[k], bits);
            lowest = std::min(lowest, lengths[k].exponent);
        }
        std::size_t error[3] = {}, longest = 0;  // bits
        for (std::size_t i = 0; i < 3; ++i) {
            normal[i] = {};
            for (std::size_t k = 0; k < 3; ++k) {
                const auto shift = static_cast<std::size_t>(lengths[k].exponent - lowest);
                normal[i] = normal[i] + (lengths[k].root * products[k][i]).shifted(shift);
                error[i] = std::max(error[i], products[k][i].sign() == 0 ? 0 : products[k][i].bit_length() + shift + 2);
            }
            longest = std::max(longest, normal[i].bit_length());
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t length = normal[i].bit_length();
            if (error[i] != 0 && length < error[i] + 67 && longest < std::max(length, error[i]) + 1152) {
                return false;
            }
        }
        return true;
    }
};

// The same by integers. Three different directions are not on one line, so that some number of bits suffices.
void exact_normal(const double* a, const double* b, const double* c, Stop stop, double* center) {
    const IntegerNormal integers(a, b, c);
    BigInteger normal[3];
    std::size_t bits = 128;
    while (!integers.sum(bits, normal)) {
        check(stop);
        bits *= 2;
    }
    round_unit(normal, center);
}

}  // namespace

void careful_center_plane(const double* const* corners, Stop stop, double* center) {
    if (!careful_planar_center(corners, center)) {
        check(stop);
        exact_planar_center(corners[0], corners[1], corners[2], center);
    }
}

void careful_center_sphere(const double* const* corners, Stop stop, double* center) {
    if (!close_center(corners[0], corners[1], corners[2], center)) {
        check(stop);
        exact_normal(corners[0], corners[1], corners[2], stop, center);
    }
}

}  // namespace stereodel::voronoi
