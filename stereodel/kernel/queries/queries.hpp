// The folder `queries`: which triangle holds a point, and which points are nearest to it.
// Reading order: queries, query_pieces (many queries, on threads), location; nearest_finder, nearest, equal_points,
// k_nearest; nearest_flat, where there are no triangles.
//
// Triangulations as plain arrays, and a query's side of their edges: what location and nearest points share.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "mesh/corners.hpp"
#include "order/charts.hpp"
#include "predicates/plane_predicates.hpp"
#include "predicates/ray_predicates.hpp"
#include "predicates/symmetry.hpp"
#include "threads.hpp"

namespace stereodel::queries {

namespace plane = predicates::plane;
namespace rays = predicates::rays;
using mesh::place_of;
using order::PlaneChart;
using order::SphereChart;
using predicates::equal_by_symmetry_in_plane;
using predicates::equal_by_symmetry_on_sphere;
using predicates::PlanePoints;
using predicates::bubble;
using predicates::compare_angles;
using predicates::turn;

// A point and a triangle that has it.
struct Near {
    Index point, triangle;
};

// Neighbours opposite each corner, -1 for none. `closing`: triangles that no query lies in; null if there is none.
class TriangleArrays {
  public:
    TriangleArrays(const double* points, const Index* corners, const Index* neighbors, const bool* closing,
                   std::size_t count)
        : points_(points), corners_(corners), neighbors_(neighbors), closing_(closing), count_(count) {}

    const double* points() const { return points_; }
    std::size_t count() const { return count_; }
    const Index* corners(Index t) const { return corners_ + 3 * static_cast<std::size_t>(t); }
    const Index* neighbors(Index t) const { return neighbors_ + 3 * static_cast<std::size_t>(t); }
    bool may_enter(Index t) const { return t >= 0 && (closing_ == nullptr || !closing_[t]); }

    std::size_t place(Index t, Index vertex) const { return place_of(corners(t), vertex); }

    // Calls visit(t) for all triangles at a vertex, of which `start` is one.
    template <class Visit>
    void around(Index vertex, Index start, Visit&& visit) const {
        Index t = start;
        do {
            visit(t);
            t = counterclockwise(t, vertex);
        } while (t >= 0 && t != start);
        if (t < 0) {
            for (t = clockwise(start, vertex); t >= 0; t = clockwise(t, vertex)) {
                visit(t);
            }
        }
    }

    // Calls visit(near) for all points that an edge joins to one.
    template <class Visit>
    void neighbors_around(Near here, Visit&& visit) const {
        around(here.point, here.triangle, [&](Index t) {
            const std::size_t at = place(t, here.point);
            visit(Near{corners(t)[(at + 1) % 3], t});
            if (neighbors(t)[(at + 1) % 3] < 0) {
                visit(Near{corners(t)[(at + 2) % 3], t});  // the last one of an open fan
            }
        });
    }

  private:
    Index counterclockwise(Index t, Index vertex) const { return neighbors(t)[(place(t, vertex) + 1) % 3]; }
    Index clockwise(Index t, Index vertex) const { return neighbors(t)[(place(t, vertex) + 2) % 3]; }

    const double* points_;
    const Index* corners_;
    const Index* neighbors_;
    const bool* closing_;
    std::size_t count_;
};

// How much nearer than v a neighbour u is: (|q-v|^2 - |q-u|^2) / |u-v|^2, and the bound of its error, which may be
// infinite or NaN. Inversion at v takes the neighbours of v to the corners of a convex polygon and this to a linear
// function: where it is larger than on both sides it is largest. The ghost, at infinity, has -1.
struct Gain {
    double value, error;

    bool certainly_exceeds(Gain other) const { return value - other.value > error + other.error; }
};

constexpr Gain GHOST_GAIN{-1.0, 0.0};

// One query in the plane at a time.
class PlaneQuery {
  public:
    using Chart = PlaneChart;

    explicit PlaneQuery(const double* points) : points_(points, 0.0) {}

    void take(const double* query) { query_ = query; }
    int side(Index u, Index v) { return points_.orient(u, v, query_); }

    // Sign of the distance between the query and a less that between the query and b.
    int compare(Index a, Index b) {
        const Sign sign = compare_squares(square(a), square(b));
        if (sign != OPEN) {
            return sign;
        }
        const bool equal = equal_by_symmetry_in_plane(query_, points_.at(a), query_, points_.at(b));
        return equal ? 0 : points_.compare_distances(query_, a, b);
    }

    // Whether the query lies inside the circle of three corners; points have no common granularity here.
    bool sees(const Index* c) { return points_.incircle(c[0], c[1], c[2], query_) > 0; }

    // Grows with the distance from a point, but for roundings.
    double rough_distance(Index a) const { return square(a); }

    // The squared distance from a point, rounded; which of two is smaller, if that is certain.
    double square(Index a) const { return PlaneChart::rough_distance(query_, points_.at(a)); }
    static Sign compare_squares(double to_a, double to_b) { return plane::compare_squares(to_a, to_b); }

