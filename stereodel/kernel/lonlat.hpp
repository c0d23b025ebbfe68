// Longitude and latitude to unit vectors.
#pragma once

#include <cstddef>

namespace stereodel {

// xyz[3i .. 3i+2] = (cos lat cos lon, cos lat sin lon, sin lat), each correctly rounded unless it is within 2^-100 of
// the middle between two doubles, and never -0. Rows (lon, lat) in degrees: finite longitude, latitude in [-90, 90].
void lonlat_to_xyz(const double* lonlat, std::size_t count, double* xyz);

}  // namespace stereodel
