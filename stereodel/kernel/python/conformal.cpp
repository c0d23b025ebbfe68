// Python: conformal maps of the sphere at many points.
#include <nanobind/stl/pair.h>

#include <stdexcept>
#include <utility>

#include "conformal/moebius.hpp"
#include "python/arrays.hpp"

namespace stereodel::python {

using conformal::MoebiusParts;
using conformal::SplitRotation;
using conformal::moebius_images;
using conformal::moebius_lonlat;
using conformal::moebius_scales;

namespace {

using namespace nb::literals;
using Matrix = RowsIn<double, 3>;

constexpr std::size_t long_work = 100000;  // points: some milliseconds

// Six rows: a matrix and what it leaves of a more exact one.
SplitRotation split(const Matrix& matrix) {
    if (matrix.shape(0) != 6) {
        throw std::invalid_argument("a rotation is given by six rows");
    }
    check_finite("rotation", matrix.data(), 6, 3);
    return {matrix.data(), matrix.data() + 9};
}

MoebiusParts to_parts(const Matrix& left, double magnification, const Matrix& right) {
    if (!(magnification >= 0x1p-333 && magnification <= 0x1p333)) {  // 1e-100 to 1e100, and a little room
        throw std::invalid_argument("magnification must be from 1e-100 to 1e100");
    }
    return {split(left), magnification, split(right)};
}

template <std::size_t Width>
using Images = std::pair<RowsOut<double, Width>, bool>;
template <auto Evaluate, std::size_t Width>
Images<Width> images(const RowsIn<double, Width>& points, const Matrix& left, double magnification, const Matrix& right,
                     int workers) {
    const MoebiusParts parts = to_parts(left, magnification, right);
    const std::size_t count = points.shape(0);
    bool sound = true;
    Buffer<double> rows = filled<double>(Width * count, count > long_work, [&](double* out, Stop stop) {
        sound = Evaluate(parts, points.data(), count, out, workers, stop);
    });
    return {to_rows<Width>(std::move(rows)), sound};
}

std::pair<ValuesOut<double>, bool> scales(const RowsIn<double, 3>& xyz, const Matrix& left, double magnification,
                                          const Matrix& right, int workers) {
    const MoebiusParts parts = to_parts(left, magnification, right);
    const std::size_t count = xyz.shape(0);
    bool sound = true;
    Buffer<double> values = filled<double>(count, count > long_work, [&](double* out, Stop stop) {
        sound = moebius_scales(parts, xyz.data(), count, out, workers, stop);
    });
    return {to_values(std::move(values)), sound};
}

}  // namespace

void bind_conformal(Modules& modules) {
    nb::module_& module = modules.both;
    module.def("moebius_images", images<moebius_images, 3>, "xyz"_a, "left"_a, "magnification"_a, "right"_a,
               "workers"_a = 1, "Images of directions as unit vectors, and whether all were finite and not zero.");
    module.def("moebius_lonlat", images<moebius_lonlat, 2>, "lonlat"_a, "left"_a, "magnification"_a, "right"_a,
               "workers"_a = 1, "Images (lon, lat) of (lon, lat) in degrees, and whether all were points.");
    module.def("moebius_scales", scales, "xyz"_a, "left"_a, "magnification"_a, "right"_a, "workers"_a = 1,
               "Local scales at directions, and whether all were finite and not zero.");
}

}  // namespace stereodel::python
