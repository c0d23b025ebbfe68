// Circumcentres: from differences of the given coordinates, in about twice the precision or by integers, rounded once.
#pragma once

#include <cstddef>

#include "tally.hpp"
#include "threads.hpp"

namespace stereodel::voronoi {

// Triangles by three point numbers each; the centre of row k goes to place[k], or to k if `place` is null.
struct TriangleRows {
    const Index *corners, *place;
    std::size_t count;

    std::size_t to(std::size_t k) const { return place == nullptr ? k : static_cast<std::size_t>(place[k]); }
};

// Both throw std::invalid_argument for triangles without a circumcentre.
//
// Plane: two coordinates a centre, off by little more than half a unit in the last place of the centre or the radius,
// infinite beyond the range of doubles. Sphere: the unit normals on the side from which the corners appear
// counterclockwise, off by little more than half a unit in the last place of their length, 2^-54: components that are
// far shorter than that may hold fewer digits.
template <std::size_t Width>
void circumcenters(const double* points, std::size_t size, const TriangleRows& rows, double* centers, int workers,
                   Stop stop);
template <>
void circumcenters<2>(const double*, std::size_t, const TriangleRows&, double*, int, Stop);
template <>
void circumcenters<3>(const double*, std::size_t, const TriangleRows&, double*, int, Stop);

}  // namespace stereodel::voronoi
