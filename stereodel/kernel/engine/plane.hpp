// Delaunay triangulation of points of the plane.
#pragma once

#include <cstddef>
#include <limits>
#include <stdexcept>

#include "duplicates.hpp"
#include "engine/triangles.hpp"
#include "tally.hpp"
#include "threads.hpp"

namespace stereodel::engine {

struct Triangulation {
    Triangles triangles;
    Pairs duplicates;    // in order
    int dimension = -1;  // 0 one point, 1 all on one line (great circle), 2 triangles
    Tally tally;
};

// Directed edges are numbered by `Index`, six a point.
inline void check_size(std::size_t count) {
    if (count > static_cast<std::size_t>(std::numeric_limits<Index>::max()) / 6) {
        throw std::length_error("more than 357913941 points");
    }
}

// `xy` holds finite numbers, `count` pairs of them. The result does not depend on `workers`.
// Throws std::bad_alloc, std::length_error, Cancelled.
Triangulation triangulate_plane(const double* xy, std::size_t count, bool with_neighbors, int workers, Stop stop);

}  // namespace stereodel::engine
