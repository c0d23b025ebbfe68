#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bind_triangles.hpp"
#include "k_nearest.hpp"
#include "location.hpp"
#include "nearest.hpp"
#include "nearest_flat.hpp"
#include "query_pieces.hpp"

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
                            RowsIn<double, 2> queries, int workers, bool checked) {
    const TriangleArrays triangles = to_triangles(points, simplices, neighbors, {}, checked);
    check_points("queries", queries);
    const std::size_t count = queries.shape(0);
    return answers(count, count > long_work, [&](Index* found, Stop stop) {
        find_simplex_plane(triangles, queries.data(), count, found, workers, stop);
    });
}

ValuesOut<Index> find_sphere(RowsIn<double, 3> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                             RowsIn<double, 3> queries, std::optional<Closing> closing, int workers,
                             bool checked) {
    const TriangleArrays triangles = to_triangles(points, simplices, neighbors, closing, checked);
    check_points("queries", queries);
    const std::size_t count = queries.shape(0);
    return answers(count, count > long_work, [&](Index* found, Stop stop) {
        find_simplex_sphere(triangles, queries.data(), count, found, workers, stop);
    });
}

// Both searches walk through triangles.
TriangleArrays with_triangles(const TriangleArrays& triangles) {
    if (first_open(triangles) == static_cast<Index>(triangles.count())) {
        throw std::invalid_argument("there are no triangles: use nearest_flat");
    }
    return triangles;
}

ValuesOut<Index> nearest_in_plane(RowsIn<double, 2> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                                  RowsIn<double, 2> queries, int workers, bool checked) {
    const TriangleArrays triangles = with_triangles(to_triangles(points, simplices, neighbors, {}, checked));
    check_points("queries", queries);
    const std::size_t count = queries.shape(0);
    return answers(count, count > long_work, [&](Index* found, Stop stop) {
        nearest_plane(triangles, queries.data(), count, found, workers, stop);
    });
}

ValuesOut<Index> nearest_on_sphere(RowsIn<double, 3> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                                   RowsIn<double, 3> queries, std::optional<Closing> closing, int workers,
                                   bool checked) {
    const TriangleArrays triangles = with_triangles(to_triangles(points, simplices, neighbors, closing, checked));
    check_points("queries", queries);
    const std::size_t count = queries.shape(0);
    return answers(count, count > long_work, [&](Index* found, Stop stop) {
        nearest_sphere(triangles, queries.data(), count, found, workers, stop);
    });
}

// Rows of k numbers for each of `count` queries to some of `size` points.
template <class Work>
RowsOfAnyWidth rows_of(std::size_t k, std::size_t size, std::size_t count, Work&& work) {
    if (k == 0 || k > size) {
        throw std::invalid_argument("k must be at least 1 and at most the number of points");
    }
    return to_array<RowsOfAnyWidth>(filled<Index>(count * k, count * k > long_work, work), {count, k});
}

// `duplicates` of the triangulation.
template <class Points, class Work>
RowsOfAnyWidth k_nearest(const TriangleArrays& triangles, const Points& points, const RowsIn<Index, 2>& duplicates,
                         const Points& queries, std::size_t k, Work&& work) {
    with_triangles(triangles);
    check_points("queries", queries);
    const std::size_t count = queries.shape(0);
    const Pairs pairs = to_pairs(duplicates, points.shape(0));
    return rows_of(k, points.shape(0), count, [&](Index* found, Stop stop) {
        work(KNearestTask{triangles, pairs, queries.data(), count, k, found}, stop);
    });
}

RowsOfAnyWidth k_nearest_in_plane(RowsIn<double, 2> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                                  RowsIn<Index, 2> duplicates, RowsIn<double, 2> queries, std::size_t k, int workers,
                                  bool checked) {
    const TriangleArrays triangles = to_triangles(points, simplices, neighbors, {}, checked);
    return k_nearest(triangles, points, duplicates, queries, k,
                     [&](const KNearestTask& task, Stop stop) { k_nearest_plane(task, workers, stop); });
}

