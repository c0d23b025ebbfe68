// Comparisons of directions: their lexicographic order, which decides ties, and their angles from a third.
#pragma once

#include "ray_stages.hpp"
#include "tally.hpp"

namespace stereodel::rays {

// Lexicographic order of the exact unit vectors, by x, then y, then z: -1 if a comes first, 0 for one direction.
// unit: the lengths are within 2^-49 of 1.
int compare(const double* a, const double* b, bool unit);

// One component: sign of a_k/|a| - b_k/|b|; and its stages.
int compare_component(const double* a, const double* b, int k, bool unit);
Sign compare_component_filter(const double* a, const double* b, int k);  // lengths within 2^-49 of 1
Sign compare_component_double_double(const double* a, const double* b, int k);

// The stages of the comparison of angles: sign of the angle between q and a less that between q and b.
Sign compare_angles_filter(const Direction& q, const Direction& a, const Direction& b);
Sign compare_angles_double_double(const Direction& q, const Direction& a, const Direction& b);

}  // namespace stereodel::rays
