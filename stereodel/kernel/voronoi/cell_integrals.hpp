// Areas and centroids of Voronoi cells, from their sites alone: no rounded vertex enters.
//
// A cell is cut into right-angled triangles: from the site p to the middle m of p and a neighbour q, a leg h, and from
// there along the ridge to a vertex, a leg l, signed, positive to the left of p -> q. With the vertex's third site r,
// D = q - p, E = r - p, F = r - q:
//     plane     h = |D|/2, tan l replaced by l = |D| (E.F) / (2 D x E)
//     sphere    sin h = |D|/2, tan l = |D| (E.F) / (2 det[p q r])
// (n = D x E has the components n.(p x D) = |D|^2 E.F / 2 along the ridge and n.(p + q) = 2 det[p q r] towards the
// middle; in the plane this is the cotangent of the angle at r). The vertex between the neighbours a and b of a cell,
// counterclockwise, is on the circle of p, a, b; so the neighbours of a cell tell all.
//
// Each cell is first measured in doubles, with a bound; where the bound is too large beside the area (far vertices of
// small cells, flat triangles, large cells of the sphere) in double-double, with a bound again (plane_cells.cpp,
// cell_ridges.hpp); and what that leaves open in as many digits as it takes (ball_cells.hpp).
#pragma once

#include <cstddef>

#include "voronoi/diagram_parts.hpp"

namespace stereodel::voronoi {

// One number a site: 0 without entries, infinite for unbounded cells of the plane.
void cell_areas_plane(const double* points, const Cells& cells, double* areas, int workers, Stop stop);
void cell_areas_sphere(const double* points, const Cells& cells, double* areas, int workers, Stop stop);

// A point of the plane or a unit vector for each site; NaN without entries and for unbounded cells of the plane.
void cell_centroids_plane(const double* points, const Cells& cells, double* centroids, int workers, Stop stop);
void cell_centroids_sphere(const double* points, const Cells& cells, double* centroids, int workers, Stop stop);

// The bound relative to the area, and for centroids to the size of the cell, up to which a stage is good enough: some
// hundred times the usual error of doubles.
constexpr double CELL_ERROR = 0x1p-39;

// That of areas of the sphere beyond doubles, where a cell may be half of it: so all areas together are 4 pi within
// 4 pi 2^-47 < 1e-13, and what cells in doubles are off by, which is mostly far below their bound.
constexpr double SHARE_ERROR = 0x1p-47;

}  // namespace stereodel::voronoi
