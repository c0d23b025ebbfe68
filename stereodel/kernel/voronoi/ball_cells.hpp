// Voronoi cells in as many digits as they need: the last stage of areas and centroids, and lunes. It ends, because all
// that it divides by or takes roots of is positive for cells of a Voronoi diagram.
#pragma once

#include <cstddef>

#include "voronoi/cell_ridges.hpp"
#include "voronoi/diagram_parts.hpp"

namespace stereodel::voronoi {

// A bounded cell of the plane; the centroid is relative to the site.
MeasuredCell plane_cell_in_balls(const double* points, const Cells& cells, std::size_t site);

MeasuredCell sphere_cell_in_balls(const double* points, const Cells& cells, std::size_t site, const UnitVector& unit,
                                  bool with_centroid);

}  // namespace stereodel::voronoi
