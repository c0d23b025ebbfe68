// The cell of one site of the sphere: its neighbours as sides, from differences, in doubles or double-double.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "cell_integrals.hpp"
#include "error_counts.hpp"
#include "right_triangles.hpp"
#include "unit_vectors.hpp"

namespace stereodel {

// Neighbours that are nearer to the antipode of the site than this (twice the cosine of half the angle) have no middle
// with it that double-double would know.
constexpr double OPPOSITE = 0x1p-49;

// Products of edges below this lose digits to underflow. Cells with such neighbours go by directions of edges where
// that is better: their angles do not depend on lengths.
constexpr double TINY_PRODUCT = 0x1p-820, TINY = 0x1p-400;
constexpr double WIDE = 1e-6;  // an area that angles, off by some 1e-15, tell well enough

// A neighbour q of a site p: |q - p|^2, the cosine of half the angle between them, the legs to the two vertices.
template <class Number>
struct Side {
    Number square{}, cosine{};
    Leg<Number> left, right;
    double edge[3] = {};        // q - p
    double towards[3] = {};     // the part of it across p; of careful sides
    double normals[2][3] = {};  // the vertices on the left and the right; of careful sides
};

inline double rounded(DoubleDouble x) { return x.hi + x.lo; }

template <class Vector>
double largest_component(const Vector& v) {
    return std::max({std::fabs(v[0].hi), std::fabs(v[1].hi), std::fabs(v[2].hi)});
}

// Multiplied by a power of two, so that the largest component is in [1/2, 1); a zero vector stays.
struct Scaled {
    DoubleDouble v[3];

    explicit Scaled(const DoubleDouble* vector) {
        int exponent = 0;
        std::frexp(largest_component(vector), &exponent);
        for (int k = 0; k < 3; ++k) {
            v[k] = {std::ldexp(vector[k].hi, -exponent), std::ldexp(vector[k].lo, -exponent)};
        }
    }
};

inline void round_all(const DoubleDouble* from, double* to) {
    for (int k = 0; k < 3; ++k) {
        to[k] = rounded(from[k]);
    }
}

// The length of the ridge between nearly antipodal sites.
inline double opposite_length(const Side<DoubleDouble>& side) {
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
        by_angles_ = false;
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
        }
        const bool tiny = lengthen(edges);
        for (std::size_t k = 0; k < sides.size(); ++k) {
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
        by_angles_ = tiny && go_by_angles(edges);
        if (by_angles_) {
            take_directions(edges);
            return;
        }
        std::size_t last = sides.size() - 1;
        for (std::size_t k = 0; k < sides.size(); last = k++) {
            RayEdge across(rays[last], rays[k]);
            for (int i = 0; tiny && i < 3; ++i) {
                across.v[i] = edges[k].v[i] - edges[last].v[i];
            }
            take_vertex_carefully(p, edges[last], edges[k], across, last, k);
        }
        for (std::size_t k = 0; k < sides.size(); ++k) {
            sides[k] = rounded_side(careful_[k]);
        }
    }

    // Whether the cell is known by the angles of its boundary alone, after `take_carefully`: then `angular_area` and
    // the arcs of the boundary are what there is.
    bool by_angles() const { return by_angles_; }
    double angular_area() const { return angular_area_; }

    // The sum of the triangles of the site and each ridge, which are all positive.
    double careful_area() const {
        if (by_angles_) {
            return angular_area_;
        }
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

    // Edges below TINY become longer by a common power of two, their longest one about TINY: beside any cell that doubles
    // can tell from nothing both are nothing. Whether there are any.
    static bool lengthen(std::vector<RayEdge>& edges) {
        double longest = 0.0;
        for (const RayEdge& edge : edges) {
            const double size = largest_component(edge.v);
            longest = size < TINY ? std::max(longest, size) : longest;
        }
        if (longest == 0.0) {
            return false;
        }
        const int exponent = std::ilogb(TINY) - std::ilogb(longest);
        for (RayEdge& edge : edges) {
            if (largest_component(edge.v) < TINY) {
                for (DoubleDouble& x : edge.v) {
                    x = {std::ldexp(x.hi, exponent), std::ldexp(x.lo, exponent)};
                }
            }
        }
        return true;
    }

    // 2 pi less the angles by which the boundary turns (Gauss and Bonnet): those between edges, which are normal to it.
    bool go_by_angles(const std::vector<RayEdge>& edges) {
        bool lost = false;
        double turned = 0.0;
        std::size_t last = edges.size() - 1;
        for (std::size_t k = 0; k < edges.size(); last = k++) {
            lost |= largest_component(edges[k].v) * largest_component(edges[last].v) < TINY_PRODUCT;
            const Scaled r(edges[last].v), q(edges[k].v);
            DoubleDouble normal[3];
            cross(r.v, q.v, normal);
            turned += std::atan2(sqrt(dot(normal, normal)).hi, dot(r.v, q.v).hi);
        }
        angular_area_ = std::max(2 * PI - turned, 0.0);
        return lost || angular_area_ > WIDE;
    }

    // Edges as if they were two units long, as between antipodes, and the vertices between them.
    void take_directions(const std::vector<RayEdge>& edges) {
        std::size_t last = edges.size() - 1;
        for (std::size_t k = 0; k < edges.size(); last = k++) {
            const Scaled r(edges[last].v), q(edges[k].v);
            DoubleDouble normal[3];
            cross(r.v, q.v, normal);
            const double length = sqrt(dot(normal, normal)).hi, size = sqrt(dot(q.v, q.v)).hi;
            for (int i = 0; i < 3; ++i) {
                careful_[k].edge[i] = sides[k].edge[i] = 2 * q.v[i].hi / size;
                const double component = length > 0.0 ? normal[i].hi / length : 0.0;
                careful_[k].normals[1][i] = careful_[last].normals[0][i] = component;
            }
        }
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
    double bound_ = 0.0, angular_area_ = 0.0;
    bool by_angles_ = false;
    std::vector<Side<DoubleDouble>> careful_;
};

}  // namespace stereodel
