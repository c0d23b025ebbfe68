#include "coordinates/latitudes.hpp"

#include <cstddef>

namespace stereodel::coordinates {

namespace {

constexpr std::size_t TERMS = 15;  // e^30 is below 2^-108, and the terms left out add up to less than that
// Those in double-double: ten roundings of the rest, below e^10 < 2^-36, lose 2^-85 at most.
constexpr std::size_t PAIRS = 5;

constexpr DoubleDouble whole(double value) {
    return {value, 0.0};
}

// Horner's rule: small terms of high order in doubles.
DoubleDouble polynomial(const DoubleDouble* terms, std::size_t count, DoubleDouble t) {
    double tail = 0.0;
    for (std::size_t k = count; k-- > PAIRS;) {
        tail = (tail + terms[k].hi) * t.hi;
    }
    DoubleDouble total = whole(tail);
    for (std::size_t k = PAIRS; k-- > 1;) {
        total = (total + terms[k]) * t;
    }
    return total + terms[0];
}

struct Ellipsoid {
    DoubleDouble polar;             // 1 - e^2
    DoubleDouble p[TERMS];          // (k + 1)/(2k + 1) e^2k
    DoubleDouble later[TERMS - 1];  // the sums of all later ones
    DoubleDouble p_at_pole;

    // 1/f = 298.257223563 as a fraction of two doubles, so that e^2 is known to twice the precision of one.
    Ellipsoid() {
        const DoubleDouble below = whole(298257223563.0), one_less_f = whole(297257223563.0) / below;
        const DoubleDouble e2 = whole(1e9) / below * (one_less_f + whole(1.0));
        polar = one_less_f * one_less_f;
        DoubleDouble power = whole(1.0), sum;
        for (std::size_t k = 0; k < TERMS; ++k) {
            const auto order = static_cast<double>(k);
            p[k] = power * whole(order + 1.0) / whole(2.0 * order + 1.0);
            power = power * e2;
        }
        for (std::size_t k = TERMS - 1; k > 0; --k) {
            later[k - 1] = sum = sum + p[k];
        }
        p_at_pole = polynomial(p, TERMS, whole(1.0));
    }
};

const Ellipsoid& ellipsoid() {
    static const Ellipsoid earth;
    return earth;
}

}  // namespace

AuthalicFactors authalic_factors(DoubleDouble t) {
    const Ellipsoid& earth = ellipsoid();
    const DoubleDouble p = polynomial(earth.p, TERMS, t);
    return {p, sqrt(p * p + (earth.p_at_pole + p) * polynomial(earth.later, TERMS - 1, t))};
}

SineCosine on_sphere(const SineCosine& latitude, Latitude kind) {
    const Ellipsoid& earth = ellipsoid();
    auto [sine, cosine] = latitude;
    DoubleDouble length = earth.p_at_pole;
    if (kind == Latitude::geodetic) {
        sine = earth.polar * sine;
        length = sqrt(sine * sine + cosine * cosine);
    } else {
        const auto [p, r] = authalic_factors(sine * sine);
        sine = sine * p;
        cosine = cosine * r;
    }
    return {sine / length, cosine / length};
}

void ellipsoid_to_xyz(const double* lonlat, std::size_t count, Latitude kind, double* xyz) {
    for (std::size_t k = 0; k < count; ++k) {
        const SineCosine east = sin_cos_degrees(lonlat[2 * k]);
        const SineCosine north = on_sphere(sin_cos_degrees(lonlat[2 * k + 1]), kind);
        const DoubleDouble x = north.cosine * east.cosine, y = north.cosine * east.sine;
        xyz[3 * k] = x.hi + x.lo + 0.0;
        xyz[3 * k + 1] = y.hi + y.lo + 0.0;
        xyz[3 * k + 2] = north.sine.hi + north.sine.lo + 0.0;
    }
}

}  // namespace stereodel::coordinates
