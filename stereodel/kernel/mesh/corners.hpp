// Places of a triangle's three corners.
#pragma once

#include <cstddef>

#include "tally.hpp"

namespace stereodel::mesh {

// The places after and before one, counterclockwise: by a choice, which costs less than a remainder.
inline std::size_t place_after(std::size_t place) {
    return place == 2 ? 0 : place + 1;
}
inline std::size_t place_before(std::size_t place) {
    return place == 0 ? 2 : place - 1;
}

// Place of a vertex that is one of the corners. By branches: who walks around the vertex goes on with a guess before
// the corners have come from memory.
inline std::size_t place_of(const Index* corner, Index vertex) {
    return corner[0] == vertex ? 0 : corner[1] == vertex ? 1 : 2;
}

// The others are computed, since a guess would be wrong every second time: the first of two places that is right, or
// the third.
inline std::size_t first_place(bool first, bool second) {
    return (2 - std::size_t{second}) & (std::size_t{first} - 1);
}

// Place of the corner that is neither u nor v. Two facets that share all their corners are neighbours thrice, so the
// place of a neighbour cannot be found by its number.
inline std::size_t place_opposite(const Index* corner, Index u, Index v) {
    return first_place((corner[0] != u) & (corner[0] != v), (corner[1] != u) & (corner[1] != v));
}

// Place of the smallest corner; corners differ.
inline std::size_t place_of_least(const Index* corner) {
    return first_place((corner[0] < corner[1]) & (corner[0] < corner[2]), corner[1] < corner[2]);
}

}  // namespace stereodel::mesh
