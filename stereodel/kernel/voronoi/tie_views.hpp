// Which edges of a triangulation are tied: views of the points for one thread, as `DualTriangles::find_ties` asks them.
#pragma once

#include <cstddef>
#include <vector>

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
    void prepare(const DualTriangles&, std::size_t, std::size_t) {}

    bool is_tied(const DualTriangles& dual, HalfEdge e, HalfEdge twin) {
        const Index* c = dual.corners(e.t);
        return points.incircle(c[0], c[1], c[2], dual.corners(twin.t)[twin.place]) == 0;
    }
};

// Points all on one small circle form a flat polygon with two sides: across its rim the corners lie on one circle, too,
// but the triangles face different ways.
class SphereView {
  public:
    explicit SphereView(const Rays& rays) : rays_(rays) {}

    void fetch(Index site) const {
        prefetch(rays_.at(site));
        prefetch(rays_.at(site) + 2);  // it may begin at the end of a cache line
    }

    void prepare(const DualTriangles& dual, std::size_t begin, std::size_t end) {
        first_ = begin;
        planes_.resize(rays_.unit() ? end - begin : 0);
        for (std::size_t k = 0; k < planes_.size(); ++k) {
            const Index* c = dual.corners(static_cast<Index>(begin + k));
            planes_[k] = rays::BubblePlane(rays_.at(c[0]), rays_.at(c[1]), rays_.at(c[2]));
        }
    }

    bool is_tied(const DualTriangles& dual, HalfEdge e, HalfEdge twin) {
        const Index *c = dual.corners(e.t), *d = dual.corners(twin.t), beyond = d[twin.place];
        if (rays_.unit() &&
            planes_[static_cast<std::size_t>(e.t) - first_].side(rays_.at(c[0]), rays_.at(beyond)) != OPEN) {
            return false;
        }
        return rays_.bubble(c[0], c[1], c[2], beyond) == 0 &&
               rays_.turn(c[0], c[1], c[2]) == rays_.turn(d[0], d[1], d[2]);
    }

  private:
    Rays rays_;
    std::size_t first_ = 0;
    std::vector<rays::BubblePlane> planes_;  // of the triangles from that one on
};

// What makes a view for each thread.
template <std::size_t Width>
auto views_of(const double* points, std::size_t sites) {
    if constexpr (Width == 2) {
        const double granularity = predicates::common_granularity(points, sites);
        return [=] { return PlaneView{PlanePoints(points, granularity)}; };
    } else {
        const bool unit = predicates::all_unit(points, sites);
        return [=] { return SphereView(Rays(points, unit)); };
    }
}

}  // namespace stereodel::voronoi
