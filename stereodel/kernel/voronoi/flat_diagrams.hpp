// Voronoi diagrams of points without triangles: none, one, all on a line of the plane or on a great circle.
//
// On a line the cells are strips without vertices, between parallel ridges. On a great circle they are lunes between
// two vertices, the ends of its axis; a ridge is half a great circle. A single point has no vertices: its cell is all.
// Orders are those of flat_order.hpp.
#pragma once

#include <cstddef>
#include <vector>

#include "voronoi/voronoi.hpp"

namespace stereodel::voronoi {

// The cells of `count` points, of which those in `order` are different: one entry each, without vertex or neighbour.
Diagram line_diagram(const std::vector<Index>& order, std::size_t count);

// The sites i < j of the ridges between neighbours, in lexicographic order.
Buffer<Index> line_ridges(const std::vector<Index>& order);

// The cells of `count` directions, of which those in `order` are different, counterclockwise around vertex 0.
Diagram circle_diagram(const std::vector<Index>& order, std::size_t count);

// The area of each cell: 0 for points that are dropped, 4 pi for one that is alone. `gaps` are those of `GreatCircle`.
void circle_areas(const std::vector<Index>& order, const std::vector<double>& gaps, std::size_t count, double* areas);

// Unit vectors to the middles of the cells, NaN for points that are dropped; one that is alone is its own middle.
// `axis`: the first end. They are off by a few 2^-53.
void circle_centroids(const double* xyz, const std::vector<Index>& order, const std::vector<double>& gaps,
                      const double* axis, std::size_t count, double* centroids);

}  // namespace stereodel::voronoi
