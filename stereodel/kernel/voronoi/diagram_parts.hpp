// What follows from the cells of a diagram: its ridges, the sites around its vertices, its triangulation.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "tally.hpp"
#include "threads.hpp"

namespace stereodel::voronoi {

// The arrays of a diagram; see voronoi.hpp. Entries must fit together.
struct Cells {
    const std::int64_t* offsets;
    const Index *vertices, *neighbors;
    std::size_t sites, vertex_count;
    const Index* order = nullptr;  // the sites with entries, near ones soon after one another; for areas and centroids
    std::size_t filled = 0;        // how many these are

    std::size_t begin(std::size_t site) const { return static_cast<std::size_t>(offsets[site]); }
    std::size_t end(std::size_t site) const { return static_cast<std::size_t>(offsets[site + 1]); }
};

// Of arrays that callers hand in: `entries` vertices and neighbours that fit the offsets, and the order of the sites.
// Throw std::invalid_argument.
void check_cells(const Cells& cells, std::size_t entries);
void check_order(const Cells& cells);

// Ridges by their two sites, i < j, in lexicographic order, with their first and last vertices, i on the left.
struct Ridges {
    Buffer<Index> sites, vertices;
};

// The sites around each vertex, counterclockwise from the lowest: those of vertex v in [offsets[v], offsets[v + 1]).
struct Polygons {
    Buffer<std::int64_t> offsets;
    Buffer<Index> sites;
};

Ridges ridges_of(const Cells& cells, int workers, Stop stop);
// Throws std::invalid_argument if the cells are not those of a diagram.
Polygons polygons_of(const Cells& cells, int workers, Stop stop);

// In which order triangles are wanted: the vertex of each, and its place among those of that vertex in the
// lexicographic order of their corners (null: each vertex has one).
struct TriangleOrder {
    const Index *vertex, *rank;
    std::size_t count;
};

// The triangles of displaced points (plane_predicates.hpp, ray_predicates.hpp), lowest site first. Throws
// std::invalid_argument if the order is not one of the diagram's triangles.
template <std::size_t Width>
Buffer<Index> triangles_of(const double* points, std::size_t sites, const Polygons& polygons,
                           const TriangleOrder& order, int workers, Stop stop);

}  // namespace stereodel::voronoi
