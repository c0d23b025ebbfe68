// Directions of one great circle: their exact order around it, its axis, the angles between neighbours; and the planes
// that bisect two directions.
#pragma once

#include <cstddef>
#include <vector>

#include "tally.hpp"
#include "threads.hpp"

namespace stereodel {

inline constexpr double FULL_TURN = 0x1.921fb54442d18p2;  // 2 pi

// The different directions of one great circle.
struct GreatCircle {
    // The first of equal ones, counterclockwise around the first end of the axis from the lowest. Of three or more, the
    // three lowest are counterclockwise; two are in the order of their numbers.
    std::vector<Index> order;
    // Both ends, -0 nowhere. Of two directions the first end is that of their vector product; of two opposite ones that
    // of p x e, e the first of the coordinate axes along which p is shortest. Zero for fewer than two.
    double ends[2][3] = {};

    GreatCircle() = default;
    // Throws std::invalid_argument if the directions, `count` of them, do not lie on one great circle; Cancelled.
    GreatCircle(const double* xyz, std::size_t count, Stop stop);

    // The angle from each one to the next around the first end, in [0, 2 pi), for two or more: within 2^-51 of itself.
    std::vector<double> gaps(const double* xyz) const;
};

// Unit vectors of p/|p| - q/|q| for rows of different directions, however close: the normals of the planes between, on
// the side of p, off by less than 0.51 ulp of the longest component or so.
void bisector_normals(const double* p, const double* q, std::size_t count, double* normals, int workers, Stop stop);

}  // namespace stereodel
