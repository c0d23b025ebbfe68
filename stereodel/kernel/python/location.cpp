#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>

#include <optional>
#include <stdexcept>

#include "python/triangles.hpp"
#include "queries/k_nearest.hpp"
#include "queries/location.hpp"
#include "queries/nearest.hpp"
#include "queries/nearest_flat.hpp"
#include "queries/query_pieces.hpp"

namespace stereodel::python {

using queries::KNearestTask;
using queries::NearestFlatTask;
using queries::first_open;

namespace {

using namespace nb::literals;
using RowsOfAnyWidth = nb::ndarray<nb::numpy, Index, nb::ndim<2>, nb::c_contig>;

constexpr std::size_t long_work = 10000;  // queries: some milliseconds

// One number for each of `count` queries.
template <class Work>
ValuesOut<Index> answers(std::size_t count, bool is_long, Work&& work) {
    return to_values(filled<Index>(count, is_long, work));
}

template <std::size_t Width>
ValuesOut<Index> find_simplex(RowsIn<double, Width> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                              RowsIn<double, Width> queries, std::optional<Closing> closing, int workers,
                              bool checked) {
    const TriangleArrays triangles = to_triangles(points, simplices, neighbors, closing, checked);
    check_points("queries", queries);
    const std::size_t count = queries.shape(0);
    return answers(count, count > long_work, [&](Index* found, Stop stop) {
        queries::find_simplex<Width>(triangles, queries.data(), count, found, workers, stop);
    });
}

// Both searches walk through triangles.
TriangleArrays with_triangles(const TriangleArrays& triangles) {
    if (first_open(triangles) == static_cast<Index>(triangles.count())) {
        throw std::invalid_argument("there are no triangles: use nearest_flat");
    }
    return triangles;
}

template <std::size_t Width>
ValuesOut<Index> nearest(RowsIn<double, Width> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                         RowsIn<double, Width> queries, std::optional<Closing> closing, int workers, bool checked) {
    const TriangleArrays triangles = with_triangles(to_triangles(points, simplices, neighbors, closing, checked));
    check_points("queries", queries);
    const std::size_t count = queries.shape(0);
    return answers(count, count > long_work, [&](Index* found, Stop stop) {
        queries::nearest<Width>(triangles, queries.data(), count, found, workers, stop);
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
template <std::size_t Width>
RowsOfAnyWidth k_nearest(RowsIn<double, Width> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                         RowsIn<Index, 2> duplicates, RowsIn<double, Width> queries, std::size_t k,
                         std::optional<Closing> closing, int workers, bool checked) {
    const TriangleArrays triangles = with_triangles(to_triangles(points, simplices, neighbors, closing, checked));
    check_points("queries", queries);
    const std::size_t count = queries.shape(0);
    const Pairs pairs = to_pairs(duplicates, points.shape(0));
    return rows_of(k, points.shape(0), count, [&](Index* found, Stop stop) {
        const KNearestTask task{triangles, pairs, queries.data(), count, k, found};
        queries::k_nearest<Width>(task, workers, stop);
    });
}

template <std::size_t Width>
RowsOfAnyWidth nearest_flat(RowsIn<double, Width> points, ValuesIn<Index> order, RowsIn<Index, 2> duplicates,
                            RowsIn<double, Width> queries, std::size_t k, int workers, bool checked) {
    const std::size_t size = points.shape(0), count = queries.shape(0), different = order.shape(0);
    if (different == 0) {
        throw std::invalid_argument("order must hold a point");
    }
    if (!checked) {
        check_points("points", points);
        check_distinct("order", order.data(), different, size);
    }
    check_points("queries", queries);
    const Pairs pairs = to_pairs(duplicates, size);
    return rows_of(k, size, count, [&](Index* found, Stop stop) {
        const NearestFlatTask task{points.data(), order.data(), different, pairs, queries.data(), count, k, found};
        queries::nearest_flat<Width>(task, workers, stop);
    });
}

template <std::size_t Width>
void bind_space(nb::module_& space) {
    space.def("find_simplex", find_simplex<Width>, "points"_a, "simplices"_a, "neighbors"_a, "queries"_a,
              "closing"_a = nb::none(), "workers"_a = 1, "checked"_a = false,
              "The lowest triangle that holds each query, -1 outside. closing: triangles that hold none. checked: the "
              "kernel made the arrays.");
    space.def("nearest", nearest<Width>, "points"_a, "simplices"_a, "neighbors"_a, "queries"_a,
              "closing"_a = nb::none(), "workers"_a = 1, "checked"_a = false,
              "The nearest point of each query, the lowest of several. There must be simplices.");
    space.def("k_nearest", k_nearest<Width>, "points"_a, "simplices"_a, "neighbors"_a, "duplicates"_a, "queries"_a,
              "k"_a, "closing"_a = nb::none(), "workers"_a = 1, "checked"_a = false,
              "The k nearest points of each query, duplicates among them, by distance, equally near ones by number.");
    space.def("nearest_flat", nearest_flat<Width>, "points"_a, "order"_a, "duplicates"_a, "queries"_a, "k"_a,
              "workers"_a = 1, "checked"_a = false,
              "The same for points that are taken to lie on one line or great circle; order: what flat_order gives.");
}

}  // namespace

void bind_location(Modules& modules) {
    bind_space<2>(modules.plane);
    bind_space<3>(modules.sphere);
}

}  // namespace stereodel::python
