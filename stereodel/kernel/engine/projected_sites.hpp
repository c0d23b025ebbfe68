// Directions in the plane: projected stereographically for sorting and for the first filter, decided on the rays.
//
// A circle stays a circle, so the plane's incircle test is the sphere's bubble test, and three points are
// counterclockwise exactly if the pole does not lie in their bubble. The pole may be one of the points; otherwise it is
// an artificial point that comes first in the order of displacements. Displaced points are in strictly convex position,
// and seen from the displaced pole they are a set of the plane without three points on a line or four on a circle.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/curve_sites.hpp"
#include "engine/projection.hpp"
#include "predicates/ray_predicates.hpp"

namespace stereodel::engine {

// The directions and the pole that the projection leaves from.
struct ProjectedRays {
    const double* xyz;
    bool unit;        // every length within 2^-49 of 1
    Pole pole;
    bool artificial;  // the pole is none of the points

    const double* at(Index point) const { return xyz + 3 * static_cast<std::ptrdiff_t>(point); }

    // A projected point as (x/w, y/w).
    struct Ratio {
        double x, y, w;

        // Relatively within 8u; NaN, which decides nothing, where products of coordinates might leave the range of
        // doubles.
        Point2 point() const { return {in_range(x / w), in_range(y / w)}; }
    };

    // Relatively within 7u, so that one more rounding makes 8u, or NaN.
    Ratio ratio(Index point) const {
        const double* const p = at(point);
        if (!unit) {
            double out[2];
            project(p, pole, out);
            return {out[0], out[1], 1.0};
        }
        // w = |p| - s p_k, or (x^2 + y^2)/(|p| + |p_k|) where that difference would cancel. Roundings: the length 2.5,
        // its sum with |p_k| 3.5, the sum of squares 2: at most 3.5 + 2 + 1 = 6.5.
        const double along = p[pole.axis];
        const double x = p[(pole.axis + (pole.sign < 0 ? 1 : 2)) % 3], y = p[(pole.axis + (pole.sign < 0 ? 2 : 1)) % 3];
        const double across = x * x + y * y;
        const double sum = std::sqrt(across + along * along) + std::fabs(along);
        const bool near = pole.sign * along > 0.0;
        return {x, y, (near ? across : sum) / (near ? sum : 1.0)};  // no branch: half of the points are near
    }

    // A coordinate of 2^-70 or more is a multiple of 2^-123, and so are differences: no product of eight of them and
    // three roundoffs underflows (see `InCircleEstimate`).
    static double in_range(double x) {
        return x == 0.0 || (std::fabs(x) >= 0x1p-70 && std::fabs(x) <= 0x1p70) ? x : std::nan("");
    }
};

// A value and the bound of its error.
struct Estimated {
    double value, bound;
    bool positive() const { return value > bound; }
    bool negative() const { return value < -bound; }
};

// The bounds below. A projected coordinate X is off by 8u|X| (`project`), u = 2^-53. For a difference a = A - D that is
// 8u(|A| + |D|) <= 16u|D| + 8u|a|, and its own rounding adds u: an error relative to the difference, 9u with the small
// excess of second order counted as 9.5u, and an absolute one, e = 17u|D|.
//
// Three points, pivot A: a product of two differences with five roundings of 9.5u, 9.5u, u, u: 21u and the bound's own:
// 22u; e moves the sum of the two products by at most e times the sum of the four differences, and 2e^2.
inline Estimated orient_estimate(Point2 a, Point2 b, Point2 c) {
    const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
    const double left = bx * cy, right = by * cx;
    const double e = 17 * 0x1p-53 * (std::fabs(a.x) + std::fabs(a.y));
    const double moved = e * (std::fabs(bx) + std::fabs(by) + std::fabs(cx) + std::fabs(cy) + 2 * e);
    return {left - right, 22 * 0x1p-53 * (std::fabs(left) + std::fabs(right)) + 1.01 * moved};
}

// The same where no coordinate exceeds r: differences are at most 2r and off by 2 * 8u r for the coordinates and 2u r,
// 18u r; each product of two moves by 2 * 2r * 18u r = 72u r^2, and its rounding adds 4u r^2, the last one 8u r^2. With
// terms of second order less than 2^8 u r^2.
inline double orient_bound_within(double r) { return 0x1p-45 * r * r; }

// Four points, pivot D. A term of the determinant holds four differences (38u) and seven more roundings, with the
// bound's own: 46u times the permanent q = AB + BC + CA (A = |a|^2 and so on; see plane_forms.hpp). An absolute error e
// in each difference moves the determinant by at most (4/3) e S P with S = |a|+|b|+|c| and P = |a||b|+|b||c|+|c||a|,
// all lengths taken longer by e to cover higher orders: (4/3) e (S + 3e)(P + 2eS + 3e^2). With s = A+B+C: S <=
// sqrt(3s), P <= sqrt(3q), P <= s, eS <= (e^2 + 3s)/2, this is at most
//   4 e sqrt(sq) + 32 e^2 (s + e^2).
struct InCircleEstimate {
    double value, permanent, squares, error_squared;

