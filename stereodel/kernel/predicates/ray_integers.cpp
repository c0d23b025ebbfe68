#include "predicates/ray_integers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "arithmetic/error_counts.hpp"
#include "arithmetic/roots.hpp"
#include "arithmetic/wrapping_integer.hpp"
#include "predicates/ray_forms.hpp"

namespace stereodel::predicates::rays {

using arithmetic::RootTerm;
using arithmetic::RoundingCount;
using arithmetic::UNIT_ROUNDOFF;
using arithmetic::WrappingInteger;
using arithmetic::lowest_exponent;
using arithmetic::sign_of_roots;

namespace {

BigInteger minor(const IntegerRay& u, const IntegerRay& v, int i, int j) {
    return u.v[i] * v.v[j] - u.v[j] * v.v[i];
}

BigInteger determinant(const IntegerRay& a, const IntegerRay& b, const IntegerRay& c) {
    return a.v[0] * minor(b, c, 1, 2) + a.v[1] * minor(b, c, 2, 0) + a.v[2] * minor(b, c, 0, 1);
}

BigInteger dot(const IntegerRay& a, const IntegerRay& b) {
    return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2];
}

}  // namespace

IntegerRay::IntegerRay(const double* vector) {
    const int exponent =
        std::min({lowest_exponent(vector[0]), lowest_exponent(vector[1]), lowest_exponent(vector[2])});
    for (int k = 0; k < 3; ++k) {
        v[k] = BigInteger::from_double(vector[k], exponent);
    }
}

BigInteger IntegerRay::squared() const {
    return dot(*this, *this);
}

int bubble_exact(const double* a, const double* b, const double* c, const double* p) {
    const IntegerRay ra(a), rb(b), rc(c), rp(p);
    const std::array<RootTerm, 4> terms = {
        RootTerm{determinant(rb, rc, rp), ra.squared()}, RootTerm{-determinant(ra, rc, rp), rb.squared()},
        RootTerm{determinant(ra, rb, rp), rc.squared()}, RootTerm{-determinant(ra, rb, rc), rp.squared()}};
    return sign_of_roots(terms.data(), 4);
}

int turn_exact(const double* a, const double* b, const double* c) {
    const Sign sign = turn_units(a, b, c);
    return sign != OPEN ? sign : determinant(IntegerRay(a), IntegerRay(b), IntegerRay(c)).sign();
}

int compare_component_exact(const double* a, const double* b, int k) {
    const IntegerRay ra(a), rb(b);
    const std::array<RootTerm, 2> terms = {RootTerm{ra.v[k], rb.squared()}, RootTerm{-rb.v[k], ra.squared()}};
    return sign_of_roots(terms.data(), 2);
}

int compare_angles_exact(const double* q, const double* a, const double* b) {
    const IntegerRay rq(q), ra(a), rb(b);
    const std::array<RootTerm, 2> terms = {RootTerm{dot(rq, rb), ra.squared()}, RootTerm{-dot(rq, ra), rb.squared()}};
    return sign_of_roots(terms.data(), 2);
}

int shadow_exact(const double* a, const double* b, const double* c, int axis) {
    const int i = axis == 0 ? 1 : 0, j = axis == 2 ? 1 : 2;
    const IntegerRay ra(a), rb(b), rc(c);
    const std::array<RootTerm, 3> terms = {RootTerm{minor(rb, rc, i, j), ra.squared()},
                                           RootTerm{-minor(ra, rc, i, j), rb.squared()},
                                           RootTerm{minor(ra, rb, i, j), rc.squared()}};
    return sign_of_roots(terms.data(), 3);
}

int compare_lengths_exact(const double* p, const double* a, const double* q, const double* b) {
    const IntegerRay rp(p), ra(a), rq(q), rb(b);
    const std::array<RootTerm, 2> terms = {RootTerm{dot(rq, rb), rp.squared() * ra.squared()},
                                           RootTerm{-dot(rp, ra), rq.squared() * rb.squared()}};
    return sign_of_roots(terms.data(), 2);
}

int diametral_exact(const double* a, const double* b, const double* p) {
    const IntegerRay ra(a), rb(b), rp(p);
    const BigInteger aa = ra.squared(), bb = rb.squared(), pp = rp.squared();
    const std::array<RootTerm, 4> terms = {RootTerm{BigInteger(1), aa * bb * pp}, RootTerm{dot(ra, rb), pp},
                                           RootTerm{-dot(rp, ra), bb}, RootTerm{-dot(rp, rb), aa}};
    return sign_of_roots(terms.data(), 4);
}

namespace {

// Vectors in units of one power of two: integers up to 2^bits if `fits`.
template <std::size_t COUNT>
struct Units {
    double v[COUNT][3];
    bool fits = false;

