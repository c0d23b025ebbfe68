// From a point of a page back to longitude and latitude: view, lens and raster undone, with the derivatives.
//
// Page points are those of the unit disc that a view shows, x right, y up. A view gives a unit vector in its own axes
// (right, up, toward the viewer); `first`, the fisheye of magnification `size` along +z, and `last` lead to the source.
// The rotations of view and lens are multiplied before, in double-double.
#pragma once

#include <cstddef>

namespace stereodel::raster {

struct PageMap {
    double first[9];  // rotation of the view axes to those of the fisheye, rows
    double size;      // magnification of the inverse lens
    double last[9];
    // Orthographic: 0. Stereographic: tan(extent/2), extent the angular radius of the disc.
    double reach;
};

// What one page point shows, and how that changes over a step on the page; angles in radians.
struct Traced {
    double lon, lat;
    double lon_x, lon_y, lat_x, lat_y;
    // How far from straight the map is over a step: a relative change of the derivatives. Infinite outside the disc.
    double bend;
};

// The side of a pixel along x and along y.
struct Step {
    double right, up;

    double longer() const { return right > up ? right : up; }
};

// For `count` points of a row, a step apart, the first at (x, y), and the changes over a step right and up. In double
// arithmetic: lon and lat are within 1e-9 rad, plus 2^-50 times the magnification there, of those of the given numbers.
void trace_row(const PageMap& map, double x, double y, Step step, std::size_t count, Traced* out);

}  // namespace stereodel::raster
