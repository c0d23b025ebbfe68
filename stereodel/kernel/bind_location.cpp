#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>

#include <optional>
#include <stdexcept>
#include <utility>

#include "bind_triangles.hpp"
#include "k_nearest.hpp"
#include "location.hpp"
#include "nearest.hpp"

namespace stereodel {
namespace {

using namespace nb::literals;
using RowsOfAnyWidth = nb::ndarray<nb::numpy, Index, nb::ndim<2>, nb::c_contig>;

constexpr std::size_t long_work = 10000;  // queries: some milliseconds

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

// Rows of k numbers of points; `duplicates` of the triangulation.
template <class Points, class Work>
RowsOfAnyWidth k_nearest(const TriangleArrays& triangles, const Points& points, const RowsIn<Index, 2>& duplicates,
                         const Points& queries, std::size_t k, Work&& work) {
    const std::size_t size = points.shape(0), count = queries.shape(0);
    if (k == 0 || k > size) {
        throw std::invalid_argument("k must be at least 1 and at most the number of points");
    }
    const Pairs pairs = to_pairs(duplicates, size);
    const bool is_long = is_long_search(triangles, size, count) || count * k > long_work;
    Buffer<Index> numbers = filled<Index>(count * k, is_long, [&](Index* found, Stop stop) {
        work(KNearestTask{triangles, size, pairs, queries.data(), count, k, found}, stop);
    });
    return to_array<RowsOfAnyWidth>(std::move(numbers), {count, k});
}

RowsOfAnyWidth k_nearest_in_plane(RowsIn<double, 2> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                                  RowsIn<Index, 2> duplicates, RowsIn<double, 2> queries, std::size_t k, int workers) {
    const TriangleArrays triangles = to_triangles(points.data(), simplices, neighbors, {});
    return k_nearest(triangles, points, duplicates, queries, k,
                     [&](const KNearestTask& task, Stop stop) { k_nearest_plane(task, workers, stop); });
}

RowsOfAnyWidth k_nearest_on_sphere(RowsIn<double, 3> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                                   RowsIn<Index, 2> duplicates, RowsIn<double, 3> queries, std::size_t k,
                                   std::optional<Closing> closing, int workers) {
    const TriangleArrays triangles = to_triangles(points.data(), simplices, neighbors, closing);
    return k_nearest(triangles, points, duplicates, queries, k,
                     [&](const KNearestTask& task, Stop stop) { k_nearest_sphere(task, workers, stop); });
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
    module.def("k_nearest_plane", k_nearest_in_plane, "points"_a, "simplices"_a, "neighbors"_a, "duplicates"_a,
               "queries"_a, "k"_a, "workers"_a = 1,
               "The k nearest points of each query, duplicates among them, by distance, equally near ones by number.");
    module.def("k_nearest_sphere", k_nearest_on_sphere, "points"_a, "simplices"_a, "neighbors"_a, "duplicates"_a,
               "queries"_a, "k"_a, "closing"_a = nb::none(), "workers"_a = 1, "The same for directions.");
}

}  // namespace stereodel
