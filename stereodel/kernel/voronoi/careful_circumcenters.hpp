// Circumcentres that about twice the precision leaves open: of triangles of any size, flat ones and needles.
#pragma once

#include "threads.hpp"

namespace stereodel::voronoi {

// Of three corners, each an array of coordinates. Both throw std::invalid_argument if there is no circumcentre.
void careful_center_plane(const double* const* corners, Stop stop, double* center);
void careful_center_sphere(const double* const* corners, Stop stop, double* center);

}  // namespace stereodel::voronoi
