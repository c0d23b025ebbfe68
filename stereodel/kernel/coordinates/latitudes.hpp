// Latitudes of the WGS84 ellipsoid as latitudes of a sphere (stereodel/sphere/latitudes.py has the formulas).
#pragma once

#include <cstddef>

#include "coordinates/degrees.hpp"

namespace stereodel::coordinates {

enum class Latitude {
    geodetic,  // the direction from the Earth's centre
    authalic   // equal areas
};

// P and R of t = sin^2 of a geodetic latitude.
struct AuthalicFactors {
    DoubleDouble p, r;
};
AuthalicFactors authalic_factors(DoubleDouble t);

// Sine and cosine on the sphere of those of a geodetic latitude, relative error below 2^-84.
SineCosine on_sphere(const SineCosine& latitude, Latitude kind);

// As lonlat_to_xyz, of geodetic latitudes: each component rounded once from that, and never -0.
void ellipsoid_to_xyz(const double* lonlat, std::size_t count, Latitude kind, double* xyz);

}  // namespace stereodel::coordinates
