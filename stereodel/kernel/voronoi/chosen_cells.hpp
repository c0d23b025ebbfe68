// The cells of some sites of a triangulation, without numbers of vertices: what areas and degrees take.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "tally.hpp"
#include "threads.hpp"
#include "voronoi/diagram_parts.hpp"

namespace stereodel::voronoi {

// Neighbours as in a `Diagram`, from its lowest vertex on, of sites that were chosen; the others have no entries.
// `vertices` holds -1 beside the entry of an unbounded cell, 0 beside all others.
struct ChosenCells {
    Buffer<std::int64_t> offsets;
    Buffer<Index> vertices, neighbors;
    Buffer<Index> order;

    Cells view() const {
        return {offsets.data(), vertices.data(), neighbors.data(), offsets.size() - 1, 1, order.data(), order.size()};
    }
};

// `chosen`: `count` different sites, ascending. Vertices compare by `ids`, those of the points, not by rows: so a part
// of a triangulation gives what all of it gives.
template <std::size_t Width>
ChosenCells chosen_cells(const double* points, std::size_t sites, const Index* simplices, const Index* neighbors,
                         std::size_t triangles, const std::int64_t* ids, const Index* chosen, std::size_t count,
                         Stop stop);

}  // namespace stereodel::voronoi
