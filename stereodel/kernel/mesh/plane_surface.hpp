// The plane as a closed surface: which facets does a point see, ties decided. The ghost, the plane's point at infinity,
// takes part in no displacement and wins every tie: a point within an edge of the hull sees the facet beyond it.
#pragma once

#include <algorithm>
#include <cstddef>

#include "mesh/mesh_walk.hpp"
#include "order/charts.hpp"
#include "predicates/plane_predicates.hpp"

namespace stereodel::mesh {

using order::PlaneChart;
using predicates::PlanePoints;
using predicates::common_granularity;

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

    // Of the hull of the lifted points: whether p sees a facet, which may be clockwise in the plane; four different
    // points. None sees a facet on its own line; such facets are made and taken away again while a hole is filled.
    // Their points are the corners of a convex polygon in a vertical plane, and other points see all of it or nothing,
    // however it is cut.
    bool in_bubble(Index a, Index b, Index c, Index p) { return points_.in_circle(a, b, c, p); }

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

    PlanePoints points_;
};

}  // namespace stereodel::mesh