    Units(const std::array<const double*, COUNT>& vectors, int bits) {
        double largest = 0.0;
        for (const double* p : vectors) {
            largest = std::max({largest, std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])});
        }
        if (!(largest > 0x1p-500 && largest < 0x1p500)) {
            return;
        }
        int exponent = 0;
        std::frexp(largest, &exponent);
        const double units = std::ldexp(1.0, bits - exponent);
        for (std::size_t i = 0; i < COUNT; ++i) {
            for (int k = 0; k < 3; ++k) {
                const double number = vectors[i][k] * units;
                if (!is_integer(number) || (number == 0.0 && vectors[i][k] != 0.0)) {
                    return;  // of most vectors that are not made of integers, soon
                }
                v[i][k] = number;
            }
        }
        fits = true;
    }

  private:
    // Between 2^52 and 2^53 doubles are integers: adding 2^52 rounds smaller numbers to such.
    static bool is_integer(double x) {
        const double size = std::fabs(x);
        return size >= 0x1p52 || (size + 0x1p52) - 0x1p52 == size;
    }
};

constexpr RoundingCount EXACT[3] = {{0}, {0}, {0}};
constexpr double TURN_ROUNDING = 6;
static_assert(determinant_form(EXACT, EXACT, EXACT).bound() <= TURN_ROUNDING);

constexpr int LONG_BITS = 53, SHORT_BITS = 16;

struct Digits {
    WrappingInteger v[3];

    explicit Digits(const double* p)
        : v{WrappingInteger(static_cast<std::int64_t>(p[0])), WrappingInteger(static_cast<std::int64_t>(p[1])),
            WrappingInteger(static_cast<std::int64_t>(p[2]))} {}
};

// Of integers up to 2^53 the permanent is at most 6 * 2^159, and what doubles leave open is below twice their error,
// 2^113: its last 128 digits are the number.
int turn_in_units(const double* a, const double* b, const double* c) {
    const double value = determinant_form(a, b, c);
    const Sign sign = decide(value, TURN_ROUNDING * UNIT_ROUNDOFF * (6 * 0x1p159));
    if (sign != OPEN) {
        return sign;
    }
    const Digits digits[3] = {Digits(a), Digits(b), Digits(c)};
    return determinant_form(digits[0].v, digits[1].v, digits[2].v).sign();
}

// Of integers up to 2^16. Minors are at most 2^33, determinants 3 * 2^49, squares 3 * 2^32: exact, and so are
// sums of determinants. A term coefficient * sqrt(square) is rounded twice and passes three sums: 5u.
Sign bubble_in_short_units(const double (&v)[4][3]) {
    double squares[4];
    for (int i = 0; i < 4; ++i) {
        squares[i] = dot_form(v[i], v[i]);
    }
    double coefficients[4] = {determinant_form(v[1], v[2], v[3]), -determinant_form(v[0], v[2], v[3]),
                              determinant_form(v[0], v[1], v[3]), -determinant_form(v[0], v[1], v[2])};
    double value = 0.0, permanent = 0.0;
    int terms = 0;
    for (int i = 0; i < 4; ++i) {
        for (int j = i + 1; j < 4; ++j) {
            if (squares[i] == squares[j]) {
                coefficients[j] += coefficients[i];
                coefficients[i] = 0.0;
                break;
            }
        }
        const double term = coefficients[i] * std::sqrt(squares[i]);
        value += term;
        permanent += std::fabs(term);
        terms += coefficients[i] != 0.0;
    }
    return terms <= 1 ? sign_of(value) : decide(value, 6 * UNIT_ROUNDOFF * permanent);
}

}  // namespace

Sign bubble_units(const double* a, const double* b, const double* c, const double* p) {
    const Units<4> longs({a, b, c, p}, LONG_BITS);
    if (!longs.fits) {
        return OPEN;
    }
    const Units<4> shorts({a, b, c, p}, SHORT_BITS);
    if (const Sign sign = shorts.fits ? bubble_in_short_units(shorts.v) : OPEN; sign != OPEN) {
        return sign;
    }
    const auto& v = longs.v;
    const auto on_one_great_circle = [&v] {
        return turn_in_units(v[0], v[1], v[2]) == 0 && turn_in_units(v[0], v[1], v[3]) == 0 &&
               turn_in_units(v[0], v[2], v[3]) == 0 && turn_in_units(v[1], v[2], v[3]) == 0;
    };
    return on_one_great_circle() ? 0 : OPEN;
}

Sign turn_units(const double* a, const double* b, const double* c) {
    const Units<3> units({a, b, c}, LONG_BITS);
    return units.fits ? turn_in_units(units.v[0], units.v[1], units.v[2]) : OPEN;
}

}  // namespace stereodel::predicates::rays
