// What callers hand in: finite numbers, vectors with a direction, numbers of points and triangles that there are.
//
// Everything behind takes this for granted: a NaN makes every comparison false, a number out of range reads elsewhere.
// Numbers are passed over without branches; the culprit is looked for only if there is one. All functions throw
// std::invalid_argument, which names the argument, the place and the value.
#pragma once

#include <cstddef>

#include "tally.hpp"

namespace stereodel {

// Numbers, or rows of `width` of them: finite.
void check_finite(const char* name, const double* values, std::size_t count, std::size_t width = 1);

// Vectors of three: finite, and none of them zero. Any length will do.
void check_directions(const char* name, const double* xyz, std::size_t count);

void check_same_length(const char* first, std::size_t one, const char* second, std::size_t other);

// Numbers of things, or rows of `width` of them, of which there are `size`.
void check_indices(const char* name, const Index* numbers, std::size_t count, std::size_t size, std::size_t width = 1);

// None of them twice, all below `size`.
void check_distinct(const char* name, const Index* numbers, std::size_t count, std::size_t size);

enum class Border {
    open,   // the plane: -1 where there is no neighbour
    closed  // the sphere: all neighbours are there
};

// Rows of three points and of three neighbours that fit together: each edge inside is that of its neighbour, backwards.
// So turning around a point comes to an end. Whether the triangles are Delaunay is not asked.
void check_triangles(const Index* simplices, const Index* neighbors, std::size_t count, std::size_t points,
                     Border border);

}  // namespace stereodel
