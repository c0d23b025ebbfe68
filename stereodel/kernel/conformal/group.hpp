// Products of conformal maps: exact, and rounded once.
#pragma once

#include <array>

#include "arithmetic/double_double.hpp"
#include "conformal/rotations.hpp"

namespace stereodel::conformal {

// A rotation, after the fisheye of a magnification above 0 along z, after a rotation: quaternions of any length but 0.
struct StoredMap {
    std::array<double, 4> left;
    double magnification;
    std::array<double, 4> right;
};

// real + i imag in SL(2, C), quaternions with complex coefficients (stereodel/conformal/group.py).
struct Element {
    Quaternion real, imag;
};

struct KnownElement {
    Element element;                                 // each component within 2^-105 of itself
    std::array<arithmetic::DoubleDouble, 2> square;  // v.v of the vector part, as accurate: re, im
};

KnownElement element_of(const StoredMap& map);

// The map of an element, of magnification 1 or more. Each parameter is rounded once.
StoredMap stored(const Element& element);

// First `first`, then `then`, of any magnifications.
StoredMap composed(const StoredMap& then, const StoredMap& first);

}  // namespace stereodel::conformal
