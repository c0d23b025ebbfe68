// Distances that are equal by symmetry: known without arithmetic that rounds. The case of most exact ties of lattices,
// graticules and solids. False says nothing.
#pragma once

#include <algorithm>

#include "arithmetic/double_double.hpp"

namespace stereodel::predicates {

using arithmetic::DoubleDouble;
using arithmetic::two_difference;

// Whether the steps along the axes from p to a and from q to b are of the same sizes, perhaps exchanged. A size is an
// exact difference, the unevaluated sum of two doubles.
inline bool equal_by_symmetry_in_plane(const double* p, const double* a, const double* q, const double* b) {
    const auto step = [](double from, double to) { return two_difference(std::max(from, to), std::min(from, to)); };
    const auto same = [](DoubleDouble s, DoubleDouble t) { return s.hi == t.hi && s.lo == t.lo; };
    const DoubleDouble x = step(p[0], a[0]), y = step(p[1], a[1]), u = step(q[0], b[0]), v = step(q[1], b[1]);
    return (same(x, u) && same(y, v)) || (same(x, v) && same(y, u));
}

// Whether one of the 48 symmetries of the cube takes p to q and a to b: of angles between directions.
inline bool equal_by_symmetry_on_sphere(const double* p, const double* a, const double* q, const double* b) {
    constexpr int orders[6][3] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}};
    for (const auto& order : orders) {
        bool same = true;
        for (int k = 0; k < 3 && same; ++k) {
            const int j = order[k];
            same = (b[k] == a[j] && q[k] == p[j]) || (b[k] == -a[j] && q[k] == -p[j]);
        }
        if (same) {
            return true;
        }
    }
    return false;
}

}  // namespace stereodel::predicates
