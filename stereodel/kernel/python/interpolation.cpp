#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "interpolation/natural_neighbors.hpp"
#include "python/triangles.hpp"

namespace stereodel::python {

using interpolation::NaturalNeighborTask;
using interpolation::natural_neighbors;

namespace {

using namespace nb::literals;

constexpr std::size_t long_work = 4000;  // queries: some milliseconds

using Table = nb::ndarray<const double, nb::numpy, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Vectors = nb::ndarray<nb::numpy, double, nb::ndim<3>, nb::c_contig>;

// Values at the queries, (count, 1, width), or gradients, (count, dimension, width).
template <std::size_t Width>
Vectors answers(const NaturalNeighborTask& task, bool gradients, int workers) {
    const std::size_t size = task.count * task.width;
    const bool is_long = task.count > long_work;
    using Both = std::pair<Buffer<double>, Buffer<double>>;
    Both both = run_without_lock(is_long, [&](Stop stop) {
        Both out(Buffer<double>{size}, Buffer<double>{gradients ? size * Width : 0});
        NaturalNeighborTask filled = task;
        filled.found = out.first.data();
        filled.gradients = gradients ? out.second.data() : nullptr;
        natural_neighbors<Width>(filled, workers, stop);
        return out;
    });
    return gradients ? to_array<Vectors>(std::move(both.second), {task.count, Width, task.width})
                     : to_array<Vectors>(std::move(both.first), {task.count, 1, task.width});
}

// Whose values count for each query, row after row: offsets (count + 1,), numbers of points, and weights.
template <std::size_t Width>
nb::tuple shares(const NaturalNeighborTask& task, int workers) {
    struct Shares {
        Buffer<std::int64_t> offsets;
        Buffer<Index> members;
        Buffer<double> weights;
    };
    Shares all = run_without_lock(task.count > long_work, [&](Stop stop) {
        // First how many there are, so that the threads know where to put them.
        Shares out;
        out.offsets = Buffer<std::int64_t>{task.count + 1};
        out.offsets.data()[0] = 0;
        NaturalNeighborTask counted = task;
        counted.counts = out.offsets.data() + 1;
        natural_neighbors<Width>(counted, workers, stop);
        for (std::size_t k = 0; k < task.count; ++k) {
            out.offsets.data()[k + 1] += out.offsets.data()[k];
        }
        const std::size_t size = static_cast<std::size_t>(out.offsets.data()[task.count]);
        out.members = Buffer<Index>{size};
        out.weights = Buffer<double>{size};
        NaturalNeighborTask filled = task;
        filled.starts = out.offsets.data();
        filled.members = out.members.data();
        filled.weights = out.weights.data();
        natural_neighbors<Width>(filled, workers, stop);
        return out;
    });
    return nb::make_tuple(to_values(std::move(all.offsets)), to_values(std::move(all.members)),
                          to_values(std::move(all.weights)));
}

NaturalNeighborTask plane_task(const RowsIn<double, 2>& points, const RowsIn<Index, 3>& simplices,
                               const RowsIn<Index, 3>& neighbors, const RowsIn<double, 2>& queries, bool checked) {
    check_points("queries", queries);
    NaturalNeighborTask task{to_triangles(points, simplices, neighbors, {}, checked)};
    task.queries = queries.data();
    task.count = queries.shape(0);
    return task;
}

NaturalNeighborTask sphere_task(const RowsIn<double, 3>& points, const RowsIn<double, 3>& units,
                                const RowsIn<double, 3>& rests, const RowsIn<Index, 3>& simplices,
                                const RowsIn<Index, 3>& neighbors, const RowsIn<double, 3>& queries,
                                const RowsIn<double, 3>& query_units, const RowsIn<double, 3>& query_rests,
                                const std::optional<Closing>& closing, bool checked) {
    const std::size_t size = points.shape(0), count = queries.shape(0);
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
    NaturalNeighborTask task{to_triangles(points, simplices, neighbors, closing, checked)};
    task.units = units.data();
    task.unit_rests = rests.data();
    task.queries = queries.data();
    task.query_units = query_units.data();
    task.query_rests = query_rests.data();
    task.count = count;
    return task;
}

template <class Rows>
void take_values(NaturalNeighborTask& task, const Rows& points, const Table& values) {
    check_same_length("points", points.shape(0), "values", values.shape(0));
    task.values = values.data();
    task.width = values.shape(1);
}

Vectors in_plane(RowsIn<double, 2> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors, Table values,
                 RowsIn<double, 2> queries, bool gradients, int workers, bool checked) {
    NaturalNeighborTask task = plane_task(points, simplices, neighbors, queries, checked);
    take_values(task, points, values);
    return answers<2>(task, gradients, workers);
}

nb::tuple weights_in_plane(RowsIn<double, 2> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                           RowsIn<double, 2> queries, int workers, bool checked) {
    const NaturalNeighborTask task = plane_task(points, simplices, neighbors, queries, checked);
    return shares<2>(task, workers);
}

Vectors on_sphere(RowsIn<double, 3> points, RowsIn<double, 3> units, RowsIn<double, 3> rests,
                  RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors, Table values, RowsIn<double, 3> queries,
                  RowsIn<double, 3> query_units, RowsIn<double, 3> query_rests, std::optional<Closing> closing,
                  bool gradients, int workers, bool checked) {
    NaturalNeighborTask task = sphere_task(points, units, rests, simplices, neighbors, queries, query_units,
                                           query_rests, closing, checked);
    take_values(task, points, values);
    return answers<3>(task, gradients, workers);
}

nb::tuple weights_on_sphere(RowsIn<double, 3> points, RowsIn<double, 3> units, RowsIn<double, 3> rests,
                            RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors, RowsIn<double, 3> queries,
                            RowsIn<double, 3> query_units, RowsIn<double, 3> query_rests,
                            std::optional<Closing> closing, int workers, bool checked) {
    const NaturalNeighborTask task = sphere_task(points, units, rests, simplices, neighbors, queries, query_units,
                                                 query_rests, closing, checked);
    return shares<3>(task, workers);
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
    modules.plane.def("natural_neighbor_weights", weights_in_plane, "points"_a, "simplices"_a, "neighbors"_a,
               "queries"_a, "workers"_a = 1, "checked"_a = false,
               "Sibson's weights at the queries, row after row: offsets (m + 1,), points and their weights.");
    modules.sphere.def("natural_neighbor_weights", weights_on_sphere, "points"_a, "units"_a, "rests"_a, "simplices"_a,
               "neighbors"_a, "queries"_a, "query_units"_a, "query_rests"_a, "closing"_a = nb::none(), "workers"_a = 1,
               "checked"_a = false,
               "The same for directions, which come as unit vectors in double-double too: units + rests.");
}

}  // namespace stereodel::python
