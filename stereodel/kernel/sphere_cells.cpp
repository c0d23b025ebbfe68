#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cell_integrals.hpp"
#include "error_counts.hpp"
#include "memory.hpp"
#include "right_triangles.hpp"
#include "unit_vectors.hpp"

namespace stereodel {
namespace {

// Neighbours that are nearer to the antipode of the site than this (twice the cosine of half the angle) have no middle
// with it that double-double would know.
constexpr double OPPOSITE = 0x1p-49;

// A neighbour q of a site p: |q - p|^2, the cosine of half the angle between them, the legs to the two vertices.
template <class Number>
struct Side {
    Number square{}, cosine{};
    Leg<Number> left, right;
    double edge[3] = {};        // q - p
    double towards[3] = {};     // the part of it across p; of careful sides
    double normals[2][3] = {};  // the vertices on the left and the right; of careful sides
};

double rounded(DoubleDouble x) { return x.hi + x.lo; }

void round_all(const DoubleDouble* from, double* to) {
    for (int k = 0; k < 3; ++k) {
        to[k] = rounded(from[k]);
    }
}

// The length of the ridge between nearly antipodal sites.
double opposite_length(const Side<DoubleDouble>& side) {
    const double *from = side.normals[1], *to = side.normals[0];
    double inside[3];
    for (int k = 0; k < 3; ++k) {
        inside[k] = -0.5 * side.edge[k];
    }
    const double length = std::atan2(rays::determinant_form(inside, from, to), rays::dot_form(from, to));
    return length < -PI / 2 ? length + 2 * PI : std::max(length, 0.0);
}

// All neighbours of a site, in one of two precisions.
class SphereCell {
  public:
    SphereCell(const double* points, const Cells& cells, const UnitVector* units)
        : points_(points), cells_(cells), units_(units) {}

    // In doubles. Returns whether that may do: no neighbour is so near that the errors of unit vectors count, or
    // farther than 90 degrees, and no vertex is farther than that from its triangle.
    bool take(std::size_t site) {
        begin_ = cells_.begin(site);
        sides.resize(cells_.end(site) - begin_);
        bound_ = 0.0;
        const UnitVector& p = units_[site];
        for (std::size_t k = 0; k < sides.size(); ++k) {
            Side<double>& side = sides[k];
            const RoundedEdge edge(p, unit(k));
            std::copy(edge.v, edge.v + 3, side.edge);
            side.square = rays::dot_form(edge.v, edge.v);
            if (!(side.square > 0x1p-90 && side.square < 2.0)) {
                return false;
            }
            side.cosine = std::sqrt(1.0 - 0.25 * side.square);
        }
        bool in_front = true;
        std::size_t last = sides.size() - 1;
        for (std::size_t k = 0; k < sides.size(); last = k++) {
            in_front &= take_vertex(p, last, k);
        }
        return in_front;
    }

    double area() const {
        double sum = 0.0;
        for (const Side<double>& side : sides) {
            const double half = 0.5 * side.square / (1 + side.cosine);
            sum += 2 * (arc_tangent(half * tangent(side, side.left)) + arc_tangent(half * tangent(side, side.right)));
        }
        return sum;
    }

    bool is_good(double area) const { return bound_ <= CELL_ERROR * area; }

    // In double-double, with differences of relative accuracy, and rounded to the sides in doubles.
    void take_carefully(std::size_t site) {
        const Ray p(at(static_cast<Index>(site)));
        careful_.assign(sides.size(), {});
        std::vector<Ray> rays;
        std::vector<RayEdge> edges;
        for (std::size_t k = 0; k < sides.size(); ++k) {
            rays.emplace_back(at(other(k)));
            edges.emplace_back(p, rays[k]);
            Side<DoubleDouble>& side = careful_[k];
            side.square = dot(edges[k].v, edges[k].v);
            const DoubleDouble rest = DoubleDouble{1.0, 0.0} - side.square * DoubleDouble{0.25, 0.0};
            side.cosine = rest.hi > 0.0 ? sqrt(rest) : DoubleDouble{};
            round_all(edges[k].v, side.edge);
            DoubleDouble towards[3];
            for (int i = 0; i < 3; ++i) {
                towards[i] = edges[k].v[i] + p.v[i] / p.length * side.square * DoubleDouble{0.5, 0.0};
            }
            round_all(towards, side.towards);
        }
        std::size_t last = sides.size() - 1;
        for (std::size_t k = 0; k < sides.size(); last = k++) {
            take_vertex_carefully(p, edges[last], edges[k], RayEdge(rays[last], rays[k]), last, k);
        }
        for (std::size_t k = 0; k < sides.size(); ++k) {
            sides[k] = rounded_side(careful_[k]);
        }
    }

    // The sum of the triangles of the site and each ridge, which are all positive.
    double careful_area() const {
        double sum = 0.0;
        for (std::size_t k = 0; k < sides.size(); ++k) {
            const Side<DoubleDouble>& side = careful_[k];
            if (side.cosine.hi < OPPOSITE) {
                sum += opposite_length(side);
                continue;
            }
            const HalfArea a = half_area(side.square, side.cosine, side.left);
            const HalfArea b = half_area(side.square, side.cosine, side.right);
            const double m = rounded(a.m * b.m - a.n * b.n), n = rounded(a.n * b.m + a.m * b.n);
            sum += 2 * (is_turned(std::sqrt(sides[k].square), sides[k].left, sides[k].right) ? std::atan2(-n, -m)
                                                                                           : std::atan2(n, m));
        }
        return sum;
    }

