// The fisheye is the boost of rapidity -ln S on light-cone coordinates: with r the length of a vector across, z along
// the axis, r + z becomes (r + z)/S, r - z becomes (r - z) S, and the part t across stays. The smaller of the two is
// |t|^2 over the other, so that points next to the focus and its antipode keep their digits. Source: claim P18 of the
// paper; R. Penrose, W. Rindler, "Spinors and Space-Time" 1 (1984), section 1.3.
//
// The bound of the images, u = 2^-53, first order. Vectors come with components below 2 and a length above 1/2.
// Rotation: parts on the grid of 2^-25 have products on that of 2^-50, and their sums stay below 4, which are 52 bits:
//   no rounding. The other terms, below (2 + 1) sqrt(3) 2^-26 |v| together, have at most five roundings each, that is
//   2^-74 |v| a component, 2^-73 |v| all. Then each component is rounded once. Together u + 2^-73 of the length.
//   The first one so stands for a point within u + 2^-73 of the given one: (u + 2^-73) scale in the image. Errors u of
//   components also are at most sqrt(5) u sin chi, that is sqrt(5) u sin Xi in the image.
// Fisheye, taking what was rotated for exact; c = |cos chi|, the image at the distance Xi from the axis:
//   |t|^2 2u;  r^2 2u + u sin^2 chi;  r 2u + u/2 sin^2 chi;  large = r + |z|: that over 1 + c, and u: at most 3.5u;
//   small = |t|^2 / large: besides the error of large 3u; with S: `small` 4u, `large` 1u.
//   An error e of large changes lower and upper by e and -e and turns the image by e sin Xi. An error e of upper alone
//   moves it by e sin Xi sin(Xi/2), of lower alone by e sin Xi cos(Xi/2): with 4u and 1u at most sqrt(17) u sin Xi.
//   Rounded are the sum (u), the difference (u |cos Xi|) and the quotients (u). All: 7.63u sin Xi + |cos Xi| u + 2u.
// Second rotation: u + 2^-73.
// With s the scale, sin Xi = s sin chi <= min(1, s). For s >= 1 the sum is at most s u + sqrt(7.63^2 + 1) u + 3u, less
// than 10.7u + s u; for s < 1 at most s u + 7.63 s u + sqrt(1 - s^2) u + 3u, and 2.63 s + sqrt(1 - s^2) < 2.82. Both
// are 0.18u below 6u (1 + s), more than 2^-73 (1 + s) and the second order. With sqrt(5) u sin Xi in place of s u the
// sum is below 12.93u + 2^-73 s, however large s is.
//
// The scale 2r / (lower + upper) has only positive terms; with components of relative error u, |t|^2 has 4u, r^2 5u,
// r 3.5u, large 4.5u, small 9.5u, the sum 11.5u with S, the scale 16u: the bound has twice that.
//
// |t|^2 underflows where |t| < 2^-511: S^2 |t|^2 is then below 2^-350 and does not count beside 1.

#include "conformal/moebius.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "coordinates/plain_degrees.hpp"

