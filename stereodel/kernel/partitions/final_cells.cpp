#include "partitions/final_cells.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "arithmetic/arc_tangent.hpp"
#include "growing_array.hpp"
#include "partitions/site_ids.hpp"
#include "queries/queries.hpp"
#include "voronoi/cell_integrals.hpp"
#include "voronoi/chosen_cells.hpp"
#include "voronoi/unit_vectors.hpp"

namespace stereodel::partitions {

namespace rays = predicates::rays;
using arithmetic::vector_angle;
using voronoi::Cells;
using voronoi::ChosenCells;
using voronoi::Ray;
using voronoi::RayEdge;
using voronoi::unit_vector;

namespace {

double distance_in_plane(const double* p, const double* q) {
    const double x = q[0] - p[0], y = q[1] - p[1];
    int exponent = 0;
    std::frexp(std::max(std::fabs(x), std::fabs(y)), &exponent);
    const double u = std::ldexp(x, -exponent), v = std::ldexp(y, -exponent);
    return std::ldexp(std::sqrt(u * u + v * v), exponent);
}

double length_of(const RayEdge& edge) {
    const double v[3] = {edge.v[0].hi, edge.v[1].hi, edge.v[2].hi};
    return std::ldexp(std::sqrt(rays::dot_form(v, v)), edge.exponent);
}

// Twice the angle that has the lengths of q - p and q + p as sine and cosine. Differences of unit vectors are off by
// 2^-99 and two roundings; of points that are closer than 2^-45 the edge of their rays is asked, and beyond 90 degrees
// for the sum, too.
double distance_on_sphere(const double* p, const double* q) {
    const rays::Difference across(unit_vector(p), unit_vector(q));
    const double square = rays::dot_form(across.v, across.v);
    if (square > 0x1p-90 && square < 2.0) {
        return 2 * vector_angle(std::sqrt(square), std::sqrt(4 - square));
    }
    const Ray a(p), b(q);
    Ray opposite(a);
    for (auto& x : opposite.v) {
        x = -x;
    }
    return 2 * vector_angle(length_of(RayEdge(a, b)), length_of(RayEdge(opposite, b)));
}

// The nearest site is a neighbour in every diagram: the disc that has both as ends of a diameter lies in the one around
// the site through its nearest, and touches the rim of that there alone.
template <class Query>
class NearestOfCells {
  public:
    NearestOfCells(const double* points, const SiteIds& ids, const Cells& cells)
        : points_(points), ids_(ids), cells_(cells), query_(points) {}

    Index find(Index site) {
        query_.take(points_ + Query::Chart::dimension * static_cast<std::size_t>(site));
        const std::size_t row = static_cast<std::size_t>(site), end = cells_.end(row);
        Index best = cells_.neighbors[cells_.begin(row)];
        double least = query_.square(best);
        for (std::size_t k = cells_.begin(row) + 1; k < end; ++k) {
            const Index other = cells_.neighbors[k];
            const double square = query_.square(other);
            Sign sign = query_.compare_squares(square, least);
            if (sign == OPEN) {
                sign = query_.compare(other, best);
            }
            if (sign < 0 || (sign == 0 && ids_.of(other) < ids_.of(best))) {
                best = other;
                least = square;
            }
        }
        return best;
    }

  private:
    const double* points_;
    const SiteIds& ids_;
    const Cells& cells_;
    Query query_;
};

// With the vector of lowest id for each site: one of another length may give other last bits.
Buffer<double> moved_points(const PartialMesh& mesh, std::size_t width, const SiteIds& ids) {
    Buffer<double> points;
    for (const auto& pair : mesh.duplicates) {
        const Index site = pair.second, row = ids.row(site);
        if (row == site) {
            continue;
        }
        if (points.size() == 0) {
            points = copied(mesh.points, width * mesh.size);
        }
        std::copy_n(mesh.points + width * static_cast<std::size_t>(row), width,
                    points.data() + width * static_cast<std::size_t>(site));
    }
    return points;
}

std::vector<Index> sites_of(const SiteIds& ids, const Index* rows, std::size_t count) {
    std::vector<Index> sites(count);
    std::transform(rows, rows + count, sites.begin(), [&](Index row) { return ids.site(row); });
    if (!std::is_sorted(sites.begin(), sites.end())) {
        std::sort(sites.begin(), sites.end());
    }
    sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
    return sites;
}

}  // namespace

template <std::size_t Width>
FinalCells final_cells(const PartialMesh& mesh, const Index* rows, std::size_t count, Stop stop) {
    const SiteIds ids(mesh);
    const Buffer<double> moved = moved_points(mesh, Width, ids);
    const double* const points = moved.size() == 0 ? mesh.points : moved.data();
    const std::vector<Index> sites = sites_of(ids, rows, count);
    const ChosenCells chosen = voronoi::chosen_cells<Width>(points, mesh.size, mesh.simplices, mesh.neighbors,
                                                            mesh.count, ids.all(), sites.data(), sites.size(), stop);
    const Cells cells = chosen.view();
    Buffer<double> areas(mesh.size);
    (Width == 2 ? voronoi::cell_areas_plane : voronoi::cell_areas_sphere)(points, cells, areas.data(), 1, stop);
    NearestOfCells<queries::QueryOf<Width>> nearest(points, ids, cells);
    FinalCells result{Buffer<std::int64_t>(count), Buffer<std::int32_t>(count), Buffer<double>(count),
                      Buffer<std::int64_t>(count), Buffer<double>(count)};
    for_range(0, count, stop, [&](std::size_t k) {
        const Index site = ids.site(rows[k]);
        const auto at = static_cast<std::size_t>(site);
        const std::size_t entries = cells.end(at) - cells.begin(at);
        const bool kept = ids.is_kept(rows[k]);
        result.kept[k] = ids.of(site);
        result.degree[k] = kept ? static_cast<std::int32_t>(entries) : 0;
        result.area[k] = kept ? areas[at] : 0.0;
        result.nearest[k] = ids.equal_to(rows[k]);
        result.distance[k] = 0.0;
        if (result.nearest[k] < 0 && entries > 0) {
            const Index other = nearest.find(site);
            result.nearest[k] = ids.of(other);
            result.distance[k] = (Width == 2 ? distance_in_plane : distance_on_sphere)(
                points + Width * at, points + Width * static_cast<std::size_t>(other));
        }
    });
    return result;
}

template FinalCells final_cells<2>(const PartialMesh&, const Index*, std::size_t, Stop);
template FinalCells final_cells<3>(const PartialMesh&, const Index*, std::size_t, Stop);

FinalTriangles final_triangles(const PartialMesh& mesh, const bool* is_final, Stop stop) {
    const SiteIds ids(mesh);
    GrowingArray<std::int64_t> corners;
    GrowingArray<Index> rows;
    for_range(0, mesh.count, stop, [&](std::size_t t) {
        const Index* const corner = mesh.simplices + 3 * t;
        const std::int64_t id[3] = {ids.of(corner[0]), ids.of(corner[1]), ids.of(corner[2])};
        const std::size_t k = id[0] < id[1] && id[0] < id[2] ? 0 : id[1] < id[2] ? 1 : 2;
        if (is_final[ids.row(corner[k])]) {
            const std::int64_t row[3] = {id[k], id[(k + 1) % 3], id[(k + 2) % 3]};
            corners.append(row, 3);
            rows.push_back(static_cast<Index>(t));
        }
    });
    return {copied(corners), copied(rows)};
}

}  // namespace stereodel::partitions
