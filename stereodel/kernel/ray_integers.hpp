// The last stage of the predicates on directions: integer vectors, square roots by their squares, nothing rounded.
// The formulas are those of stereodel/predicates/rays.py and ties.py.
#pragma once

#include "big_integer.hpp"
#include "tally.hpp"

namespace stereodel::rays {

// The integer vector on the ray that is shortest among those by powers of two.
struct IntegerRay {
    BigInteger v[3];

    explicit IntegerRay(const double* vector);
    BigInteger squared() const;
};

// Sign of |a| det[b c p] - |b| det[a c p] + |c| det[a b p] - |p| det[a b c].
int bubble_integers(const double* a, const double* b, const double* c, const double* p);

// Sign of det[a b c].
int turn_integers(const double* a, const double* b, const double* c);

// Sign of a_k/|a| - b_k/|b|.
int compare_component_integers(const double* a, const double* b, int k);

// Sign of the angle between q and a less that between q and b; the same of two pairs without a common vector.
int compare_angles_integers(const double* q, const double* a, const double* b);
int compare_lengths_integers(const double* p, const double* a, const double* q, const double* b);

// Sign of (a'-p').(b'-p') of the unit vectors.
int diametral_integers(const double* a, const double* b, const double* p);

// Sign of the determinant of the unit vectors with rows (the two components without `axis`, 1).
int shadow_integers(const double* a, const double* b, const double* c, int axis);

// For vectors of small integers times one power of two (up to 16 bits): determinants and squares are exact in doubles.
// Open if they are no such vectors, or if the sum of roots that is left is too close to zero for doubles.
Sign bubble_small_integers(const double* a, const double* b, const double* c, const double* p);
Sign turn_small_integers(const double* a, const double* b, const double* c);

// The last stage: balls where integers would be long, and integers.
int bubble_exact(const double* a, const double* b, const double* c, const double* p);
int turn_exact(const double* a, const double* b, const double* c);
int compare_component_exact(const double* a, const double* b, int k);
int compare_angles_exact(const double* q, const double* a, const double* b);
int compare_lengths_exact(const double* p, const double* a, const double* q, const double* b);
int diametral_exact(const double* a, const double* b, const double* p);
int shadow_exact(const double* a, const double* b, const double* c, int axis);

}  // namespace stereodel::rays
