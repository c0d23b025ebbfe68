#include "engine/projected_sites.hpp"

#include <algorithm>
#include <cstdint>

#include "engine/projection.hpp"
#include "predicates/ray_predicates.hpp"

namespace stereodel::engine {

using order::cell_bits;
using order::cells;
using order::curve_key;
using predicates::in_bubble;

namespace {

// A border between two columns or rows, hi + lo exactly.
struct Border {
    double hi, lo;
};

// Number of the cell that holds a coordinate: the one whose lower border is the last not above it. `near` is a guess,
// the answer is exact, whatever the guess: so cells are cells of the true projection, and points of different ones lie
// on two sides of a line.
template <class BorderOf>
std::uint32_t exact_cell(const ProjectedRays& rays, Index point, int coordinate, std::uint32_t near,
                         BorderOf&& border) {
    const double* const p = rays.at(point);
    const auto beyond = [&](std::uint32_t cell) {  // not before the lower border of the cell
        const Border b = border(cell);
        return compare_to_line(p, rays.pole, coordinate, b.hi, b.lo) >= 0;
    };
    std::uint32_t low = 0, high = cells;  // in [low, high)
    if (near > 0 && near < cells - 1) {
        if (beyond(near)) {
            low = near;
            high = beyond(near + 1) ? cells : near + 1;
        } else {
            low = near > 1 && beyond(near - 1) ? near - 1 : 0;  // the first cell has no lower border
            high = near;
        }
    }
    while (high - low > 1) {
        const std::uint32_t middle = low + (high - low) / 2;
        (beyond(middle) ? low : high) = middle;
    }
    return low;
}

// The cell of a coordinate that lies `place` cells from the first border, within `error` cells.
template <class BorderOf>
inline std::uint32_t cell_at(double place, double error, const ProjectedRays& rays, Index point, int coordinate,
                             BorderOf&& border) {
    const double last = cells - 1.0;
    const double bounded = place > 0.0 ? std::min(place, last) : 0.0;  // NaN becomes 0, and is not certain
    const std::uint32_t near = static_cast<std::uint32_t>(bounded);
    const double rest = place - near;
    const bool above = near == 0 ? place < 1.0 - error : rest > error;
    const bool below = near == cells - 1 ? place > last + error : rest < 1.0 - error;
    return above && below ? near : exact_cell(rays, point, coordinate, near, border);
}

// The grid over the whole plane: y = X/(1 + |X|) is evenly divided. The borders are the doubles next to y/(1 - |y|).
struct WholePlaneBorder {
    Border operator()(std::uint32_t cell) const {
        const double half = cells / 2, k = cell - half;
        return {k / (half - std::fabs(k)), 0.0};
    }
};

// The place in the grid of X = x/w, half (1 + x/(w + |x|)). Both are off by 7u, the formula adds 4u, a border's
// rounding u/4: times 2^15 cells far below 2^-30 of a cell.
std::uint32_t whole_plane_cell(double x, double w, const ProjectedRays& rays, Index point, int coordinate) {
    const double half = cells / 2;
    return cell_at(half + half * (x / (w + std::fabs(x))), 0x1p-30, rays, point, coordinate, WholePlaneBorder{});
}

// A square grid with exact borders over part of the plane, for offsets from an origin that is a double.
//
// Borders are base + k step, multiples of the power of two `step`, and exact: |base| <= 2^52 step.
class FineGrid {
  public:
    void include(Point2 offset) {
        low_ = {std::min(low_.x, offset.x), std::min(low_.y, offset.y)};
        high_ = {std::max(high_.x, offset.x), std::max(high_.y, offset.y)};
    }

    double largest() const {
        return std::max({std::fabs(low_.x), std::fabs(high_.x), std::fabs(low_.y), std::fabs(high_.y)});
    }

    // `error`: how far an offset may be from the true one, its rounding apart. False where cells would be so small that
    // many points needed exact decisions. An offset is at most 2^16 steps from the base, so roundings of u are far
    // below the slack of 2^-30 of a cell.
    bool fit(double error) {
        const double extent = std::max(high_.x - low_.x, high_.y - low_.y);
        if (!(extent > 0x1p-600 && extent < 0x1p300)) {
            return false;
        }
        step_ = std::ldexp(1.0, std::ilogb(extent) + 2 - cell_bits);  // at most 2^15 steps, and room at the end
        base_ = {std::floor(low_.x / step_) * step_, std::floor(low_.y / step_) * step_};
        error_ = error / step_ + 0x1p-30;
        return error_ < 0.1 && largest() < 0x1p50 * step_;
    }

