#include <algorithm>
#include <cmath>
#include <limits>

#include "arithmetic/double_double.hpp"
#include "arithmetic/error_counts.hpp"
#include "voronoi/ball_cells.hpp"
#include "voronoi/cell_integrals.hpp"

namespace stereodel::voronoi {

using arithmetic::UNIT_ROUNDOFF;

namespace {

constexpr std::size_t grain = std::size_t{1} << 12;

double rounded(double x) { return x; }
double rounded(DoubleDouble x) { return x.hi + x.lo; }

double difference(double a, double b, double) { return a - b; }
DoubleDouble difference(double a, double b, DoubleDouble) { return two_difference(a, b); }

double times(double x, double factor) { return x * factor; }
DoubleDouble times(DoubleDouble x, double factor) { return x * DoubleDouble{factor, 0.0}; }

// What an operation of a number may be off by, of its result: those of double_double.hpp are at most 11u^2.
double roundoff(double) { return UNIT_ROUNDOFF; }
double roundoff(DoubleDouble) { return 11 * UNIT_ROUNDOFF * UNIT_ROUNDOFF; }

template <class Number>
struct CellEdge {
    Number x, y, square;

    // scale: a power of two.
    CellEdge(const double* from, const double* to, double scale)
        : x(difference(scale * to[0], scale * from[0], Number{})),
          y(difference(scale * to[1], scale * from[1], Number{})),
          square(x * x + y * y) {}
};

// The two right-angled triangles of the neighbours a and b at their common vertex: g = l/|D| of each, and their bound.
//
// With area |D|^2 g/4 for each leg pair, D = b, E = a: E.F, with the rounding of the differences, is off by 6u|E||F|,
// X = a x b by 5u|a||b|; |g| <= |E||F|/(2X). With the other roundings each area is off by less than
// 8u |a||b||F| |D|/(8X) (1 + |a||b|/X), if the error of X is less than 2^-5 of it and no product underflows.
template <class Number>
struct CornerTriangles {
    Number at_a, at_b;
    double bound;

    CornerTriangles(const CellEdge<Number>& a, const CellEdge<Number>& b, const CellEdge<Number>& across) {
        const Number twice = times(a.x * b.y - a.y * b.x, 2.0);
        at_a = (b.x * across.x + b.y * across.y) / twice;
        at_b = (-(a.x * across.x) - a.y * across.y) / twice;
        const double to_a = std::sqrt(rounded(a.square)), to_b = std::sqrt(rounded(b.square)), product = to_a * to_b;
        const double shape = product / rounded(twice), unit = roundoff(Number{});
        bound = shape > 0.0 && shape < 0x1p-10 / unit && product > 0x1p-800
                    ? 2 * unit * (to_a + to_b) * std::sqrt(rounded(across.square)) * shape * (1 + 2 * shape)
                    : HUGE_VAL;
    }
};

// The triangle with the legs D/2 and g |D|: its area |D|^2 g/4, moment area (D/3 +- g D'/3), D' = D turned by 90
// degrees. The centroid, of which the legs are no longer than the cell, is good where the area is.
template <class Number>
MeasuredCell measure(const double* points, const Index* neighbors, std::size_t size, std::size_t site, double scale) {
    const auto at = [points](std::size_t k) { return points + 2 * k; };
    const auto other = [&](std::size_t k) { return static_cast<std::size_t>(neighbors[k]); };
    Number area{}, x{}, y{};
    double bound = 0.0, total = 0.0;
    std::size_t before = size - 1;
    for (std::size_t k = 0; k < size; before = k++) {
        const CellEdge<Number> a(at(site), at(other(before)), scale), b(at(site), at(other(k)), scale);
        const CornerTriangles<Number> corner(a, b, CellEdge<Number>(at(other(before)), at(other(k)), scale));
        const Number of_a = times(a.square * corner.at_a, 0.25), of_b = times(b.square * corner.at_b, 0.25);
        area = area + (of_a + of_b);
        x = x + (of_a * (a.x - a.y * corner.at_a) + of_b * (b.x + b.y * corner.at_b));
        y = y + (of_a * (a.y + a.x * corner.at_a) + of_b * (b.y - b.x * corner.at_b));
        bound += corner.bound;
        total += std::fabs(rounded(of_a)) + std::fabs(rounded(of_b));
    }
    // No partial sum of areas is longer than `total`, none of moments longer than that with legs of the cell.
    bound += static_cast<double>(size) * roundoff(Number{}) * total;
    // Between these no product of the moment leaves the range of doubles.
    const bool good = bound <= CELL_ERROR * rounded(area) && rounded(area) > 0x1p-400 && rounded(area) < 0x1p400;
    const double unscaled = rounded(area) / scale / scale;
    return {unscaled, {rounded(x) / rounded(area) / 3 / scale, rounded(y) / rounded(area) / 3 / scale, 0.0}, good};
}

// In double-double, brought to a size at which no product leaves the range of doubles.
MeasuredCell measure_carefully(const double* points, const Index* neighbors, std::size_t size, std::size_t site) {
    double largest = 0.0;
    for (std::size_t k = 0; k < size; ++k) {
        const double* const other = points + 2 * static_cast<std::size_t>(neighbors[k]);
        for (std::size_t i = 0; i < 2; ++i) {
            largest = std::max(largest, std::fabs(other[i] / 2 - points[2 * site + i] / 2));
        }
    }
    int exponent = 0;
    std::frexp(largest, &exponent);
    return measure<DoubleDouble>(points, neighbors, size, site, std::ldexp(1.0, std::clamp(-exponent, -1000, 1000)));
}

// Calls put(site, measured) for all sites with bounded cells, put(site, what) for the others.
template <class Put>
void for_cells(const double* points, const Cells& cells, int workers, Stop stop, Put&& put) {
    Crew crew(useful_workers(workers, cells.sites));
    constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
    for_range(0, cells.sites, stop, [&](std::size_t site) {
        if (cells.begin(site) == cells.end(site)) {
            put(site, MeasuredCell{0.0, {nowhere, nowhere}, true});
        }
    });
    in_grains(cells.filled, grain, crew, [&](std::size_t first, std::size_t last) {
        for_range(first, last, stop, [&](std::size_t k) {
            const auto site = static_cast<std::size_t>(cells.order[k]);
            const std::size_t begin = cells.begin(site), size = cells.end(site) - begin;
            if (cells.vertices[begin] < 0) {
                put(site, MeasuredCell{HUGE_VAL, {nowhere, nowhere}, true});
                return;
            }
            MeasuredCell measured = measure<double>(points, cells.neighbors + begin, size, site, 1.0);
            if (!measured.good) {
                measured = measure_carefully(points, cells.neighbors + begin, size, site);
            }
            put(site, measured.good ? measured : plane_cell_in_balls(points, cells, site));
        });
    });
}

}  // namespace

void cell_areas_plane(const double* points, const Cells& cells, double* areas, int workers, Stop stop) {
    for_cells(points, cells, workers, stop,
              [areas](std::size_t site, const MeasuredCell& measured) { areas[site] = measured.area; });
}

void cell_centroids_plane(const double* points, const Cells& cells, double* centroids, int workers, Stop stop) {
    for_cells(points, cells, workers, stop, [=](std::size_t site, const MeasuredCell& measured) {
        for (std::size_t k = 0; k < 2; ++k) {
            centroids[2 * site + k] = points[2 * site + k] + measured.centroid[k];
        }
    });
}

}  // namespace stereodel::voronoi
