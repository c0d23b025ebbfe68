// The predicates on many points at once, for callers from outside: points are checked, signs are exact.
//
// A row stands for one point, and one row alone for as many as the others have. Each function throws
// std::invalid_argument for numbers that are not finite, for vectors without a direction where directions are meant,
// and for lengths that do not fit; the message names the argument. Results do not depend on the number of workers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "threads.hpp"

namespace stereodel::predicates::signs {

struct PointRows {
    const char* name;  // of the argument, for messages
    const double* coordinates;
    std::size_t count;
};

// How many signs there are for these rows.
std::size_t common_count(std::initializer_list<PointRows> points);

// 1 counterclockwise, -1 clockwise, 0 on one line.
void orient2d(PointRows a, PointRows b, PointRows c, std::int8_t* signs, int workers, Stop stop);

// 1 if d lies inside the circle of a counterclockwise triangle abc, -1 outside, 0 on it.
void incircle(PointRows a, PointRows b, PointRows c, PointRows d, std::int8_t* signs, int workers, Stop stop);

// Of det[b-a c-a d-a].
void orient3d(PointRows a, PointRows b, PointRows c, PointRows d, std::int8_t* signs, int workers, Stop stop);

// Directions of any length: 1 if p lies in the open bubble of abc, -1 beyond it, 0 on its circle.
void in_bubble(PointRows a, PointRows b, PointRows c, PointRows p, std::int8_t* signs, int workers, Stop stop);

// The same: 1 if c lies to the left of the great circle from a to b, -1 to the right, 0 on it.
void turn(PointRows a, PointRows b, PointRows c, std::int8_t* signs, int workers, Stop stop);

// The lexicographic order of directions: -1, 0 for equal ones, 1.
void compare(PointRows a, PointRows b, std::int8_t* signs, int workers, Stop stop);

}  // namespace stereodel::predicates::signs
