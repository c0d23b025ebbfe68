// The module stereodel._kernel. Types, orders and widths of arrays are checked by nanobind, what they hold by
// input_checks.hpp.
#include <nanobind/nanobind.h>

namespace stereodel {

void bind_conformal(nanobind::module_& module);
void bind_degrees(nanobind::module_& module);
void bind_delaunay(nanobind::module_& module);
void bind_graphs(nanobind::module_& module);
void bind_interpolation(nanobind::module_& module);
void bind_location(nanobind::module_& module);
void bind_mesh(nanobind::module_& module);
void bind_predicates(nanobind::module_& module);
void bind_raster(nanobind::module_& module);
void bind_signs(nanobind::module_& module);
void bind_voronoi(nanobind::module_& module);

}  // namespace stereodel

NB_MODULE(_kernel, module) {
    module.doc() =
        "The compiled part of stereodel: predicates, divide and conquer, insertion and removal, location, Voronoi "
        "diagrams, rasters on a globe.";
    stereodel::bind_conformal(module);
    stereodel::bind_degrees(module);
    stereodel::bind_delaunay(module);
    stereodel::bind_graphs(module);
    stereodel::bind_interpolation(module);
    stereodel::bind_location(module);
    stereodel::bind_mesh(module);
    stereodel::bind_predicates(module);
    stereodel::bind_raster(module);
    stereodel::bind_signs(module);
    stereodel::bind_voronoi(module);
}
