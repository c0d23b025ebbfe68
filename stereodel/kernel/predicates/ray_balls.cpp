#include "predicates/ray_balls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "arithmetic/ball_vectors.hpp"
#include "predicates/ray_forms.hpp"
#include "predicates/spanning_edges.hpp"

namespace stereodel::predicates::rays {

using arithmetic::Ball;
using arithmetic::BallVector;
using arithmetic::cross;
using arithmetic::sqrt;

namespace {

struct Vector : BallVector {
    Ball square, length;

    explicit Vector(const double* p) : BallVector(p), square(dot_form(v, v)), length(sqrt(square)) {}

    Vector opposite() const {
        Vector result = *this;
        for (Ball& component : result.v) {
            component = -component;
        }
        return result;
    }
};

// q|p| - p|q|, a positive multiple of the chord from p/|p| to q/|q|.
struct Chord : BallVector {
    Chord(const Vector& p, const Vector& q) : Chord(p, q, cross(p, q)) {}

    Chord(const Vector& p, const Vector& q, const BallVector& normal) {
        Ball products[3];
        for (int k = 0; k < 3; ++k) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            products[k] = normal.v[k] * (p.v[i] * q.v[j] + p.v[j] * q.v[i]);
        }
        for (int k = 0; k < 3; ++k) {
            const Ball end = q.v[k] * p.length, start = p.v[k] * q.length;
            const bool alike = q.v[k].sign() * p.v[k].sign() > 0;
            v[k] = alike ? (products[(k + 1) % 3] - products[(k + 2) % 3]) / (end + start) : end - start;
        }
    }

    Ball square() const { return dot_form(v, v); }
};

// How far two directions are apart, in powers of two: a guess, but for directions that are the same or opposite.
int distance(const Vector& p, const Vector& q, const BallVector& normal) {
    constexpr int LARGE = 3;
    return dot_form(p.v, q.v).sign() > 0 ? normal.exponent() - p.length.exponent() - q.length.exponent() : LARGE;
}

}  // namespace

bool is_wide(const double* vector) {
    const double x = std::fabs(vector[0]), y = std::fabs(vector[1]), z = std::fabs(vector[2]);
    const double limit = 0x1p-64 * std::max({x, y, z});  // 0 only for subnormal vectors, whose integers are short
    const auto is_small = [limit](double component) { return component != 0.0 && component < limit; };
    return is_small(x) || is_small(y) || is_small(z);
}

// The bubble test is det[b'-a' c'-a' p'-a'] of the unit vectors (see ray_stages.hpp). The edges of any spanning tree of
// the four serve; those of the shortest tree are nowhere a small difference of long ones, and nothing but the
// determinant itself is left to cancel.
Sign bubble_balls(const double* a, const double* b, const double* c, const double* p) {
    const std::array<Vector, 4> points = {Vector(a), Vector(b), Vector(c), Vector(p)};
    const std::array<BallVector, SpanningEdges::PAIRS> normals = {
        cross(points[0], points[1]), cross(points[0], points[2]), cross(points[0], points[3]),
        cross(points[1], points[2]), cross(points[1], points[3]), cross(points[2], points[3])};
    const SpanningEdges edges([&](std::size_t pair, std::size_t from, std::size_t to) {
        return distance(points[from], points[to], normals[pair]);
    });
    const auto chord = [&](std::size_t k) {
        const SpanningEdges::Edge edge = edges[k];
        return Chord(points[edge.from], points[edge.to], normals[edge.pair]);
    };
    const Chord first = chord(0), second = chord(1), third = chord(2);
    const Sign sign = determinant_form(first.v, second.v, third.v).sign();
    return sign == OPEN ? OPEN : edges.orientation() * sign;
}

Sign turn_balls(const double* a, const double* b, const double* c) {
    const Vector u(a), v(b), w(c);
    return determinant_form(u.v, v.v, w.v).sign();
}

Sign compare_component_balls(const double* a, const double* b, int k) {
    return Chord(Vector(b), Vector(a)).v[k].sign();
}

