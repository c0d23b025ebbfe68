// The folder `coordinates`: degrees, and longitude and latitude as unit vectors.
// Reading order: degrees, sine and cosine to twice the precision; plain_degrees, the same in doubles; lonlat;
// latitudes, those of the ellipsoid.
//
// Longitude and latitude to unit vectors and back.
#pragma once

#include <cstddef>

#include "threads.hpp"

namespace stereodel::coordinates {

// xyz[3i .. 3i+2] = (cos lat cos lon, cos lat sin lon, sin lat), each correctly rounded unless it is within 2^-100 of
// the middle between two doubles, and never -0. Rows (lon, lat) in degrees: finite longitude, latitude in [-90, 90].
void lonlat_to_xyz(const double* lonlat, std::size_t count, double* xyz, int workers, Stop stop);

// Longitude in [-180, 180) and latitude in degrees, each within an ulp and never -0, of directions of any length that
// are finite and not zero; longitude 0 at the poles. The same bits on every machine, too.
void xyz_to_lonlat(const double* xyz, std::size_t count, double* lonlat, int workers, Stop stop);

}  // namespace stereodel::coordinates
