// What is told of points whose triangles are final: as if all points had been at hand, to the last bit.
#pragma once

#include <cstddef>
#include <cstdint>

#include "duplicates.hpp"
#include "memory.hpp"
#include "tally.hpp"
#include "threads.hpp"

namespace stereodel::partitions {

// A triangulation of some of all points, whose numbers among all are `ids`, in any order; `duplicates`: pairs (dropped,
// kept) of rows.
struct PartialMesh {
    const double* points;
    std::size_t size;
    const Index *simplices, *neighbors;
    std::size_t count;
    const Pairs& duplicates;
    const std::int64_t* ids;
};

// Of each row that is asked for. `kept`: the lowest id of its equal points; areas and degrees are those of the diagram
// of all points, 0 where `kept` is another one; `nearest`: the id of the nearest other point, the lowest of several, -1
// if there is none, and how far away that is (on the sphere the angle in radians; 0 for duplicates).
struct FinalCells {
    Buffer<std::int64_t> kept;
    Buffer<std::int32_t> degree;
    Buffer<double> area;
    Buffer<std::int64_t> nearest;
    Buffer<double> distance;
};

// `rows`: ascending; all triangles at their sites must be final. There must be triangles.
template <std::size_t Width>
FinalCells final_cells(const PartialMesh& mesh, const Index* rows, std::size_t count, Stop stop);

// Triangles by ids, the lowest first, counterclockwise, of those whose lowest id is that of a site that `is_final`, a
// value a row, tells of; and the rows of `simplices` where they stand.
struct FinalTriangles {
    Buffer<std::int64_t> corners;
    Buffer<Index> rows;
};

FinalTriangles final_triangles(const PartialMesh& mesh, const bool* is_final, Stop stop);

}  // namespace stereodel::partitions
