#include <algorithm>
#include <cmath>
#include <limits>

#include "memory.hpp"
#include "voronoi/ball_cells.hpp"
#include "voronoi/cell_integrals.hpp"
#include "voronoi/sphere_cell.hpp"

namespace stereodel::voronoi {
namespace {

// The integral of x over a cell, as a multiple of the site and the rest, and the bound of that.
struct CellMoment {
    double radial = 0.0;
    double rest[3] = {0.0, 0.0, 0.0};
    double bound = 0.0, size = 0.0;    // size: the cell reaches at least as far
    double total = 0.0, ridges = 0.0;  // of the parts' absolute values; how many were added

    void add(double factor, const double* vector) {
        for (int k = 0; k < 3; ++k) {
            rest[k] += factor * vector[k];
        }
    }

    // Both triangles of a ridge, in the frame of the site, the direction to the neighbour and their normal. The frame
    // is off by some 10u, the moments by `bound`, and by the legs' errors: those change the area, which has a bound of
    // its own, at vertices, and the cell reaches as far as these.
    void add_ridge(const double* p, const Side& side) {
        const TriangleMoment left = voronoi::moment(side.length, side.cosine, side.left);
        const TriangleMoment right = voronoi::moment(side.length, side.cosine, side.right);
        radial += left.radial + right.radial;
        double towards[3];  // the part of q - p across p
        for (int k = 0; k < 3; ++k) {
            towards[k] = side.edge[k] + 0.5 * side.length * side.length * p[k];
        }
        const double across = std::sqrt(rays::dot_form(towards, towards));
        for (double& x : towards) {
            x /= across;
        }
        const double along[3] = {p[1] * towards[2] - p[2] * towards[1], p[2] * towards[0] - p[0] * towards[2],
                                 p[0] * towards[1] - p[1] * towards[0]};
        add(left.towards + right.towards, towards);
        add(left.along - right.along, along);
        bound += left.bound + right.bound;
        total += std::fabs(left.towards) + std::fabs(right.towards) + std::fabs(left.along) + std::fabs(right.along);
        ++ridges;
        size = std::max(size, side.length / 2);
    }

    // No partial sum of the rest is longer than `total`; there are two additions a ridge.
    bool is_good(double area) const {
        return bound + (16 + 2 * ridges) * UNIT_ROUNDOFF * total <= CELL_ERROR * area * size;
    }

    // The unit vector of its direction: the site's and a little more.
    void direction(const UnitVector& p, double* result) const {
        Pair v[3];
        for (int k = 0; k < 3; ++k) {
            const DoubleDouble sum = two_sum(p.hi[k], rest[k] / radial);
            v[k] = {sum.hi, sum.lo + p.lo[k]};
        }
        round_unit(v, result);
    }
};

// Sites come in any order in memory, their neighbours in the order of `cells` soon after one another.
void fetch_ahead(const Cells& cells, const Buffer<UnitVector>& units, std::size_t k) {
    if (constexpr std::size_t far = 24, near = 12; k + far < cells.filled) {
        prefetch(cells.offsets + cells.order[k + far]);
        const auto site = static_cast<std::size_t>(cells.order[k + near]);
        const std::size_t begin = cells.begin(site);
        prefetch(cells.neighbors + begin);
        prefetch(cells.neighbors + begin + 5);
        const auto next = static_cast<std::size_t>(cells.order[k + near / 2]);
        for (std::size_t entry = cells.begin(next); entry < cells.end(next); ++entry) {
            prefetch(units.data() + cells.neighbors[entry]);
            prefetch(units[static_cast<std::size_t>(cells.neighbors[entry])].lo + 2);
        }
    }
}

// The area of a cell, and its centroid if that is wanted, by the first stage that may do.
class CellMeasure {
  public:
    CellMeasure(const double* points, const Cells& cells, const UnitVector* units)
        : points_(points), cells_(cells), units_(units), cell_(points, cells, units) {}

    double area(std::size_t site) {
        if (cell_.take(site)) {
            const double area = cell_.area();
            if (cell_.is_good(area)) {
                return area;
            }
        }
        return carefully(site, false).area;
    }

    void centroid(std::size_t site, double* result) {
        if (cell_.take(site)) {
            const double area = cell_.area();
            CellMoment moment;
            for (const Side& side : cell_.sides) {
                moment.add_ridge(units_[site].hi, side);
            }
            if (cell_.is_good(area) && moment.is_good(area)) {
                moment.direction(units_[site], result);
                return;
            }
        }
        std::copy_n(carefully(site, true).centroid, 3, result);
    }

  private:
    MeasuredCell carefully(std::size_t site, bool with_centroid) {
        const MeasuredCell cell = cell_.measure_carefully(site, with_centroid);
        return cell.good ? cell : sphere_cell_in_balls(points_, cells_, site, units_[site], with_centroid);
    }

    const double* points_;
    const Cells& cells_;
    const UnitVector* units_;
    SphereCell cell_;
};

// Calls visit(measure, site) for sites with entries, visit_empty(site) for those without.
template <class Visit, class VisitEmpty>
void for_cells(const double* points, const Cells& cells, int workers, Stop stop, Visit&& visit,
               VisitEmpty&& visit_empty) {
    Crew crew(useful_workers(workers, cells.sites));
    Buffer<UnitVector> units(cells.sites);
    for_all(cells.sites, crew, stop, [&](std::size_t k) { units[k] = unit_vector(points + 3 * k); });
    for_range(0, cells.sites, stop, [&](std::size_t site) {
        if (cells.begin(site) == cells.end(site)) {
            visit_empty(site);
        }
    });
    in_grains(cells.filled, std::size_t{1} << 12, crew, [&](std::size_t first, std::size_t last) {
        CellMeasure measure(points, cells, units.data());
        for_range(first, last, stop, [&](std::size_t k) {
            fetch_ahead(cells, units, k);
            visit(measure, static_cast<std::size_t>(cells.order[k]));
        });
    });
}

}  // namespace

void cell_areas_sphere(const double* points, const Cells& cells, double* areas, int workers, Stop stop) {
    for_cells(
        points, cells, workers, stop,
        [areas](CellMeasure& measure, std::size_t site) { areas[site] = measure.area(site); },
        [areas](std::size_t site) { areas[site] = 0.0; });
}

void cell_centroids_sphere(const double* points, const Cells& cells, double* centroids, int workers, Stop stop) {
    for_cells(
        points, cells, workers, stop,
        [centroids](CellMeasure& measure, std::size_t site) { measure.centroid(site, centroids + 3 * site); },
        [centroids](std::size_t site) {
            std::fill_n(centroids + 3 * site, 3, std::numeric_limits<double>::quiet_NaN());
        });
}

}  // namespace stereodel::voronoi
