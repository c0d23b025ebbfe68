// The convex hull of directions as a closed surface: which facets does a direction see, ties decided.
#pragma once

#include <cstddef>
#include <stdexcept>

#include "mesh/mesh_walk.hpp"
#include "order/charts.hpp"
#include "predicates/ray_predicates.hpp"

namespace stereodel::mesh {

using order::SphereChart;
using predicates::Rays;
using predicates::all_unit;

class SphereSurface {
  public:
    using Chart = SphereChart;
    static constexpr bool has_ghost = false;

    // What the predicates want to know about all vectors: whether they are of length one.
    using Scale = bool;
    static Scale scale_of(const double* xyz, std::size_t count) { return all_unit(xyz, count); }
    static Scale common(Scale a, Scale b) { return a && b; }

    SphereSurface(const double* xyz, Scale unit) : rays_(xyz, unit) {}

    const Tally& tally() const { return rays_.tally; }

    // p is none of the corners.
    bool sees(const Facet& facet, Index p) { return in_bubble(facet.corner[0], facet.corner[1], facet.corner[2], p); }
    bool in_bubble(Index a, Index b, Index c, Index p) { return rays_.in_bubble(a, b, c, p); }

    // From a facet near p.
    //
    // The facets that are not closing (det[a b c] > 0) cover the sphere, or a convex part of it with all vertices.
    // Within it the walk finds the one whose cone holds p, and p sees it. Otherwise the walk leaves across an edge of
    // the border with p strictly beyond the plane of edge and centre. This plane supports the hull between the planes
    // of the two facets at the edge: its outward normal is a combination of theirs with coefficients >= 0. So p sees
    // one of the two.
    Location locate(const Mesh& mesh, Index near, Index p, Stop stop) {
        const WalkedMesh walked{mesh, [this](const Facet& facet) { return is_open(facet); }};
        const Index start = open_near(mesh, near);
        const WalkEnd end = walk(walked, start, [&](Index u, Index v) { return rays_.turn(u, v, p); }, stop);
        const Facet& facet = mesh[end.triangle];
        if (end.exit >= 0) {
            const Index closing = facet.neighbor[static_cast<std::size_t>(end.exit)];
            return {sees(facet, p) ? end.triangle : closing, nobody};
        }
        for (std::size_t k = 0; k < 3 && end.on_line(); ++k) {
            if (end.side[(k + 1) % 3] == 0 && end.side[(k + 2) % 3] == 0 && rays_.compare(facet.corner[k], p) == 0) {
                return {end.triangle, facet.corner[k]};
            }
        }
        return {end.triangle, nobody};
    }

    // Whether all that remains lies on a great circle: every facet then has the centre in its plane.
    bool is_flat(const Mesh& mesh) {
        for (Index t = 0; t < mesh.slots(); ++t) {
            const auto& c = mesh[t].corner;
            if (mesh.in_use(t) && rays_.turn(c[0], c[1], c[2]) != 0) {
                return false;
            }
        }
        return true;
    }

  private:
    bool is_open(const Facet& facet) { return rays_.turn(facet.corner[0], facet.corner[1], facet.corner[2]) > 0; }

    // A facet that is not closing, at a vertex of the given one. There is one at every vertex w: otherwise -w, like the
    // rest of the hull seen from w, would lie on the outer side of all of them, and the hull would reach beyond w, out
    // of the sphere.
    Index open_near(const Mesh& mesh, Index near) {
        const Index vertex = mesh[near].corner[0];
        Index t = near;
        while (!is_open(mesh[t])) {
            t = mesh.next_around(t, vertex);
            if (t == near) {
                throw std::invalid_argument("no hull of directions: a vertex has closing facets alone");
            }
        }
        return t;
    }

    Rays rays_;
};

}  // namespace stereodel::mesh