namespace {

// Sign of the angle between p and a less that between q and b: by the cosines, or, where these nearly agree, by the
// squared chords, or, for two obtuse angles, by those to the opposite ends: both are far below 4 then.
Sign compare_chords(const Vector& p, const Vector& a, const Vector& q, const Vector& b) {
    const Ball pa = dot_form(p.v, a.v), qb = dot_form(q.v, b.v);
    const Sign by_cosines = (qb * (p.length * a.length) - pa * (q.length * b.length)).sign();
    if (by_cosines != OPEN) {
        return by_cosines;
    }
    const bool obtuse = pa.sign() < 0 && qb.sign() < 0;
    const Ball first = (obtuse ? Chord(p, a.opposite()) : Chord(p, a)).square();
    const Ball second = (obtuse ? Chord(q, b.opposite()) : Chord(q, b)).square();
    const Sign sign = (first * (q.square * b.square) - second * (p.square * a.square)).sign();
    return obtuse && sign != OPEN ? -sign : sign;
}

}  // namespace

// (q.b)|a| - (q.a)|b| = q.(b|a| - a|b|), which does not cancel where a and b are close to each other and far from q.
Sign compare_angles_balls(const double* q, const double* a, const double* b) {
    const Vector vertex(q), u(a), v(b);
    const Sign sign = dot_form(vertex.v, Chord(u, v).v).sign();
    return sign != OPEN ? sign : compare_chords(vertex, u, vertex, v);
}

Sign compare_lengths_balls(const double* p, const double* a, const double* q, const double* b) {
    return compare_chords(Vector(p), Vector(a), Vector(q), Vector(b));
}

Sign diametral_balls(const double* a, const double* b, const double* p) {
    const Vector u(a), v(b), w(p);
    return dot_form(Chord(w, u).v, Chord(w, v).v).sign();
}

// (b'-a') x (c'-a') along the axis, of two sides of the triangle, one after the other: those beside its longest one.
Sign shadow_balls(const double* a, const double* b, const double* c, int axis) {
    const int i = axis == 0 ? 1 : 0, j = axis == 2 ? 1 : 2;
    const Vector points[3] = {Vector(a), Vector(b), Vector(c)};
    const BallVector normals[3] = {cross(points[0], points[1]), cross(points[1], points[2]),
                                   cross(points[2], points[0])};
    int longest = 0, length = 0;
    for (int k = 0; k < 3; ++k) {
        const int candidate = distance(points[k], points[(k + 1) % 3], normals[k]);
        if (k == 0 || candidate > length) {
            longest = k;
            length = candidate;
        }
    }
    const int next = (longest + 1) % 3, last = (longest + 2) % 3;
    const Chord first(points[next], points[last], normals[next]), second(points[last], points[longest], normals[last]);
    return (first.v[i] * second.v[j] - first.v[j] * second.v[i]).sign();
}

// With heights h and g above the pole's equator, p_i/(|p| - h) - q_i/(|q| - g) has the sign of
// (p_i|q| - q_i|p|) + (q_i h - p_i g).
Sign compare_projected_balls(const double* p, const double* q, int axis, int sign, int i) {
    const Vector u(p), v(q);
    const Ball minor = v.v[i] * u.v[axis] - u.v[i] * v.v[axis];
    const Ball difference = Chord(v, u).v[i];
    return (sign > 0 ? difference + minor : difference - minor).sign();
}

// p_i/(|p| - h) - t has the sign of p_i + th - t|p|. For t > 0 that is negative unless p_i + th > 0; then it has the
// sign of the difference of squares, (1 - t)(1 + t) p_i^2 + 2 t h p_i - t^2 y^2 with the third component y. All for
// t < 0 by a mirror.
Sign compare_to_line_balls(const double* p, int axis, int sign, int i, double hi, double lo) {
    const Ball line = Ball(hi) + Ball(lo);
    const Sign side = line.sign();
    if (side == 0 || side == OPEN) {
        return side == 0 ? Ball(p[i]).sign() : OPEN;
    }
    const int k = 3 - axis - i;
    const Ball t = side < 0 ? -line : line, one(1.0);
    const Ball x(side < 0 ? -p[i] : p[i]), y(p[k]), height(sign * p[axis]);
    const Sign reach = (x + t * height).sign();
    if (reach != 1) {
        return reach == OPEN ? OPEN : -side;
    }
    const Ball tx = t * x, ty = t * y;
    const Ball squares = (one - t) * (one + t) * (x * x) + (tx + tx) * height - ty * ty;
    const Sign result = squares.sign();
    return result == OPEN ? OPEN : side * result;
}

}  // namespace stereodel::predicates::rays
