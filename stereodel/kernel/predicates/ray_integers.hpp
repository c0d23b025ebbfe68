// The last stage of the predicates on directions: integer vectors, square roots by their squares, nothing rounded.
// The formulas are those of tests/reference.py.
#pragma once

#include "arithmetic/big_integer.hpp"
#include "tally.hpp"

namespace stereodel::predicates::rays {

using arithmetic::BigInteger;

// The integer vector on the ray that is shortest among those by powers of two.
struct IntegerRay {
    BigInteger v[3];

    explicit IntegerRay(const double* vector);
    BigInteger squared() const;
};

// Sign of |a| det[b c p] - |b| det[a c p] + |c| det[a b p] - |p| det[a b c].
int bubble_exact(const double* a, const double* b, const double* c, const double* p);

// Sign of det[a b c].
int turn_exact(const double* a, const double* b, const double* c);

// Sign of a_k/|a| - b_k/|b|.
int compare_component_exact(const double* a, const double* b, int k);

// Sign of the angle between q and a less that between q and b; the same of two pairs without a common vector.
int compare_angles_exact(const double* q, const double* a, const double* b);
int compare_lengths_exact(const double* p, const double* a, const double* q, const double* b);

// Sign of (a'-p').(b'-p') of the unit vectors.
int diametral_exact(const double* a, const double* b, const double* p);

// Sign of the determinant of the unit vectors with rows (the two components without `axis`, 1).
int shadow_exact(const double* a, const double* b, const double* c, int axis);

// For vectors of integers times one power of two that fit into machine words: up to 2^53. Of turns all are decided; of
// four directions great circles, and integers up to 2^16 unless the sum of roots is too close to zero for doubles.
Sign bubble_units(const double* a, const double* b, const double* c, const double* p);
Sign turn_units(const double* a, const double* b, const double* c);

}  // namespace stereodel::predicates::rays
