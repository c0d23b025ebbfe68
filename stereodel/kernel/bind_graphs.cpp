#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <stdexcept>
#include <string>

#include "bind_rows.hpp"
#include "bind_triangles.hpp"
#include "proximity.hpp"
#include "sites.hpp"
#include "spanning_tree.hpp"

namespace stereodel {
namespace {

using namespace nb::literals;

constexpr std::size_t long_work = 10000;  // triangles, edges: some milliseconds

Proximity graph_of(const std::string& name) {
    if (name == "gabriel") {
        return Proximity::gabriel;
    }
    if (name == "urquhart") {
        return Proximity::urquhart;
    }
    if (name == "relative") {
        return Proximity::relative;
    }
    throw std::invalid_argument("graph: gabriel, urquhart or relative");
}

template <std::size_t Width>
RowsOut<Index, 2> proximity(RowsIn<double, Width> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                            const std::string& name, int workers, bool checked) {
    const TriangleArrays triangles = to_triangles(points, simplices, neighbors, {}, checked);
    const Proximity graph = graph_of(name);
    return to_rows(run_without_lock(triangles.count() > long_work, [&](Stop stop) {
        return (Width == 2 ? proximity_plane : proximity_sphere)(triangles, points.shape(0), graph, workers, stop);
    }));
}

template <std::size_t Width>
RowsOut<Index, 2> spanning_tree(RowsIn<double, Width> points, const Numbers& edges) {
    const std::size_t size = points.shape(0), count = edges.shape(0);
    check_points("points", points);
    check_numbers(edges, 2, size);
    Pairs pairs;
    for (std::size_t k = 0; k < count; ++k) {
        pairs.emplace_back(edges.data()[2 * k], edges.data()[2 * k + 1]);
    }
    return to_rows(run_without_lock(count > long_work, [&](Stop stop) {
        return (Width == 2 ? spanning_tree_plane : spanning_tree_sphere)(points.data(), size, pairs, stop);
    }));
}

// The predicates, by number: four of each row for lengths, three for diametral circles.
template <class Sites, std::size_t Width>
Signs compare_lengths(RowsIn<double, Width> points, const Numbers& numbers) {
    check_numbers(numbers, 4, points.shape(0));
    check_points("points", points);
    const Sites sites(points.data(), points.shape(0));
    return over_rows(numbers.shape(0), [&](std::size_t k) {
        const Index* n = numbers.data() + 4 * k;
        return sites.compare_lengths(n[0], n[1], n[2], n[3]);
    });
}

template <class Sites, std::size_t Width>
Signs diametral(RowsIn<double, Width> points, const Numbers& numbers) {
    check_numbers(numbers, 3, points.shape(0));
    check_points("points", points);
    const Sites sites(points.data(), points.shape(0));
    return over_rows(numbers.shape(0), [&](std::size_t k) {
        const Index* n = numbers.data() + 3 * k;
        return sites.diametral(n[0], n[1], n[2]);
    });
}

}  // namespace

void bind_graphs(nb::module_& module) {
    module.def("proximity_plane", proximity<2>, "points"_a, "simplices"_a, "neighbors"_a, "graph"_a,
               "workers"_a = 1, "checked"_a = false,
               "Edges of the graph \"gabriel\", \"urquhart\" or \"relative\" of a triangulation, sorted.");
    module.def("proximity_sphere", proximity<3>, "points"_a, "simplices"_a, "neighbors"_a, "graph"_a,
               "workers"_a = 1, "checked"_a = false,
               "The same for directions.");
    module.def("spanning_tree_plane", spanning_tree<2>, "points"_a, "edges"_a,
               "The shortest forest among the edges, equally long ones in the order of their ends; sorted.");
    module.def("spanning_tree_sphere", spanning_tree<3>, "points"_a, "edges"_a, "The same for directions.");
    module.def("compare_lengths_plane", compare_lengths<PlaneSites, 2>, "points"_a, "numbers"_a,
               "Sign of |ab| - |cd| for rows a b c d of numbers.");
    module.def("compare_lengths_sphere", compare_lengths<SphereSites, 3>, "points"_a, "numbers"_a,
               "The same of angles between directions.");
    module.def("diametral_plane", diametral<PlaneSites, 2>, "points"_a, "numbers"_a,
               "1 where p lies outside the circle with diameter ab, 0 on it, -1 inside, for rows a b p of numbers.");
    module.def("diametral_sphere", diametral<SphereSites, 3>, "points"_a, "numbers"_a,
               "The same for directions; 0 for opposite a and b.");
}

}  // namespace stereodel
