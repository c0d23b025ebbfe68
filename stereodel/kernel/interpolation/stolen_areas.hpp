// Areas that a query's Voronoi cell would take, in coordinates around the query: the plane's, or those of the tangent
// plane of the sphere.
//
// A point p of the sphere is d = p - q with its components along two axes of the tangent plane and -|d|^2/2 along q.
// So everything is made from differences: a cluster of any size has as many digits as the whole sphere. The centre of
// a circle is the direction of N = (b-a) x (c-a), whose part along q is the triangle's area as seen along q and whose
// other part, q x (N x q), comes from N x q = (c-a) (q.(b-a)) - (b-a) (q.(c-a)) with 2 q.(b-a) = |a-q|^2 - |b-q|^2 =
// -(b-a).(a-q + b-q). In the plane the same formula gives the centre times twice the area.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "arithmetic/arc_tangent.hpp"
#include "order/charts.hpp"
#include "tally.hpp"

namespace stereodel::interpolation {

using arithmetic::vector_angle;
using order::PlaneChart;
using order::SphereChart;

struct Local {
    double x, y, z;
};

inline Local operator-(const Local& a, const Local& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Local operator+(const Local& a, const Local& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline double inner(const Local& a, const Local& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double outer(const Local& a, const Local& b) { return a.x * b.y - a.y * b.x; }

// The circle's centre, z being what the rest is to be divided by.
inline Local homogeneous_center(const Local& a, const Local& b, const Local& c) {
    const Local d = b - a, e = c - a;
    const double along_d = inner(d, a + b) / 2, along_e = inner(e, a + c) / 2;
    return {along_d * e.y - along_e * d.y, along_e * d.x - along_d * e.x, outer(d, e)};
}

// The plane around a query, scaled by a power of two.
class PlaneAround {
  public:
    using Chart = PlaneChart;

    PlaneAround(const double* points, const double*) : points_(points) {}

    void take(const double* query, const double*) {
        query_ = query;
        scale_ = 1.0;
    }

    // Make that point lie at a distance of about one.
    void fit(Index a) {
        const Local d = at(a);
        const double size = std::max(std::fabs(d.x), std::fabs(d.y));
        scale_ = size > 0.0 ? std::ldexp(scale_, -std::ilogb(size)) : 1.0;
    }

    Local at(Index a) const {
        const double* p = points_ + 2 * static_cast<std::size_t>(a);
        return {(p[0] - query_[0]) * scale_, (p[1] - query_[1]) * scale_, 0.0};
    }

    static Local center(const Local& a, const Local& b, const Local& c) {
        const Local h = homogeneous_center(a, b, c);
        return {h.x / h.z, h.y / h.z, 1.0};
    }

    // Signed area of the triangle of query, a and b.
    static double sector(const Local& a, const Local& b) { return outer(a, b) / 2; }

    // Integral of the points of an edge along its length.
    static Local moment(const Local& a, const Local& b) {
        const double half = std::sqrt(inner(b - a, b - a)) / 2;
        return {(a.x + b.x) * half, (a.y + b.y) * half, 0.0};
    }

    void put_gradient(const Local& g, double* out, std::size_t stride) const {
        out[0] = g.x * scale_;
        out[stride] = g.y * scale_;
    }

  private:
    const double* points_;
    const double* query_ = nullptr;
    double scale_ = 1.0;
};

// The sphere around a query. Vectors are of length one in double-double: what is missing of each stands in `rests`.
class SphereAround {
  public:
    using Chart = SphereChart;

    SphereAround(const double* units, const double* rests) : units_(units), rests_(rests) {}

    void take(const double* unit, const double* rest) {
        unit_ = unit;
        rest_ = rest;
        // The axis that the query is farthest from, less its part along the query.
        const std::size_t k = std::fabs(unit[0]) < std::fabs(unit[1])
                                  ? (std::fabs(unit[0]) < std::fabs(unit[2]) ? 0 : 2)
                                  : (std::fabs(unit[1]) < std::fabs(unit[2]) ? 1 : 2);
        for (std::size_t j = 0; j < 3; ++j) {
            first_[j] = (j == k ? 1.0 : 0.0) - unit[k] * unit[j];
        }
        const double length = std::sqrt(first_[0] * first_[0] + first_[1] * first_[1] + first_[2] * first_[2]);
        for (double& component : first_) {
            component /= length;
        }
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t u = (j + 1) % 3, v = (j + 2) % 3;
            second_[j] = unit[u] * first_[v] - unit[v] * first_[u];
        }
    }

    void fit(Index) {}

    Local at(Index a) const {
        const double *p = units_ + 3 * static_cast<std::size_t>(a), *r = rests_ + 3 * static_cast<std::size_t>(a);
        double d[3];
        for (std::size_t j = 0; j < 3; ++j) {
            d[j] = (p[j] - unit_[j]) + (r[j] - rest_[j]);
        }
        return {d[0] * first_[0] + d[1] * first_[1] + d[2] * first_[2],
                d[0] * second_[0] + d[1] * second_[1] + d[2] * second_[2],
                -(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) / 2};
    }

    static Local center(const Local& a, const Local& b, const Local& c) {
        const Local h = homogeneous_center(a, b, c);
        const double length = std::sqrt(inner(h, h));
        return {h.x / length, h.y / length, h.z / length};
    }

    // Of unit vectors; with the query as third axis, by the formula of Van Oosterom and Strackee. All corners lie in
    // the query's cell, which is convex and does not hold its antipode: so sectors add up to areas, without 4 pi more
    // or less.
    static double sector(const Local& a, const Local& b) {
        return 2 * vector_angle(outer(a, b), 1 + a.z + b.z + inner(a, b));
    }

    // Over an arc of length s the unit vectors add up to 2 sin(s/2), the chord, times the arc's middle.
    static Local moment(const Local& a, const Local& b) {
        const Local sum = a + b, chord = b - a;
        const double factor = std::sqrt(inner(chord, chord) / inner(sum, sum));
        return {sum.x * factor, sum.y * factor, 0.0};
    }

    void put_gradient(const Local& g, double* out, std::size_t stride) const {
        for (std::size_t j = 0; j < 3; ++j) {
            out[j * stride] = g.x * first_[j] + g.y * second_[j];
        }
    }

  private:
    const double *units_, *rests_;
    const double *unit_ = nullptr, *rest_ = nullptr;
    double first_[3] = {}, second_[3] = {};
};

}  // namespace stereodel::interpolation
