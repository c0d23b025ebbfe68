// One point at a time: find a facet that it sees, the facets that it sees, their horizon; join the horizon to the
// point.
//
// The paper's pseudo-code, with the projection pole as a ghost vertex in the plane.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <vector>

#include "mesh/mesh_walk.hpp"

namespace stereodel::mesh {

template <class Surface>
class Insertion {
  public:
    Insertion(Mesh& mesh, Surface& surface, Stop stop) : mesh_(mesh), surface_(surface), stop_(stop) {}

    // Insert p, looking for its place from the facet `near` on, which then becomes one that has p. If there is an equal
    // vertex, returns it and inserts nothing.
    Index insert(Index p, Index& near) {
        const Location location = surface_.locate(mesh_, near, p, stop_);
        near = location.facet;
        if (location.equal == nobody) {
            find_horizon(location.facet, p);
            near = make_fan(p);
        }
        return location.equal;
    }

  private:
    // An edge u -> v of a facet that p sees, and the facet across.
    struct Edge {
        Index u, v, across;
    };

    // Take away what p sees, by depth-first search from one such facet; the horizon comes as one counterclockwise
    // cycle. No facet is reached twice: a second way to one would close a ring around a vertex and hide it.
    void find_horizon(Index seen, Index p) {
        horizon_.clear();
        front_.clear();
        const Facet first = mesh_[seen];
        for (std::size_t k = 3; k-- > 0;) {
            front_.push_back({first.corner[k], first.corner[(k + 1) % 3], first.neighbor[(k + 2) % 3]});
        }
        mesh_.release(seen);
        for (std::size_t steps = 1; !front_.empty(); ++steps) {
            if (steps % 4096 == 0) {
                check(stop_);
            }
            const Edge edge = front_.back();
            front_.pop_back();
            const Facet& facet = mesh_[edge.across];
            if (!mesh_.in_use(edge.across)) {
                throw std::invalid_argument("the mesh is no Delaunay triangulation of the points");
            }
            if (!surface_.sees(facet, p)) {
                horizon_.push_back(edge);
                continue;
            }
            const std::size_t k = facet.opposite(edge.u, edge.v);
            const Index w = facet.corner[k];
            front_.push_back({w, edge.v, facet.neighbor[(k + 2) % 3]});
            front_.push_back({edge.u, w, facet.neighbor[(k + 1) % 3]});
            mesh_.release(edge.across);
        }
    }

    // Returns a facet of the fan.
    Index make_fan(Index p) {
        const std::size_t size = horizon_.size();
        fan_.resize(size);
        for (Index& t : fan_) {
            t = mesh_.take();
        }
        for (std::size_t k = 0; k < size; ++k) {
            const Edge& edge = horizon_[k];
            const Index after = fan_[k + 1 == size ? 0 : k + 1], before = fan_[k == 0 ? size - 1 : k - 1];
            mesh_.put(fan_[k], {edge.u, edge.v, p}, {after, before, edge.across});
            mesh_.set_neighbor(edge.across, edge.u, edge.v, fan_[k]);
        }
        return fan_.back();
    }

    Mesh& mesh_;
    Surface& surface_;
    Stop stop_;
    std::vector<Edge> front_, horizon_;
    std::vector<Index> fan_;
};

}  // namespace stereodel::mesh
