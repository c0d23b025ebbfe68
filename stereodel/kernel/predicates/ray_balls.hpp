// The predicates on directions in ball arithmetic: for vectors whose components differ by more powers of two than the
// doubles of the stages before can hold. Every sign is proven, or open.
//
// Nothing is normalised. The basis are the chords between unit vectors, |p||q|(q/|q| - p/|p|) = q|p| - p|q|. Where both
// terms of a component have one sign, it is
//     (q_k^2 |p|^2 - p_k^2 |q|^2) / (q_k|p| + p_k|q|),
// and with n = p x q and s_k = p_i q_j + p_j q_i for the other two components i, j the numerator is
//     n_i s_i - n_j s_j,  (k, i, j) in cyclic order,
// so that only n may cancel, and that has two exact products in each component. So each component of a chord is known
// up to some 2^-100 of itself, unless directions are nearly mirror images.
#pragma once

#include "tally.hpp"

namespace stereodel::predicates::rays {

// Whether a vector has components so different that integers in their place are long: more than 2^64 apart.
bool is_wide(const double* vector);

Sign bubble_balls(const double* a, const double* b, const double* c, const double* p);
Sign turn_balls(const double* a, const double* b, const double* c);
Sign compare_component_balls(const double* a, const double* b, int k);
Sign compare_angles_balls(const double* q, const double* a, const double* b);
Sign shadow_balls(const double* a, const double* b, const double* c, int axis);
Sign compare_lengths_balls(const double* p, const double* a, const double* q, const double* b);
Sign diametral_balls(const double* a, const double* b, const double* p);

// Of projections from the pole sign * e_axis, component i: see projection.hpp.
Sign compare_projected_balls(const double* p, const double* q, int axis, int sign, int i);
Sign compare_to_line_balls(const double* p, int axis, int sign, int i, double hi, double lo);

}  // namespace stereodel::predicates::rays
