#include "great_circles.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "angles.hpp"
#include "duplicates.hpp"
#include "ray_predicates.hpp"
#include "unit_vectors.hpp"

namespace stereodel {
namespace {

using Size = std::size_t;

const double* row(const double* xyz, Index k) {
    return xyz + 3 * static_cast<std::ptrdiff_t>(k);
}

// value 2^exponent, |value| in [1/4, 1), or 0.
struct ScaledNumber {
    DoubleDouble value;
    int exponent;
};

// Exactly, for any two doubles.
ScaledNumber product(double a, double b) {
    int of_a = 0, of_b = 0;
    const double x = std::frexp(a, &of_a), y = std::frexp(b, &of_b);
    return {two_product(x, y), of_a + of_b};
}

DoubleDouble times_power(DoubleDouble x, int exponent) {
    return {std::ldexp(x.hi, exponent), std::ldexp(x.lo, exponent)};
}

// Differences in double-double are off by 3u^2 + 13u^3 of themselves, also where they cancel. What is below 2^-120 of
// the other is left out: 2^-117 of the difference. So 2^-104, and zero only if the difference is.
ScaledNumber difference(ScaledNumber a, ScaledNumber b) {
    if (a.value.hi == 0.0 || b.value.hi == 0.0) {
        return a.value.hi == 0.0 ? ScaledNumber{-b.value, b.exponent} : a;
    }
    const int ahead = a.exponent - b.exponent;
    if (ahead > 120 || ahead < -120) {
        return ahead > 0 ? a : ScaledNumber{-b.value, b.exponent};
    }
    if (ahead >= 0) {
        return {a.value - times_power(b.value, -ahead), a.exponent};
    }
    return {times_power(a.value, ahead) - b.value, b.exponent};
}

ScaledNumber cross_component(const double* a, const double* b, int k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    return difference(product(a[i], b[j]), product(a[j], b[i]));
}

// A vector times a power of two, the longest component in [1/2, 1).
struct ScaledRay {
    double v[3];
    int exponent = 0;

    explicit ScaledRay(const double* p) {
        std::frexp(std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])}), &exponent);
        for (int k = 0; k < 3; ++k) {
            v[k] = std::ldexp(p[k], -exponent);  // a component that underflows here counts for nothing
        }
    }

    double squared() const { return rays::dot_form(v, v); }
};

Pair to_pair(DoubleDouble x) {
    return {x.hi, x.lo};
}

double length(const ScaledVector& n) {
    return std::sqrt(n.v[0].hi * n.v[0].hi + n.v[1].hi * n.v[1].hi + n.v[2].hi * n.v[2].hi);
}

// The angle between two directions, in [0, pi], from their vector product: small ones to a few 2^-53 of themselves.
double angle_between(const double* p, const double* q, const ScaledVector& normal) {
    const ScaledRay a(p), b(q);
    const DoubleDouble cosine =
        two_product(a.v[0], b.v[0]) + two_product(a.v[1], b.v[1]) + two_product(a.v[2], b.v[2]);
    return vector_angle(std::ldexp(length(normal), normal.exponent - a.exponent - b.exponent), cosine.hi);
}

// Directions of a great circle around the first coordinate axis that does not lie in it: without that coordinate they
// are in the same order, or in the opposite one, and none of them is zero.
class Turns {
  public:
    Turns(const double* xyz, int axis) : xyz_(xyz), axis_(axis) {}

    int compare(Index a, Index b) const {
        const double *p = row(xyz_, a), *q = row(xyz_, b);
        const bool late = is_late(p), other_late = is_late(q);
        return late != other_late ? (late ? 1 : -1) : -cross_sign(p, q, axis_);
    }

  private:
    bool is_late(const double* p) const {
        const double x = p[(axis_ + 1) % 3], y = p[(axis_ + 2) % 3];
        return x < 0.0 || (x == 0.0 && y < 0.0);
    }

    const double* xyz_;
    int axis_;
};

int first_axis(const ScaledVector& n) {
    return n.sign(0) != 0 ? 0 : n.sign(1) != 0 ? 1 : 2;
}