    InCircleEstimate(Point2 a, Point2 b, Point2 c, Point2 d) {
        const double ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x, cy = c.y - d.y;
        const double aa = ax * ax + ay * ay, bb = bx * bx + by * by, cc = cx * cx + cy * cy;
        value = aa * (bx * cy - by * cx) + bb * (cx * ay - cy * ax) + cc * (ax * by - ay * bx);
        permanent = aa * bb + bb * cc + cc * aa;
        squares = aa + bb + cc;
        error_squared = 17 * 0x1p-53 * 17 * 0x1p-53 * (d.x * d.x + d.y * d.y);
    }

    double bound() const {
        const double absolute = std::sqrt(error_squared * squares * permanent);
        return 46 * 0x1p-53 * permanent + 4.01 * absolute + 33 * error_squared * (squares + error_squared);
    }

    // Where points are far apart, beside the error of their coordinates, a bound without a root: if e^2 s <= 2^-66 q,
    // then also e^2 <= 2^-66 s (q <= s^2), and the bound is below 2^-30 q.
    bool is_wide() const { return error_squared * squares * 0x1p66 <= permanent; }
    double wide_bound() const { return 0x1p-30 * permanent; }
};

class ProjectedSites : public CurveSites {
  public:
    ProjectedSites(CurveArrays& arrays, const ProjectedRays& rays) : CurveSites(arrays), rays_(rays) {
        const double sign = rays.pole.sign;
        for (int k = 0; k < 3; ++k) {
            pole_[k] = k == rays.pole.axis ? sign : 0.0;
        }
    }

    // From now on it is asked about these points alone.
    void stay_within(Index low, Index high) {
        double reach = 0.0;
        for (Index a = low; a < high; ++a) {
            reach = std::max({reach, std::fabs(points_[a].x), std::fabs(points_[a].y)});  // NaN decides nothing later
        }
        orient_bound_ = orient_bound_within(reach);
    }
    void leave() { orient_bound_ = HUGE_VAL; }

    // Never 0: displaced points are not on a line.
    int orient(Index a, Index b, Index c) {
        const Point2 p = points_[a], q = points_[b], r = points_[c];
        const double area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
        if (area > orient_bound_) {
            return 1;
        }
        return area < -orient_bound_ ? -1 : orient_close(a, b, c);
    }

    bool in_circle(Index a, Index b, Index c, Index d) {
        const InCircleEstimate e(points_[a], points_[b], points_[c], points_[d]);
        if (e.is_wide()) {
            if (e.value > e.wide_bound()) {
                return true;
            }
            if (e.value < -e.wide_bound()) {
                return false;
            }
        }
        return in_circle_close(a, b, c, d, e);
    }

    bool before(Index a, Index b, Axis axis) {
        const Point2 p = points_[a], q = points_[b];
        const double x = axis == Axis::x ? p.x : p.y, y = axis == Axis::x ? q.x : q.y;
        const double bound = coordinate_error * (std::fabs(x) + std::fabs(y));
        if (x - y > bound) {
            return false;
        }
        return x - y < -bound || compare(a, b, axis) < 0;
    }
    bool refine(Index low, Index high);
    void sort_few(Index low, Index high) {
        insertion_sort(low, high, [this](Index a, Index b) { return before(a, b, Axis::x); });
    }
    Index sort_distinct(Index low, Index high);
    const Tally& tally() const { return tally_; }

  private:
    const double* ray(Index a) const { return rays_.at(source_[a]); }
    int orient_close(Index a, Index b, Index c);
    bool in_circle_close(Index a, Index b, Index c, Index d, const InCircleEstimate& e);
    int compare(Index a, Index b, Axis axis);
    int compare_along(Index a, Index b, int coordinate);
    template <class Coordinates>
    bool refine(Index low, Index high, const Coordinates& coordinates);

    static constexpr double coordinate_error = 9 * 0x1p-53;  // 8u each, and the bound's own roundings

    ProjectedRays rays_;
    double pole_[3];
    double orient_bound_ = HUGE_VAL;
    Tally tally_;
};

// The key of a direction in the grid over the whole plane; `ratio` is its projection.
std::uint32_t whole_plane_key(const ProjectedRays& rays, Index point, ProjectedRays::Ratio ratio);

}  // namespace stereodel::engine