    // A squared distance is off by 4u of it (each difference counts twice, a square, a sum), so the gain by less than
    // 16u of the sum of the two above, over that below. That sum is at least half of that below, so underflow is
    // nothing.
    Gain gain(Index u, Index v) const {
        const double *a = points_.at(u), *b = points_.at(v);
        const double to_a = PlaneChart::rough_distance(query_, a), to_b = PlaneChart::rough_distance(query_, b);
        const double between = PlaneChart::rough_distance(a, b);
        return {(to_b - to_a) / between, between > 0x1p-900 ? 0x1p-49 * (to_a + to_b) / between : HUGE_VAL};
    }

  private:
    PlanePoints points_;
    const double* query_ = nullptr;
};

// One queried direction at a time.
class SphereQuery {
  public:
    using Chart = SphereChart;

    explicit SphereQuery(const double* points) : points_(points) {}

    void take(const double* query) {
        is_unit_ = rays::is_unit(query);
        if (is_unit_) {
            std::copy_n(query, 3, unit_);
        } else {
            Chart::prepare(query, unit_);
        }
        query_ = query;
        if (!is_ordinary(query) && rescale(query)) {
            query_ = scaled_;
        }
        ordinary_ = is_ordinary(query_);
    }

    int side(Index u, Index v) {
        const double *a = at(u), *b = at(v);
        return turn(a, b, query_, ordinary_ && is_ordinary(a) && is_ordinary(b), tally_);
    }

    // Whether the query lies inside the bubble of three corners.
    bool sees(const Index* c) {
        const double *p = at(c[0]), *q = at(c[1]), *r = at(c[2]);
        const bool unit = is_unit_ && rays::is_unit(p) && rays::is_unit(q) && rays::is_unit(r);
        return bubble(p, q, r, query_, unit, tally_) > 0;
    }

    // Sign of the angle between the query and a less that between the query and b.
    int compare(Index a, Index b) {
        const Sign sign = compare_squares(square(a), square(b));
        if (sign != OPEN) {
            return sign;
        }
        const bool equal = equal_by_symmetry_on_sphere(query_, at(a), query_, at(b));
        return equal ? 0 : compare_angles(query_, at(a), at(b), tally_);
    }

    // Grows with the angle to a direction, but for roundings.
    double rough_distance(Index a) const {
        const double* const p = at(a);
        return -rays::dot_form(unit_, p) / std::sqrt(rays::dot_form(p, p));
    }

    // The squared chord to a point, rounded; not a number if its vector is not of length one.
    double square(Index a) const {
        return rays::is_unit(at(a)) ? Chart::rough_distance(unit_, at(a)) : std::numeric_limits<double>::quiet_NaN();
    }

    // Which of two squared chords A, B belongs to the smaller angle, if that is certain. For a unit query (lengths
    // within 2^-49 of 1) the angles compare as A - B does if that exceeds 2^-47 (A + B) + 2^-94, see
    // `rays::compare_angles_filter`. Otherwise its direction is off by d < 2^-51 (two divisions of each component
    // round), which moves A - B by at most 2d|a - b| <= 2d sqrt(2(A + B)) < 2^-49 sqrt(A + B).
    Sign compare_squares(double to_a, double to_b) const {
        const double sum = to_a + to_b;
        return decide(to_a - to_b, 0x1p-47 * sum + 0x1p-94 + (is_unit_ ? 0.0 : 0x1p-49 * std::sqrt(sum)));
    }

    // Squared chords of vectors within 2^-49 of length one, off by 2^-47 of them and 2^-95 (see `compare_squares`, also
    // for what is added if the query is not of length one); the quotient by the errors above over that below, and by
    // that below relatively. Of directions closer than 2^-40 it is not known.
    Gain gain(Index u, Index v) const {
        const double *a = at(u), *b = at(v);
        const double to_a = Chart::rough_distance(unit_, a), to_b = Chart::rough_distance(unit_, b);
        const double between = Chart::rough_distance(a, b), sum = to_a + to_b;
        const double above = 0x1p-46 * sum + 0x1p-94 + (is_unit_ ? 0.0 : 0x1p-49 * std::sqrt(sum));
        const bool known = between > 0x1p-80 && rays::is_unit(a) && rays::is_unit(b);
        return {(to_b - to_a) / between, known ? (above + 0x1p-93 * sum / between) / between : HUGE_VAL};
    }

  private:
    const double* at(Index a) const { return points_ + 3 * static_cast<std::size_t>(a); }

    // The filter of `turn` asks for lengths between 1/2 and 2.
    static bool is_ordinary(const double* p) {
        const double square = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
        return square > 0.3 && square < 3.9;
    }

    // Times a power of two; false if that changes a digit.
    bool rescale(const double* query) {
        const int exponent = std::ilogb(std::max({std::fabs(query[0]), std::fabs(query[1]), std::fabs(query[2])}));
        bool same = true;
        for (int k = 0; k < 3; ++k) {
            scaled_[k] = std::scalbn(query[k], -exponent);
            same &= std::scalbn(scaled_[k], exponent) == query[k];
        }
        return same;
    }

    const double* points_;
    const double* query_ = nullptr;
    double scaled_[3] = {}, unit_[3] = {};
    bool ordinary_ = false, is_unit_ = false;
    Tally tally_;
};

// Of points with so many coordinates.
template <std::size_t Width>
using QueryOf = std::conditional_t<Width == 2, PlaneQuery, SphereQuery>;

}  // namespace stereodel::queries
