// The folder `raster`: pictures of the sphere through a conformal map, pixel by pixel.
// Reading order: rough_angle, page_trace (from the page back to the sphere), levels (means of the raster), sample,
// warp.
//
// An equirectangular raster on a globe seen through a lens, as pixels.
#pragma once

#include <cstdint>

#include "raster/page_trace.hpp"
#include "raster/sample.hpp"
#include "threads.hpp"

namespace stereodel::raster {

// Pixels of the page: the upper left corner of the first and the sides of one, in the units of its projection.
struct PageWindow {
    double left, top;
    Step step;
    int width, height;
};

// Fills width x height pixels, four bytes each, opacity not premultiplied, rows from the top. With `covered` the
// opacity is multiplied by the part of the pixel in the disc; without, pixels that the disc touches have its colours
// there. A page that is no disc has colours everywhere.
void warp_raster(const RasterSampler& raster, const PageMap& map, const PageWindow& window, bool covered,
                 std::uint8_t* pixels, Crew& crew, Stop stop);

}  // namespace stereodel::raster
