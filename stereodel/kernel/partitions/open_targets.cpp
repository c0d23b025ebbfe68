#include "partitions/open_targets.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "memory.hpp"
#include "mesh/walk.hpp"
#include "queries/query_pieces.hpp"

namespace stereodel::partitions {

using mesh::WalkEnd;
using mesh::place_opposite;
using mesh::walk;
using queries::TriangleArrays;
using queries::first_open;
using queries::for_queries;

namespace {

// Faces and the target that asks for each; targets are points after all others.
struct AskedFaces {
    std::vector<std::array<Index, 3>> corners;
    std::vector<std::size_t> target;
};

template <class Query>
class FacesOfTargets {
  public:
    FacesOfTargets(const Targets& targets, AskedFaces& faces, Stop stop)
        : targets_(targets), triangles_(targets.triangles), query_(triangles_.points()), faces_(faces), stop_(stop) {}

    void ask(std::size_t target, const double* query, Index& near) {
        target_ = target;
        query_.take(query);
        const WalkEnd end = walk(triangles_, near, [this](Index u, Index v) { return query_.side(u, v); }, stop_);
        near = end.triangle;
        const Index* const c = triangles_.corners(end.triangle);
        if (end.exit >= 0) {
            const auto place = static_cast<std::size_t>(end.exit);
            ask_beyond(c[(place + 1) % 3], c[(place + 2) % 3], triangles_.neighbors(end.triangle)[place]);
            return;
        }
        ask_triangle(end.triangle);
        for (std::size_t k = 0; k < 3; ++k) {
            if (end.side[(k + 1) % 3] == 0 && end.side[(k + 2) % 3] == 0) {  // the corner itself
                triangles_.around(c[k], end.triangle, [this](Index t) { ask_triangle(t); });
                return;
            }
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (end.side[k] == 0) {
                ask_beyond(c[(k + 1) % 3], c[(k + 2) % 3], triangles_.neighbors(end.triangle)[k]);
            }
        }
        if (targets_.natural) {
            ask_conflicts(end.triangle);
        }
    }

  private:
    struct Edge {
        Index u, v, across;
    };

    void add(Index a, Index b, Index c) {
        faces_.corners.push_back({a, b, c});
        faces_.target.push_back(target_);
    }

    void ask_triangle(Index t) {
        const Index* const c = triangles_.corners(t);
        add(c[0], c[1], c[2]);
    }

    // What lies beyond the edge u -> v of a triangle.
    void ask_beyond(Index u, Index v, Index across) {
        if (across < 0) {
            add(u, v, -1);
        } else {
            ask_triangle(across);
        }
    }

    // Beyond the hull's edge nothing but its half-plane counts: the rest of the bubble of the edge and the target lies
    // in those of triangles that go.
    void ask_conflicts(Index first) {
        const Index* const c = triangles_.corners(first);
        front_.clear();
        for (std::size_t k = 0; k < 3; ++k) {
            front_.push_back({c[(k + 1) % 3], c[(k + 2) % 3], triangles_.neighbors(first)[k]});
        }
        while (!front_.empty()) {
            check(stop_);
            const Edge edge = front_.back();
            front_.pop_back();
            if (edge.across < 0) {
                add(edge.u, edge.v, -1);
                continue;
            }
            const Index* const corners = triangles_.corners(edge.across);
            if (!query_.sees(corners)) {
                add(edge.u, edge.v, static_cast<Index>(targets_.points + target_));
                continue;
            }
            ask_triangle(edge.across);
            const Index* const across = triangles_.neighbors(edge.across);
            const std::size_t k = place_opposite(corners, edge.u, edge.v);
            front_.push_back({corners[(k + 2) % 3], corners[k], across[(k + 1) % 3]});
            front_.push_back({corners[k], corners[(k + 1) % 3], across[(k + 2) % 3]});
        }
    }

    const Targets& targets_;
    const TriangleArrays& triangles_;
    Query query_;
    AskedFaces& faces_;
    Stop stop_;
    std::size_t target_ = 0;
    std::vector<Edge> front_;
};

}  // namespace

template <std::size_t Width>
void open_targets(const Targets& targets, const BoxTree<Width>& tree, const Openness& openness, Stop stop) {
    using Query = queries::QueryOf<Width>;
    AskedFaces asked;
    for_queries<typename Query::Chart>(
        targets.triangles, first_open(targets.triangles), targets.queries, targets.count, 1, stop, [&] {
            return [faces = FacesOfTargets<Query>(targets, asked, stop)](std::size_t k, const double* query,
                                                                         Index& near) mutable {
                faces.ask(k, query, near);
            };
        });
    Buffer<double> points(Width * (targets.points + targets.count));
    std::copy_n(targets.triangles.points(), Width * targets.points, points.data());
    std::copy_n(targets.queries, Width * targets.count, points.data() + Width * targets.points);
    Buffer<bool> is_open(asked.corners.size());
    const Faces faces{points.data(), targets.points + targets.count,
                      asked.corners.empty() ? nullptr : asked.corners.front().data(), asked.corners.size(), nullptr};
    open_bubbles(faces, tree, Openness{is_open.data(), openness.depth}, stop);
    std::fill_n(openness.is_open, targets.count, false);
    for (std::size_t k = 0; k < asked.target.size(); ++k) {
        openness.is_open[asked.target[k]] |= is_open[k];
    }
}

template void open_targets<2>(const Targets&, const BoxTree<2>&, const Openness&, Stop);
template void open_targets<3>(const Targets&, const BoxTree<3>&, const Openness&, Stop);

}  // namespace stereodel::partitions
