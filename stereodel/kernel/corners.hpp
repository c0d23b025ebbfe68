// Places of a triangle's three corners.
#pragma once

#include <cstddef>

#include "tally.hpp"

namespace stereodel {

// Place of a vertex that is one of the corners.
inline std::size_t place_of(const Index* corner, Index vertex) {
    return corner[0] == vertex ? 0 : corner[1] == vertex ? 1 : 2;
}

// Place of the corner that is neither u nor v. Two facets that share all their corners are neighbours thrice, so the
// place of a neighbour cannot be found by its number.
inline std::size_t place_opposite(const Index* corner, Index u, Index v) {
    return corner[0] != u && corner[0] != v ? 0 : corner[1] != u && corner[1] != v ? 1 : 2;
}

// Place of the smallest corner; corners differ.
inline std::size_t place_of_least(const Index* corner) {
    return corner[1] < corner[0] ? (corner[2] < corner[1] ? 2 : 1) : (corner[2] < corner[0] ? 2 : 0);
}

}  // namespace stereodel
