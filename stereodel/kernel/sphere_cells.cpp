#include <algorithm>
#include <cmath>
#include <limits>

#include "cell_integrals.hpp"
#include "memory.hpp"
#include "sphere_cell.hpp"

namespace stereodel {
namespace {

// The integral of x over a cell, as a multiple of the site and the rest.
struct CellMoment {
    double radial = 0.0;
    double rest[3] = {0.0, 0.0, 0.0};

    void add(double factor, const double* vector) {
        for (int k = 0; k < 3; ++k) {
            rest[k] += factor * vector[k];
        }
    }

    // The unit vector of its direction. A small cell's is the site's and a little more.
    void direction(const UnitVector& p, double* result) const {
        Pair v[3];
        double size = std::max({radial, std::fabs(rest[0]), std::fabs(rest[1]), std::fabs(rest[2])});
        size = radial > 0.5 * size ? radial : size;
        if (!(size > 0.0)) {  // its area is below the least of doubles
            std::copy(p.hi, p.hi + 3, result);
            return;
        }
        for (int k = 0; k < 3; ++k) {
            const DoubleDouble sum = two_sum(radial == size ? p.hi[k] : radial / size * p.hi[k], rest[k] / size);
            v[k] = {sum.hi, sum.lo};
        }
        round_unit(v, result);
    }
};

// Both triangles of a ridge, in the frame of the site, the direction to the neighbour and their normal.
void add_ridge(const double* p, const SphereCell& cell, std::size_t place, CellMoment& moment) {
    const Side<double>& side = cell.sides[place];
    const TriangleMoment left = stereodel::moment(side.length, side.cosine, side.left);
    const TriangleMoment right = stereodel::moment(side.length, side.cosine, side.right);
    const double turned = is_turned(side.left, side.right) ? PI : 0.0;
    moment.radial += left.radial + right.radial + turned * side.length / 2;
    // The part of q - p across p. Beyond a right angle the sum cancels, near p it is too short for squares.
    double towards[3];
    for (int k = 0; k < 3; ++k) {
        towards[k] = cell.is_careful() ? cell.towards(place)[k] : side.edge[k] + 0.5 * side.length * side.length * p[k];
    }
    const double across = std::sqrt(rays::dot_form(towards, towards));
    for (double& x : towards) {
        x /= across;
    }
    const double along[3] = {p[1] * towards[2] - p[2] * towards[1], p[2] * towards[0] - p[0] * towards[2],
                             p[0] * towards[1] - p[1] * towards[0]};
    moment.add(left.towards + right.towards - turned * side.cosine, towards);
    moment.add(left.along - right.along, along);
}

// Half of angle times normal of the side from v to w.
void add_arc(const double* v, const double* w, CellMoment& moment) {
    const double normal[3] = {v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]};
    const double sine = std::sqrt(rays::dot_form(normal, normal));
    if (sine > 0.0) {
        moment.add(0.5 * std::atan2(sine, rays::dot_form(v, w)) / sine, normal);
    }
}

// The triangle of the site and a ridge that is nearly its polar great circle.
void add_opposite_ridge(const double* p, const SphereCell& cell, std::size_t k, CellMoment& moment) {
    moment.add(-0.25 * cell.ridge_length(k), cell.sides[k].edge);
    add_arc(cell.left_vertex(k), p, moment);
    add_arc(p, cell.right_vertex(k), moment);
}

CellMoment moment_of(const SphereCell& cell, const UnitVector& p) {
    CellMoment moment;
    for (std::size_t k = 0; k < cell.sides.size(); ++k) {
        if (cell.sides[k].cosine < OPPOSITE) {
            add_opposite_ridge(p.hi, cell, k, moment);
        } else {
            add_ridge(p.hi, cell, k, moment);
        }
    }
    return moment;
}

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

// Calls visit(cell, site) with cells that are taken, visit_empty(site) for sites without entries.
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
        SphereCell cell(points, cells, units.data());
        for_range(first, last, stop, [&](std::size_t k) {
            fetch_ahead(cells, units, k);
            const auto site = static_cast<std::size_t>(cells.order[k]);
            double area = HUGE_VAL;
            if (!cell.take(site) || !cell.is_good(area = cell.area())) {
                cell.take_carefully(site);
                area = cell.careful_area();
            }
            visit(cell, units[site], site, area);
        });
    });
}

}  // namespace

void cell_areas_sphere(const double* points, const Cells& cells, double* areas, int workers, Stop stop) {
    for_cells(
        points, cells, workers, stop,
        [areas](const SphereCell&, const UnitVector&, std::size_t site, double area) { areas[site] = area; },
        [areas](std::size_t site) { areas[site] = 0.0; });
}

void cell_centroids_sphere(const double* points, const Cells& cells, double* centroids, int workers, Stop stop) {
    for_cells(
        points, cells, workers, stop,
        [centroids](const SphereCell& cell, const UnitVector& p, std::size_t site, double) {
            moment_of(cell, p).direction(p, centroids + 3 * site);
        },
        [centroids](std::size_t site) {
            std::fill_n(centroids + 3 * site, 3, std::numeric_limits<double>::quiet_NaN());
        });
}

}  // namespace stereodel
