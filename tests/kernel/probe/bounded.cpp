// Double-doubles that know their error, for Python.
#include "arithmetic/bounded.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/pair.h>

#include <utility>

namespace stereodel::probe {

namespace nb = nanobind;
using arithmetic::Bounded;

// a/b, both exact, times a power of two: its double and its radius.
std::pair<double, double> bounded_quotient(double a, double b, int bits) {
    const Bounded quotient = (Bounded({a, 0.0}) / Bounded({b, 0.0})).times_power(bits);
    return {quotient.middle(0), quotient.radius(0)};
}

void bind_bounded(nb::module_& m) {
    m.def("bounded_quotient", bounded_quotient, nb::arg("a"), nb::arg("b"), nb::arg("bits"));
}

}  // namespace stereodel::probe
