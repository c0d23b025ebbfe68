// Python: sine and cosine of degrees, longitude and latitude to unit vectors.

#include "bind_support.hpp"
#include "degrees.hpp"
#include "lonlat.hpp"

namespace stereodel {
namespace {

using namespace nb::literals;

RowsOut<double, 4> sines_and_cosines(const ValuesIn<double>& angles) {
    const std::size_t count = angles.shape(0);
    return to_rows<4>(filled<double>(4 * count, false, [&](double* rows, Stop) {
        for (std::size_t k = 0; k < count; ++k) {
            const SineCosine value = sin_cos_degrees(angles.data()[k]);
            rows[4 * k] = value.sine.hi;
            rows[4 * k + 1] = value.sine.lo;
            rows[4 * k + 2] = value.cosine.hi;
            rows[4 * k + 3] = value.cosine.lo;
        }
    }));
}

RowsOut<double, 3> unit_vectors(const RowsIn<double, 2>& lonlat) {
    const std::size_t count = lonlat.shape(0);
    return to_rows<3>(
        filled<double>(3 * count, false, [&](double* xyz, Stop) { lonlat_to_xyz(lonlat.data(), count, xyz); }));
}

}  // namespace

void bind_degrees(nb::module_& module) {
    module.def("sin_cos_degrees", sines_and_cosines, "angles"_a,
               "Rows (sine, its low part, cosine, its low part) of angles in degrees; relative errors below 2^-101.");
    module.def("lonlat_to_xyz", unit_vectors, "lonlat"_a,
               "Unit vectors of rows (lon, lat) in degrees, each component rounded once.");
}

}  // namespace stereodel
