// Vertices with their numbers, and cells, of the dual of a triangulation: integers alone.
#pragma once

#include "voronoi/dual.hpp"
#include "voronoi/voronoi.hpp"

namespace stereodel::voronoi {

// `sites`: how many there are; corners are below.
Diagram cells_of(const DualTriangles& dual, std::size_t sites, Crew& crew, Stop stop);

}  // namespace stereodel::voronoi
