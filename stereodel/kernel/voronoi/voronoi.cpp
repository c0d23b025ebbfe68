#include "voronoi/voronoi.hpp"

#include "voronoi/tie_views.hpp"
#include "voronoi/voronoi_cells.hpp"

namespace stereodel::voronoi {

template <std::size_t Width>
Diagram diagram_of(const double* points, std::size_t sites, const Index* simplices, const Index* neighbors,
                   std::size_t count, int workers, Stop stop) {
    DualTriangles dual(simplices, neighbors, count);
    Crew crew(useful_workers(workers, count));
    dual.find_ties(crew, stop, views_of<Width>(points, sites));
    return cells_of(dual, sites, crew, stop);
}

template Diagram diagram_of<2>(const double*, std::size_t, const Index*, const Index*, std::size_t, int, Stop);
template Diagram diagram_of<3>(const double*, std::size_t, const Index*, const Index*, std::size_t, int, Stop);

}  // namespace stereodel::voronoi
