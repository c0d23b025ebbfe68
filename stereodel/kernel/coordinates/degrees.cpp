// The series of sine and cosine for up to 45 degrees.
//
// Source: Taylor's series by Horner's rule, sum of (-t^2)^k / (2k + first)!, t = angle in radians, |t| <= pi/4.
//
// The error, u = 2^-53 and the bounds of double_double.hpp (sum 3u^2, product 7u^2; third order left out):
//   t        one product and the rounding of pi/180: 8u^2; costs sine as much and cosine t tan t times that, 6.3u^2
//   t^2      7u^2 more
//   Horner   T_k = T_(k+1) (-t^2) + c_k is off by e_k <= 3u^2 |T_k| + t^2 (e_(k+1) + (7 + 7)u^2 |T_(k+1)|),
//            t^2 < 0.617; from |T_k| <= c_k: cosine e_2 < 0.2u^2, e_1 < 2u^2, e_0 < 8.6u^2 of at least 0.707: 12.2u^2;
//            sine e_1 < 0.7u^2, e_0 < 4.9u^2 of at least 0.9: 5.5u^2, and 7u^2 for the product with t
//   tail     the terms from t^18/18! < 2^-58 on are summed in plain double, a few u each: below 2^-108
//   cut      t^30/30! < 2^-117 and t^28/29! < 2^-112 are left out
// Together below 21u^2, that is below 2^-101 for both.

#include "coordinates/degrees.hpp"

namespace stereodel::coordinates {

namespace {

// 1/n!, each to 106 bits: n = 0, 2, … for cosine, n = 1, 3, … for sine; the tails in plain double.
constexpr int PAIRS = 9;
constexpr DoubleDouble COSINE_TERMS[PAIRS] = {
    {0x1.0000000000000p+0, 0.0},
    {0x1.0000000000000p-1, 0.0},
    {0x1.5555555555555p-5, 0x1.5555555555555p-59},
    {0x1.6c16c16c16c17p-10, -0x1.f49f49f49f49fp-65},
    {0x1.a01a01a01a01ap-16, 0x1.a01a01a01a01ap-76},
    {0x1.27e4fb7789f5cp-22, 0x1.cbbc05b4fa99ap-76},
    {0x1.1eed8eff8d898p-29, -0x1.2aec959e14c06p-83},
    {0x1.93974a8c07c9dp-37, 0x1.05d6f8a2efd1fp-92},
    {0x1.ae7f3e733b81fp-45, 0x1.1d8656b0ee8cbp-101},
};
constexpr double COSINE_TAIL[] = {0x1.6827863b97d97p-53, 0x1.e542ba4020225p-62, 0x1.0ce396db7f853p-70,
                                  0x1.f2cf01972f578p-80, 0x1.88e85fc6a4e5ap-89, 0x1.0a18a2635085dp-98};
constexpr DoubleDouble SINE_TERMS[PAIRS] = {
    {0x1.0000000000000p+0, 0.0},
    {0x1.5555555555555p-3, 0x1.5555555555555p-57},
    {0x1.1111111111111p-7, 0x1.1111111111111p-63},
    {0x1.a01a01a01a01ap-13, 0x1.a01a01a01a01ap-73},
    {0x1.71de3a556c734p-19, -0x1.c154f8ddc6c00p-73},
    {0x1.ae64567f544e4p-26, -0x1.c062e06d1f209p-80},
    {0x1.6124613a86d09p-33, 0x1.f28e0cc748ebep-87},
    {0x1.ae7f3e733b81fp-41, 0x1.1d8656b0ee8cbp-97},
    {0x1.952c77030ad4ap-49, 0x1.ac981465ddc6cp-103},
};
constexpr double SINE_TAIL[] = {0x1.2f49b46814157p-57, 0x1.71b8ef6dcf572p-66, 0x1.761b41316381ap-75,
                                0x1.3f3ccdd165fa9p-84, 0x1.d1ab1c2dccea3p-94};

constexpr DoubleDouble SQRT_HALF{0x1.6a09e667f3bcdp-1, -0x1.bdd3413b26455p-55};

template <std::size_t TAIL>
DoubleDouble series(const DoubleDouble (&terms)[PAIRS], const double (&tail)[TAIL], DoubleDouble minus_square) {
    double rest = tail[TAIL - 1];
    for (std::size_t k = TAIL - 1; k-- > 0;) rest = rest * minus_square.hi + tail[k];
    DoubleDouble total{rest, 0.0};
    for (std::size_t k = PAIRS; k-- > 0;) total = total * minus_square + terms[k];
    return total;
}

}  // namespace

SineCosine sin_cos_rest(double rest) {
    // At 45 degrees both are the root of a half: the swap of x and y is then as exact as the other mirrors.
    if (std::abs(rest) == 45.0) return {rest > 0 ? SQRT_HALF : -SQRT_HALF, SQRT_HALF};
    const DoubleDouble theta = RADIAN * DoubleDouble{rest, 0.0};
    const DoubleDouble minus_square = -(theta * theta);
    return {theta * series(SINE_TERMS, SINE_TAIL, minus_square), series(COSINE_TERMS, COSINE_TAIL, minus_square)};
}

const DegreeTable& degree_table() {
    static const DegreeTable made = [] {
        DegreeTable values{};
        for (std::size_t k = 0; k < values.size(); ++k) {
            values[k] = sin_cos_rest(static_cast<double>(k) * 45.0 / DEGREE_STEPS);
        }
        return values;
    }();
    return made;
}

}  // namespace stereodel::coordinates
