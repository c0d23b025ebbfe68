// Triangulations from the points alone, and points that come and go.
#include <cstddef>
#include <utility>

#include "engine/plane.hpp"
#include "engine/sphere.hpp"
#include "mesh/dynamic.hpp"
#include "mesh/plane_surface.hpp"
#include "mesh/sphere_surface.hpp"
#include "web/answer.hpp"

namespace stereodel::web {

using engine::Pole;
using engine::Triangulation;
using mesh::DynamicDelaunay;
using mesh::Mesh;
using mesh::PlaneSurface;
using mesh::SphereSurface;

namespace {

// Simplices, neighbours, duplicates, dimension, tally.
Answer* to_page(Triangulation&& made) {
    auto* answer = new Answer;
    answer->add(std::move(made.triangles.corners));
    answer->add(std::move(made.triangles.neighbors));
    answer->add(made.duplicates);
    answer->add(std::vector<Index>{made.dimension});
    answer->add(made.tally);
    return answer;
}

// The same after a change, and the new number of each old point if some were removed. Dimension 1 stands for any
// below 2: where no triangles are left, the page begins anew.
template <class Surface>
Answer* to_page(DynamicDelaunay<Surface>& changed, Buffer<Index>&& number) {
    auto* answer = new Answer;
    Mesh& mesh = changed.mesh();
    Buffer<Index> simplices(3 * mesh.triangles()), neighbors(3 * mesh.triangles());
    if (simplices.size() != 0) {
        mesh.write(simplices.data(), neighbors.data(), nullptr);
    }
    answer->add(std::move(simplices));
    answer->add(std::move(neighbors));
    answer->add(changed.duplicates());
    answer->add(std::vector<Index>{changed.is_flat() ? 1 : 2});
    answer->add(changed.tally());
    answer->add(std::move(number));
    return answer;
}

// A triangulation as the page holds it.
struct Arrays {
    const double* points;
    std::size_t size;
    const Index *simplices, *neighbors;
    std::size_t count;
    const Index* duplicates;
    std::size_t duplicate_count;

    template <class Surface>
    DynamicDelaunay<Surface> mesh() const {
        return {points, size, simplices, neighbors, count, to_pairs(duplicates, duplicate_count), nullptr};
    }
};

template <class Surface>
Answer* insert_into(const Arrays& arrays, const double* added, std::size_t count) {
    DynamicDelaunay<Surface> mesh = arrays.mesh<Surface>();
    mesh.insert(added, count, nullptr);
    return to_page(mesh, Buffer<Index>(0));
}

template <class Surface>
Answer* remove_from(const Arrays& arrays, const Index* gone, std::size_t count) {
    DynamicDelaunay<Surface> mesh = arrays.mesh<Surface>();
    Buffer<Index> number = mesh.remove(gone, count, nullptr);
    return to_page(mesh, std::move(number));
}

}  // namespace

STEREODEL_EXPORT(plane_triangulate) Answer* plane_triangulate(const double* points, std::size_t size) {
    return to_page(engine::triangulate_plane(points, size, true, alone, nullptr));
}

STEREODEL_EXPORT(sphere_triangulate) Answer* sphere_triangulate(const double* points, std::size_t size) {
    return to_page(engine::triangulate_sphere(points, size, true, alone, Pole{0, -1}, nullptr));
}

STEREODEL_EXPORT(sphere_closing)
void sphere_closing(const double* points, std::size_t size, const Index* simplices, std::size_t count, bool* closing) {
    engine::closing_facets(points, size, simplices, count, closing, nullptr);
}

STEREODEL_EXPORT(plane_insert)
Answer* plane_insert(const double* points, std::size_t size, const Index* simplices, const Index* neighbors,
                     std::size_t count, const Index* duplicates, std::size_t duplicate_count, const double* added,
                     std::size_t added_count) {
    return insert_into<PlaneSurface>({points, size, simplices, neighbors, count, duplicates, duplicate_count}, added,
                                     added_count);
}

STEREODEL_EXPORT(sphere_insert)
Answer* sphere_insert(const double* points, std::size_t size, const Index* simplices, const Index* neighbors,
                      std::size_t count, const Index* duplicates, std::size_t duplicate_count, const double* added,
                      std::size_t added_count) {
    return insert_into<SphereSurface>({points, size, simplices, neighbors, count, duplicates, duplicate_count}, added,
                                      added_count);
}

STEREODEL_EXPORT(plane_remove)
Answer* plane_remove(const double* points, std::size_t size, const Index* simplices, const Index* neighbors,
                     std::size_t count, const Index* duplicates, std::size_t duplicate_count, const Index* gone,
                     std::size_t gone_count) {
    return remove_from<PlaneSurface>({points, size, simplices, neighbors, count, duplicates, duplicate_count}, gone,
                                     gone_count);
}

STEREODEL_EXPORT(sphere_remove)
Answer* sphere_remove(const double* points, std::size_t size, const Index* simplices, const Index* neighbors,
                      std::size_t count, const Index* duplicates, std::size_t duplicate_count, const Index* gone,
                      std::size_t gone_count) {
    return remove_from<SphereSurface>({points, size, simplices, neighbors, count, duplicates, duplicate_count}, gone,
                                      gone_count);
}

}  // namespace stereodel::web
