// CGAL in the plane: Delaunay_triangulation_2 with exact predicates and inexact constructions, insertion of a range
// (which sorts the points along a space-filling curve first).
#include "worker.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#include <memory>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation = CGAL::Delaunay_triangulation_2<Kernel>;

int main(int, char** argv) {
    std::vector<Kernel::Point_2> points;
    {
        const std::vector<double> xy = peer::read_doubles(argv[1]);
        points.reserve(xy.size() / 2);
        for (std::size_t i = 0; i + 1 < xy.size(); i += 2) points.emplace_back(xy[i], xy[i + 1]);
    }
    const auto triangulate = [&] { return std::make_unique<Triangulation>(points.begin(), points.end()); };
    const auto count = [](const Triangulation& t) { return peer::Counts{t.number_of_vertices(), t.number_of_faces()}; };
    return peer::converse(CGAL_VERSION_STR, triangulate, count);
}
