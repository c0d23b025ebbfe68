// Lengths of arcs between directions, and the bubbles that have such arcs as diameters: the answers of exact arithmetic
// on the rays through the given doubles, stage by stage.
#pragma once

#include "arithmetic/double_double.hpp"
#include "predicates/ray_stages.hpp"
#include "tally.hpp"

namespace stereodel::predicates::rays {

using arithmetic::DoubleDouble;

// In double-double.
inline DoubleDouble dot(const Direction& a, const Direction& b) {
    const DoubleDouble u[3] = {{a.hi[0], a.lo[0]}, {a.hi[1], a.lo[1]}, {a.hi[2], a.lo[2]}};
    const DoubleDouble v[3] = {{b.hi[0], b.lo[0]}, {b.hi[1], b.lo[1]}, {b.hi[2], b.lo[2]}};
    return dot_form(u, v);
}

// The stages of the comparison of angles: sign of the angle between p and a less that between q and b. Squared chords
// stand for the angles in the first.
double squared_chord(const Direction& p, const Direction& a);
Sign compare_lengths_double_double(const Direction& p, const Direction& a, const Direction& q, const Direction& b);

// Of squared chords A and B that were computed with at most seven roundings a term, from vectors within 2^-49 of length
// one (as they stand, or differences of `Direction`s). The squared chord of unit vectors is
// (|a-p|^2 - (|a|-|p|)^2) / (|a||p|) for vectors of any length: the denominator is within 2^-47.9 of 1, the subtrahend
// at most 2^-96. The roundings are below 8u, differences of `Direction`s are off by 2^-106, so that |a-p|^2 is by
// less than 2^-100. Together 2^-47.9 + 2^-50 + a little < 2^-47 of both, and 2^-94.
inline Sign compare_squared_chords(double aa, double bb) {
    return decide(aa - bb, 0x1p-47 * (aa + bb) + 0x1p-94);
}

// The stages of (a'-p').(b'-p') for the unit vectors a', b', p' of a, b, p: positive outside the smaller bubble that
// has a and b as ends of a diameter, zero on its circle. The first takes vectors within 2^-49 of length one as they
// stand, or directions.
Sign diametral_filter(const double* a, const double* b, const double* p);
Sign diametral_filter(const Direction& a, const Direction& b, const Direction& p);
Sign diametral_double_double(const Direction& a, const Direction& b, const Direction& p);

}  // namespace stereodel::predicates::rays
