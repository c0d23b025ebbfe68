// The cell of one site of the sphere: its neighbours as sides, from differences, in doubles or double-double.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "arithmetic/bounded.hpp"
#include "arithmetic/error_counts.hpp"
#include "voronoi/cell_integrals.hpp"
#include "voronoi/cell_ridges.hpp"
#include "voronoi/right_triangles.hpp"
#include "voronoi/unit_vectors.hpp"

namespace stereodel::voronoi {

using arithmetic::Bounded;
using arithmetic::arc_tangent;

// A neighbour q of a site p: |q - p|, the cosine of half the angle between them, the legs to the two vertices.
struct Side {
    double length = 0.0, cosine = 0.0;
    Leg<double> left, right;
    double edge[3] = {};  // q - p
};

// All neighbours of a site, in one of two precisions.
class SphereCell {
  public:
    SphereCell(const double* points, const Cells& cells, const UnitVector* units)
        : points_(points), cells_(cells), units_(units) {}

    // In doubles. Returns whether that may do: no neighbour is so near that the errors of unit vectors count, or
    // farther than 90 degrees, and no vertex is farther than that from its triangle.
    bool take(std::size_t site) {
        set_site(site);
        sides.resize(size_);
        bound_ = 0.0;
        const UnitVector& p = units_[site];
        for (std::size_t k = 0; k < sides.size(); ++k) {
            Side& side = sides[k];
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

    // After `take`, once: the bound grows by what the additions are off by. No partial sum is longer than `total`.
    double area() {
        double sum = 0.0, total = 0.0;
        for (const Side& side : sides) {
            const double half = 0.5 * side.length / (1 + side.cosine);
            const double left = arc_tangent(half * half_tangent(side.left));
            const double right = arc_tangent(half * half_tangent(side.right));
            sum += 2 * (left + right);
            total += 2 * (std::fabs(left) + std::fabs(right));
        }
        bound_ += static_cast<double>(sides.size()) * UNIT_ROUNDOFF * total;
        return sum;
    }

    bool is_good(double area) const { return bound_ <= CELL_ERROR * area; }

    // In double-double.
    MeasuredCell measure_carefully(std::size_t site, bool with_centroid) {
        set_site(site);
        const Ray p(at(static_cast<Index>(site)));
        ridges_.resize(size_);
        sums_.resize(size_);
        rays_.clear();
        for (std::size_t k = 0; k < size_; ++k) {
            rays_.emplace_back(at(other(k)));
            take_edge(p, rays_[k], ridges_[k], sums_[k]);
        }
        legs_.resize(2 * size_);
        std::size_t last = size_ - 1;
        for (std::size_t k = 0; k < size_; last = k++) {
            take_vertex_carefully(p, last, k);
        }
        for (std::size_t k = 0; k < size_; ++k) {
            const Leg<Bounded>&left = legs_[2 * k], &right = legs_[2 * k + 1];
            ridges_[k].set(left, right, left.across * right.along - left.along * right.across);
        }
        return RidgeSum<Bounded>(units_[site], ridges_).measure(with_centroid);
    }

    std::vector<Side> sides;

  private:
    // A `RayEdge` with the error that is derived there, and that of components of rays which underflow.
    struct Edge {
        Bounded v[3], square;
        int exponent = 0;
        bool is_used = true;

        Edge() = default;
        explicit Edge(const RayEdge& edge) : exponent(edge.exponent) {
            const double error = 0x1p-98 * edge.loss + std::ldexp(0x1p-1066, -edge.exponent);
            for (int k = 0; k < 3; ++k) {
                v[k] = Bounded(edge.v[k], error);
            }
            square = rays::dot_form(v, v);
        }
    };

    void set_site(std::size_t site) {
        begin_ = cells_.begin(site);
        size_ = cells_.end(site) - begin_;
    }
    Index other(std::size_t k) const { return cells_.neighbors[begin_ + k]; }
    const UnitVector& unit(std::size_t k) const { return units_[static_cast<std::size_t>(other(k))]; }
    const double* at(Index a) const { return points_ + 3 * static_cast<std::ptrdiff_t>(a); }

    // The vertex between two neighbours, and the errors of its legs.
    //
    // Differences are off by 2.5u of their length, p by u. A dot E.F, with three roundings, is off by 9u|E||F|, the
    // volume X = 2 det[p E D] by less than 32u|E||D|; with |Y| <= |D||E||F| the leg l by
    //     9u |D||E||F|/X + |Y| 32u|E||D|/X^2 <= 32u |D||E||F|/X (1 + |E||D|/X),
    // if the error of X is less than 2^-5 of it. For l up to 90 degrees the area changes by less than 0.6 |D| times
    // that (|D|^2 < 2); its own roundings, some 10u of at most |D|/2 l, are covered by the rest.
    bool take_vertex(const UnitVector& p, std::size_t last, std::size_t k) {
        Side &q = sides[k], &r = sides[last];
        const rays::Difference across(unit(last), unit(k));
        const double volume = 2 * rays::determinant_form(p.hi, r.edge, q.edge);
        r.left = {r.length * rays::dot_form(q.edge, across.v), volume};
        q.right = {-q.length * rays::dot_form(r.edge, across.v), volume};
        const double shape = q.length * r.length / volume;
        bound_ += 32 * UNIT_ROUNDOFF * (q.length + r.length) * std::sqrt(rays::dot_form(across.v, across.v)) * shape *
                  (1 + shape);
        return volume > 0.0 && shape < 0x1p-10 / UNIT_ROUNDOFF;
    }

    // tan(l/2).
    static double half_tangent(const Leg<double>& leg) {
        return leg.across / (leg.along + std::sqrt(leg.along * leg.along + leg.across * leg.across));
    }

    // sin h = |D|/2 and cos h = |S|/2 with S = q + p: the shorter one from its difference, which keeps its digits.
    static void take_edge(const Ray& p, const Ray& q, Ridge<Bounded>& ridge, Edge& sum) {
        const Edge edge(RayEdge(p, q));
        std::copy(edge.v, edge.v + 3, ridge.edge);
        ridge.exponent = edge.exponent;
        ridge.length = sqrt(edge.square);
        ridge.sine = ridge.length.times_power(edge.exponent - 1);
        const Bounded one = edge.square.like(1.0), rest = one - ridge.sine * ridge.sine;
        sum.is_used = !(rest.middle(0) > 0.5);
        if (!sum.is_used) {
            ridge.cosine = sqrt(rest);
            return;
        }
        Ray opposite(p);
        for (DoubleDouble& x : opposite.v) {
            x = -x;
        }
        sum = Edge(RayEdge(opposite, q));
        ridge.cosine = sqrt(sum.square).times_power(sum.exponent - 1);
        ridge.sine = sqrt(one - ridge.cosine * ridge.cosine);
    }

    // The legs of the ridges with two neighbours r and q at their common vertex. With edges brought to length 1 by 2^-i
    // and 2^-j, and that across, f, by 2^-k, the legs (|q| r.f, 2 det[p r q]) and so on are both 2^(i + j) times what
    // has the numbers of length 1 and 2^k in front of the first.
    void take_vertex_carefully(const Ray& p, std::size_t last, std::size_t k) {
        Ridge<Bounded>&to_r = ridges_[last], &to_q = ridges_[k];
        const Edge across(RayEdge(rays_[last], rays_[k]));
        Bounded site[3];
        take_direction(p, site);
        const Bounded volume = rays::determinant_form(site, to_r.edge, to_q.edge).times_power(1);
        legs_[2 * last] = sums_[last].is_used
                              ? opposite_leg(site, last, k, 1.0)
                              : leg(to_r.length * rays::dot_form(to_q.edge, across.v), across.exponent, volume);
        legs_[2 * k + 1] = sums_[k].is_used
                               ? opposite_leg(site, k, last, -1.0)
                               : leg(to_q.length * rays::dot_form(to_r.edge, across.v), across.exponent, volume);
    }

    // Lengths are off by the root's 5u^2 and half the 13u^2 of a sum of three squares.
    static void take_direction(const Ray& ray, Bounded* result) {
        for (int i = 0; i < 3; ++i) {
            result[i] = Bounded(ray.v[i]) / Bounded(ray.length, 0x1p-102);
        }
    }

    // Of the ridge with an opposite neighbour q, at the vertex with r on its left (sign 1) or its right (-1). Both legs
    // are as short as S, and made of it: with D = q - p, E = r - p, F = r - q
    //     E.F = |S|^2/2 - r.S,    det[p q r] = det[p S r].
    Leg<Bounded> opposite_leg(const Bounded* site, std::size_t k, std::size_t third, double sign) const {
        const Edge& sum = sums_[k];
        Bounded r[3];
        take_direction(rays_[third], r);
        const Bounded half = sum.square.times_power(sum.exponent - 1), factor = half.like(sign);
        const Bounded across = ridges_[k].sine.times_power(1) * (half - rays::dot_form(r, sum.v));
        return leg(factor * across, 0, factor * rays::determinant_form(site, sum.v, r).times_power(1));
    }

    // Of length 1.
    static Leg<Bounded> leg(const Bounded& across, int exponent, const Bounded& along) {
        const std::int64_t largest = std::max(across.exponent() + exponent, along.exponent());
        const Bounded y = across.times_power(exponent - largest), x = along.times_power(-largest);
        const Bounded length = length_of(x, y);
        return {y / length, x / length};
    }

    const double* points_;
    const Cells& cells_;
    const UnitVector* units_;
    std::size_t begin_ = 0, size_ = 0;
    double bound_ = 0.0;
    std::vector<Ray> rays_;
    std::vector<Edge> sums_;  // q + p of the neighbours that are farther than 90 degrees
    std::vector<Leg<Bounded>> legs_;  // left and right of each side
    std::vector<Ridge<Bounded>> ridges_;
};

}  // namespace stereodel::voronoi
