#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "order/flat_order.hpp"
#include "python/arrays.hpp"
#include "voronoi/cell_integrals.hpp"
#include "voronoi/circumcenters.hpp"
#include "voronoi/diagram_parts.hpp"
#include "voronoi/flat_diagrams.hpp"
#include "voronoi/great_circles.hpp"
#include "voronoi/voronoi.hpp"

namespace stereodel::python {

using order::circle_order;
using order::line_order;
using voronoi::Cells;
using voronoi::Diagram;
using voronoi::GreatCircle;
using voronoi::Polygons;
using voronoi::Ridges;
using voronoi::TriangleOrder;
using voronoi::TriangleRows;
using voronoi::bisector_normals;
using voronoi::cell_areas_plane;
using voronoi::cell_areas_sphere;
using voronoi::cell_centroids_plane;
using voronoi::cell_centroids_sphere;
using voronoi::check_cells;
using voronoi::check_order;
using voronoi::circle_areas;
using voronoi::circle_centroids;
using voronoi::circle_diagram;
using voronoi::circumcenters;
using voronoi::diagram_of;
using voronoi::line_diagram;
using voronoi::line_ridges;
using voronoi::polygons_of;
using voronoi::ridges_of;
using voronoi::triangles_of;

namespace {

using namespace nb::literals;

constexpr std::size_t long_work = 20000;  // rows: some milliseconds

nb::tuple to_python(Diagram&& diagram) {
    nb::object rank = nb::none(), sites = nb::none(), vertex = nb::none();
    if (diagram.row_vertex.size() != 0) {
        sites = nb::cast(to_rows<3>(std::move(diagram.vertex_sites)));
        vertex = nb::cast(to_values(std::move(diagram.row_vertex)));
        rank = nb::cast(to_values(std::move(diagram.simplex_rank)));
    }
    return nb::make_tuple(to_values(std::move(diagram.offsets)), to_values(std::move(diagram.vertices)),
                          to_values(std::move(diagram.neighbors)), to_values(std::move(diagram.order)),
                          to_values(std::move(diagram.simplex_vertex)), rank, sites, vertex);
}

template <std::size_t Width>
nb::tuple diagram(RowsIn<double, Width> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors, int workers,
                  bool checked) {
    const std::size_t count = simplices.shape(0);
    return to_python(run_without_lock(count > long_work, [&](Stop stop) {
        check_triangles(points, simplices, neighbors, checked, Border::open);  // part of a sphere will do
        return diagram_of<Width>(points.data(), points.shape(0), simplices.data(), neighbors.data(), count, workers,
                                 stop);
    }));
}

using Offsets = ValuesIn<std::int64_t>;
using Entries = ValuesIn<Index>;

Cells to_cells(const Offsets& offsets, const Entries& vertices, const Entries& neighbors, std::size_t vertex_count,
               bool checked = false) {
    if (offsets.shape(0) == 0) {
        throw std::invalid_argument("offsets must have an entry more than there are sites");
    }
    check_same_length("vertices", vertices.shape(0), "neighbors", neighbors.shape(0));
    const Cells cells{offsets.data(), vertices.data(), neighbors.data(), offsets.shape(0) - 1, vertex_count};
    if (!checked) {
        check_cells(cells, vertices.shape(0));
    }
    return cells;
}

// Of a diagram of these points.
template <class Rows>
Cells to_cells(const Rows& points, const Offsets& offsets, const Entries& vertices,
               const Entries& neighbors, std::size_t vertex_count, bool checked = false) {
    const Cells cells = to_cells(offsets, vertices, neighbors, vertex_count, checked);
    check_same_length("points", points.shape(0), "cells", cells.sites);
    if (!checked) {
        check_points("points", points);
    }
    return cells;
}

// With the sites that have entries in an order for areas and centroids, each once.
template <class Rows>
Cells to_ordered_cells(const Rows& points, const Offsets& offsets, const Entries& vertices,
                       const Entries& neighbors, std::size_t vertex_count, const ValuesIn<Index>& order,
                       bool checked) {
    Cells cells = to_cells(points, offsets, vertices, neighbors, vertex_count, checked);
    cells.order = order.data();
    cells.filled = order.shape(0);
    if (!checked) {
        check_order(cells);
    }
    return cells;
}

nb::tuple ridges(Offsets offsets, Entries vertices, Entries neighbors, std::size_t vertex_count, int workers) {
    const Cells cells = to_cells(offsets, vertices, neighbors, vertex_count);
    Ridges made = run_without_lock(cells.sites > long_work, [&](Stop stop) { return ridges_of(cells, workers, stop); });
    return nb::make_tuple(to_rows<2>(std::move(made.sites)), to_rows<2>(std::move(made.vertices)));
}

nb::tuple polygons(Offsets offsets, Entries vertices, Entries neighbors, std::size_t vertex_count, int workers) {
    const Cells cells = to_cells(offsets, vertices, neighbors, vertex_count);
    Polygons made =
        run_without_lock(cells.sites > long_work, [&](Stop stop) { return polygons_of(cells, workers, stop); });
    return nb::make_tuple(to_array<ValuesOut<std::int64_t>>(std::move(made.offsets), {vertex_count + 1}),
                          to_values(std::move(made.sites)));
}

using Ranks = std::optional<ValuesIn<Index>>;

TriangleOrder to_order(const Entries& simplex_vertex, const Ranks& rank) {
    if (rank) {
        check_same_length("simplex_vertex", simplex_vertex.shape(0), "rank", rank->shape(0));
    }
    return {simplex_vertex.data(), rank ? rank->data() : nullptr, simplex_vertex.shape(0)};
}

// The triangles of a diagram's vertices.
template <std::size_t Width>
RowsOut<Index, 3> delaunay_of(RowsIn<double, Width> points, Offsets offsets, Entries vertices, Entries neighbors,
                              std::size_t vertex_count, Entries simplex_vertex, Ranks rank, int workers) {
    const Cells cells = to_cells(points, offsets, vertices, neighbors, vertex_count);
    const TriangleOrder order = to_order(simplex_vertex, rank);
    return to_rows<3>(run_without_lock(cells.sites > long_work, [&](Stop stop) {
        return triangles_of<Width>(points.data(), cells.sites, polygons_of(cells, workers, stop), order, workers, stop);
    }));
}

// `per_site` numbers for each site.
template <class Fill>
Buffer<double> for_sites(const Cells& cells, std::size_t per_site, Fill&& fill) {
    return filled<double>(per_site * cells.sites, cells.sites > long_work, fill);
}

using Integrals = void(const double* points, const Cells& cells, double* results, int workers, Stop stop);

template <std::size_t Width, Integrals& areas_of>
ValuesOut<double> areas(RowsIn<double, Width> points, Offsets offsets, Entries vertices, Entries neighbors,
                        std::size_t vertex_count, ValuesIn<Index> order, int workers, bool checked) {
    const Cells cells = to_ordered_cells(points, offsets, vertices, neighbors, vertex_count, order, checked);
    return to_values(for_sites(cells, 1, [&](double* results, Stop stop) {
        areas_of(points.data(), cells, results, workers, stop);
    }));
}

template <std::size_t Width, Integrals& centroids_of>
RowsOut<double, Width> centroids(RowsIn<double, Width> points, Offsets offsets, Entries vertices, Entries neighbors,
                                 std::size_t vertex_count, ValuesIn<Index> order, int workers, bool checked) {
    const Cells cells = to_ordered_cells(points, offsets, vertices, neighbors, vertex_count, order, checked);
    return to_rows<Width>(for_sites(cells, Width, [&](double* results, Stop stop) {
        centroids_of(points.data(), cells, results, workers, stop);
    }));
}

using Places = std::optional<ValuesIn<Index>>;

template <class Rows>
TriangleRows to_rows_of(const Rows& points, const RowsIn<Index, 3>& triangles, const Places& place, bool checked) {
    if (!checked) {
        check_points("points", points);
        check_indices("triangles", triangles.data(), triangles.shape(0), points.shape(0), 3);
    }
    if (place && !checked) {  // else two threads might write the same
        check_same_length("place", place->shape(0), "triangles", triangles.shape(0));
        check_distinct("place", place->data(), place->shape(0), triangles.shape(0));
    }
    return {triangles.data(), place ? place->data() : nullptr, triangles.shape(0)};
}

template <std::size_t Width>
RowsOut<double, Width> centers(RowsIn<double, Width> points, RowsIn<Index, 3> triangles, Places place, int workers,
                               bool checked) {
    const TriangleRows rows = to_rows_of(points, triangles, place, checked);
    return to_rows<Width>(filled<double>(Width * rows.count, rows.count > long_work, [&](double* out, Stop stop) {
        circumcenters<Width>(points.data(), points.shape(0), rows, out, workers, stop);
    }));
}

// Without triangles ------------------------------------------------------------------------------------------------

nb::tuple to_cells_in_python(Diagram&& diagram) {
    return nb::make_tuple(to_values(std::move(diagram.offsets)), to_values(std::move(diagram.vertices)),
                          to_values(std::move(diagram.neighbors)));
}

// All points that lie on a line are given: there is nothing else to be checked.
ValuesOut<Index> order_on_line(RowsIn<double, 2> points, bool) {
    check_points("points", points);
    return to_values(run_without_lock(points.shape(0) > long_work, [&](Stop stop) {
        return copied(line_order(points.data(), points.shape(0), stop));
    }));
}

ValuesOut<Index> order_on_circle(RowsIn<double, 3> points, bool checked) {
    check_points("points", points);
    return to_values(run_without_lock(points.shape(0) > long_work, [&](Stop stop) {
        return copied(circle_order(points.data(), points.shape(0), checked, stop));
    }));
}

// Of some of `count` points, each once.
std::vector<Index> to_order(const ValuesIn<Index>& order, std::size_t count) {
    check_distinct("order", order.data(), order.shape(0), count);
    return {order.data(), order.data() + order.shape(0)};
}

GreatCircle to_circle(const RowsIn<double, 3>& points, const ValuesIn<Index>& order) {
    check_points("points", points);
    return GreatCircle(points.data(), to_order(order, points.shape(0)));
}

nb::tuple of_line(RowsIn<double, 2> points, ValuesIn<Index> numbers) {
    const std::vector<Index> order = to_order(numbers, points.shape(0));
    return nb::make_tuple(to_cells_in_python(line_diagram(order, points.shape(0))), to_rows<2>(line_ridges(order)));
}

nb::tuple of_circle(RowsIn<double, 3> points, ValuesIn<Index> order) {
    const GreatCircle circle = to_circle(points, order);
    Buffer<double> ends(circle.order.size() < 2 ? 0 : 6);
    std::copy_n(circle.ends[0], ends.size(), ends.data());
    return nb::make_tuple(to_cells_in_python(circle_diagram(circle.order, points.shape(0))),
                          to_rows<3>(std::move(ends)));
}

ValuesOut<double> areas_on_circle(RowsIn<double, 3> points, ValuesIn<Index> order) {
    const GreatCircle circle = to_circle(points, order);
    Buffer<double> areas(points.shape(0));
    circle_areas(circle.order, circle.gaps(points.data()), areas.size(), areas.data());
    return to_values(std::move(areas));
}

RowsOut<double, 3> centroids_on_circle(RowsIn<double, 3> points, ValuesIn<Index> order) {
    const GreatCircle circle = to_circle(points, order);
    Buffer<double> centroids(3 * points.shape(0));
    circle_centroids(points.data(), circle.order, circle.gaps(points.data()), circle.ends[0], points.shape(0),
                     centroids.data());
    return to_rows<3>(std::move(centroids));
}

RowsOut<double, 3> bisectors(RowsIn<double, 3> p, RowsIn<double, 3> q, int workers) {
    const std::size_t count = p.shape(0);
    check_same_length("p", count, "q", q.shape(0));
    check_points("p", p);
    check_points("q", q);
    return to_rows<3>(filled<double>(3 * count, count > long_work, [&](double* normals, Stop stop) {
        bisector_normals(p.data(), q.data(), count, normals, workers, stop);
    }));
}

template <std::size_t Width, Integrals& areas_of, Integrals& centroids_of>
void bind_integrals(nb::module_& space) {
    space.def("cell_areas", areas<Width, areas_of>, "points"_a, "offsets"_a, "vertices"_a, "neighbors"_a,
              "vertex_count"_a, "order"_a, "workers"_a = 1, "checked"_a = false,
              "Areas of the cells, infinite where unbounded; steradians.");
    space.def("cell_centroids", centroids<Width, centroids_of>, "points"_a, "offsets"_a, "vertices"_a, "neighbors"_a,
              "vertex_count"_a, "order"_a, "workers"_a = 1, "checked"_a = false,
              "Centroids of the cells; NaN where there is none.");
}

void bind_plane(nb::module_& plane) {
    plane.def("voronoi", diagram<2>, "points"_a, "simplices"_a, "neighbors"_a, "workers"_a = 1, "checked"_a = false,
              "Offsets of the cells, vertices and neighbours of their entries, the sites along a curve, the vertex of "
              "each triangle; if triangles share vertices, its rank there, rows of three sites and the vertex of each "
              "row.");
    plane.def("delaunay_of", delaunay_of<2>, "points"_a, "offsets"_a, "vertices"_a, "neighbors"_a,
              "vertex_count"_a, "simplex_vertex"_a, "rank"_a = nb::none(), "workers"_a = 1,
              "Triangles of a diagram's sites, in the order of `simplex_vertex`.");
    plane.def("circumcenters", centers<2>, "points"_a, "triangles"_a, "place"_a = nb::none(), "workers"_a = 1,
              "checked"_a = false,
              "Centres of triangles by number, that of row k at place[k].");
    plane.def("flat_order", order_on_line, "points"_a, "checked"_a = false, "Different points of a line along it.");
    plane.def("flat_diagram", of_line, "points"_a, "order"_a,
              "Offsets, vertices and neighbours of the cells of points, and the sites of their ridges. They are taken "
              "to lie on one line, in this order.");
    bind_integrals<2, cell_areas_plane, cell_centroids_plane>(plane);
}

void bind_sphere(nb::module_& sphere) {
    sphere.def("voronoi", diagram<3>, "points"_a, "simplices"_a, "neighbors"_a, "workers"_a = 1, "checked"_a = false,
               "As in the plane.");
    sphere.def("delaunay_of", delaunay_of<3>, "points"_a, "offsets"_a, "vertices"_a, "neighbors"_a,
               "vertex_count"_a, "simplex_vertex"_a, "rank"_a = nb::none(), "workers"_a = 1, "As in the plane.");
    sphere.def("circumcenters", centers<3>, "points"_a, "triangles"_a, "place"_a = nb::none(), "workers"_a = 1,
               "checked"_a = false,
               "Unit normals of triangles by number, on the side seen counterclockwise, that of row k at place[k].");
    sphere.def("flat_order", order_on_circle, "points"_a, "checked"_a = false,
               "Different directions of a great circle around it, the three lowest counterclockwise. checked: they are "
               "known to lie on one.");
    sphere.def("flat_diagram", of_circle, "points"_a, "order"_a,
               "Offsets, vertices and neighbours of the cells of directions, and the vertices. They are taken to lie "
               "on one great circle, in this order.");
    sphere.def("flat_areas", areas_on_circle, "points"_a, "order"_a, "Areas of the cells of flat_diagram.");
    sphere.def("flat_centroids", centroids_on_circle, "points"_a, "order"_a, "Centroids of the cells of flat_diagram.");
    sphere.def("bisector_normals", bisectors, "p"_a, "q"_a, "workers"_a = 1,
               "Unit normals, on the side of p, of the planes between directions p and q.");
    bind_integrals<3, cell_areas_sphere, cell_centroids_sphere>(sphere);
}

}  // namespace

void bind_voronoi(Modules& modules) {
    modules.both.def("voronoi_ridges", ridges, "offsets"_a, "vertices"_a, "neighbors"_a, "vertex_count"_a,
                     "workers"_a = 1, "Sites i < j and vertices of the ridges of a diagram, in lexicographic order.");
    modules.both.def("voronoi_polygons", polygons, "offsets"_a, "vertices"_a, "neighbors"_a, "vertex_count"_a,
                     "workers"_a = 1, "Offsets and sites of the polygons around the vertices of a diagram.");
    bind_plane(modules.plane);
    bind_sphere(modules.sphere);
}

}  // namespace stereodel::python
