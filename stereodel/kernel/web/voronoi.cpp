// Voronoi diagrams, their ridges, areas and centroids.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "order/flat_order.hpp"
#include "voronoi/cell_integrals.hpp"
#include "voronoi/circumcenters.hpp"
#include "voronoi/diagram_parts.hpp"
#include "voronoi/flat_diagrams.hpp"
#include "voronoi/great_circles.hpp"
#include "voronoi/voronoi.hpp"
#include "web/answer.hpp"

namespace stereodel::web {

using voronoi::Cells;
using voronoi::Diagram;
using voronoi::GreatCircle;
using voronoi::Ridges;
using voronoi::TriangleRows;

namespace {

// Offsets, vertices and neighbours of the cells, sites along a curve, the vertex of each triangle, the vertices.
template <std::size_t Width>
Answer* diagram(const double* points, std::size_t size, const Index* simplices, const Index* neighbors,
                std::size_t count) {
    Diagram diagram = voronoi::diagram_of<Width>(points, size, simplices, neighbors, count, alone, nullptr);
    const bool shared = diagram.row_vertex.size() != 0;
    const TriangleRows rows =
        shared ? TriangleRows{diagram.vertex_sites.data(), diagram.row_vertex.data(), diagram.row_vertex.size()}
               : TriangleRows{simplices, diagram.simplex_vertex.data(), count};
    Buffer<double> centers(Width * rows.count);
    voronoi::circumcenters<Width>(points, size, rows, centers.data(), alone, nullptr);
    auto* answer = new Answer;
    answer->add_offsets(diagram.offsets);
    answer->add(std::move(diagram.vertices));
    answer->add(std::move(diagram.neighbors));
    answer->add(std::move(diagram.order));
    answer->add(std::move(diagram.simplex_vertex));
    answer->add(std::move(centers));
    return answer;
}

// Offsets, vertices and neighbours of the cells, the order of the sites; the ends of the axis, or the ridges' sites.
template <class T>
Answer* to_page(Diagram&& diagram, const std::vector<Index>& order, Buffer<T>&& last) {
    auto* answer = new Answer;
    answer->add_offsets(diagram.offsets);
    answer->add(std::move(diagram.vertices));
    answer->add(std::move(diagram.neighbors));
    answer->add(order);
    answer->add(std::move(last));
    return answer;
}

// A diagram as the page holds it: entries of cells in 32 bits.
class PageCells {
  public:
    PageCells(std::size_t sites, const Index* offsets, const Index* vertices, const Index* neighbors,
              std::size_t vertex_count, const Index* order = nullptr, std::size_t filled = 0)
        : offsets_(offsets, offsets + sites + 1),
          cells_{offsets_.data(), vertices, neighbors, sites, vertex_count, order, filled} {}
    PageCells(const PageCells&) = delete;
    PageCells& operator=(const PageCells&) = delete;

    const Cells& cells() const { return cells_; }

