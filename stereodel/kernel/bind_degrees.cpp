// Python: sine and cosine of degrees, longitude and latitude to unit vectors.

#include "bind_support.hpp"
#include "degrees.hpp"
#include "lonlat.hpp"

namespace stereodel {
namespace {

using namespace nb::literals;
using Angles = nb::ndarray<const double, nb::numpy, nb::shape<-1>, nb::c_contig, nb::device::cpu>;

RowsOut<double, 4> sines_and_cosines(const Angles& angles) {
    const std::size_t count = angles.shape(0);
    Buffer<double> rows(4 * count);
    {
        const nb::gil_scoped_release release;
        for (std::size_t k = 0; k < count; ++k) {
            const SineCosine value = sin_cos_degrees(angles.data()[k]);
            rows[4 * k] = value.sine.hi;
            rows[4 * k + 1] = value.sine.lo;
            rows[4 * k + 2] = value.cosine.hi;
            rows[4 * k + 3] = value.cosine.lo;
        }
    }
    return to_rows<4>(std::move(rows));
}

RowsOut<double, 3> unit_vectors(const RowsIn<double, 2>& lonlat) {
    const std::size_t count = lonlat.shape(0);
    Buffer<double> xyz(3 * count);
    {
        const nb::gil_scoped_release release;
        lonlat_to_xyz(lonlat.data(), count, xyz.data());
    }
    return to_rows<3>(std::move(xyz));
}

}  // namespace

void bind_degrees(nb::module_& module) {
    module.def("sin_cos_degrees", sines_and_cosines, "angles"_a,
               "Rows (sine, its low part, cosine, its low part) of angles in degrees; relative errors below 2^-101.");
    module.def("lonlat_to_xyz", unit_vectors, "lonlat"_a,
               "Unit vectors of rows (lon, lat) in degrees, each component rounded once.");
}

}  // namespace stereodel
