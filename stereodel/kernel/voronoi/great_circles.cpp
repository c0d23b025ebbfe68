#include "voronoi/great_circles.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "arithmetic/arc_tangent.hpp"
#include "arithmetic/ball_vectors.hpp"
#include "voronoi/unit_vectors.hpp"

namespace stereodel::voronoi {

using arithmetic::BallVector;
using arithmetic::cross;
using arithmetic::two_product;
using arithmetic::vector_angle;

namespace {

using Size = std::size_t;

const double* row(const double* xyz, Index k) {
    return xyz + 3 * static_cast<std::ptrdiff_t>(k);
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

// v 2^exponent, the longest component in [1, 2); of a vector product, which has no radius to speak of.
struct ScaledProduct {
    Pair v[3];
    int exponent;

    explicit ScaledProduct(const BallVector& balls) : exponent(balls.exponent()) {
        for (int k = 0; k < 3; ++k) {
            const DoubleDouble middle = balls.v[k].middle(exponent);
            v[k] = {middle.hi, middle.lo};
        }
    }

    double length() const { return std::sqrt(length_squared(v)); }
};

// The angle between two directions, in [0, pi], from their vector product: small ones to a few 2^-53 of themselves.
double angle_between(const double* p, const double* q, const ScaledProduct& normal) {
    const ScaledRay a(p), b(q);
    const DoubleDouble cosine =
        two_product(a.v[0], b.v[0]) + two_product(a.v[1], b.v[1]) + two_product(a.v[2], b.v[2]);
    return vector_angle(std::ldexp(normal.length(), normal.exponent - a.exponent - b.exponent), cosine.hi);
}

BallVector axis_of_pair(const double* p, const double* q) {
    const BallVector normal = cross(p, q);
    if (!normal.is_zero()) {
        return normal;
    }
    int shortest = 0;
    for (int k = 1; k < 3; ++k) {
        shortest = std::fabs(p[k]) < std::fabs(p[shortest]) ? k : shortest;
    }
    double axis[3] = {};
    axis[shortest] = 1.0;
    return cross(p, axis);
}

// Of three directions, counterclockwise. Of the three steps around the circle at most one is a half-turn or more: two
// or three of the products point along the axis, at most one is zero or points against it.
BallVector axis_of_three(const double* a, const double* b, const double* c) {
    const BallVector products[] = {cross(c, a), cross(a, b), cross(b, c)};
    const int k = (products[0].is_zero() ? products[1] : products[0]).first_axis();
    const auto sign = [&](int product) { return products[product].v[k].sign(); };
    const int turn = sign(0) + sign(1) + sign(2);
    return products[sign(0) * turn > 0 ? 0 : sign(1) * turn > 0 ? 1 : 2];
}

// p/|p| - q/|q| = 2 sin(w/2) (cos(w/2) t + sin(w/2) p/|p|), w the angle between them, t the unit vector along
// p x (p x q), at right angles to p: away from q. The product p x q has full precision however close they are. Below
// w = 2^-43, sin(w/2)/cos(w/2) is w/2 to 2^-88 of itself; it is multiplied by |p x q|, the length of the other term.
void bisector_of_close(const double* p, const double* q, const UnitVector& unit, double* normal) {
    const ScaledProduct across(cross(p, q));
    const double tilt = 0.5 * angle_between(p, q, across) * across.length();
    Pair v[3];
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const Pair along =
            Pair{unit.hi[i], unit.lo[i]} * across.v[j] - Pair{unit.hi[j], unit.lo[j]} * across.v[i];
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

GreatCircle::GreatCircle(const double* xyz, std::vector<Index> directions) : order(std::move(directions)) {
    const Size size = order.size();
    if (size < 2) {
        return;
    }
    const auto site = [&](Size third) { return row(xyz, order[third * size / 3]); };
    const ScaledProduct axis(size == 2 ? axis_of_pair(row(xyz, order[0]), row(xyz, order[1]))
                                      : axis_of_three(site(0), site(1), site(2)));
    round_unit(axis.v, ends[0]);
    for (int k = 0; k < 3; ++k) {
        ends[1][k] = 0.0 - ends[0][k];
    }
}

std::vector<double> GreatCircle::gaps(const double* xyz) const {
    const Size size = order.size();
    std::vector<double> result(size);
    for (Size k = 0; k < size; ++k) {
        const double *p = row(xyz, order[k]), *q = row(xyz, order[k + 1 < size ? k + 1 : 0]);
        const ScaledProduct normal(cross(p, q));
        const double angle = angle_between(p, q, normal);
        double along = 0.0;
        for (int j = 0; j < 3; ++j) {
            along += normal.v[j].h * ends[0][j];
        }
        result[k] = along < 0.0 ? FULL_TURN - angle : angle;
    }
    return result;
}

void bisector_normals(const double* p, const double* q, std::size_t count, double* normals, int workers, Stop stop) {
    Crew crew(useful_workers(workers, count));
    for_all(count, crew, stop, [&](Size k) { bisector_normal(p + 3 * k, q + 3 * k, normals + 3 * k); });
}

}  // namespace stereodel::voronoi
