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

// A neighbour q of a site p: |q - p|, the cosine of half the angle between them, the legs to the two vertices.
template <class Number>
struct Side {
    Number length{}, cosine{};
    Leg<Number> left, right;
    double edge[3] = {};        // q - p
    double towards[3] = {};     // its part across p, of any length; of careful sides
    double normals[2][3] = {};  // the vertices on the left and the right; of careful sides
};

inline double rounded(DoubleDouble x) { return x.hi + x.lo; }

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
        begin_ = cells_.begin(site);
        sides.resize(cells_.end(site) - begin_);
        bound_ = 0.0;
        is_careful_ = false;
        const UnitVector& p = units_[site];
        for (std::size_t k = 0; k < sides.size(); ++k) {
            Side<double>& side = sides[k];
            const rays::Difference edge(p, unit(k));
            std::copy(edge.v, edge.v + 3, side.edge);
            const double square = rays::dot_form(edge.v, edge.v);
            if (!(square > 0x1p-90 && square < 2.0)) {
                return false;
            }
            side.length = std::sqrt(square);
            side.cosine = std::sqrt(1.0 - 0.25 * square);
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
            const double half = 0.5 * side.length / (1 + side.cosine);
            sum += 2 * (arc_tangent(half * half_tangent(side.left)) + arc_tangent(half * half_tangent(side.right)));
        }
        return sum;
    }

    bool is_good(double area) const { return bound_ <= CELL_ERROR * area; }

    // In double-double, with differences of relative accuracy, and rounded to the sides in doubles.
    void take_carefully(std::size_t site) {
        const Ray p(at(static_cast<Index>(site)));
        is_careful_ = true;
        careful_.assign(sides.size(), {});
        std::vector<Ray> rays;
        std::vector<RayEdge> edges;
        for (std::size_t k = 0; k < sides.size(); ++k) {
            rays.emplace_back(at(other(k)));
            edges.emplace_back(p, rays[k]);
            Side<DoubleDouble>& side = careful_[k];
            take_edge_carefully(p, edges[k], side);
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
            const HalfArea a = half_area(side.length, side.cosine, side.left);
            const HalfArea b = half_area(side.length, side.cosine, side.right);
            const double m = rounded(a.m * b.m - a.n * b.n), n = rounded(a.n * b.m + a.m * b.n);
            sum += 2 * (is_turned(sides[k].left, sides[k].right) ? std::atan2(-n, -m) : std::atan2(n, m));
        }
        return sum;
    }

    bool is_careful() const { return is_careful_; }

    // After `take_carefully`: the vertices on the left and the right of a ridge, and more of it.
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
        const rays::Difference across(unit(last), unit(k));
        const double volume = 2 * rays::determinant_form(p.hi, r.edge, q.edge);
        r.left = {r.length * rays::dot_form(q.edge, across.v), volume};
        q.right = {-q.length * rays::dot_form(r.edge, across.v), volume};
        const double shape = q.length * r.length / volume;
        bound_ += 32 * UNIT_ROUNDOFF * (q.length + r.length) * std::sqrt(rays::dot_form(across.v, across.v)) * shape *
                  (1 + shape);
        return volume > 0.0;
    }

    // tan(l/2).
    static double half_tangent(const Leg<double>& leg) {
        return leg.across / (leg.along + std::sqrt(leg.along * leg.along + leg.across * leg.across));
    }

    static DoubleDouble shifted(DoubleDouble x, int exponent) {
        return {std::ldexp(x.hi, exponent), std::ldexp(x.lo, exponent)};
    }

    static void take_edge_carefully(const Ray& p, const RayEdge& edge, Side<DoubleDouble>& side) {
        const DoubleDouble square = rays::dot_form(edge.v, edge.v), quarter = shifted(square, 2 * edge.exponent - 2);
        const DoubleDouble rest = DoubleDouble{1.0, 0.0} - quarter;
        side.length = shifted(sqrt(square), edge.exponent);
        side.cosine = rest.hi > 0.0 ? sqrt(rest) : DoubleDouble{};
        const DoubleDouble outward = shifted(square, edge.exponent - 1) / p.length;
        for (int i = 0; i < 3; ++i) {
            side.edge[i] = rounded(shifted(edge.v[i], edge.exponent));
            side.towards[i] = rounded(edge.v[i] + p.v[i] * outward);
        }
    }

    // With edges r and q brought to length 1 by 2^-i and 2^-j, and that across, f, by 2^-k, the legs
    // (|q| r.f, 2 det[p r q]) and so on are both 2^(i + j) times what has the numbers of length 1 and 2^k in front of
    // the first.
    void take_vertex_carefully(const Ray& p, const RayEdge& to_r, const RayEdge& to_q, const RayEdge& across,
                               std::size_t last, std::size_t k) {
        Side<DoubleDouble>&q = careful_[k], &r = careful_[last];
        DoubleDouble normal[3];
        cross(to_r.v, to_q.v, normal);
        const DoubleDouble volume = rays::dot_form(p.v, normal) / p.length * DoubleDouble{2.0, 0.0};
        const DoubleDouble length_q = sqrt(rays::dot_form(to_q.v, to_q.v));
        const DoubleDouble length_r = sqrt(rays::dot_form(to_r.v, to_r.v));
        r.left = leg(length_r * rays::dot_form(to_q.v, across.v), across.exponent, volume);
        q.right = leg(-(length_q * rays::dot_form(to_r.v, across.v)), across.exponent, volume);
        RayEdge::normalize(normal);
        double direction[3];
        round_all(normal, direction);
        const double length = std::sqrt(rays::dot_form(direction, direction));
        for (int i = 0; i < 3; ++i) {
            q.normals[1][i] = r.normals[0][i] = direction[i] / length;
        }
    }

    // Brought to a size at which squares keep their digits.
    static Leg<DoubleDouble> leg(DoubleDouble across, int exponent, DoubleDouble along) {
        int i = 0, j = 0;
        std::frexp(across.hi, &i);
        std::frexp(along.hi, &j);
        const int largest = across.hi == 0.0 ? j : along.hi == 0.0 ? i + exponent : std::max(i + exponent, j);
        return {shifted(across, exponent - largest), shifted(along, -largest)};
    }

    static Side<double> rounded_side(const Side<DoubleDouble>& side) {
        Side<double> result;
        result.length = rounded(side.length);
        result.cosine = rounded(side.cosine);
        result.left = {rounded(side.left.across), rounded(side.left.along)};
        result.right = {rounded(side.right.across), rounded(side.right.along)};
        std::copy(side.edge, side.edge + 3, result.edge);
        return result;
    }

    const double* points_;
    const Cells& cells_;
    const UnitVector* units_;
    std::size_t begin_ = 0;
    double bound_ = 0.0;
    bool is_careful_ = false;
    std::vector<Side<DoubleDouble>> careful_;
};

}  // namespace stereodel
