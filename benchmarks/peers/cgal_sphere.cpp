// CGAL on the sphere: Delaunay_triangulation_on_sphere_2, insertion of a range. Compiled twice: with the plain traits,
// which take the rounded coordinates for points of the sphere and leave out those too close together, and with
// PROJECTING defined, with the traits that take points for the rays through them.
#include "worker.hpp"

#include <CGAL/Delaunay_triangulation_on_sphere_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_traits_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_on_sphere_traits_3.h>
#include <CGAL/version.h>

#include <memory>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
#ifdef PROJECTING
using Traits = CGAL::Projection_on_sphere_traits_3<Kernel>;
#else
using Traits = CGAL::Delaunay_triangulation_on_sphere_traits_2<Kernel>;
#endif
using Triangulation = CGAL::Delaunay_triangulation_on_sphere_2<Traits>;

int main(int, char** argv) {
    std::vector<Kernel::Point_3> points;
    {
        const std::vector<double> xyz = peer::read_doubles(argv[1]);
        points.reserve(xyz.size() / 3);
        for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) points.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
    }
    const Traits traits(Kernel::Point_3(0, 0, 0), 1);
    const auto triangulate = [&] { return std::make_unique<Triangulation>(points.begin(), points.end(), traits); };
    const auto count = [](const Triangulation& t) { return peer::Counts{t.number_of_vertices(), t.number_of_faces()}; };
    return peer::converse(CGAL_VERSION_STR, triangulate, count);
}
