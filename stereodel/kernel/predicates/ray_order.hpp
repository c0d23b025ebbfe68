// Comparisons of directions: their lexicographic order, which decides ties, and their angles from a third.
#pragma once

#include "predicates/ray_stages.hpp"
#include "tally.hpp"

namespace stereodel::predicates::rays {

// Lexicographic order of the exact unit vectors, by x, then y, then z: -1 if a comes first, 0 for one direction.
// unit: the lengths are within 2^-49 of 1.
int compare(const double* a, const double* b, bool unit);

// One component: sign of a_k/|a| - b_k/|b|; and its stages.
int compare_component(const double* a, const double* b, int k, bool unit);
Sign compare_component_filter(const double* a, const double* b, int k);  // lengths within 2^-49 of 1
Sign compare_component_squares(const double* a, const double* b, int k);  // any lengths, components of one sign
Sign compare_component_double_double(const double* a, const double* b, int k);

// Whether four different directions lie on one circle by symmetry: with one component in common, or two pairs of
// mirror images in one of the nine planes x = 0, x = y, x = -y and so on. So most exact ties of lattices, graticules
// and solids are known without arithmetic; false says nothing.
bool cocircular_by_symmetry(const double* a, const double* b, const double* c, const double* p);

// Whether three directions lie on one great circle by symmetry, in one of the nine planes; false says nothing.
bool on_mirror(const double* a, const double* b, const double* c);

// Sign of the area of abc seen along an axis: of the determinant of the unit vectors with rows (the two components
// without `axis`, 1). unit: the lengths are within 2^-49 of 1.
int shadow(const double* a, const double* b, const double* c, int axis, bool unit);
Sign shadow_filter(const double* a, const double* b, const double* c, int axis);  // lengths within 2^-49 of 1
Sign shadow_of_rounded(const double* a, const double* b, const double* c, int axis);  // any lengths

// The stages of the comparison of angles: sign of the angle between q and a less that between q and b.
Sign compare_angles_filter(const Direction& q, const Direction& a, const Direction& b);
Sign compare_angles_double_double(const Direction& q, const Direction& a, const Direction& b);

}  // namespace stereodel::predicates::rays
