#include "engine/plane.hpp"

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/curve_sites.hpp"
#include "order/square_grid.hpp"
#include "predicates/plane_predicates.hpp"

namespace stereodel::engine {

using order::SquareGrid;
using predicates::PlanePoints;
using predicates::common_granularity;

namespace {

class SortedPoints : public CurveSites {
  public:
    SortedPoints(CurveArrays& arrays, double granularity)
        : CurveSites(arrays), predicates_(&arrays.points.data()->x, granularity) {
        predicates_.remember_circles();  // where something was asked about places, these are in their final order
    }

    int orient(Index a, Index b, Index c) { return predicates_.orient(a, b, c); }
    bool in_circle(Index a, Index b, Index c, Index d) { return predicates_.in_circle(a, b, c, d); }

    bool before(Index a, Index b, Axis axis) const {
        const Point2 p = points_[a], q = points_[b];
        return axis == Axis::x ? p.x < q.x || (p.x == q.x && p.y < q.y) : p.y < q.y || (p.y == q.y && p.x < q.x);
    }

    bool refine(Index low, Index high) {
        SquareGrid grid;
        for (Index a = low; a < high; ++a) {
            grid.include(points_[a]);
        }
        if (!grid.fit()) {
            return false;
        }
        sort_range(low, high, [&](Index a) { return grid.key(points_[a]); });
        return key(low) != key(high - 1);
    }

    void sort_few(Index low, Index high) {
        insertion_sort(low, high, [this](Index a, Index b) { return before(a, b, Axis::x); });
    }

    Index sort_distinct(Index low, Index high) {
        return sort_and_drop(low, high, [this](Index a, Index b) {
            return before(a, b, Axis::x) ? -1 : (before(b, a, Axis::x) ? 1 : 0);
        });
    }

    const Tally& tally() const { return predicates_.tally; }

  private:
    PlanePoints predicates_;
};

template <class PointOf>
SquareGrid bounding_grid(PointOf&& point, std::size_t count, Crew& crew) {
    const std::size_t pieces = crew.size();
    std::vector<SquareGrid> parts(pieces);
    crew.run(pieces, [&](std::size_t k) {
        SquareGrid grid;
        const Piece piece(count, k, pieces);
        for (std::size_t i = piece.begin; i < piece.end; ++i) {
            grid.include(point(static_cast<Index>(i)));
        }
        parts[k] = grid;
    });
    SquareGrid grid;
    for (const SquareGrid& part : parts) {
        grid.include(part);
    }
    grid.fit();
    return grid;
}

// Leave out what lies outside the hull. Returns how many edges border it.
std::size_t leave_out_hull(const Edges& edges, Index hull_edge, TriangleWriter& writer) {
    std::size_t count = 0;
    Index e = hull_edge;
    do {
        const Index following = edges.next(e ^ 1);
        writer.leave_out(e ^ 1, outside);
        e = following;
        ++count;
    } while (e != hull_edge);
    return count;
}

}  // namespace

Triangulation triangulate_plane(const double* xy, std::size_t count, bool with_neighbors, int workers, Stop stop) {
    check_size(count);
    Triangulation result;
    if (count == 0) {
        return result;
    }
    Crew crew(useful_workers(workers, count));
    const auto number = [](std::size_t k) { return static_cast<Index>(k); };
    const auto point = [xy](Index k) {
        const double* const p = xy + 2 * static_cast<std::ptrdiff_t>(k);
        return Point2{p[0], p[1]};
    };
    const SquareGrid grid = bounding_grid(point, count, crew);
    const auto key = [&](Index k) { return grid.key(point(k)); };
    CurveArrays arrays = CurveArrays::sorted(count, number, point, key, crew, stop);
    const SortedPoints sites(arrays, common_granularity(xy, count));
    CurveTriangulation<SortedPoints> work(arrays, sites, crew, Buffer<char>());
    result.duplicates = std::move(work.duplicates);
    result.tally = work.tally;
    const std::size_t distinct = count - result.duplicates.size();
    result.dimension = distinct == 1 ? 0 : 1;
    if (distinct < 3) {
        return result;
    }
    TriangleWriter writer(work.edges, arrays.source.data());
    const std::size_t hull = leave_out_hull(work.edges, work.whole.edge, writer);
    const std::size_t triangles = 2 * distinct - 2 - hull;  // Euler; 0 for a path, whose hull goes there and back
    result.dimension = triangles > 0 ? 2 : 1;
    result.triangles.corners = Buffer<Index>(std::move(arrays.sorted_items), 3 * triangles);
    if (with_neighbors) {
        result.triangles.neighbors = Buffer<Index>(std::move(arrays.points), 3 * triangles);
    }
    write_triangles(writer, work.ranges, result.triangles, crew, stop);
    return result;
}

}  // namespace stereodel::engine
