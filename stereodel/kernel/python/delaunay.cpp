#include <nanobind/nanobind.h>

#include <stdexcept>
#include <utility>

#include "engine/plane.hpp"
#include "engine/sphere.hpp"
#include "python/arrays.hpp"

namespace stereodel::python {

using engine::Pole;
using engine::Triangulation;
using engine::closing_facets;
using engine::triangulate_plane;
using engine::triangulate_sphere;

namespace {

using namespace nb::literals;

constexpr std::size_t long_work = 20000;  // points: some milliseconds

nb::tuple to_python(Triangulation&& result, bool with_neighbors, bool on_sphere) {
    nb::object neighbors = nb::none();
    if (with_neighbors) {
        neighbors = nb::cast(to_rows<3>(std::move(result.triangles.neighbors)));
    }
    return nb::make_tuple(to_rows<3>(std::move(result.triangles.corners)), neighbors, to_rows(result.duplicates),
                          result.dimension, to_dict(result.tally, on_sphere));
}

nb::tuple triangulate_points(RowsIn<double, 2> points, int workers, bool neighbors) {
    const std::size_t size = points.shape(0);
    Triangulation result = run_without_lock(size > long_work, [&](Stop stop) {
        check_points("points", points);
        return triangulate_plane(points.data(), size, neighbors, workers, stop);
    });
    return to_python(std::move(result), neighbors, false);
}

nb::tuple triangulate_directions(RowsIn<double, 3> points, int workers, bool neighbors, int axis, int sign) {
    const std::size_t size = points.shape(0);
    if (axis < 0 || axis > 2 || (sign != 1 && sign != -1)) {
        throw std::invalid_argument("axis must be 0, 1 or 2, sign -1 or 1");
    }
    Triangulation result = run_without_lock(size > long_work, [&](Stop stop) {
        check_points("points", points);
        return triangulate_sphere(points.data(), size, neighbors, workers, Pole{axis, sign}, stop);
    });
    return to_python(std::move(result), neighbors, true);
}

ValuesOut<bool> closing_rows(RowsIn<double, 3> points, RowsIn<Index, 3> simplices) {
    const std::size_t count = simplices.shape(0);
    return to_values(filled<bool>(count, count > long_work, [&](bool* closing, Stop stop) {
        check_points("points", points);
        check_indices("simplices", simplices.data(), count, points.shape(0), 3);
        closing_facets(points.data(), points.shape(0), simplices.data(), count, closing, stop);
    }));
}

}  // namespace

void bind_delaunay(Modules& modules) {
    // Keys of the inconclusive tests.
    modules.plane.attr("stages") = nb::make_tuple("filter", "double_double", "exact");
    modules.sphere.attr("stages") = nb::make_tuple("filter", "curvature", "double_double", "exact");
    modules.plane.def("triangulate", triangulate_points, "points"_a, "workers"_a = 1, "neighbors"_a = true,
                      "Simplices, neighbors or None, duplicates, dimension and inconclusive tests.");
    modules.sphere.def("triangulate", triangulate_directions, "points"_a, "workers"_a = 1, "neighbors"_a = true,
                       "axis"_a = 0, "sign"_a = -1,
                       "The same of directions; `sign` times axis number `axis` is the pole of the projection.");
    modules.sphere.def("closing", closing_rows, "points"_a, "simplices"_a, "Whether det[a b c] <= 0, for each facet.");
}

}  // namespace stereodel::python
