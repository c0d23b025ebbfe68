#include "voronoi/voronoi.hpp"

#include "voronoi/tie_views.hpp"
#include "voronoi/voronoi_cells.hpp"

namespace stereodel::voronoi {

using predicates::all_unit;
using predicates::common_granularity;

namespace {

// `make_view()`: a view of the points for one thread; see DualTriangles::find_ties.
template <class MakeView>
Diagram voronoi(std::size_t sites, const Index* simplices, const Index* neighbors, std::size_t count, int workers,
                Stop stop, MakeView&& make_view) {
    DualTriangles dual(simplices, neighbors, count);
    Crew crew(useful_workers(workers, count));
    dual.find_ties(crew, stop, make_view);
    return cells_of(dual, sites, crew, stop);
}

}  // namespace

Diagram voronoi_plane(const double* points, std::size_t sites, const Index* simplices, const Index* neighbors,
                      std::size_t count, int workers, Stop stop) {
    const double granularity = common_granularity(points, sites);
    return voronoi(sites, simplices, neighbors, count, workers, stop,
                   [&] { return PlaneView{PlanePoints(points, granularity)}; });
}

Diagram voronoi_sphere(const double* points, std::size_t sites, const Index* simplices, const Index* neighbors,
                       std::size_t count, int workers, Stop stop) {
    const bool unit = all_unit(points, sites);
    return voronoi(sites, simplices, neighbors, count, workers, stop,
                   [&] { return SphereView(Rays(points, unit)); });
}

}  // namespace stereodel::voronoi
