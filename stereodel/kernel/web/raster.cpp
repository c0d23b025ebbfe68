// An equirectangular raster at all resolutions, and on a globe seen through a lens.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "raster/levels.hpp"
#include "raster/warp.hpp"
#include "web/answer.hpp"

namespace stereodel::web {

using raster::PageMap;
using raster::PageProjection;
using raster::PageWindow;
using raster::RasterSampler;
using raster::RasterShape;

STEREODEL_EXPORT(raster_levels_size) std::size_t raster_levels_size(int width, int height) {
    return RasterShape(width, height).size();
}

// `edges`: west, south, east, north.
STEREODEL_EXPORT(raster_levels)
void raster_levels(const std::uint8_t* texels, int width, int height, const double* edges, std::uint8_t* levels) {
    Crew crew(alone);
    raster::make_raster_levels(texels, RasterShape(width, height), edges[3], edges[1], levels, crew, nullptr);
}

// `map`: rotation, magnification, rotation, reach (0 of an orthographic view), 20 numbers; `place`: left, top, width
// and height of a pixel.
STEREODEL_EXPORT(warp_raster)
void warp_raster(const std::uint8_t* texels, const std::uint8_t* levels, int width, int height, const double* edges,
                 const double* map, const double* place, int across, int down, bool covered, std::uint8_t* pixels) {
    const RasterSampler sampler(RasterShape(width, height), texels, levels,
                                {edges[0], edges[1], edges[2], edges[3]}, {});
    const double reach = map[19];
    PageMap page{{}, map[9], {}, reach == 0.0 ? PageProjection::orthographic : PageProjection::stereographic, reach};
    std::copy_n(map, 9, page.first);
    std::copy_n(map + 10, 9, page.last);
    const PageWindow window{place[0], place[1], {place[2], place[3]}, across, down};
    Crew crew(alone);
    raster::warp_raster(sampler, page, window, covered, pixels, crew, nullptr);
}

}  // namespace stereodel::web
