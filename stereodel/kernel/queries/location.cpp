#include "queries/location.hpp"

#include <algorithm>

#include "mesh/walk.hpp"
#include "queries/query_pieces.hpp"

namespace stereodel::queries {

using mesh::WalkEnd;
using mesh::walk;

namespace {

// The lowest triangle at a vertex; remembers the last answer, because sorted queries ask for the same vertex in turn.
class LowestAtVertex {
  public:
    explicit LowestAtVertex(const TriangleArrays& triangles) : triangles_(triangles) {}

    // `t`: a triangle at the vertex that may be entered.
    Index operator()(Index vertex, Index t) {
        if (vertex != vertex_) {
            vertex_ = vertex;
            lowest_ = t;
            triangles_.around(vertex, t, [this](Index other) {
                if (triangles_.may_enter(other)) {
                    lowest_ = std::min(lowest_, other);
                }
            });
        }
        return lowest_;
    }

  private:
    const TriangleArrays& triangles_;
    Index vertex_ = -1;
    Index lowest_ = -1;
};

template <class Query>
class Finder {
  public:
    Finder(const TriangleArrays& triangles, Stop stop)
        : triangles_(triangles), query_(triangles.points()), lowest_(triangles), stop_(stop) {}

    // The triangle of a query, looked for from `near` on, which becomes the last one on the way.
    Index find(const double* query, Index& near) {
        query_.take(query);
        const WalkEnd end = walk(triangles_, near, [this](Index u, Index v) { return query_.side(u, v); }, stop_);
        near = end.triangle;
        if (end.exit >= 0) {
            return -1;
        }
        return end.on_line() ? lowest(end) : end.triangle;
    }

  private:
    // Of the triangles that share the edge or the corner on which the query lies.
    Index lowest(const WalkEnd& end) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (end.side[k] != 0 && end.side[(k + 1) % 3] == 0 && end.side[(k + 2) % 3] == 0) {
                return lowest_(triangles_.corners(end.triangle)[k], end.triangle);
            }
        }
        const std::size_t k = end.side[0] == 0 ? 0 : end.side[1] == 0 ? 1 : 2;
        const Index across = triangles_.neighbors(end.triangle)[k];
        return triangles_.may_enter(across) ? std::min(across, end.triangle) : end.triangle;
    }

    const TriangleArrays& triangles_;
    Query query_;
    LowestAtVertex lowest_;
    Stop stop_;
};

}  // namespace

template <std::size_t Width>
void find_simplex(const TriangleArrays& triangles, const double* queries, std::size_t count, Index* found, int workers,
                  Stop stop) {
    using Query = QueryOf<Width>;
    const Index start = first_open(triangles);
    if (start == static_cast<Index>(triangles.count())) {
        std::fill_n(found, count, -1);
        return;
    }
    for_queries<typename Query::Chart>(triangles, start, queries, count, workers, stop, [&] {
        return [found, finder = Finder<Query>(triangles, stop)](
                   std::size_t k, const double* query, Index& near) mutable { found[k] = finder.find(query, near); };
    });
}

template void find_simplex<2>(const TriangleArrays&, const double*, std::size_t, Index*, int, Stop);
template void find_simplex<3>(const TriangleArrays&, const double*, std::size_t, Index*, int, Stop);

}  // namespace stereodel::queries
