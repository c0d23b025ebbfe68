#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <stdexcept>
#include <string>

#include "graphs/proximity.hpp"
#include "graphs/sites.hpp"
#include "graphs/spanning_tree.hpp"
#include "python/rows.hpp"
#include "python/triangles.hpp"

namespace stereodel::python {

using graphs::Proximity;
using graphs::SitesOf;

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
        return graphs::proximity<Width>(triangles, points.shape(0), graph, workers, stop);
    }));
}

template <std::size_t Width>
RowsOut<Index, 2> spanning_tree(RowsIn<double, Width> points, const Numbers& edges) {
    const std::size_t size = points.shape(0), count = edges.shape(0);
    check_points("points", points);
    check_numbers(edges, 2, size);
    const Pairs pairs = stereodel::to_pairs(edges.data(), count);
    return to_rows(run_without_lock(count > long_work, [&](Stop stop) {
        return graphs::spanning_tree<Width>(points.data(), size, pairs, stop);
    }));
}

// The predicates, by number: four of each row for lengths, three for diametral circles.
template <std::size_t Width>
Signs compare_lengths(RowsIn<double, Width> points, const Numbers& numbers) {
    check_numbers(numbers, 4, points.shape(0));
    check_points("points", points);
    const SitesOf<Width> sites(points.data(), points.shape(0));
    return over_rows(numbers.shape(0), [&](std::size_t k) {
        const Index* n = numbers.data() + 4 * k;
        return sites.compare_lengths(n[0], n[1], n[2], n[3]);
    });
}

template <std::size_t Width>
Signs diametral(RowsIn<double, Width> points, const Numbers& numbers) {
    check_numbers(numbers, 3, points.shape(0));
    check_points("points", points);
    const SitesOf<Width> sites(points.data(), points.shape(0));
    return over_rows(numbers.shape(0), [&](std::size_t k) {
        const Index* n = numbers.data() + 3 * k;
        return sites.diametral(n[0], n[1], n[2]);
    });
}

template <std::size_t Width>
void bind_space(nb::module_& space) {
    space.def("proximity", proximity<Width>, "points"_a, "simplices"_a, "neighbors"_a, "graph"_a, "workers"_a = 1,
              "checked"_a = false,
              "Edges of the graph \"gabriel\", \"urquhart\" or \"relative\" of a triangulation, sorted.");
    space.def("spanning_tree", spanning_tree<Width>, "points"_a, "edges"_a,
              "The shortest forest among the edges, equally long ones in the order of their ends; sorted.");
    space.def("compare_lengths", compare_lengths<Width>, "points"_a, "numbers"_a,
              "Sign of |ab| - |cd| for rows a b c d of numbers; of angles between directions.");
    space.def("diametral", diametral<Width>, "points"_a, "numbers"_a,
              "1 where p lies outside the circle with diameter ab, 0 on it, -1 inside, for rows a b p of numbers; 0 "
              "for opposite directions a and b.");
}

}  // namespace

void bind_graphs(Modules& modules) {
    bind_space<2>(modules.plane);
    bind_space<3>(modules.sphere);
}

}  // namespace stereodel::python
