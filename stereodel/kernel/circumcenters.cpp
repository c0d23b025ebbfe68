#include "circumcenters.hpp"

#include <algorithm>
#include <cmath>

#include "memory.hpp"
#include "unit_vectors.hpp"

namespace stereodel {
namespace {

constexpr std::size_t grain = std::size_t{1} << 13;

// a + (e_y|d|^2 - d_y|e|^2, d_x|e|^2 - e_x|d|^2) / (2 d x e), d = b - a, e = c - a. Differences are exact sums of two
// doubles, the product d x e is off by less than 16u^2 |d||e|: at 2^-44 |d||e| that is less than 2^-58 of it.
bool planar_center(const double* a, const double* b, const double* c, double* center) {
    const double size = std::max({std::fabs(b[0] - a[0]), std::fabs(b[1] - a[1]), std::fabs(c[0] - a[0]),
                                  std::fabs(c[1] - a[1])});
    if (!(size > 0x1p-400 && size < 0x1p400)) {
        return false;
    }
    int exponent = 0;
    std::frexp(size, &exponent);
    const double scale = std::ldexp(1.0, -exponent);
    const auto scaled = [scale](double x) { return x * scale; };
    DoubleDouble d[2], e[2];
    for (int k = 0; k < 2; ++k) {
        d[k] = two_difference(scaled(b[k]), scaled(a[k]));
        e[k] = two_difference(scaled(c[k]), scaled(a[k]));
    }
    const DoubleDouble area = d[0] * e[1] - d[1] * e[0];
    const DoubleDouble dd = d[0] * d[0] + d[1] * d[1], ee = e[0] * e[0] + e[1] * e[1];
    if (!(std::fabs(area.hi) > 0x1p-44 * std::sqrt(dd.hi * ee.hi))) {
        return false;
    }
    const DoubleDouble divisor{2 * area.hi, 2 * area.lo};
    const DoubleDouble x = DoubleDouble{scaled(a[0])} + (e[1] * dd - d[1] * ee) / divisor;
    const DoubleDouble y = DoubleDouble{scaled(a[1])} + (d[0] * ee - e[0] * dd) / divisor;
    center[0] = std::ldexp(x.hi + x.lo, exponent);
    center[1] = std::ldexp(y.hi + y.lo, exponent);
    return true;
}

// d x e of unit vectors' differences. They are off by 2^-100 each, the product by sqrt(3) 2^-100 (|d| + |e|) and some
// 2^-99 |d||e|: at 2^-44 (|d| + |e|), less than 2^-55 of it.
bool spherical_center(const UnitVector& a, const UnitVector& b, const UnitVector& c, double* center) {
    const PairedEdge d(a, b), e(a, c);
    Pair normal[3];
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        normal[k] = d.v[i] * e.v[j] - d.v[j] * e.v[i];
    }
    const double sides = std::sqrt(length_squared(d.v)) + std::sqrt(length_squared(e.v));
    if (!(length_squared(normal) > 0x1p-88 * sides * sides)) {
        return false;
    }
    round_unit(normal, center);
    return true;
}

// The same for points that are closer together, by differences of relative accuracy: the product of two of length up to
// 2 is off by less than 2^-95 of the larger loss, and by less than 2^-54 of itself if it is 2^41 times as long.
bool close_center(const double* a, const double* b, const double* c, double* center) {
    const Ray ra(a), rb(b), rc(c);
    const RayEdge d(ra, rb), e(ra, rc);
    DoubleDouble product[3];
    cross(d.v, e.v, product);
    const Pair normal[3] = {
        {product[0].hi, product[0].lo}, {product[1].hi, product[1].lo}, {product[2].hi, product[2].lo}};
    if (!(std::sqrt(length_squared(normal)) > 0x1p-41 * std::max(d.loss, e.loss))) {
        return false;
    }
    round_unit(normal, center);
    return true;
}

// Calls center(k) for all rows, on several threads; returns those for which it says no.
template <class Center>
std::vector<Index> open_rows(std::size_t count, Crew& crew, Stop stop, Center&& center) {
    std::vector<std::vector<Index>> open((count + grain - 1) / grain);
    in_grains(count, grain, crew, [&](std::size_t begin, std::size_t end) {
        for_range(begin, end, stop, [&](std::size_t k) {
            if (!center(k)) {
                open[begin / grain].push_back(static_cast<Index>(k));
            }
        });
    });
    std::vector<Index> all;
    for (const std::vector<Index>& some : open) {
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

}  // namespace

std::vector<Index> circumcenters_plane(const double* points, const TriangleRows& rows, double* centers, int workers,
                                       Stop stop) {
    Crew crew(useful_workers(workers, rows.count));
    const auto at = [points](Index a) { return points + 2 * static_cast<std::ptrdiff_t>(a); };
    return open_rows(rows.count, crew, stop, [&](std::size_t k) {
        const Index* t = rows.corners + 3 * k;
        return planar_center(at(t[0]), at(t[1]), at(t[2]), centers + 2 * rows.to(k));
    });
}

std::vector<Index> circumcenters_sphere(const double* points, std::size_t size, const TriangleRows& rows,
                                        double* centers, int workers, Stop stop) {
    Crew crew(useful_workers(workers, rows.count));
    Buffer<UnitVector> units(size);
    for_all(size, crew, stop, [&](std::size_t k) { units[k] = unit_vector(points + 3 * k); });
    const auto at = [points](Index a) { return points + 3 * static_cast<std::ptrdiff_t>(a); };
    const auto unit = [&](Index a) -> const UnitVector& { return units[static_cast<std::size_t>(a)]; };
    return open_rows(rows.count, crew, stop, [&](std::size_t k) {
        const Index* t = rows.corners + 3 * k;
        if (constexpr std::size_t ahead = 16; k + ahead < rows.count) {
            for (std::size_t place = 0; place < 3; ++place) {
                const UnitVector& corner = unit(t[3 * ahead + place]);
                prefetch(&corner);
                prefetch(corner.lo + 2);
            }
            prefetch(centers + 3 * rows.to(k + ahead));
        }
        double* const center = centers + 3 * rows.to(k);
        return spherical_center(unit(t[0]), unit(t[1]), unit(t[2]), center) ||
               close_center(at(t[0]), at(t[1]), at(t[2]), center);
    });
}

}  // namespace stereodel
