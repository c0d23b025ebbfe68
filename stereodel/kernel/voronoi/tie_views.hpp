// Which edges of a triangulation are tied: views of the points for one thread, as `DualTriangles::find_ties` asks them.
#pragma once

#include "memory.hpp"
#include "predicates/plane_predicates.hpp"
#include "predicates/ray_predicates.hpp"
#include "voronoi/dual.hpp"

namespace stereodel::voronoi {

namespace rays = predicates::rays;
using predicates::PlanePoints;
using predicates::Rays;

struct PlaneView {
    PlanePoints points;

    void fetch(Index site) const { prefetch(points.at(site)); }

    bool is_tied(const DualTriangles& dual, HalfEdge e, HalfEdge twin) {
        const Index* c = dual.corners(e.t);
        return points.incircle(c[0], c[1], c[2], dual.corners(twin.t)[twin.place]) == 0;
    }
};

// Points all on one small circle form a flat polygon with two sides: across its rim the corners lie on one circle, too,
// but the triangles face different ways.
struct SphereView {
    Rays rays;

    void fetch(Index site) const {
        prefetch(rays.at(site));
        prefetch(rays.at(site) + 2);  // it may begin at the end of a cache line
    }

    bool is_tied(const DualTriangles& dual, HalfEdge e, HalfEdge twin) {
        const Index *c = dual.corners(e.t), *d = dual.corners(twin.t), beyond = d[twin.place];
        if (rays.unit() &&
            rays::bubble_plane_filter(rays.at(c[0]), rays.at(c[1]), rays.at(c[2]), rays.at(beyond)) != OPEN) {
            return false;
        }
        return rays.bubble(c[0], c[1], c[2], beyond) == 0 &&
               rays.turn(c[0], c[1], c[2]) == rays.turn(d[0], d[1], d[2]);
    }
};

}  // namespace stereodel::voronoi
