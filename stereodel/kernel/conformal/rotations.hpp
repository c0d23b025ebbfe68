// Rotations as quaternions in double-double: one of any length but 0 is the rotation v -> q v q* / |q|^2.
#pragma once

#include <array>
#include <cstddef>

#include "arithmetic/double_double.hpp"

namespace stereodel::conformal {

using Quaternion = std::array<arithmetic::DoubleDouble, 4>;  // w, x, y, z
using Vector = std::array<arithmetic::DoubleDouble, 3>;
using Matrix = std::array<Vector, 3>;  // rows

// As rotations, first q, then p. Component k has the terms p[i] q[i xor k]: bytes count in WebAssembly.
template <class Number>
std::array<Number, 4> product(const std::array<Number, 4>& p, const std::array<Number, 4>& q) {
    constexpr bool minus[4][4] = {{false, true, true, true},
                                  {false, false, false, true},
                                  {false, true, false, false},
                                  {false, false, true, false}};
    std::array<Number, 4> result;
    for (std::size_t k = 0; k < 4; ++k) {
        result[k] = p[0] * q[k];
        for (std::size_t i = 1; i < 4; ++i) {
            const Number term = p[i] * q[i ^ k];
            result[k] = result[k] + (minus[k][i] ? -term : term);
        }
    }
    return result;
}

template <class Number, std::size_t Size>
Number dot(const std::array<Number, Size>& a, const std::array<Number, Size>& b) {
    Number total = a[0] * b[0];
    for (std::size_t k = 1; k < Size; ++k) {
        total = total + a[k] * b[k];
    }
    return total;
}

// Of length 1.
template <std::size_t Size>
std::array<arithmetic::DoubleDouble, Size> normalized(const std::array<arithmetic::DoubleDouble, Size>& vector) {
    const arithmetic::DoubleDouble length = sqrt(dot(vector, vector));
    std::array<arithmetic::DoubleDouble, Size> result;
    for (std::size_t k = 0; k < Size; ++k) {
        result[k] = vector[k] / length;
    }
    return result;
}

// The direction of a vector of any length but 0, each component with an absolute error below 2^-102.
Vector unit(const double* xyz);

// The shortest rotation from unit vector a to b, as a quaternion of any length. Opposite vectors: half a turn about
// a x e, e the axis along which a is shortest.
Quaternion between(const Vector& a, const Vector& b);

// Entries with errors below 2^-100.
Matrix matrix_of(const Quaternion& q);

// Rotated vectors of any length, rounded once and without -0.
void rotate(const Matrix& matrix, const double* xyz, std::size_t count, double* images);

}  // namespace stereodel::conformal
