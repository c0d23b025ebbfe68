// Directions of one great circle: its axis and the angles between neighbours; the planes that bisect two directions.
#pragma once

#include <cstddef>
#include <vector>

#include "tally.hpp"
#include "threads.hpp"

namespace stereodel::voronoi {

inline constexpr double FULL_TURN = 0x1.921fb54442d18p2;  // 2 pi

// The different directions of one great circle, in the order of `circle_order`.
struct GreatCircle {
    std::vector<Index> order;
    // Both ends of the axis, -0 nowhere; the order is counterclockwise around the first one. Of two directions that is
    // the end of their vector product; of two opposite ones that of p x e, e the first of the coordinate axes along
    // which p is shortest. Zero for fewer than two.
    double ends[2][3] = {};

    GreatCircle(const double* xyz, std::vector<Index> directions);

    // The angle from each one to the next around the first end, in [0, 2 pi), for two or more: within 2^-50 of itself.
    std::vector<double> gaps(const double* xyz) const;
};

// Unit vectors of p/|p| - q/|q| for rows of different directions, however close: the normals of the planes between, on
// the side of p, off by less than 0.51 ulp of the longest component or so.
void bisector_normals(const double* p, const double* q, std::size_t count, double* normals, int workers, Stop stop);

}  // namespace stereodel::voronoi
