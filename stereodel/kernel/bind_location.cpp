#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>

#include <optional>
#include <stdexcept>
#include <utility>

#include "bind_support.hpp"
#include "location.hpp"
#include "nearest.hpp"

namespace stereodel {
namespace {

using namespace nb::literals;

constexpr std::size_t long_work = 10000;  // queries: some milliseconds

using Closing = ValuesIn<bool>;

TriangleArrays to_triangles(const double* points, const RowsIn<Index, 3>& simplices, const RowsIn<Index, 3>& neighbors,
                            const std::optional<Closing>& closing) {
    const std::size_t count = simplices.shape(0);
    if (neighbors.shape(0) != count || (closing && closing->shape(0) != count)) {
        throw std::invalid_argument("simplices, neighbors and closing must have the same length");
    }
    return {points, simplices.data(), neighbors.data(), closing ? closing->data() : nullptr, count};
}

// One number for each of `count` queries.
template <class Work>
ValuesOut<Index> answers(std::size_t count, bool is_long, Work&& work) {
    return to_values(filled<Index>(count, is_long, work));
}

ValuesOut<Index> find_plane(RowsIn<double, 2> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                            RowsIn<double, 2> queries, int workers) {
    const TriangleArrays triangles = to_triangles(points.data(), simplices, neighbors, {});
    const std::size_t count = queries.shape(0);
    return answers(count, count > long_work, [&](Index* found, Stop stop) {
        find_simplex_plane(triangles, queries.data(), count, found, workers, stop);
    });
}

ValuesOut<Index> find_sphere(RowsIn<double, 3> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                             RowsIn<double, 3> queries, std::optional<Closing> closing, int workers) {
    const TriangleArrays triangles = to_triangles(points.data(), simplices, neighbors, closing);
    const std::size_t count = queries.shape(0);
    return answers(count, count > long_work, [&](Index* found, Stop stop) {
        find_simplex_sphere(triangles, queries.data(), count, found, workers, stop);
    });
}

void check_points(std::size_t size) {
    if (size == 0) {
        throw std::invalid_argument("nearest needs at least one point");
    }
}

// Without triangles a query takes as long as there are points.
bool is_long_search(const TriangleArrays& triangles, std::size_t size, std::size_t count) {
    return count * (triangles.count() == 0 ? size : 1) > long_work;
}

ValuesOut<Index> nearest_in_plane(RowsIn<double, 2> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                                  RowsIn<double, 2> queries, int workers) {
    check_points(points.shape(0));
    const TriangleArrays triangles = to_triangles(points.data(), simplices, neighbors, {});
    const std::size_t count = queries.shape(0);
    return answers(count, is_long_search(triangles, points.shape(0), count), [&](Index* found, Stop stop) {
        nearest_plane(triangles, points.shape(0), queries.data(), count, found, workers, stop);
    });
}

ValuesOut<Index> nearest_on_sphere(RowsIn<double, 3> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                                   RowsIn<double, 3> queries, std::optional<Closing> closing, int workers) {
    check_points(points.shape(0));
    const TriangleArrays triangles = to_triangles(points.data(), simplices, neighbors, closing);
    const std::size_t count = queries.shape(0);
    return answers(count, is_long_search(triangles, points.shape(0), count), [&](Index* found, Stop stop) {
        nearest_sphere(triangles, points.shape(0), queries.data(), count, found, workers, stop);
    });
}

}  // namespace

void bind_location(nb::module_& module) {
    module.def("find_simplex_plane", find_plane, "points"_a, "simplices"_a, "neighbors"_a, "queries"_a, "workers"_a = 1,
               "The lowest triangle that holds each query, -1 outside.");
    module.def("find_simplex_sphere", find_sphere, "points"_a, "simplices"_a, "neighbors"_a, "queries"_a,
               "closing"_a = nb::none(), "workers"_a = 1,
               "The same for directions; `closing` tells the triangles that hold none (none if not given).");
    module.def("nearest_plane", nearest_in_plane, "points"_a, "simplices"_a, "neighbors"_a, "queries"_a,
               "workers"_a = 1,
               "The nearest point of each query, the lowest of several. Without simplices all points are compared.");
    module.def("nearest_sphere", nearest_on_sphere, "points"_a, "simplices"_a, "neighbors"_a, "queries"_a,
               "closing"_a = nb::none(), "workers"_a = 1, "The same for directions.");
}

}  // namespace stereodel
