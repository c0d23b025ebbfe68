#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>

#include <cstddef>
#include <optional>
#include <utility>

#include "interpolation/natural_neighbors.hpp"
#include "python/triangles.hpp"

namespace stereodel::python {

using interpolation::NaturalNeighborTask;
using interpolation::natural_neighbors_plane;
using interpolation::natural_neighbors_sphere;

namespace {

using namespace nb::literals;

constexpr std::size_t long_work = 4000;  // queries: some milliseconds

using Table = nb::ndarray<const double, nb::numpy, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Vectors = nb::ndarray<nb::numpy, double, nb::ndim<3>, nb::c_contig>;

// Values at the queries, (count, 1, width), or gradients, (count, dimension, width).
template <class Work>
Vectors answers(const NaturalNeighborTask& task, std::size_t dimension, bool gradients, Work&& work) {
    const std::size_t size = task.count * task.width;
    const bool is_long = task.count > long_work;
    using Both = std::pair<Buffer<double>, Buffer<double>>;
    Both both = run_without_lock(is_long, [&](Stop stop) {
        Both out(Buffer<double>{size}, Buffer<double>{gradients ? size * dimension : 0});
        NaturalNeighborTask filled = task;
        filled.found = out.first.data();
        filled.gradients = gradients ? out.second.data() : nullptr;
        work(filled, stop);
        return out;
    });
    return gradients ? to_array<Vectors>(std::move(both.second), {task.count, dimension, task.width})
                     : to_array<Vectors>(std::move(both.first), {task.count, 1, task.width});
}

Vectors in_plane(RowsIn<double, 2> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors, Table values,
                    RowsIn<double, 2> queries, bool gradients, int workers, bool checked) {
    check_same_length("points", points.shape(0), "values", values.shape(0));
    check_points("queries", queries);
    const NaturalNeighborTask task{to_triangles(points, simplices, neighbors, {}, checked),
                                   nullptr,
                                   nullptr,
                                   queries.data(),
                                   nullptr,
                                   nullptr,
                                   queries.shape(0),
                                   values.data(),
                                   values.shape(1),
                                   nullptr,
                                   nullptr};
    return answers(task, 2, gradients, [workers](const NaturalNeighborTask& filled, Stop stop) {
        natural_neighbors_plane(filled, workers, stop);
    });
}

Vectors on_sphere(RowsIn<double, 3> points, RowsIn<double, 3> units, RowsIn<double, 3> rests,
                     RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors, Table values, RowsIn<double, 3> queries,
                     RowsIn<double, 3> query_units, RowsIn<double, 3> query_rests, std::optional<Closing> closing,
                     bool gradients, int workers, bool checked) {
    const std::size_t size = points.shape(0), count = queries.shape(0);
    check_same_length("points", size, "values", values.shape(0));
    check_same_length("points", size, "units", units.shape(0));
    check_same_length("points", size, "rests", rests.shape(0));
    check_same_length("queries", count, "query_units", query_units.shape(0));
    check_same_length("queries", count, "query_rests", query_rests.shape(0));
    check_points("queries", queries);
    check_points("query_units", query_units);
    check_finite("query_rests", query_rests.data(), count, 3);
    if (!checked) {
        check_points("units", units);
        check_finite("rests", rests.data(), size, 3);
    }
    const NaturalNeighborTask task{to_triangles(points, simplices, neighbors, closing, checked),
                                   units.data(),
                                   rests.data(),
                                   queries.data(),
                                   query_units.data(),
                                   query_rests.data(),
                                   count,
                                   values.data(),
                                   values.shape(1),
                                   nullptr,
                                   nullptr};
    return answers(task, 3, gradients, [workers](const NaturalNeighborTask& filled, Stop stop) {
        natural_neighbors_sphere(filled, workers, stop);
    });
}

}  // namespace

void bind_interpolation(Modules& modules) {
    modules.plane.def("natural_neighbors", in_plane, "points"_a, "simplices"_a, "neighbors"_a, "values"_a, "queries"_a,
               "gradients"_a = false, "workers"_a = 1, "checked"_a = false,
               "Sibson's interpolant of values (n, k) at the queries, (m, 1, k), or its gradients, (m, 2, k).");
    modules.sphere.def("natural_neighbors", on_sphere, "points"_a, "units"_a, "rests"_a, "simplices"_a, "neighbors"_a,
               "values"_a, "queries"_a, "query_units"_a, "query_rests"_a, "closing"_a = nb::none(),
               "gradients"_a = false, "workers"_a = 1, "checked"_a = false,
               "The same for directions, which come as unit vectors in double-double too: units + rests.");
}

}  // namespace stereodel::python
