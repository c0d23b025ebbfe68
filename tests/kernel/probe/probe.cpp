// The module stereodel._kernel_probe: parts of the kernel that the tests ask by themselves, and that the library
// reaches from C++ alone. Wheels do not have it.
#include <nanobind/nanobind.h>

namespace stereodel::probe {

void bind_bounded(nanobind::module_& module);
void bind_predicates(nanobind::module_& module);
void bind_projection(nanobind::module_& module);
void bind_raster(nanobind::module_& module);

}  // namespace stereodel::probe

NB_MODULE(_kernel_probe, module) {
    stereodel::probe::bind_bounded(module);
    stereodel::probe::bind_predicates(module);
    stereodel::probe::bind_projection(module);
    stereodel::probe::bind_raster(module);
}