namespace stereodel::conformal {

using coordinates::DegreeTable;
using coordinates::PlainSineCosine;
using coordinates::degree_table;
using coordinates::plain_angle;
using coordinates::plain_sin_cos;

namespace {

constexpr std::size_t BLOCK = 256;  // points of which everything stays in the first-level cache
constexpr std::size_t GRAIN = 64 * BLOCK;
constexpr double GRID = 0x1.8p27;  // adding and subtracting it rounds |x| < 2^26 to a multiple of 2^-25

// Coordinates apart, so that compilers put points side by side into registers.
struct Block {
    double x[BLOCK], y[BLOCK], z[BLOCK];
    std::size_t count;
};

double on_grid(double value) {
    return (value + GRID) - GRID;
}

// The power of two that brings the sum of the components of a vector into [1, 2), from the bits of its exponent.
// Meaningless unless `usual`: the sum is subnormal, huge or no number.
struct Power {
    double value;
    bool usual;
};

inline Power power_for(double x, double y, double z) {
    constexpr std::uint64_t exponent = std::uint64_t{2047} << 52, reciprocal = std::uint64_t{2046} << 52;
    const double sum = std::abs(x) + std::abs(y) + std::abs(z);
    std::uint64_t bits;
    std::memcpy(&bits, &sum, sizeof bits);
    bits = reciprocal - (bits & exponent);
    Power power;
    power.usual = bits - 1 < reciprocal - 1;
    std::memcpy(&power.value, &bits, sizeof bits);
    return power;
}

// Other vectors are brought near length 1 first, which loses components that are 2^1022 times as short as another.
// False if one is zero or not finite.
bool take_unusual(const double* xyz, Block& p) {
    bool sound = true;
    for (std::size_t k = 0; k < p.count; ++k) {
        double x = xyz[3 * k], y = xyz[3 * k + 1], z = xyz[3 * k + 2];
        if (power_for(x, y, z).usual) continue;
        const double size = std::max({std::abs(x), std::abs(y), std::abs(z)});
        sound &= size > 0.0 && std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
        int exponent = 0;
        std::frexp(size, &exponent);
        for (double* component : {&x, &y, &z}) *component = std::ldexp(*component, -exponent);
        const Power power = power_for(x, y, z);
        p.x[k] = x * power.value;
        p.y[k] = y * power.value;
        p.z[k] = z * power.value;
    }
    return sound;
}

bool load(const double* xyz, std::size_t count, Block& p) {
    p.count = count;
    std::size_t usual = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const double x = xyz[3 * k], y = xyz[3 * k + 1], z = xyz[3 * k + 2];
        const Power power = power_for(x, y, z);
        usual += power.usual ? 1 : 0;
        p.x[k] = x * power.value;
        p.y[k] = y * power.value;
        p.z[k] = z * power.value;
    }
    return usual == count || take_unusual(xyz, p);
}

// The matrix by value: nothing that is written to can be a part of it.
void rotate(const SplitRotation m, Block& p) {
    for (std::size_t k = 0; k < p.count; ++k) {
        const double x = p.x[k], y = p.y[k], z = p.z[k];
        const double xh = on_grid(x), yh = on_grid(y), zh = on_grid(z);
        const double xl = x - xh, yl = y - yh, zl = z - zh;
        const auto row = [&](std::size_t i) {
            const double exact = (m.high[i] * xh + m.high[i + 1] * yh) + m.high[i + 2] * zh;
            const double rest = ((m.high[i] * xl + m.low[i] * x) + (m.high[i + 1] * yl + m.low[i + 1] * y)) +
                                (m.high[i + 2] * zl + m.low[i + 2] * z);
            return exact + rest;
        };
        p.x[k] = row(0);
        p.y[k] = row(3);
        p.z[k] = row(6);
    }
}

struct LightCone {
    double length, lower, upper;
};

inline LightCone light_cone(double x, double y, double z, double magnification) {
    const double across = x * x + y * y;
    const double length = std::sqrt(across + z * z);
    const double large = length + std::abs(z);
    const double small = across / large;
    const double lower = z < 0 ? small : large, upper = z < 0 ? large : small;
    return {length, lower / magnification, upper * magnification};
}

void normalize(Block& p) {
    for (std::size_t k = 0; k < p.count; ++k) {
        const double x = p.x[k], y = p.y[k], z = p.z[k];
        const double length = std::sqrt(x * x + y * y + z * z);
        p.x[k] = x / length;
        p.y[k] = y / length;
        p.z[k] = z / length;
    }
}

void boost(double magnification, Block& p) {
    if (magnification == 1.0) return normalize(p);  // fewer roundings
    for (std::size_t k = 0; k < p.count; ++k) {
        const double x = p.x[k], y = p.y[k];
        const LightCone cone = light_cone(x, y, p.z[k], magnification);
        const double total = cone.lower + cone.upper;
        p.x[k] = 2.0 * x / total;
        p.y[k] = 2.0 * y / total;
        p.z[k] = (cone.lower - cone.upper) / total;
    }
}

void store(const Block& p, double* xyz) {
    for (std::size_t k = 0; k < p.count; ++k) {
        xyz[3 * k] = p.x[k] + 0.0;
        xyz[3 * k + 1] = p.y[k] + 0.0;
        xyz[3 * k + 2] = p.z[k] + 0.0;
    }
}

bool load_lonlat(const double* lonlat, std::size_t count, const DegreeTable& table, Block& p) {
    p.count = count;
    bool sound = true;
    for (std::size_t k = 0; k < count; ++k) {
        const double lon = lonlat[2 * k], lat = lonlat[2 * k + 1];
        const bool good = std::isfinite(lon) && std::abs(lat) <= 90.0;
        sound &= good;
        const PlainSineCosine east = plain_sin_cos(good ? lon : 0.0, table);
        const PlainSineCosine north = plain_sin_cos(good ? lat : 0.0, table);
        p.x[k] = north.cosine * east.cosine;
        p.y[k] = north.cosine * east.sine;
        p.z[k] = north.sine;
    }
    return sound;
}

void store_lonlat(const Block& p, const DegreeTable& table, double* lonlat) {
    for (std::size_t k = 0; k < p.count; ++k) {
        const double x = p.x[k], y = p.y[k];
        const double lon = plain_angle(y, x, table);
        lonlat[2 * k] = lon == 180.0 ? -180.0 : lon + 0.0;
        lonlat[2 * k + 1] = plain_angle(p.z[k], std::sqrt(x * x + y * y), table) + 0.0;
    }
}

// Calls fill(block, first, count) and each(block, first) for points in blocks, which are turned by `right` between.
template <class Fill, class Each>
bool over_blocks(const SplitRotation& right, std::size_t count, int workers, Stop stop, Fill&& fill, Each&& each) {
    Crew crew(useful_workers(workers, count));
    std::atomic<bool> sound{true};
    in_grains(count, GRAIN, crew, [&](std::size_t begin, std::size_t end) {
        check(stop);
        Block p;
        for (; begin < end; begin += BLOCK) {
            if (!fill(p, begin, std::min(BLOCK, end - begin))) sound = false;
            rotate(right, p);
            each(p, begin);
        }
    });
    return sound;
}

}  // namespace