    std::uint32_t key(Point2 offset, Point2 origin, const ProjectedRays& rays, Index point) const {
        const auto cell = [&](double x, double base, double from, int coordinate) {
            const auto border = [&](std::uint32_t k) { return Border{from, base + k * step_}; };
            return cell_at((x - base) / step_, error_, rays, point, coordinate, border);
        };
        return curve_key(cell(offset.x, base_.x, origin.x, 0), cell(offset.y, base_.y, origin.y, 1));
    }

  private:
    Point2 low_{HUGE_VAL, HUGE_VAL}, high_{-HUGE_VAL, -HUGE_VAL}, base_{0.0, 0.0};
    double step_ = 0.0, error_ = 0.0;
};

// Coordinates as the first filter has them, each off by 8u of its size.
struct RoundedCoordinates {
    const Point2* points;
    Point2 origin{0.0, 0.0};
    double relative_error = 8 * 0x1p-53;

    Point2 offset(Index place, const double*) const { return points[place]; }
};

// Offsets from one of the points, of coordinates in double-double: off by 2^-97 of the coordinate, and rounded.
struct PreciseCoordinates {
    Pole pole;
    Point2 origin;
    double relative_error = 0x1p-96;

    Point2 offset(Index, const double* p) const {
        double c[4];
        project_double_double(p, pole, c);
        return {(c[0] - origin.x) + c[1], (c[2] - origin.y) + c[3]};
    }
};

bool is_finite(Point2 p) { return std::isfinite(p.x) && std::isfinite(p.y); }

}  // namespace

std::uint32_t whole_plane_key(const ProjectedRays& rays, Index point, ProjectedRays::Ratio p) {
    return curve_key(whole_plane_cell(p.x, p.w, rays, point, 0), whole_plane_cell(p.y, p.w, rays, point, 1));
}

int ProjectedSites::orient_close(Index a, Index b, Index c) {
    const Estimated e = orient_estimate(points_[a], points_[b], points_[c]);
    if (e.positive() || e.negative()) {
        return e.positive() ? 1 : -1;
    }
    ++tally_.filter;
    const int first = rays_.artificial ? 3 : -1;
    return in_bubble(ray(a), ray(b), ray(c), pole_, rays_.unit, first, tally_) ? -1 : 1;
}

bool ProjectedSites::in_circle_close(Index a, Index b, Index c, Index d, const InCircleEstimate& e) {
    const double bound = e.bound();
    if (e.value > bound) {
        return true;
    }
    if (e.value < -bound) {
        return false;
    }
    ++tally_.filter;
    return in_bubble(ray(a), ray(b), ray(c), ray(d), rays_.unit, -1, tally_);
}

int ProjectedSites::compare_along(Index a, Index b, int coordinate) {
    const Point2 p = points_[a], q = points_[b];
    const double x = coordinate == 0 ? p.x : p.y, y = coordinate == 0 ? q.x : q.y;
    const double bound = coordinate_error * (std::fabs(x) + std::fabs(y));
    if (x - y > bound) {
        return 1;
    }
    if (x - y < -bound) {
        return -1;
    }
    const double *const v = ray(a), *const w = ray(b);
    return v[0] == w[0] && v[1] == w[1] && v[2] == w[2] ? 0 : compare_projected(v, w, rays_.pole, coordinate);
}

int ProjectedSites::compare(Index a, Index b, Axis axis) {
    const int first = axis == Axis::x ? 0 : 1;
    const int sign = compare_along(a, b, first);
    return sign != 0 ? sign : compare_along(a, b, 1 - first);
}

Index ProjectedSites::sort_distinct(Index low, Index high) {
    return sort_and_drop(low, high, [this](Index a, Index b) { return compare(a, b, Axis::x); });
}

template <class Coordinates>
bool ProjectedSites::refine(Index low, Index high, const Coordinates& coordinates) {
    FineGrid grid;
    for (Index a = low; a < high; ++a) {
        poll();
        const Point2 offset = coordinates.offset(a, ray(a));
        if (!is_finite(offset)) {
            return false;
        }
        grid.include(offset);
    }
    const Point2 origin = coordinates.origin;
    const double size = std::max(grid.largest(), std::max(std::fabs(origin.x), std::fabs(origin.y)));
    if (!grid.fit(coordinates.relative_error * size)) {
        return false;
    }
    sort_range(low, high, [&](Index a) { return grid.key(coordinates.offset(a, ray(a)), origin, rays_, source_[a]); });
    return key(low) != key(high - 1);
}

bool ProjectedSites::refine(Index low, Index high) {
    if (refine(low, high, RoundedCoordinates{points_})) {
        return true;
    }
    double c[4];
    project_double_double(ray(low), rays_.pole, c);
    return refine(low, high, PreciseCoordinates{rays_.pole, {c[0], c[2]}});
}

}  // namespace stereodel::engine
