// Longitude and latitude to unit vectors and back; sine and cosine of degrees.
#include "coordinates/lonlat.hpp"

#include <cstddef>

#include "coordinates/degrees.hpp"

#include "web/answer.hpp"

namespace stereodel::web {

STEREODEL_EXPORT(lonlat_to_xyz) void lonlat_to_xyz(const double* lonlat, std::size_t count, double* xyz) {
    coordinates::lonlat_to_xyz(lonlat, count, xyz, alone, nullptr);
}

STEREODEL_EXPORT(xyz_to_lonlat) void xyz_to_lonlat(const double* xyz, std::size_t count, double* lonlat) {
    coordinates::xyz_to_lonlat(xyz, count, lonlat, alone, nullptr);
}

// Rows: sine, its low part, cosine, its low part.
STEREODEL_EXPORT(sin_cos_degrees) void sin_cos_degrees(const double* angles, std::size_t count, double* rows) {
    for (std::size_t k = 0; k < count; ++k) {
        const coordinates::SineCosine value = coordinates::sin_cos_degrees(angles[k]);
        rows[4 * k] = value.sine.hi;
        rows[4 * k + 1] = value.sine.lo;
        rows[4 * k + 2] = value.cosine.hi;
        rows[4 * k + 3] = value.cosine.lo;
    }
}

}  // namespace stereodel::web
