// The module stereodel._kernel. Types, orders and widths of arrays are checked by nanobind, what they hold by
// input_checks.hpp.
#include "python/arrays.hpp"

namespace stereodel::python {

void bind_conformal(Modules& modules);
void bind_degrees(Modules& modules);
void bind_delaunay(Modules& modules);
void bind_graphs(Modules& modules);
void bind_interpolation(Modules& modules);
void bind_location(Modules& modules);
void bind_mesh(Modules& modules);
void bind_partitions(Modules& modules);
void bind_predicates(Modules& modules);
void bind_raster(Modules& modules);
void bind_voronoi(Modules& modules);

}  // namespace stereodel::python

NB_MODULE(_kernel, module) {
    using namespace stereodel::python;
    module.doc() =
        "The compiled part of stereodel: predicates, triangulation, location, Voronoi diagrams, graphs, conformal "
        "maps, rasters on a globe, triangulations in parts.";
    Modules modules{module, module.def_submodule("plane", "Points of the plane, (n, 2)."),
                    module.def_submodule("sphere", "Directions, (n, 3): what `plane` has, under the same names.")};
    bind_conformal(modules);
    bind_degrees(modules);
    bind_delaunay(modules);
    bind_graphs(modules);
    bind_interpolation(modules);
    bind_location(modules);
    bind_mesh(modules);
    bind_partitions(modules);
    bind_predicates(modules);
    bind_raster(modules);
    bind_voronoi(modules);
}
