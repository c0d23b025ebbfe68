// Any bytes as points of the plane or directions: the kernel must give a valid triangulation, the same on one and two
// threads, after insertions and removals, and on the sphere from any pole. A crash, a wrong address, a hang or a failed
// check stops the program.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "changes.hpp"
#include "checks.hpp"
#include "predicates/plane_predicates.hpp"
#include "mesh/plane_surface.hpp"
#include "points_from_bytes.hpp"
#include "predicates/ray_predicates.hpp"
#include "engine/sphere.hpp"
#include "mesh/sphere_surface.hpp"

namespace fuzz {
namespace {

template <class Same>
void check_same_points(const Triangulation& result, Same&& same) {
    for (const auto& [gone, kept] : result.duplicates) {
        require(same(gone, kept), "duplicates are not the same point");
    }
}

// Nothing to triangulate: side(a, b, c) is zero for the first point, each of three others and all. Three, because one
// of them may be the antipode of the first.
template <class Side>
void check_flat(const Triangulation& result, std::size_t points, Side&& side) {
    std::vector<char> dropped(points, 0);
    for (const auto& pair : result.duplicates) {
        dropped[static_cast<std::size_t>(pair.first)] = 1;
    }
    int tried = 0;
    for (std::size_t b = 1; b < points && tried < 3; ++b) {
        if (dropped[b] == 0) {
            ++tried;
            for (std::size_t a = 1; a < points; ++a) {
                require(side(0, static_cast<Index>(b), static_cast<Index>(a)) == 0, "points off the line");
            }
        }
    }
}

void check_equal(const Triangulation& a, const Triangulation& b, const char* what) {
    require(a.dimension == b.dimension && a.duplicates == b.duplicates, what);
    require(sorted_rows(Rows(a)) == sorted_rows(Rows(b)), what);
}

void check_plane(const Points& points) {
    const double* xy = points.coordinates.data();
    const Triangulation result = stereodel::engine::triangulate_plane(xy, points.count, true, 1, nullptr);
    const Rows rows(result);
    stereodel::predicates::PlanePoints predicates(xy, stereodel::predicates::common_granularity(xy, points.count));
    const auto orient = [&](Index a, Index b, Index c) { return predicates.orient(a, b, c); };
    const auto equal = [xy](Index a, Index b) { return xy[2 * a] == xy[2 * b] && xy[2 * a + 1] == xy[2 * b + 1]; };
    check_same_points(result, equal);
    check_corners(rows, points.count, result);
    for (std::size_t row = 0; row < rows.count(); ++row) {
        require(orient(rows.corner(row, 0), rows.corner(row, 1), rows.corner(row, 2)) > 0, "a triangle is not ccw");
    }
    if (rows.count() > 0) {
        const auto border = check_edges(
            rows, [&](Index a, Index b, Index c, Index d) { return predicates.in_circle(a, b, c, d); });
        const std::size_t distinct = points.count - result.duplicates.size();
        require(rows.count() == 2 * distinct - 2 - check_border(border, orient), "Euler's formula");
    } else {
        check_flat(result, points.count, orient);
    }
    check_equal(result, stereodel::engine::triangulate_plane(xy, points.count, true, 2, nullptr),
                "threads change triangles");
    check_changes<stereodel::mesh::PlaneSurface>(points.coordinates, [](const Coordinates& some) {
        return stereodel::engine::triangulate_plane(some.data(), some.size() / 2, true, 1, nullptr);
    });
}

void check_sphere(const Points& points) {
    const double* xyz = points.coordinates.data();
    const Triangulation result =
        stereodel::engine::triangulate_sphere(xyz, points.count, true, 1, points.pole, nullptr);
    const Rows rows(result);
    stereodel::predicates::Rays rays(xyz, stereodel::predicates::all_unit(xyz, points.count));
    check_same_points(result, [&](Index a, Index b) { return rays.compare(a, b) == 0; });
    check_corners(rows, points.count, result);
    if (rows.count() > 0) {
        const auto border =
            check_edges(rows, [&](Index a, Index b, Index c, Index d) { return rays.in_bubble(a, b, c, d); });
        require(border.empty(), "the sphere has a border");
        require(rows.count() == 2 * (points.count - result.duplicates.size()) - 4, "Euler's formula");
    } else {
        check_flat(result, points.count, [&](Index a, Index b, Index c) { return rays.turn(a, b, c); });
    }
    const stereodel::engine::Pole other{(points.pole.axis + 1) % 3, -points.pole.sign};
    check_equal(result, stereodel::engine::triangulate_sphere(xyz, points.count, true, 2, other, nullptr),
                "other pole or threads, other triangles");
    check_changes<stereodel::mesh::SphereSurface>(points.coordinates, [&](const Coordinates& some) {
        return stereodel::engine::triangulate_sphere(some.data(), some.size() / 3, true, 1, other, nullptr);
    });
}

}  // namespace
}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const fuzz::Points points = fuzz::points_from_bytes(data, size);
    if (points.on_sphere) {
        fuzz::check_sphere(points);
    } else {
        fuzz::check_plane(points);
    }
    return 0;
}
