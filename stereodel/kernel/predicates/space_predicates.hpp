// Orientation of four points of space, by the stages of plane_stages.hpp: doubles, about twice the precision, integers.
#pragma once

#include "tally.hpp"

namespace stereodel::predicates::space {

// Sign of det[b-a c-a d-a]: 1 if a, b, c appear counterclockwise from d, 0 if the four lie in one plane.
int orient(const double* a, const double* b, const double* c, const double* d);

Sign orient_filter(const double* a, const double* b, const double* c, const double* d);
Sign orient_double_double(const double* a, const double* b, const double* c, const double* d);
int orient_exact(const double* a, const double* b, const double* c, const double* d);

}  // namespace stereodel::predicates::space
