// Python: rotations and conformal maps of the sphere, composed and at many points.
#include <nanobind/stl/pair.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "conformal/group.hpp"
#include "conformal/moebius.hpp"
#include "conformal/rotations.hpp"
#include "python/arrays.hpp"

namespace stereodel::python {

using arithmetic::DoubleDouble;
using conformal::Element;
using conformal::MoebiusParts;
using conformal::SplitRotation;
using conformal::StoredMap;
using conformal::composed;
using conformal::element_of;
using conformal::moebius_images;
using conformal::moebius_lonlat;
using conformal::moebius_scales;
using conformal::stored;

namespace {

using namespace nb::literals;
using SixRows = RowsIn<double, 3>;

constexpr std::size_t long_work = 100000;  // points: some milliseconds

// Six rows: a matrix and what it leaves of a more exact one.
SplitRotation split(const SixRows& matrix, const char* name = "rotation") {
    if (matrix.shape(0) != 6) {
        throw std::invalid_argument("a rotation is given by six rows");
    }
    check_finite(name, matrix.data(), 6, 3);
    return {matrix.data(), matrix.data() + 9};
}

void check_magnification(double magnification) {
    if (!(magnification >= 0x1p-333 && magnification <= 0x1p333)) {  // 1e-100 to 1e100, and a little room
        throw std::invalid_argument("magnification must be from 1e-100 to 1e100");
    }
}

MoebiusParts to_parts(const SixRows& left, double magnification, const SixRows& right) {
    check_magnification(magnification);
    return {split(left), magnification, split(right)};
}

// Nine numbers: a quaternion, the magnification, a quaternion.
StoredMap to_map(const char* name, const ValuesIn<double>& numbers) {
    if (numbers.shape(0) != 9) {
        throw std::invalid_argument("a map is given by nine numbers");
    }
    check_finite(name, numbers.data(), 9);
    check_magnification(numbers.data()[4]);
    StoredMap map;
    std::copy_n(numbers.data(), 4, map.left.begin());
    map.magnification = numbers.data()[4];
    std::copy_n(numbers.data() + 5, 4, map.right.begin());
    const auto is_zero = [](double x) { return x == 0.0; };
    if (std::all_of(map.left.begin(), map.left.end(), is_zero) ||
        std::all_of(map.right.begin(), map.right.end(), is_zero)) {
        throw std::invalid_argument("a quaternion of a map is zero");
    }
    return map;
}

ValuesOut<double> to_numbers(const StoredMap& map) {
    Buffer<double> numbers(9);
    std::copy(map.left.begin(), map.left.end(), numbers.data());
    numbers[4] = map.magnification;
    std::copy(map.right.begin(), map.right.end(), numbers.data() + 5);
    return to_values(std::move(numbers));
}

// Rows of four: the real part as doubles and what they leave, the imaginary part likewise, and v.v: re, im.
RowsOut<double, 4> element(const ValuesIn<double>& map) {
    const auto [element, square] = element_of(to_map("map", map));
    Buffer<double> rows(20);
    for (std::size_t k = 0; k < 4; ++k) {
        rows[k] = element.real[k].hi;
        rows[4 + k] = element.real[k].lo;
        rows[8 + k] = element.imag[k].hi;
        rows[12 + k] = element.imag[k].lo;
    }
    for (std::size_t k = 0; k < 2; ++k) {
        rows[16 + 2 * k] = square[k].hi;
        rows[17 + 2 * k] = square[k].lo;
    }
    return to_rows<4>(std::move(rows));
}

ValuesOut<double> decomposed(const RowsIn<double, 4>& element) {
    if (element.shape(0) != 4) {
        throw std::invalid_argument("an element is given by four rows");
    }
    const double* rows = element.data();
    check_finite("element", rows, 4, 4);
    Element parts;
    for (std::size_t k = 0; k < 4; ++k) {
        parts.real[k] = {rows[k], rows[4 + k]};
        parts.imag[k] = {rows[8 + k], rows[12 + k]};
    }
    return to_numbers(stored(parts));
}

ValuesOut<double> product(const ValuesIn<double>& then, const ValuesIn<double>& first) {
    return to_numbers(composed(to_map("then", then), to_map("first", first)));
}

// Two rows: doubles and what they leave.
template <std::size_t Width>
std::array<DoubleDouble, Width> to_pairs(const char* name, const RowsIn<double, Width>& rows) {
    if (rows.shape(0) != 2) {
        throw std::invalid_argument("a vector in double-double is given by two rows");
    }
    check_finite(name, rows.data(), 2, Width);
    std::array<DoubleDouble, Width> pairs;
    for (std::size_t k = 0; k < Width; ++k) {
        pairs[k] = {rows.data()[k], rows.data()[Width + k]};
    }
    return pairs;
}

RowsOut<double, 4> two_rows(const conformal::Quaternion& q) {
    Buffer<double> rows(8);
    for (std::size_t k = 0; k < 4; ++k) {
        rows[k] = q[k].hi;
        rows[4 + k] = q[k].lo;
    }
    return to_rows<4>(std::move(rows));
}

RowsOut<double, 4> rotation_product(const RowsIn<double, 4>& then, const RowsIn<double, 4>& first) {
    return two_rows(conformal::product(to_pairs<4>("then", then), to_pairs<4>("first", first)));
}

RowsOut<double, 4> rotation_between(const RowsIn<double, 3>& start, const RowsIn<double, 3>& end) {
    return two_rows(conformal::between(to_pairs<3>("start", start), to_pairs<3>("end", end)));
}

RowsOut<double, 3> rotation_matrix(const RowsIn<double, 4>& quaternion) {
    const conformal::Matrix matrix = conformal::matrix_of(to_pairs<4>("quaternion", quaternion));
    Buffer<double> rows(18);
    for (std::size_t k = 0; k < 9; ++k) {
        const DoubleDouble entry = matrix[k / 3][k % 3];
        rows[k] = entry.hi;
        rows[9 + k] = entry.lo;
    }
    return to_rows<3>(std::move(rows));
}

RowsOut<double, 3> rotated(const SixRows& matrix, const RowsIn<double, 3>& vectors) {
    split(matrix, "matrix");
    const std::size_t count = vectors.shape(0);
    check_finite("vectors", vectors.data(), count, 3);
    conformal::Matrix entries;
    for (std::size_t k = 0; k < 9; ++k) {
        entries[k / 3][k % 3] = {matrix.data()[k], matrix.data()[9 + k]};
    }
    return to_rows<3>(filled<double>(3 * count, count > long_work, [&](double* images, Stop stop) {
        for (std::size_t first = 0; first < count; first += long_work) {
            check(stop);
            conformal::rotate(entries, vectors.data() + 3 * first, std::min(long_work, count - first),
                              images + 3 * first);
        }
    }));
}

// Rows at the points, of one number or of `Results`, and whether all are sound.
template <auto Evaluate, std::size_t Results, std::size_t Width>
auto images(const RowsIn<double, Width>& points, const SixRows& left, double magnification, const SixRows& right,
            int workers) {
    const MoebiusParts parts = to_parts(left, magnification, right);
    const std::size_t count = points.shape(0);
    bool sound = true;
    Buffer<double> rows = filled<double>(Results * count, count > long_work, [&](double* out, Stop stop) {
        sound = Evaluate(parts, points.data(), count, out, workers, stop);
    });
    if constexpr (Results == 1) {
        return std::pair(to_values(std::move(rows)), sound);
    } else {
        return std::pair(to_rows<Results>(std::move(rows)), sound);
    }
}

}  // namespace

void bind_conformal(Modules& modules) {
    nb::module_& module = modules.both;
    module.def("rotation_product", rotation_product, "then"_a, "first"_a, "The product of quaternions, two rows each.");
    module.def("rotation_between", rotation_between, "start"_a, "end"_a,
               "The shortest rotation between unit vectors, two rows each, as a quaternion of any length.");
    module.def("rotation_matrix", rotation_matrix, "quaternion"_a, "The six rows of a quaternion of two rows.");
    module.def("rotated", rotated, "matrix"_a, "vectors"_a,
               "Vectors of any length times a matrix of six rows, rounded once.");
    module.def("moebius_product", product, "then"_a, "first"_a,
               "The map `first`, then another: quaternion, magnification and quaternion, nine numbers.");
    module.def("moebius_element", element, "map"_a,
               "A map in SL(2, C): both parts as doubles and what they leave, and the square of its vector.");
    module.def("moebius_decomposed", decomposed, "element"_a, "The nine numbers of the first four rows of an element.");
    module.def("moebius_images", images<moebius_images, 3, 3>, "xyz"_a, "left"_a, "magnification"_a, "right"_a,
               "workers"_a = 1, "Images of directions as unit vectors, and whether all were finite and not zero.");
    module.def("moebius_lonlat", images<moebius_lonlat, 2, 2>, "lonlat"_a, "left"_a, "magnification"_a, "right"_a,
               "workers"_a = 1, "Images (lon, lat) of (lon, lat) in degrees, and whether all were points.");
    module.def("moebius_scales", images<moebius_scales, 1, 3>, "xyz"_a, "left"_a, "magnification"_a, "right"_a,
               "workers"_a = 1, "Local scales at directions, and whether all were finite and not zero.");
}

}  // namespace stereodel::python
