// Points that are equally near to a query by symmetry: known without arithmetic that rounds. The case of most exact
// ties of lattices, graticules and solids.
#pragma once

#include <cmath>

#include "arithmetic/pair_arithmetic.hpp"

namespace stereodel::queries {

using arithmetic::Pair;
using arithmetic::pair_difference;

// Whether the differences of coordinates are exact and the same but for signs and order; false says nothing.
inline bool equally_near_in_plane(const double* q, const double* a, const double* b) {
    const Pair ax = pair_difference(a[0], q[0]), ay = pair_difference(a[1], q[1]);
    const Pair bx = pair_difference(b[0], q[0]), by = pair_difference(b[1], q[1]);
    if (ax.l != 0.0 || ay.l != 0.0 || bx.l != 0.0 || by.l != 0.0) {
        return false;
    }
    const double x = std::fabs(ax.h), y = std::fabs(ay.h), u = std::fabs(bx.h), v = std::fabs(by.h);
    return (x == u && y == v) || (x == v && y == u);
}

// Whether one of the 48 symmetries of the cube leaves the query where it is and takes one direction to the other; false
// says nothing.
inline bool equally_near_on_sphere(const double* q, const double* a, const double* b) {
    constexpr int orders[6][3] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}};
    for (const auto& order : orders) {
        bool same = true;
        for (int k = 0; k < 3 && same; ++k) {
            const int j = order[k];
            same = (b[k] == a[j] && q[k] == q[j]) || (b[k] == -a[j] && q[k] == -q[j]);
        }
        if (same) {
            return true;
        }
    }
    return false;
}

}  // namespace stereodel::queries
