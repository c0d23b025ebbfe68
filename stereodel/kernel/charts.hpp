// Rough coordinates of points: for an order along a curve and for guesses where to begin. Only speed depends on them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "curve_keys.hpp"

namespace stereodel {

struct ChartPoint {
    double x, y;
};

// A square grid over the bounding box of points of a chart.
class CurveGrid {
  public:
    void include(ChartPoint p) {
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
        high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
    }

    // Whether the grid tells at least two of them apart. Halves, because a difference of doubles may overflow.
    bool fit() {
        const double extent = std::max(high_.x / 2 - low_.x / 2, high_.y / 2 - low_.y / 2);
        scale_ = (cells - 0.5) / extent;
        return extent > 0 && scale_ < HUGE_VAL;
    }

    std::uint32_t key(ChartPoint p) const { return curve_key(cell(p.x, low_.x), cell(p.y, low_.y)); }

  private:
    std::uint32_t cell(double x, double low) const {
        return static_cast<std::uint32_t>(std::min((x / 2 - low / 2) * scale_, cells - 1.0));
    }

    ChartPoint low_{HUGE_VAL, HUGE_VAL}, high_{-HUGE_VAL, -HUGE_VAL};
    double scale_ = 0;
};

// The plane is its own chart.
class PlaneChart {
  public:
    static constexpr std::size_t dimension = 2;

    PlaneChart() = default;
    explicit PlaneChart(const double*) {}

    static constexpr std::uint32_t face = 0;
    ChartPoint operator()(const double* p) const { return {p[0] + 0.0, p[1] + 0.0}; }  // -0 becomes 0

    // A vector in place of the point, such that `rough_distance` of two grows with their distance.
    static void prepare(const double* p, double* out) { std::copy(p, p + 2, out); }
    static double rough_distance(const double* p, const double* q) {
        const double dx = p[0] - q[0], dy = p[1] - q[1];
        return dx * dx + dy * dy;
    }
};

// A face of the cube around the sphere, seen from the centre. A direction's coordinates are quotients rounded once, so
// equal directions of different length have the same ones.
class SphereChart {
  public:
    static constexpr std::size_t dimension = 3;

    explicit SphereChart(const double* p) {
        const double x = std::fabs(p[0]), y = std::fabs(p[1]), z = std::fabs(p[2]);
        axis_ = x >= y && x >= z ? 0 : (y >= z ? 1 : 2);
        face = static_cast<std::uint32_t>(2 * axis_ + (p[axis_] > 0));
    }

    std::uint32_t face;
    ChartPoint operator()(const double* p) const {
        return {p[(axis_ + 1) % 3] / p[axis_] + 0.0, p[(axis_ + 2) % 3] / p[axis_] + 0.0};  // -0 becomes 0
    }

    // The place on the faces' common curve: 3 bits for the face, 14 for each coordinate.
    static std::uint32_t key(const double* p) {
        constexpr double half = 8191.5;
        const SphereChart chart(p);
        const ChartPoint place = chart(p);
        const auto cell = [](double x) { return static_cast<std::uint32_t>((x + 1) * half); };
        return chart.face << 28 | curve_key(cell(place.x), cell(place.y));
    }

    static void prepare(const double* p, double* out) {
        const double scale = std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])});
        const double x = p[0] / scale, y = p[1] / scale, z = p[2] / scale;
        const double length = std::sqrt(x * x + y * y + z * z);
        out[0] = x / length;
        out[1] = y / length;
        out[2] = z / length;
    }
    static double rough_distance(const double* p, const double* q) {
        const double dx = p[0] - q[0], dy = p[1] - q[1], dz = p[2] - q[2];
        return dx * dx + dy * dy + dz * dz;
    }

  private:
    int axis_;
};

}  // namespace stereodel
