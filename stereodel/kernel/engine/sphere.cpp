#include "engine/sphere.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include "duplicates.hpp"
#include "engine/projected_sites.hpp"
#include "mesh/corners.hpp"
#include "mesh/polygon_fill.hpp"
#include "predicates/ray_predicates.hpp"

namespace stereodel::engine {

using mesh::PolygonFill;
using predicates::Rays;
using predicates::all_unit;

namespace {

constexpr double coordinate_axes[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};

// Whether two vectors have one direction or opposite ones: their plane is that of any third.
bool dependent(Rays& rays, Index a, Index b) {
    const auto in_plane = [&](const double* axis) { return rays.turn(a, b, axis) == 0; };
    return std::all_of(coordinate_axes, coordinate_axes + 3, in_plane);
}

// Whether all directions lie on one great circle.
bool on_one_great_circle(Rays& rays, Index count, Stop stop) {
    Index b = 1;
    while (b < count && dependent(rays, 0, b)) {
        ++b;
    }
    for (Index c = b + 1; c < count; ++c) {
        check(stop);
        if (rays.turn(0, b, c) != 0) {
            return false;
        }
    }
    return true;
}

// Points without triangles: which are repeated, and whether there are one or more.
Triangulation flat(Rays& rays, Index count, Stop stop) {
    std::vector<Index> order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), 0);
    const auto compare = [&](Index a, Index b) {
        check(stop);
        return rays.compare(a, b);
    };
    Triangulation result;
    const std::size_t distinct = sort_and_drop(order, Comparison(compare), nullptr, result.duplicates);
    std::sort(result.duplicates.begin(), result.duplicates.end());
    result.dimension = static_cast<int>(std::min<std::size_t>(distinct, 2)) - 1;
    return result;
}

// The points that the projection can show, and those at its pole.
struct Division {
    std::vector<Index> others;  // empty if these are all
    std::vector<Index> at_pole;

    Division(const ProjectedRays& rays, std::size_t count, Crew& crew) {
        const std::size_t pieces = crew.size();
        std::vector<std::vector<Index>> found(pieces);
        crew.run(pieces, [&](std::size_t k) { found[k] = find(rays, Piece(count, k, pieces)); });
        for (const std::vector<Index>& part : found) {
            at_pole.insert(at_pole.end(), part.begin(), part.end());
        }
        for (std::size_t k = 0, next = 0; !at_pole.empty() && k < count; ++k) {
            if (next < at_pole.size() && static_cast<Index>(k) == at_pole[next]) {
                ++next;
            } else {
                others.push_back(static_cast<Index>(k));
            }
        }
    }

    std::size_t shown(std::size_t count) const { return count - at_pole.size(); }
    Index number(std::size_t k) const { return others.empty() ? static_cast<Index>(k) : others[k]; }

  private:
    static std::vector<Index> find(const ProjectedRays& rays, Piece piece) {
        const int along = rays.pole.axis, x = (along + 1) % 3, y = (along + 2) % 3;
        std::vector<Index> result;
        for (std::size_t k = piece.begin; k < piece.end; ++k) {
            const double* const p = rays.at(static_cast<Index>(k));
            if (p[x] == 0.0 && p[y] == 0.0 && rays.pole.sign * p[along] > 0.0) {
                result.push_back(static_cast<Index>(k));
            }
        }
        return result;
    }
};

bool all_unit(const double* xyz, std::size_t count, Crew& crew) {
    const std::size_t pieces = crew.size();
    std::vector<char> unit(pieces);
    crew.run(pieces, [&](std::size_t k) {
        const Piece piece(count, k, pieces);
        unit[k] = predicates::all_unit(xyz + 3 * piece.begin, piece.end - piece.begin) ? 1 : 0;
    });
    return std::find(unit.begin(), unit.end(), 0) == unit.end();
}

// What closes the sphere around the pole.
class Closure {
  public:
    // The border of the hole: edges with the hole on the left, counterclockwise around it.
    Closure(const Edges& edges, Index hull_edge, const Index* source) {
        Index e = hull_edge ^ 1;
        do {
            border_.push_back(e);
            cycle_.push_back(source[edges.origin(e)]);
            e = edges.prev(e ^ 1);
        } while (e != (hull_edge ^ 1));
    }

    std::size_t border_size() const { return border_.size(); }

    // Triangles of the border's points alone: what the artificial pole saw of them.
    void fill(Rays rays, Tally& tally, Stop stop) {
        PolygonFill filled;
        filled.run(cycle_, [&](Index a, Index b, Index c, Index p) { return rays.in_bubble(a, b, c, p); }, stop);
        triangles_ = filled.triangles();
        for (std::size_t k = 0; k < border_.size(); ++k) {
            at_border_.push_back(filled.triangle_at(k));
        }
        tally += rays.tally;
    }

    // Triangles that join the border to a point.
    void join(Index point) {
        const Index size = static_cast<Index>(border_.size());
        cycle_.push_back(point);
        for (Index k = 0; k < size; ++k) {
            const Index following = k + 1 == size ? 0 : k + 1, preceding = k == 0 ? size - 1 : k - 1;
            triangles_.push_back({{k, following, size}, {following, preceding, PolygonFill::border}});
            at_border_.push_back(k);
        }
    }

    std::size_t count() const { return triangles_.size(); }

