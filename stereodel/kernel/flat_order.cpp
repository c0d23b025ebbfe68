#include "flat_order.hpp"

#include <algorithm>

#include "plane_predicates.hpp"

namespace stereodel {
namespace {

std::vector<Index> kept_points(std::size_t size, const Pairs& duplicates) {
    std::vector<bool> is_dropped(size);
    for (const auto& pair : duplicates) {
        is_dropped[static_cast<std::size_t>(pair.first)] = true;
    }
    std::vector<Index> kept;
    kept.reserve(size - duplicates.size());
    for (std::size_t p = 0; p < size; ++p) {
        if (!is_dropped[p]) {
            kept.push_back(static_cast<Index>(p));
        }
    }
    return kept;
}

// Directions without one of their coordinates, and the origin, number 0: the k-th direction has number k + 1. Seen from
// the origin their order around it is exact, as no coordinate is rounded.
class Shadow {
  public:
    Shadow(const double* xyz, const std::vector<Index>& directions, std::size_t dropped) : xy_(2, 0.0) {
        for (const Index p : directions) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (k != dropped) {
                    xy_.push_back(xyz[3 * static_cast<std::size_t>(p) + k]);
                }
            }
        }
    }

    int turn(Index a, Index b) const { return PlanePoints(xy_.data(), 0.0).orient(0, a, b); }

    // By the angle from the positive x axis, 0 to a full turn.
    bool is_before(Index a, Index b) const {
        const int half_a = half(a), half_b = half(b);
        return half_a != half_b ? half_a < half_b : turn(a, b) > 0;
    }

  private:
    int half(Index a) const {
        const double x = xy_[2 * static_cast<std::size_t>(a)], y = xy_[2 * static_cast<std::size_t>(a) + 1];
        return y > 0.0 || (y == 0.0 && x > 0.0) ? 1 : y < 0.0 || x < 0.0 ? 2 : 0;
    }

    std::vector<double> xy_;
};

// Where the axis of the great circle has a component that is not zero, dropping this coordinate keeps the order. Of the
// second and the third direction at most one is opposite to the first, so one of them spans the circle with it.
Shadow shadow_of_circle(const double* xyz, const std::vector<Index>& directions) {
    for (std::size_t dropped = 0; dropped < 2; ++dropped) {
        Shadow shadow(xyz, directions, dropped);
        if (shadow.turn(1, 2) != 0 || shadow.turn(1, 3) != 0) {
            return shadow;
        }
    }
    return Shadow(xyz, directions, 2);
}

}  // namespace

std::vector<Index> flat_order_plane(const double* xy, std::size_t size, const Pairs& duplicates, Stop stop) {
    std::vector<Index> order = kept_points(size, duplicates);
    std::sort(order.begin(), order.end(), [xy, stop](Index a, Index b) {
        check(stop);
        const double *p = xy + 2 * static_cast<std::size_t>(a), *q = xy + 2 * static_cast<std::size_t>(b);
        return p[0] < q[0] || (p[0] == q[0] && p[1] < q[1]);
    });
    return order;
}

std::vector<Index> flat_order_sphere(const double* xyz, std::size_t size, const Pairs& duplicates, Stop stop) {
    const std::vector<Index> directions = kept_points(size, duplicates);
    if (directions.size() < 3) {
        return directions;
    }
    const Shadow shadow = shadow_of_circle(xyz, directions);
    std::vector<Index> order(directions.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        order[k] = static_cast<Index>(k) + 1;
    }
    std::sort(order.begin(), order.end(), [&shadow, stop](Index a, Index b) {
        check(stop);
        return shadow.is_before(a, b);
    });
    for (Index& p : order) {
        p = directions[static_cast<std::size_t>(p) - 1];
    }
    return order;
}

}  // namespace stereodel