SplitRotation::SplitRotation(const double* hi, const double* lo) {
    for (std::size_t k = 0; k < 9; ++k) {
        high[k] = on_grid(hi[k]);
        low[k] = (hi[k] - high[k]) + lo[k];
    }
}

bool moebius_images(const MoebiusParts& map, const double* xyz, std::size_t count, double* images, int workers,
                    Stop stop) {
    return over_blocks(
        map.right, count, workers, stop,
        [&](Block& p, std::size_t first, std::size_t n) { return load(xyz + 3 * first, n, p); },
        [&](Block& p, std::size_t first) {
            boost(map.magnification, p);
            rotate(map.left, p);
            store(p, images + 3 * first);
        });
}

bool moebius_scales(const MoebiusParts& map, const double* xyz, std::size_t count, double* scales, int workers,
                    Stop stop) {
    return over_blocks(
        map.right, count, workers, stop,
        [&](Block& p, std::size_t first, std::size_t n) { return load(xyz + 3 * first, n, p); },
        [&](const Block& p, std::size_t first) {
            for (std::size_t k = 0; k < p.count; ++k) {
                const LightCone cone = light_cone(p.x[k], p.y[k], p.z[k], map.magnification);
                const double scale = 2.0 * cone.length / (cone.lower + cone.upper);
                scales[first + k] = map.magnification == 1.0 ? 1.0 : scale;
            }
        });
}

// The point is off by 5.2u (two factors of 2.1u, a product), the map by 6u (1 + s), the two angles by 6u rad at most
// each, at right angles to each other, and the square root by 1.5u: below 18u (1 + s).
bool moebius_lonlat(const MoebiusParts& map, const double* lonlat, std::size_t count, double* images, int workers,
                    Stop stop) {
    const DegreeTable& table = degree_table();
    return over_blocks(
        map.right, count, workers, stop,
        [&](Block& p, std::size_t first, std::size_t n) { return load_lonlat(lonlat + 2 * first, n, table, p); },
        [&](Block& p, std::size_t first) {
            boost(map.magnification, p);
            rotate(map.left, p);
            store_lonlat(p, table, images + 2 * first);
        });
}

}  // namespace stereodel::conformal
