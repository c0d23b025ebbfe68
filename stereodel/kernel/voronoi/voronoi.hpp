// The folder `voronoi`: the dual diagram, its vertices, areas and centroids.
// Reading order: voronoi, dual, tie_views, voronoi_cells, chosen_cells (of some sites), diagram_parts (ridges,
// polygons), polygon_diagonals (back to triangles); unit_vectors, circumcenters and careful_circumcenters beyond;
// cell_integrals, right_triangles, plane_cells, sphere_cell and sphere_cells in doubles, cell_ridges and ball_cells
// beyond; great_circles and flat_diagrams, where there are no triangles.
//
// Voronoi diagrams from Delaunay triangulations, in linear time, and the way back.
//
// A diagram is three arrays. The cell of a site is a range of entries: its vertices counterclockwise, and beside each
// the site beyond the ridge that leaves the vertex. Unbounded cells have one entry with vertex -1. The lowest vertex
// stands first.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "tally.hpp"
#include "threads.hpp"

namespace stereodel::voronoi {

// Vertices are numbered by the three lowest sites of their circles, and if two vertices share these (all sites lie on
// one circle), first the one around which they are counterclockwise.
struct Diagram {
    Buffer<std::int64_t> offsets;       // sites + 1
    Buffer<Index> vertices, neighbors;  // of each entry
    Buffer<Index> simplex_vertex;       // of each triangle
    // The place of each triangle among those of its vertex, in the lexicographic order of their corners from the lowest
    // on; empty where each vertex has one triangle.
    Buffer<Index> simplex_rank;
    Buffer<Index> order;                // the sites with entries as they first come among the triangles
    // Three sites of each vertex, counterclockwise and a third of the way apart, and the vertex of each such row, in
    // the order of the triangles. Empty where each triangle has a vertex of its own, and so is such a row.
    Buffer<Index> vertex_sites, row_vertex;
};

template <std::size_t Width>
Diagram diagram_of(const double* points, std::size_t sites, const Index* simplices, const Index* neighbors,
                   std::size_t count, int workers, Stop stop);

}  // namespace stereodel::voronoi