    // Tell the writer what lies beyond the border; `first` is the row where the triangles here begin.
    void leave_out(TriangleWriter& writer, std::size_t first) const {
        for (std::size_t k = 0; k < border_.size(); ++k) {
            writer.leave_out(border_[k], static_cast<Index>(first) + at_border_[k]);
        }
    }

    // Write the triangles here, when all others have their numbers.
    void write(const Edges& edges, std::size_t first, Triangles& triangles) const {
        for (std::size_t k = 0; k < triangles_.size(); ++k) {
            const PolygonFill::Triangle& triangle = triangles_[k];
            const Three corners{vertex(triangle.corner[0]), vertex(triangle.corner[1]), vertex(triangle.corner[2])};
            const std::size_t least = place_of_least(corners.data());
            for (std::size_t j = 0; j < 3; ++j) {
                const std::size_t place = 3 * (first + k) + j, corner = (least + j) % 3;
                triangles.corners[place] = corners[corner];
                if (triangles.neighbors.size() != 0) {
                    triangles.neighbors[place] = neighbor(edges, first, triangle, corner);
                }
            }
        }
    }

  private:
    using Three = std::array<Index, 3>;

    Index vertex(Index place) const { return cycle_[static_cast<std::size_t>(place)]; }

    // What lies opposite a corner: a triangle here, or the one across the border edge that begins at the next corner.
    Index neighbor(const Edges& edges, std::size_t first, const PolygonFill::Triangle& triangle,
                   std::size_t corner) const {
        const Index here = triangle.neighbor[corner];
        if (here != PolygonFill::border) {
            return static_cast<Index>(first) + here;
        }
        const std::size_t begin = static_cast<std::size_t>(triangle.corner[(corner + 1) % 3]);
        return edges.prev(border_[begin] ^ 1);
    }

    std::vector<Index> border_, cycle_, at_border_;
    std::vector<PolygonFill::Triangle> triangles_;
};

// Write all: what was triangulated around the pole's antipode, then what closes it at the pole.
void write_sphere(CurveTriangulation<ProjectedSites>& work, const Closure& closure, CurveArrays& arrays,
                  std::size_t distinct, bool with_neighbors, Crew& crew, Stop stop, Triangles& triangles) {
    const std::size_t count = 2 * distinct - 4, first = count - closure.count();  // Euler
    triangles.corners = Buffer<Index>(std::move(arrays.sorted_items), 3 * count);
    if (with_neighbors) {
        triangles.neighbors = Buffer<Index>(std::move(arrays.points), 3 * count);
    }
    TriangleWriter writer(work.edges, arrays.source.data());
    closure.leave_out(writer, first);
    write_triangles(writer, work.ranges, triangles, crew, stop);
    closure.write(work.edges, first, triangles);
}

}  // namespace

Triangulation triangulate_sphere(const double* xyz, std::size_t count, bool with_neighbors, int workers, Pole pole,
                                 Stop stop) {
    check_size(count);
    Crew crew(useful_workers(workers, count));
    const bool unit = all_unit(xyz, count, crew);
    Rays exact(xyz, unit);
    if (count == 0) {
        return {};
    }
    if (on_one_great_circle(exact, static_cast<Index>(count), stop)) {
        return flat(exact, static_cast<Index>(count), stop);
    }
    ProjectedRays rays{xyz, unit, pole, true};
    const Division division(rays, count, crew);
    rays.artificial = division.at_pole.empty();
    // Projected once, into memory that becomes the edges'.
    Buffer<Point2> projected(count * Edges::bytes_a_point / sizeof(Point2) + 1);
    const auto key = [&](Index p) {
        const ProjectedRays::Ratio ratio = rays.ratio(p);
        projected[static_cast<std::size_t>(p)] = ratio.point();
        return whole_plane_key(rays, p, ratio);
    };
    CurveArrays arrays = CurveArrays::sorted(
        division.shown(count), [&](std::size_t k) { return division.number(k); },
        [&](Index p) { return projected[static_cast<std::size_t>(p)]; }, key, crew, stop);
    CurveTriangulation<ProjectedSites> work(arrays, ProjectedSites(arrays, rays), crew, std::move(projected));

    Triangulation result;
    result.dimension = 2;
    result.tally = work.tally;
    result.duplicates = std::move(work.duplicates);
    for (std::size_t k = 1; k < division.at_pole.size(); ++k) {
        result.duplicates.emplace_back(division.at_pole[k], division.at_pole[0]);
    }
    std::sort(result.duplicates.begin(), result.duplicates.end());

    Closure closure(work.edges, work.whole.edge, arrays.source.data());
    if (rays.artificial) {
        closure.fill(exact, result.tally, stop);
    } else {
        closure.join(division.at_pole[0]);
    }
    write_sphere(work, closure, arrays, count - result.duplicates.size(), with_neighbors, crew, stop, result.triangles);
    return result;
}

void closing_facets(const double* xyz, std::size_t size, const Index* simplices, std::size_t count, bool* closing,
                    Stop stop) {
    Rays rays(xyz, all_unit(xyz, size));
    for_range(0, count, stop, [&](std::size_t k) {
        closing[k] = rays.turn(simplices[3 * k], simplices[3 * k + 1], simplices[3 * k + 2]) <= 0;
    });
}

}  // namespace stereodel::engine
