// The plane as a closed surface: which facets does a point see, ties decided. The ghost, the plane's point at infinity,
// takes part in no displacement and wins every tie: a point within an edge of the hull sees the facet beyond it.
#pragma once

#include <algorithm>
#include <cstddef>

#include "charts.hpp"
#include "mesh_walk.hpp"
#include "plane_predicates.hpp"

namespace stereodel {

class PlaneSurface {
  public:
    using Chart = PlaneChart;
    static constexpr bool has_ghost = true;

    // What the predicates want to know about all points: a power of two that divides their coordinates, 0 if unknown.
    using Scale = double;
    static Scale scale_of(const double* xy, std::size_t count) { return common_granularity(xy, count); }
    static Scale common(Scale a, Scale b) { return std::min(a, b); }

    PlaneSurface(const double* xy, Scale granularity) : points_(xy, granularity) {}

    const Tally& tally() const { return points_.tally; }
    int orient(Index a, Index b, Index c) { return points_.orient(a, b, c); }

    // p is none of the corners.
    bool sees(const Facet& facet, Index p) {
        const auto& c = facet.corner;
        return facet.is_ghost() ? sees_beyond(c[1], c[2], p) : points_.in_circle(c[0], c[1], c[2], p);
    }

    // Four different points in any order: the sign of incircle, after displacement. Four on a line, which heights do
    // not separate, take second, smaller displacements along x, then along y; they occur between facets that are made
    // and taken away again while a hole is filled.
    bool in_bubble(Index a, Index b, Index c, Index p) {
        const int sign = points_.incircle(a, b, c, p);
        if (sign != 0) {
            return sign > 0;
        }
        const double* four[] = {points_.at(a), points_.at(b), points_.at(c), points_.at(p)};
        return (points_.orient(a, b, c) != 0 ? incircle_tie(four[0], four[1], four[2], four[3]) : line_tie(four)) > 0;
    }

    // From a facet near p.
    Location locate(const Mesh& mesh, Index near, Index p, Stop stop) {
        const WalkedMesh walked{mesh, [](const Facet& facet) { return !facet.is_ghost(); }};
        const Index start = mesh[near].is_ghost() ? mesh[near].neighbor[0] : near;
        const WalkEnd end = walk(walked, start, [&](Index u, Index v) { return points_.orient(u, v, p); }, stop);
        const Facet& facet = mesh[end.triangle];
        if (end.exit >= 0) {
            return {facet.neighbor[static_cast<std::size_t>(end.exit)], nobody};
        }
        for (const Index corner : facet.corner) {
            if (end.on_line() && same(corner, p)) {
                return {end.triangle, corner};
            }
        }
        return {end.triangle, nobody};
    }

    // Whether all that remains lies on a line.
    static bool is_flat(const Mesh& mesh) { return mesh.triangles() == 0; }

  private:
    static bool before(const double* p, const double* q) { return p[0] < q[0] || (p[0] == q[0] && p[1] < q[1]); }

    bool same(Index a, Index b) const {
        const double *p = points_.at(a), *q = points_.at(b);
        return p[0] == q[0] && p[1] == q[1];
    }

    // The facet u v GHOST: whether p lies to the left of u -> v, or within the edge.
    bool sees_beyond(Index u, Index v, Index p) {
        const int side = points_.orient(u, v, p);
        if (side != 0) {
            return side > 0;
        }
        const double *first = points_.at(u), *last = points_.at(v), *middle = points_.at(p);
        return before(first, middle) == before(middle, last);
    }

    // in_bubble for four different points of a line. The first of them in lexicographic order, in row i of the
    // determinant with rows (x, y, x^2 + y^2, 1), moves along x; if the line is parallel to it, along y. Its cofactor
    // is then (-1)^i det[y h 1] or -(-1)^i det[x h 1] of the others, h their heights. With t a coordinate along the
    // line that grows with the lexicographic order, h is quadratic in t with a positive leading coefficient, so det[t h
    // 1] has the sign of the permutation that the others are in; y grows with t or falls, and x grows where y does not
    // change.
    static int line_tie(const double* const* four) {
        const double* rest[4];
        std::copy(four, four + 4, rest);
        const auto first = std::min_element(rest, rest + 4, before) - rest;
        const double dy = four[first == 0 ? 1 : 0][1] - four[first][1];  // may round, but not to zero or past it
        std::copy(rest + first + 1, rest + 4, rest + first);
        int sign = first % 2 == 0 ? 1 : -1;
        for (const auto& [j, k] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
            sign = before(rest[j], rest[k]) ? sign : -sign;
        }
        return dy > 0 ? sign : -sign;
    }

    PlanePoints points_;
};

}  // namespace stereodel
