// Longitude and latitude to unit vectors and back.
#include "coordinates/lonlat.hpp"

#include <cstddef>

#include "coordinates/latitudes.hpp"

#include "web/answer.hpp"

namespace stereodel::web {

STEREODEL_EXPORT(lonlat_to_xyz) void lonlat_to_xyz(const double* lonlat, std::size_t count, double* xyz) {
    coordinates::lonlat_to_xyz(lonlat, count, xyz, alone, nullptr);
}

STEREODEL_EXPORT(xyz_to_lonlat) void xyz_to_lonlat(const double* xyz, std::size_t count, double* lonlat) {
    coordinates::xyz_to_lonlat(xyz, count, lonlat, alone, nullptr);
}

STEREODEL_EXPORT(ellipsoid_to_xyz)
void ellipsoid_to_xyz(const double* lonlat, std::size_t count, bool authalic, double* xyz) {
    const auto kind = authalic ? coordinates::Latitude::authalic : coordinates::Latitude::geodetic;
    coordinates::ellipsoid_to_xyz(lonlat, count, kind, xyz);
}

}  // namespace stereodel::web
