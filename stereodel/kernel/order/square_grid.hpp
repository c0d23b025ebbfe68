// The square grid over the bounding box of points of the plane; its cells are numbered along a curve.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "order/curve_keys.hpp"

namespace stereodel::order {

struct Point2 {
    double x, y;
};

// Each step from a coordinate to its cell is monotone in doubles, so points of different columns (rows) lie on two
// sides of a line.
class SquareGrid {
  public:
    void include(Point2 p) { include(p, p); }
    void include(const SquareGrid& other) { include(other.low_, other.high_); }  // of no points as well

    // Whether the grid tells at least two points apart. Halves, because a difference of doubles may overflow.
    bool fit() {
        const double extent = std::max(high_.x / 2 - low_.x / 2, high_.y / 2 - low_.y / 2);
        scale_ = (cells - 0.5) / extent;
        const bool fits = extent > 0 && scale_ < HUGE_VAL;
        if (!fits) {
            scale_ = 0;  // one cell
        }
        return fits;
    }

    std::uint32_t key(Point2 p) const { return curve_key(cell(p.x, low_.x), cell(p.y, low_.y)); }

  private:
    void include(Point2 low, Point2 high) {
        low_ = {std::min(low_.x, low.x), std::min(low_.y, low.y)};
        high_ = {std::max(high_.x, high.x), std::max(high_.y, high.y)};
    }

    std::uint32_t cell(double x, double low) const {
        return static_cast<std::uint32_t>(std::min((x / 2 - low / 2) * scale_, cells - 1.0));
    }

    Point2 low_{HUGE_VAL, HUGE_VAL}, high_{-HUGE_VAL, -HUGE_VAL};
    double scale_ = 0;
};

}  // namespace stereodel::order
