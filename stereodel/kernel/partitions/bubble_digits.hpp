// Whether a closed bubble touches a box, beyond doubles: in double-double and in as many digits as it takes, both with
// their errors, from the given vectors.
#pragma once

#include <cstddef>

namespace stereodel::partitions {

// By the given points: a triangle a b c, counterclockwise; an edge a b of the plane's hull, everything beyond it, if c
// is null; the disc around a through b.
struct Bubble {
    const double *a, *b, *c;
    bool is_disc = false;
};

// True unless it is certain that the box is free. What stays open after a thousand binary digits beyond the leading one
// is taken for a touch: mostly it is one, a corner on the rim. Vectors of any length; coordinates of any size.
template <std::size_t Width>
bool touches(const Bubble& bubble, const double* low, const double* high);

}  // namespace stereodel::partitions
