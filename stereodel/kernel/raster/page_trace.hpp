// From a point of a page back to longitude and latitude: view, lens and raster undone, with the derivatives.
//
// Page points are those of the unit disc that a view shows, x right, y up, or of a rectangle that shows the sphere or a
// part of it from within. A page gives a unit vector in its own axes (right, up, toward the viewer); `first`, the
// fisheye of magnification `size` along +z, and `last` lead to the source. The rotations of view and lens are
// multiplied before, in double-double.
#pragma once

#include <cstddef>
#include <string_view>

namespace stereodel::raster {

// Orthographic and stereographic: the unit disc. Gnomonic: x and y are tangents of angles from the middle.
// Equirectangular: longitude and latitude from the middle, radians.
enum class PageProjection { orthographic, stereographic, gnomonic, equirectangular };

// That of a name; throws std::invalid_argument for another name.
PageProjection page_projection(std::string_view name);

struct PageMap {
    double first[9];  // rotation of the page's axes to those of the fisheye, rows
    double size;      // magnification of the inverse lens
    double last[9];
    PageProjection projection;
    double reach;  // stereographic: tan(extent/2), extent the angular radius of the disc

    bool is_disc() const {
        return projection == PageProjection::orthographic || projection == PageProjection::stereographic;
    }
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