RowsOfAnyWidth k_nearest_on_sphere(RowsIn<double, 3> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                                   RowsIn<Index, 2> duplicates, RowsIn<double, 3> queries, std::size_t k,
                                   std::optional<Closing> closing, int workers, bool checked) {
    const TriangleArrays triangles = to_triangles(points, simplices, neighbors, closing, checked);
    return k_nearest(triangles, points, duplicates, queries, k,
                     [&](const KNearestTask& task, Stop stop) { k_nearest_sphere(task, workers, stop); });
}

template <class Points, class Work>
RowsOfAnyWidth nearest_flat(const Points& points, const ValuesIn<Index>& order, const RowsIn<Index, 2>& duplicates,
                            const Points& queries, std::size_t k, bool checked, Work&& work) {
    const std::size_t size = points.shape(0), count = queries.shape(0);
    if (order.shape(0) == 0) {
        throw std::invalid_argument("order must hold a point");
    }
    if (!checked) {
        check_points("points", points);
        check_indices("order", order.data(), order.shape(0), size);
    }
    check_points("queries", queries);
    const Pairs pairs = to_pairs(duplicates, size);
    return rows_of(k, size, count, [&](Index* found, Stop stop) {
        work(NearestFlatTask{points.data(), order.data(), order.shape(0), pairs, queries.data(), count, k, found},
             stop);
    });
}

RowsOfAnyWidth nearest_on_line(RowsIn<double, 2> points, ValuesIn<Index> order, RowsIn<Index, 2> duplicates,
                               RowsIn<double, 2> queries, std::size_t k, int workers, bool checked) {
    return nearest_flat(points, order, duplicates, queries, k, checked,
                        [&](const NearestFlatTask& task, Stop stop) { nearest_flat_plane(task, workers, stop); });
}

RowsOfAnyWidth nearest_on_circle(RowsIn<double, 3> points, ValuesIn<Index> order, RowsIn<Index, 2> duplicates,
                                 RowsIn<double, 3> queries, std::size_t k, int workers, bool checked) {
    return nearest_flat(points, order, duplicates, queries, k, checked,
                        [&](const NearestFlatTask& task, Stop stop) { nearest_flat_sphere(task, workers, stop); });
}

}  // namespace

void bind_location(nb::module_& module) {
    module.def("find_simplex_plane", find_plane, "points"_a, "simplices"_a, "neighbors"_a, "queries"_a,
               "workers"_a = 1, "checked"_a = false,
               "The lowest triangle that holds each query, -1 outside. checked: the kernel made the arrays.");
    module.def("find_simplex_sphere", find_sphere, "points"_a, "simplices"_a, "neighbors"_a, "queries"_a,
               "closing"_a = nb::none(), "workers"_a = 1, "checked"_a = false,
               "The same for directions; `closing` tells the triangles that hold none (none if not given).");
    module.def("nearest_plane", nearest_in_plane, "points"_a, "simplices"_a, "neighbors"_a, "queries"_a,
               "workers"_a = 1, "checked"_a = false,
               "The nearest point of each query, the lowest of several. There must be simplices.");
    module.def("nearest_sphere", nearest_on_sphere, "points"_a, "simplices"_a, "neighbors"_a, "queries"_a,
               "closing"_a = nb::none(), "workers"_a = 1, "checked"_a = false, "The same for directions.");
    module.def("k_nearest_plane", k_nearest_in_plane, "points"_a, "simplices"_a, "neighbors"_a, "duplicates"_a,
               "queries"_a, "k"_a, "workers"_a = 1, "checked"_a = false,
               "The k nearest points of each query, duplicates among them, by distance, equally near ones by number.");
    module.def("k_nearest_sphere", k_nearest_on_sphere, "points"_a, "simplices"_a, "neighbors"_a, "duplicates"_a,
               "queries"_a, "k"_a, "closing"_a = nb::none(), "workers"_a = 1, "checked"_a = false,
               "The same for directions.");
    module.def("nearest_flat_plane", nearest_on_line, "points"_a, "order"_a, "duplicates"_a, "queries"_a, "k"_a,
               "workers"_a = 1, "checked"_a = false,
               "The k nearest points of one line, as k_nearest_plane; `order`: of line_order.");
    module.def("nearest_flat_sphere", nearest_on_circle, "points"_a, "order"_a, "duplicates"_a, "queries"_a, "k"_a,
               "workers"_a = 1, "checked"_a = false, "The same for directions of one great circle; `order`: of circle_order.");
}

}  // namespace stereodel
