#include "order/flat_order.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "arithmetic/ball_vectors.hpp"
#include "duplicates.hpp"
#include "predicates/ray_predicates.hpp"

namespace stereodel::order {

using arithmetic::BallVector;
using arithmetic::cross;
using arithmetic::cross_component;
using predicates::Rays;
using predicates::all_unit;

namespace {

const double* row(const double* xyz, Index k) {
    return xyz + 3 * static_cast<std::ptrdiff_t>(k);
}

// Directions of a great circle around the first coordinate axis that does not lie in it: without that coordinate they
// are in the same order, or in the opposite one, and none of them is zero.
class Turns {
  public:
    Turns(const double* xyz, int axis) : xyz_(xyz), axis_(axis) {}

    int compare(Index a, Index b) const {
        const double *p = row(xyz_, a), *q = row(xyz_, b);
        const bool late = is_late(p), other_late = is_late(q);
        return late != other_late ? (late ? 1 : -1) : -cross_sign(p, q);
    }

  private:
    bool is_late(const double* p) const {
        const double x = p[(axis_ + 1) % 3], y = p[(axis_ + 2) % 3];
        return x < 0.0 || (x == 0.0 && y < 0.0);
    }

    // Rounding keeps the order of numbers: rounded products that differ tell that of the exact ones. Infinite ones too.
    Sign cross_sign(const double* p, const double* q) const {
        const int i = (axis_ + 1) % 3, j = (axis_ + 2) % 3;
        const double left = p[i] * q[j], right = p[j] * q[i];
        if (left != right) {
            return left < right ? -1 : 1;
        }
        const bool same = p[i] == q[i] && p[j] == q[j];
        return same ? 0 : cross_component(BallVector(p), BallVector(q), axis_).sign();
    }

    const double* xyz_;
    int axis_;
};

// The first direction that is neither that of number 0 nor opposite to it; their number if there is none.
Index first_aside(const double* xyz, Index count) {
    Index k = 1;
    while (k < count && cross(row(xyz, 0), row(xyz, k)).is_zero()) {
        ++k;
    }
    return k;
}

// An axis along which the directions are seen in order. If there is one, and perhaps its opposite: one that is not
// theirs.
int axis_of_sight(const double* xyz, Index count, Index aside) {
    const double* const first = row(xyz, 0);
    if (aside < count) {
        return cross(first, row(xyz, aside)).first_axis();
    }
    const double* const component = std::find_if(first, first + 3, [](double x) { return x != 0.0; });
    return (static_cast<int>(component - first) + 1) % 3;
}

void check_on_circle(const double* xyz, Index count, Index aside, Stop stop) {
    Rays rays(xyz, all_unit(xyz, static_cast<std::size_t>(count)));
    for_range(0, static_cast<std::size_t>(count), stop, [&](std::size_t k) {
        if (rays.turn(0, aside, static_cast<Index>(k)) != 0) {
            throw std::invalid_argument("points without triangles must lie on one great circle");
        }
    });
}

// From the lowest on, in the direction in which the three lowest follow one another.
void begin_with_lowest(std::vector<Index>& order) {
    std::rotate(order.begin(), std::min_element(order.begin(), order.end()), order.end());
    if (order.size() > 2) {
        std::vector<Index> lowest(3);
        std::partial_sort_copy(order.begin(), order.end(), lowest.begin(), lowest.end());
        if (std::find(order.begin(), order.end(), lowest[1]) > std::find(order.begin(), order.end(), lowest[2])) {
            std::reverse(order.begin() + 1, order.end());
        }
    }
}

// The first of equal ones, in the order of `compare`.
template <class Compare>
std::vector<Index> different_ones(std::size_t count, Stop stop, Compare&& compare) {
    std::vector<Index> order(count);
    std::iota(order.begin(), order.end(), 0);
    const auto patiently = [&](Index a, Index b) {
        check(stop);
        return compare(a, b);
    };
    Pairs duplicates;
    order.resize(sort_and_drop(order, Comparison(patiently), nullptr, duplicates));
    return order;
}

}  // namespace

std::vector<Index> line_order(const double* xy, std::size_t count, Stop stop) {
    return different_ones(count, stop, [xy](Index a, Index b) {
        const double *p = xy + 2 * static_cast<std::ptrdiff_t>(a), *q = xy + 2 * static_cast<std::ptrdiff_t>(b);
        const int k = p[0] != q[0] ? 0 : 1;
        return p[k] < q[k] ? -1 : p[k] > q[k] ? 1 : 0;
    });
}

std::vector<Index> circle_order(const double* xyz, std::size_t count, bool checked, Stop stop) {
    if (count == 0) {
        return {};
    }
    const Index size = static_cast<Index>(count), aside = first_aside(xyz, size);
    if (!checked && aside < size) {
        check_on_circle(xyz, size, aside, stop);
    }
    const Turns turns(xyz, axis_of_sight(xyz, size, aside));
    std::vector<Index> order =
        different_ones(count, stop, [&turns](Index a, Index b) { return turns.compare(a, b); });
    begin_with_lowest(order);
    return order;
}

}  // namespace stereodel::order
