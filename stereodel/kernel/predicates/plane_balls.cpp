// The predicates of the plane in ball arithmetic, of the edges of a shortest tree of the points.
#include <algorithm>
#include <array>
#include <cstddef>

#include "arithmetic/ball.hpp"
#include "predicates/plane_stages.hpp"
#include "predicates/spanning_edges.hpp"

namespace stereodel::predicates::plane {

using arithmetic::Ball;

namespace {

// Differences of doubles are exact, unless one is more than 2^200 times the other: then within 2^-200 of themselves.
struct BallEdge {
    Ball x, y;

    BallEdge(const double* from, const double* to) : x(Ball(to[0]) - Ball(from[0])), y(Ball(to[1]) - Ball(from[1])) {}

    int exponent() const { return std::max(x.exponent(), y.exponent()); }
};

}  // namespace

// Of two sides of the triangle, one after the other: those beside its longest one.
Sign orient_balls(const double* a, const double* b, const double* c) {
    const std::array<BallEdge, 3> sides = {BallEdge(a, b), BallEdge(b, c), BallEdge(c, a)};
    const auto shorter = [](const BallEdge& s, const BallEdge& t) { return s.exponent() < t.exponent(); };
    const auto place = std::max_element(sides.begin(), sides.end(), shorter) - sides.begin();
    const auto longest = static_cast<std::size_t>(place);
    const BallEdge &first = sides[(longest + 1) % 3], &second = sides[(longest + 2) % 3];
    return cross_form(first.x, first.y, second.x, second.y).sign();
}

// det[j - i, |j - r|^2 - |i - r|^2] over three edges ij of a tree: for any root r that is the determinant of the points
// relative to d. The difference of squares is (j - i).((j - r) + (i - r)). With the shortest tree, and the root on its
// shortest edge, nothing is a small difference of large numbers but the determinant itself, or by chance.
Sign incircle_balls(const double* a, const double* b, const double* c, const double* d) {
    const double* const points[4] = {d, a, b, c};
    const std::array<BallEdge, SpanningEdges::PAIRS> pairs = {BallEdge(d, a), BallEdge(d, b), BallEdge(d, c),
                                                              BallEdge(a, b), BallEdge(a, c), BallEdge(b, c)};
    const SpanningEdges edges([&](std::size_t pair, std::size_t, std::size_t) { return pairs[pair].exponent(); });
    const double* const root = points[edges.root()];
    Ball rows[3][3];
    for (std::size_t k = 0; k < 3; ++k) {
        const SpanningEdges::Edge edge = edges[k];
        const BallEdge &step = pairs[edge.pair], start(root, points[edge.from]), end(root, points[edge.to]);
        rows[k][0] = step.x;
        rows[k][1] = step.y;
        rows[k][2] = dot_form(step.x, step.y, start.x + end.x, start.y + end.y);
    }
    const auto minor = [&](int i, int j) { return cross_form(rows[i][0], rows[i][1], rows[j][0], rows[j][1]); };
    const Ball value = rows[0][2] * minor(1, 2) + rows[1][2] * minor(2, 0) + rows[2][2] * minor(0, 1);
    const Sign sign = value.sign();
    return sign == OPEN ? OPEN : edges.orientation() * sign;
}

Sign diametral_balls(const double* a, const double* b, const double* p) {
    const BallEdge pa(p, a), pb(p, b);
    return dot_form(pa.x, pa.y, pb.x, pb.y).sign();
}

// From one point that is the sum of the differences times that of a and b: they may be far closer to each other.
Sign distances_balls(const double* p, const double* a, const double* q, const double* b) {
    const BallEdge pa(p, a), qb(q, b);
    if (p[0] == q[0] && p[1] == q[1]) {
        const BallEdge ba(b, a);
        return dot_form(ba.x, ba.y, pa.x + qb.x, pa.y + qb.y).sign();
    }
    return (square_form(pa.x, pa.y) - square_form(qb.x, qb.y)).sign();
}

}  // namespace stereodel::predicates::plane