  private:
    std::vector<std::int64_t> offsets_;
    Cells cells_;
};

GreatCircle circle_of(const double* points, const Index* order, std::size_t count) {
    return {points, std::vector<Index>(order, order + count)};
}

}  // namespace

STEREODEL_EXPORT(plane_voronoi)
Answer* plane_voronoi(const double* points, std::size_t size, const Index* simplices, const Index* neighbors,
                      std::size_t count) {
    return diagram<2>(points, size, simplices, neighbors, count);
}

STEREODEL_EXPORT(sphere_voronoi)
Answer* sphere_voronoi(const double* points, std::size_t size, const Index* simplices, const Index* neighbors,
                       std::size_t count) {
    return diagram<3>(points, size, simplices, neighbors, count);
}

STEREODEL_EXPORT(plane_circumcenters)
void plane_circumcenters(const double* points, std::size_t, const Index* simplices, std::size_t count,
                         double* centers) {
    voronoi::circumcenters<2>(points, 0, TriangleRows{simplices, nullptr, count}, centers, alone, nullptr);
}

STEREODEL_EXPORT(sphere_circumcenters)
void sphere_circumcenters(const double* points, std::size_t size, const Index* simplices, std::size_t count,
                          double* centers) {
    voronoi::circumcenters<3>(points, size, TriangleRows{simplices, nullptr, count}, centers, alone, nullptr);
}

// Points without triangles -----------------------------------------------------------------------------------------

STEREODEL_EXPORT(plane_flat_diagram) Answer* plane_flat_diagram(const double* points, std::size_t size) {
    const std::vector<Index> order = order::line_order(points, size, nullptr);
    return to_page(voronoi::line_diagram(order, size), order, voronoi::line_ridges(order));
}

STEREODEL_EXPORT(sphere_flat_diagram) Answer* sphere_flat_diagram(const double* points, std::size_t size) {
    const GreatCircle circle(points, order::circle_order(points, size, true, nullptr));
    Buffer<double> ends(circle.order.size() < 2 ? 0 : 6);
    std::copy_n(circle.ends[0], ends.size(), ends.data());
    return to_page(voronoi::circle_diagram(circle.order, size), circle.order, std::move(ends));
}

STEREODEL_EXPORT(sphere_flat_areas)
void sphere_flat_areas(const double* points, std::size_t size, const Index* order, std::size_t count, double* areas) {
    const GreatCircle circle = circle_of(points, order, count);
    voronoi::circle_areas(circle.order, circle.gaps(points), size, areas);
}

STEREODEL_EXPORT(sphere_flat_centroids)
void sphere_flat_centroids(const double* points, std::size_t size, const Index* order, std::size_t count,
                           double* centroids) {
    const GreatCircle circle = circle_of(points, order, count);
    voronoi::circle_centroids(points, circle.order, circle.gaps(points), circle.ends[0], size, centroids);
}

// What follows from the cells --------------------------------------------------------------------------------------

STEREODEL_EXPORT(voronoi_ridges)
Answer* voronoi_ridges(std::size_t sites, const Index* offsets, const Index* vertices, const Index* neighbors,
                       std::size_t vertex_count) {
    const PageCells page(sites, offsets, vertices, neighbors, vertex_count);
    Ridges ridges = voronoi::ridges_of(page.cells(), alone, nullptr);
    auto* answer = new Answer;
    answer->add(std::move(ridges.sites));
    answer->add(std::move(ridges.vertices));
    return answer;
}

STEREODEL_EXPORT(plane_cell_areas)
void plane_cell_areas(const double* points, std::size_t sites, const Index* offsets, const Index* vertices,
                      const Index* neighbors, std::size_t vertex_count, const Index* order, std::size_t filled,
                      double* areas) {
    const PageCells page(sites, offsets, vertices, neighbors, vertex_count, order, filled);
    voronoi::cell_areas_plane(points, page.cells(), areas, alone, nullptr);
}

STEREODEL_EXPORT(sphere_cell_areas)
void sphere_cell_areas(const double* points, std::size_t sites, const Index* offsets, const Index* vertices,
                       const Index* neighbors, std::size_t vertex_count, const Index* order, std::size_t filled,
                       double* areas) {
    const PageCells page(sites, offsets, vertices, neighbors, vertex_count, order, filled);
    voronoi::cell_areas_sphere(points, page.cells(), areas, alone, nullptr);
}

STEREODEL_EXPORT(plane_cell_centroids)
void plane_cell_centroids(const double* points, std::size_t sites, const Index* offsets, const Index* vertices,
                          const Index* neighbors, std::size_t vertex_count, const Index* order, std::size_t filled,
                          double* centroids) {
    const PageCells page(sites, offsets, vertices, neighbors, vertex_count, order, filled);
    voronoi::cell_centroids_plane(points, page.cells(), centroids, alone, nullptr);
}

STEREODEL_EXPORT(sphere_cell_centroids)
void sphere_cell_centroids(const double* points, std::size_t sites, const Index* offsets, const Index* vertices,
                           const Index* neighbors, std::size_t vertex_count, const Index* order, std::size_t filled,
                           double* centroids) {
    const PageCells page(sites, offsets, vertices, neighbors, vertex_count, order, filled);
    voronoi::cell_centroids_sphere(points, page.cells(), centroids, alone, nullptr);
}

STEREODEL_EXPORT(bisector_normals)
void bisector_normals(const double* p, const double* q, std::size_t count, double* normals) {
    voronoi::bisector_normals(p, q, count, normals, alone, nullptr);
}

}  // namespace stereodel::web