void check_on_circle(const double* xyz, Index count, Index second, Stop stop) {
    Rays rays(xyz, all_unit(xyz, static_cast<Size>(count)));
    for_range(0, static_cast<Size>(count), stop, [&](Size k) {
        if (rays.turn(0, second, static_cast<Index>(k)) != 0) {
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

// Different directions in order, at least one.
std::vector<Index> order_of(const double* xyz, Index count, Stop stop) {
    std::vector<Index> order(static_cast<Size>(count));
    std::iota(order.begin(), order.end(), 0);
    Index second = 1;
    while (second < count && cross_product(row(xyz, 0), row(xyz, second)).is_zero()) {
        ++second;
    }
    int axis = 0;
    if (second < count) {
        check_on_circle(xyz, count, second, stop);
        axis = first_axis(cross_product(row(xyz, 0), row(xyz, second)));
    } else {  // one direction and perhaps its opposite: seen along an axis that is not theirs
        axis = (static_cast<int>(std::find_if(row(xyz, 0), row(xyz, 0) + 3, [](double x) { return x != 0.0; }) -
                                 row(xyz, 0)) +
                1) %
               3;
    }
    const Turns turns(xyz, axis);
    Pairs duplicates;
    const auto compare = [&](Index a, Index b) {
        check(stop);
        return turns.compare(a, b);
    };
    order.resize(sort_and_drop(order, compare, [](Index k) { return k; }, duplicates));
    begin_with_lowest(order);
    return order;
}

ScaledVector axis_of_pair(const double* p, const double* q) {
    const ScaledVector normal = cross_product(p, q);
    if (!normal.is_zero()) {
        return normal;
    }
    int shortest = 0;
    for (int k = 1; k < 3; ++k) {
        shortest = std::fabs(p[k]) < std::fabs(p[shortest]) ? k : shortest;
    }
    double axis[3] = {};
    axis[shortest] = 1.0;
    return cross_product(p, axis);
}

// Of three directions, counterclockwise. Of the three steps around the circle at most one is a half-turn or more: two
// or three of the products point along the axis, at most one is zero or points against it.
ScaledVector axis_of_three(const double* a, const double* b, const double* c) {
    const ScaledVector products[] = {cross_product(c, a), cross_product(a, b), cross_product(b, c)};
    const auto k = first_axis(products[0].is_zero() ? products[1] : products[0]);
    const int turn = products[0].sign(k) + products[1].sign(k) + products[2].sign(k);
    return products[0].sign(k) * turn > 0 ? products[0] : products[1].sign(k) * turn > 0 ? products[1] : products[2];
}

// p/|p| - q/|q| = 2 sin(w/2) (cos(w/2) t + sin(w/2) p/|p|), w the angle between them, t the unit vector along
// p x (p x q), at right angles to p: away from q. The product p x q has full precision however close they are. Below
// w = 2^-43, sin(w/2)/cos(w/2) is w/2 to 2^-88 of itself; it is multiplied by |p x q|, the length of the other term.
void bisector_of_close(const double* p, const double* q, const UnitVector& unit, double* normal) {
    const ScaledVector across = cross_product(p, q);
    const double tilt = 0.5 * angle_between(p, q, across) * length(across);
    Pair v[3];
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const Pair along = Pair{unit.hi[i], unit.lo[i]} * to_pair(across.v[j]) -
                           Pair{unit.hi[j], unit.lo[j]} * to_pair(across.v[i]);
        v[k] = along + Pair{tilt * unit.hi[k], 0.0};
    }
    round_unit(v, normal);
}

void bisector_normal(const double* p, const double* q, double* normal) {
    const UnitVector a = unit_vector(p), b = unit_vector(q);
    const PairedEdge edge(b, a);
    // A difference is off by 2^-100: at 2^-44, by 2^-56 of itself.
    if (length_squared(edge.v) > 0x1p-88) {
        round_unit(edge.v, normal);
    } else {
        bisector_of_close(p, q, a, normal);
    }
}

}  // namespace

int cross_sign(const double* a, const double* b, int k) {
    const double value = cross_component(a, b, k).value.hi;
    return value > 0.0 ? 1 : value < 0.0 ? -1 : 0;
}

ScaledVector cross_product(const double* a, const double* b) {
    const ScaledNumber parts[] = {cross_component(a, b, 0), cross_component(a, b, 1), cross_component(a, b, 2)};
    ScaledVector result{{}, 0};
    bool found = false;
    for (const ScaledNumber& part : parts) {
        if (part.value.hi != 0.0) {
            const int top = part.exponent + std::ilogb(part.value.hi) + 1;
            result.exponent = found ? std::max(result.exponent, top) : top;
            found = true;
        }
    }
    for (int k = 0; k < 3; ++k) {
        result.v[k] = times_power(parts[k].value, parts[k].exponent - result.exponent);
    }
    return result;
}

GreatCircle::GreatCircle(const double* xyz, std::size_t count, Stop stop) {
    if (count == 0) {
        return;
    }
    order = order_of(xyz, static_cast<Index>(count), stop);
    const Size size = order.size();
    if (size < 2) {
        return;
    }
    const auto site = [&](Size third) { return row(xyz, order[third * size / 3]); };
    const ScaledVector axis =
        size == 2 ? axis_of_pair(row(xyz, order[0]), row(xyz, order[1])) : axis_of_three(site(0), site(1), site(2));
    const Pair v[] = {to_pair(axis.v[0]), to_pair(axis.v[1]), to_pair(axis.v[2])};
    round_unit(v, ends[0]);
    for (int k = 0; k < 3; ++k) {
        ends[1][k] = 0.0 - ends[0][k];
    }
}

std::vector<double> GreatCircle::gaps(const double* xyz) const {
    const Size size = order.size();
    std::vector<double> result(size);
    for (Size k = 0; k < size; ++k) {
        const double *p = row(xyz, order[k]), *q = row(xyz, order[k + 1 < size ? k + 1 : 0]);
        const ScaledVector normal = cross_product(p, q);
        const double angle = angle_between(p, q, normal);
        double along = 0.0;
        for (int j = 0; j < 3; ++j) {
            along += normal.v[j].hi * ends[0][j];
        }
        result[k] = along < 0.0 ? FULL_TURN - angle : angle;
    }
    return result;
}

void bisector_normals(const double* p, const double* q, std::size_t count, double* normals, int workers, Stop stop) {
    Crew crew(useful_workers(workers, count));
    for_all(count, crew, stop, [&](Size k) { bisector_normal(p + 3 * k, q + 3 * k, normals + 3 * k); });
}

}  // namespace stereodel
