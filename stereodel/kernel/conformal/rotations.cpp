#include "conformal/rotations.hpp"

#include <algorithm>
#include <cmath>

namespace stereodel::conformal {

using arithmetic::DoubleDouble;

namespace {

constexpr DoubleDouble HALF{0.5, 0.0}, TWO{2.0, 0.0};

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The vector over 2^exponent, its largest component in [1/2, 1).
Vector scaled(const double* xyz, int& exponent) {
    std::frexp(std::max({std::abs(xyz[0]), std::abs(xyz[1]), std::abs(xyz[2])}), &exponent);
    Vector result{};
    for (std::size_t k = 0; k < 3; ++k) {
        result[k].hi = std::ldexp(xyz[k], -exponent);
    }
    return result;
}

}  // namespace

Vector unit(const double* xyz) {
    int exponent = 0;
    return normalized(scaled(xyz, exponent));
}

// (1 + a.b, a x b), with 1 + a.b = |a + b|^2/2 and a x b = a x (b -+ a), so that nothing cancels where the two are
// nearly equal or nearly opposite.
Quaternion between(const Vector& a, const Vector& b) {
    const Vector total = {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
    const DoubleDouble square = dot(total, total);
    if (square.hi <= 0x1p-200) {  // UNDECIDED of stereodel/constants.py, squared
        const auto shorter = [](DoubleDouble x, DoubleDouble y) { return std::abs(x.hi) < std::abs(y.hi); };
        Vector axis{};
        axis[static_cast<std::size_t>(std::min_element(a.begin(), a.end(), shorter) - a.begin())].hi = 1.0;
        const Vector turn = cross(a, axis);
        return {DoubleDouble{}, turn[0], turn[1], turn[2]};
    }
    const Vector difference = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const Vector turn = cross(a, dot(a, b).hi < 0 ? total : difference);
    return {square * HALF, turn[0], turn[1], turn[2]};
}

Matrix matrix_of(const Quaternion& q) {
    const auto& [w, x, y, z] = q;
    const DoubleDouble ww = w * w, xx = x * x, yy = y * y, zz = z * z;
    const DoubleDouble xy = x * y, xz = x * z, yz = y * z, wx = w * x, wy = w * y, wz = w * z;
    Matrix matrix = {Vector{ww + xx - yy - zz, (xy - wz) * TWO, (xz + wy) * TWO},
                     Vector{(xy + wz) * TWO, ww - xx + yy - zz, (yz - wx) * TWO},
                     Vector{(xz - wy) * TWO, (yz + wx) * TWO, ww - xx - yy + zz}};
    const DoubleDouble length = dot(q, q);
    for (Vector& row : matrix) {
        for (DoubleDouble& entry : row) {
            entry = entry / length;
        }
    }
    return matrix;
}

void rotate(const Matrix& matrix, const double* xyz, std::size_t count, double* images) {
    for (std::size_t i = 0; i < 3 * count; i += 3) {
        int exponent = 0;
        const Vector vector = scaled(xyz + i, exponent);
        for (std::size_t k = 0; k < 3; ++k) {
            const DoubleDouble value = dot(matrix[k], vector);
            images[i + k] = std::ldexp(value.hi + value.lo, exponent) + 0.0;
        }
    }
}

}  // namespace stereodel::conformal
