#include "voronoi/circumcenters.hpp"

#include <algorithm>
#include <cmath>

#include "memory.hpp"
#include "voronoi/careful_circumcenters.hpp"
#include "voronoi/unit_vectors.hpp"

namespace stereodel::voronoi {
namespace {

constexpr std::size_t grain = std::size_t{1} << 13;

// a + (e_y|d|^2 - d_y|e|^2, d_x|e|^2 - e_x|d|^2) / (2 d x e), d = b - a, e = c - a. Differences are exact sums of two
// doubles, the product d x e is off by less than 16u^2 |d||e|: at 2^-44 |d||e| that is less than 2^-58 of it. No side
// is longer than 2 after scaling, so above 2^-300 none is shorter than 2^-301, and nothing underflows that counts.
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
    if (!(std::fabs(area.hi) > std::max(0x1p-300, 0x1p-44 * std::sqrt(dd.hi * ee.hi)))) {
        return false;
    }
    const DoubleDouble divisor{2 * area.hi, 2 * area.lo};
    const DoubleDouble x = DoubleDouble{scaled(a[0])} + (e[1] * dd - d[1] * ee) / divisor;
    const DoubleDouble y = DoubleDouble{scaled(a[1])} + (d[0] * ee - e[0] * dd) / divisor;
    center[0] = std::ldexp(x.hi + x.lo, exponent);
    center[1] = std::ldexp(y.hi + y.lo, exponent);
    return true;
}

// Corners of some rows as unit vectors, coordinates apart, so that compilers put rows side by side into registers.
struct CornerBlock {
    static constexpr std::size_t size = 32;

    double high[3][3][size], low[3][3][size];  // corner, coordinate, row

    void put(std::size_t corner, std::size_t row, const UnitVector& unit) {
        for (std::size_t i = 0; i < 3; ++i) {
            high[corner][i][row] = unit.hi[i];
            low[corner][i][row] = unit.lo[i];
        }
    }

    UnitVector unit(std::size_t corner, std::size_t row) const {
        const auto &h = high[corner], &l = low[corner];
        return {{h[0][row], h[1][row], h[2][row]}, {l[0][row], l[1][row], l[2][row]}};
    }
};

// The centre in each coordinate, and what is positive where it holds.
struct CenterBlock {
    double center[3][CornerBlock::size], margin[CornerBlock::size];
};

// d x e of unit vectors' differences. They are off by 2^-100 each, the product by sqrt(3) 2^-100 (|d| + |e|) and some
// 2^-99 |d||e|: at 2^-44 (|d| + |e|), less than 2^-55 of it. Low parts of the product are below 4u |d||e|: of a product
// above 2^-22 (|d| + |e|)^2, and so 2^-20 |d||e|, less than 2^-31. Needles are left open.
STEREODEL_FLATTEN void spherical_centers(const CornerBlock& corners, CenterBlock& centers) {
    for (std::size_t row = 0; row < CornerBlock::size; ++row) {
        const UnitVector a = corners.unit(0, row);
        const PairedEdge d(a, corners.unit(1, row)), e(a, corners.unit(2, row));
        Pair normal[3];
        for (int k = 0; k < 3; ++k) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            normal[k] = d.v[i] * e.v[j] - d.v[j] * e.v[i];
        }
        const double sides = std::sqrt(length_squared(d.v)) + std::sqrt(length_squared(e.v)), sides2 = sides * sides;
        double center[3];
        round_unit(normal, center);
        for (std::size_t i = 0; i < 3; ++i) {
            centers.center[i][row] = center[i];
        }
        centers.margin[row] = length_squared(normal) - std::max(0x1p-88 * sides2, 0x1p-44 * sides2 * sides2);
    }
}

class SphericalCenters {
  public:
    static constexpr std::size_t most = CornerBlock::size;

    SphericalCenters(const double* points, const UnitVector* units, const TriangleRows& rows, double* centers,
                     Stop stop)
        : points_(points), units_(units), rows_(rows), centers_(centers), stop_(stop) {}

    // Some rows from one on, at most a block.
    void take(std::size_t first, std::size_t count) {
        for (std::size_t k = 0; k < most; ++k) {
            const std::size_t row = first + std::min(k, count - 1);  // the last one fills the block
            fetch_ahead(row);
            for (std::size_t place = 0; place < 3; ++place) {
                corners_.put(place, k, units_[corner(row, place)]);
            }
        }
        spherical_centers(corners_, found_);
        for (std::size_t k = 0; k < count; ++k) {
            double* const center = centers_ + 3 * rows_.to(first + k);
            if (found_.margin[k] > 0) {
                for (std::size_t i = 0; i < 3; ++i) {
                    center[i] = found_.center[i][k];
                }
            } else {
                const double* const corners[3] = {point(first + k, 0), point(first + k, 1), point(first + k, 2)};
                careful_center_sphere(corners, stop_, center);
            }
        }
    }

  private:
    std::size_t corner(std::size_t row, std::size_t place) const {
        return static_cast<std::size_t>(rows_.corners[3 * row + place]);
    }

    void fetch_ahead(std::size_t row) const {
        if (constexpr std::size_t ahead = 16; row + ahead < rows_.count) {
            for (std::size_t place = 0; place < 3; ++place) {
                const UnitVector& unit = units_[corner(row + ahead, place)];
                prefetch(&unit);
                prefetch(unit.lo + 2);
            }
            prefetch(centers_ + 3 * rows_.to(row + ahead));
        }
    }

    const double* point(std::size_t row, std::size_t place) const { return points_ + 3 * corner(row, place); }

    const double* points_;
    const UnitVector* units_;
    TriangleRows rows_;
    double* centers_;
    Stop stop_;
    CornerBlock corners_;
    CenterBlock found_;
};

// Calls center(k) for all rows, on several threads.
template <class Center>
void for_rows(std::size_t count, Crew& crew, Stop stop, Center&& center) {
    in_grains(count, grain, crew, [&](std::size_t begin, std::size_t end) { for_range(begin, end, stop, center); });
}

}  // namespace

template <>
void circumcenters<2>(const double* points, std::size_t, const TriangleRows& rows, double* centers, int workers,
                      Stop stop) {
    Crew crew(useful_workers(workers, rows.count));
    const auto at = [points](Index a) { return points + 2 * static_cast<std::ptrdiff_t>(a); };
    for_rows(rows.count, crew, stop, [&](std::size_t k) {
        const Index* t = rows.corners + 3 * k;
        const double* const corners[3] = {at(t[0]), at(t[1]), at(t[2])};
        double* const center = centers + 2 * rows.to(k);
        if (!planar_center(corners[0], corners[1], corners[2], center)) {
            careful_center_plane(corners, stop, center);
        }
    });
}

template <>
void circumcenters<3>(const double* points, std::size_t size, const TriangleRows& rows, double* centers, int workers,
                      Stop stop) {
    Crew crew(useful_workers(workers, rows.count));
    Buffer<UnitVector> units(size);
    for_all(size, crew, stop, [&](std::size_t k) { units[k] = unit_vector(points + 3 * k); });
    in_grains(rows.count, grain, crew, [&](std::size_t begin, std::size_t end) {
        SphericalCenters task(points, units.data(), rows, centers, stop);
        for (; begin < end; begin += SphericalCenters::most) {
            check(stop);
            task.take(begin, std::min(SphericalCenters::most, end - begin));
        }
    });
}

}  // namespace stereodel::voronoi
