// Rough coordinates of points: for an order along a curve and for guesses where to begin. Only speed depends on them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "order/curve_keys.hpp"
#include "order/square_grid.hpp"

namespace stereodel::order {

// The plane is its own chart.
class PlaneChart {
  public:
    static constexpr std::size_t dimension = 2;

    PlaneChart() = default;
    explicit PlaneChart(const double*) {}

    static constexpr std::uint32_t face = 0;
    Point2 operator()(const double* p) const { return {p[0] + 0.0, p[1] + 0.0}; }  // -0 becomes 0

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
    Point2 operator()(const double* p) const {
        return {p[(axis_ + 1) % 3] / p[axis_] + 0.0, p[(axis_ + 2) % 3] / p[axis_] + 0.0};  // -0 becomes 0
    }

    // The place on the faces' common curve: 3 bits for the face, 14 for each coordinate.
    static std::uint32_t key(const double* p) {
        constexpr double half = 8191.5;
        const SphereChart chart(p);
        const Point2 place = chart(p);
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

}  // namespace stereodel::order