    // The vertices on the left and the right of a ridge, after `take_carefully`.
    const double* left_vertex(std::size_t k) const { return careful_[k].normals[0]; }
    const double* right_vertex(std::size_t k) const { return careful_[k].normals[1]; }
    const double* towards(std::size_t k) const { return careful_[k].towards; }
    double ridge_length(std::size_t k) const { return opposite_length(careful_[k]); }

    std::vector<Side<double>> sides;

  private:
    Index other(std::size_t k) const { return cells_.neighbors[begin_ + k]; }
    const UnitVector& unit(std::size_t k) const { return units_[static_cast<std::size_t>(other(k))]; }
    const double* at(Index a) const { return points_ + 3 * static_cast<std::ptrdiff_t>(a); }

    // The vertex between two neighbours, and the errors of its legs.
    //
    // Differences are off by 2.5u of their length, p by u. A dot E.F, with three roundings, is off by 9u|E||F|, the
    // volume X = 2 det[p E D] by less than 32u|E||D|; with |Y| <= |D||E||F| the leg l by
    //     9u |D||E||F|/X + |Y| 32u|E||D|/X^2 <= 32u |D||E||F|/X (1 + |E||D|/X).
    // For l up to 90 degrees the area changes by less than 0.6 |D| times that (|D|^2 < 2); its own roundings, some 10u
    // of at most |D|/2 l, are covered by the rest.
    bool take_vertex(const UnitVector& p, std::size_t last, std::size_t k) {
        Side<double>&q = sides[k], &r = sides[last];
        const RoundedEdge across(unit(last), unit(k));
        q.right.volume = r.left.volume = 2 * rays::determinant_form(p.hi, r.edge, q.edge);
        r.left.dot = rays::dot_form(q.edge, across.v);
        q.right.dot = -rays::dot_form(r.edge, across.v);
        const double to_q = std::sqrt(q.square), to_r = std::sqrt(r.square), shape = to_q * to_r / q.right.volume;
        bound_ += 32 * UNIT_ROUNDOFF * (to_q + to_r) * std::sqrt(rays::dot_form(across.v, across.v)) * shape *
                  (1 + shape);
        return q.right.volume > 0.0;
    }

    // tan(l/2)/|D|.
    static double tangent(const Side<double>& side, const Leg<double>& leg) {
        return leg.dot / (leg.volume + std::sqrt(leg.volume * leg.volume + side.square * leg.dot * leg.dot));
    }

    void take_vertex_carefully(const Ray& p, const RayEdge& to_r, const RayEdge& to_q, const RayEdge& across,
                               std::size_t last, std::size_t k) {
        Side<DoubleDouble>&q = careful_[k], &r = careful_[last];
        DoubleDouble normal[3];
        cross(to_r.v, to_q.v, normal);
        DoubleDouble volume = dot(p.v, normal) / p.length * DoubleDouble{2.0, 0.0};
        DoubleDouble left = dot(to_q.v, across.v), right = -dot(to_r.v, across.v);
        // Brought to a size at which squares keep their digits.
        int exponent = 0;
        std::frexp(std::max({std::fabs(volume.hi), std::fabs(left.hi), std::fabs(right.hi)}), &exponent);
        const double scale = std::ldexp(1.0, std::min(-exponent, 1000));
        for (DoubleDouble* x : {&volume, &left, &right}) {
            *x = {x->hi * scale, x->lo * scale};
        }
        q.right = {right, volume};
        r.left = {left, volume};
        double direction[3];
        round_all(normal, direction);
        const double largest =
            std::max({std::fabs(direction[0]), std::fabs(direction[1]), std::fabs(direction[2]), 0x1p-1000});
        for (double& x : direction) {
            x /= largest;
        }
        const double length = std::sqrt(rays::dot_form(direction, direction));
        for (int i = 0; i < 3; ++i) {
            q.normals[1][i] = r.normals[0][i] = direction[i] / length;
        }
    }

    static Side<double> rounded_side(const Side<DoubleDouble>& side) {
        Side<double> result;
        result.square = rounded(side.square);
        result.cosine = rounded(side.cosine);
        result.left = {rounded(side.left.dot), rounded(side.left.volume)};
        result.right = {rounded(side.right.dot), rounded(side.right.volume)};
        std::copy(side.edge, side.edge + 3, result.edge);
        return result;
    }

    const double* points_;
    const Cells& cells_;
    const UnitVector* units_;
    std::size_t begin_ = 0;
    double bound_ = 0.0;
    std::vector<Side<DoubleDouble>> careful_;
};

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
    const TriangleMoment left = stereodel::moment(side.square, side.cosine, side.left);
    const TriangleMoment right = stereodel::moment(side.square, side.cosine, side.right);
    const double length = std::sqrt(side.square);
    const double turned = is_turned(length, side.left, side.right) ? PI : 0.0;
    moment.radial += left.radial + right.radial + turned * length / 2;
    // The part of q - p across p. Beyond a right angle the sum cancels; there all cells are careful.
    double towards[3];
    for (int k = 0; k < 3; ++k) {
        towards[k] = side.square < 2.0 ? side.edge[k] + 0.5 * side.square * p[k] : cell.towards(place)[k];
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
