// Python: sine and cosine of degrees, latitudes, angles of vectors, longitude and latitude to unit vectors.
#include <stdexcept>

#include "arithmetic/arc_tangent.hpp"
#include "coordinates/degrees.hpp"
#include "coordinates/latitudes.hpp"
#include "coordinates/lonlat.hpp"
#include "python/arrays.hpp"

namespace stereodel::python {

using arithmetic::vector_angle;
using coordinates::SineCosine;
using coordinates::authalic_factors;
using coordinates::lonlat_to_xyz;
using coordinates::sin_cos_degrees;
using coordinates::xyz_to_lonlat;

namespace {

using namespace nb::literals;

RowsOut<double, 4> sines_and_cosines(const ValuesIn<double>& angles) {
    const std::size_t count = angles.shape(0);
    check_finite("angles", angles.data(), count);
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

RowsOut<double, 4> factors_of_squares(const RowsIn<double, 2>& squares) {
    const std::size_t count = squares.shape(0);
    check_finite("squares", squares.data(), count, 2);
    return to_rows<4>(filled<double>(4 * count, false, [&](double* rows, Stop) {
        for (std::size_t k = 0; k < count; ++k) {
            const auto [p, r] = authalic_factors({squares.data()[2 * k], squares.data()[2 * k + 1]});
            std::copy_n(std::initializer_list<double>{p.hi, p.lo, r.hi, r.lo}.begin(), 4, rows + 4 * k);
        }
    }));
}

ValuesOut<double> vector_angles(const ValuesIn<double>& y, const ValuesIn<double>& x) {
    const std::size_t count = y.shape(0);
    if (x.shape(0) != count) {
        throw std::invalid_argument("x and y must have one length");
    }
    return to_values(filled<double>(count, false, [&](double* angles, Stop) {
        for (std::size_t k = 0; k < count; ++k) {
            angles[k] = vector_angle(y.data()[k], x.data()[k]);
        }
    }));
}

constexpr std::size_t long_work = 100000;  // points: some milliseconds

// A conversion of all rows.
template <auto Convert, std::size_t From, std::size_t To>
RowsOut<double, To> converted(const RowsIn<double, From>& rows, int workers) {
    const std::size_t count = rows.shape(0);
    check_points(From == 2 ? "lonlat" : "xyz", rows);
    return to_rows<To>(filled<double>(To * count, count > long_work, [&](double* out, Stop stop) {
        Convert(rows.data(), count, out, workers, stop);
    }));
}

}  // namespace

void bind_degrees(Modules& modules) {
    nb::module_& module = modules.both;
    module.def("sin_cos_degrees", sines_and_cosines, "angles"_a,
               "Rows (sine, its low part, cosine, its low part) of angles in degrees; relative errors below 2^-101.");
    module.def("authalic_factors", factors_of_squares, "squares"_a,
               "Rows (P, its low part, R, its low part) of squares (value, low part) of sines of geodetic latitudes: "
               "sine P and cosine R, over P(1), are those of the authalic latitude; relative errors below 2^-84.");
    module.def("vector_angles", vector_angles, "y"_a, "x"_a,
               "Angles of vectors (x, y) in radians, in [-pi, pi], within 3.1 * 2^-53 of themselves.");
    module.def("lonlat_to_xyz", converted<lonlat_to_xyz, 2, 3>, "lonlat"_a, "workers"_a = 1,
               "Unit vectors of rows (lon, lat) in degrees, each component rounded once.");
    module.def("xyz_to_lonlat", converted<xyz_to_lonlat, 3, 2>, "xyz"_a, "workers"_a = 1,
               "Rows (lon, lat) in degrees, each within an ulp, of non-zero directions of any length.");
}

}  // namespace stereodel::python
