// The folder `conformal`: conformal maps of the sphere. What is proved, and how, stands in moebius.cpp.
// Reading order: moebius, images of points; rotations, quaternions; group, products.
//
// Conformal maps of the sphere at many points: a rotation, the fisheye along z, a rotation.
#pragma once

#include <array>
#include <cstddef>

#include "threads.hpp"

namespace stereodel::conformal {

// A rotation matrix, row after row, as a sum: multiples of 2^-25, and what is left, at most 2^-26, rounded once.
struct SplitRotation {
    std::array<double, 9> high, low;

    // Of entries hi + lo, |lo| <= 2^-53 |hi|.
    SplitRotation(const double* hi, const double* lo);
};

struct MoebiusParts {
    SplitRotation left;
    double magnification;  // from 1e-100 to 1e100
    SplitRotation right;
};

// Images of directions (x, y, z) of any length as unit vectors without -0. For the map that the parts define exactly
// they are off by less than (1 + scale) 6 2^-53 and by less than 13 2^-53 + scale 2^-73 (derived in moebius.cpp). False
// if a row is zero or not finite: it has no image. Threads do not change the result.
bool moebius_images(const MoebiusParts& map, const double* xyz, std::size_t count, double* images, int workers,
                    Stop stop);

// Local scales at directions: off by less than 2^-48 of themselves for points within 2^-73 rad of the given ones.
bool moebius_scales(const MoebiusParts& map, const double* xyz, std::size_t count, double* scales, int workers,
                    Stop stop);

// Images (lon, lat) in degrees of rows (lon, lat), longitude in [-180, 180): within (1 + scale) 18 2^-53 rad. False if
// a row is not finite or has a latitude outside [-90, 90].
bool moebius_lonlat(const MoebiusParts& map, const double* lonlat, std::size_t count, double* images, int workers,
                    Stop stop);

}  // namespace stereodel::conformal
