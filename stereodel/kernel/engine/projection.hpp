// Stereographic projection of directions from the pole sign * e_axis, with error bounds, and exact comparisons of
// projected coordinates (rows P8 and P5 of the ledger).
//
// With k = axis and w = |p| - sign p_k: (X, Y) = (p_{k+1}, p_{k+2}) / w for sign -1 and (p_{k+2}, p_{k+1}) / w for sign
// +1, indices modulo 3: counterclockwise in (X, Y) is counterclockwise seen from outside the sphere, and orient2d of
// three projected points is minus the bubble test of the three and the pole.
#pragma once

#include "tally.hpp"

namespace stereodel::engine {

struct Pole {
    int axis;  // 0, 1, 2
    int sign;  // -1, 1
};

// Each component relatively within 8u, u = 2^-53; NaN where exponents leave the range of that promise. NaN for the
// pole.
void project(const double* p, Pole pole, double out[2]);

// X hi, X lo, Y hi, Y lo: relatively within 2^-97, NaN where that cannot be promised.
void project_double_double(const double* p, Pole pole, double out[4]);

// Sign of X(p) - X(q) (coordinate 0) or Y(p) - Y(q) (1), exact. Neither may be the pole.
int compare_projected(const double* p, const double* q, Pole pole, int coordinate);

// Sign of X(p) - (hi + lo), or of Y, exact. hi and lo are any finite doubles.
int compare_to_line(const double* p, Pole pole, int coordinate, double hi, double lo);

// The stages of the two comparisons.
Sign compare_projected_filter(const double* p, const double* q, Pole pole, int coordinate);
Sign compare_projected_double_double(const double* p, const double* q, Pole pole, int coordinate);
int compare_projected_exact(const double* p, const double* q, Pole pole, int coordinate);
Sign compare_to_line_filter(const double* p, Pole pole, int coordinate, double hi, double lo);
Sign compare_to_line_double_double(const double* p, Pole pole, int coordinate, double hi, double lo);
int compare_to_line_exact(const double* p, Pole pole, int coordinate, double hi, double lo);

}  // namespace stereodel::engine
