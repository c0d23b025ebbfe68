// An equirectangular raster at all resolutions: level (i, j) has its width halved i times and its height j times,
// i >= j, because near a pole, where meridians crowd, a square of the sphere is wide in the raster and never high.
//
// Texels are four bytes, colour premultiplied by opacity. A texel of a level is the mean of the raster over its area of
// the sphere: along a row all weigh the same, rows by the difference of the sines of their latitudes. Halves are
// rounded up where the width is odd; texels then overlap three of the level below, each with its part.
//
// Source: L. Williams, "Pyramidal parametrics", SIGGRAPH 1983, for means in powers of two; the sides halved apart are
// known as a rip map.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "threads.hpp"

namespace stereodel::raster {

struct RasterLevel {
    const std::uint8_t* texels;
    int width, height;
};

// The shape of a raster, and where its levels lie in one piece of memory after the raster itself.
class RasterShape {
  public:
    RasterShape(int width, int height);

    int columns() const { return static_cast<int>(widths_.size()); }  // number of widths: level i < columns()
    int rows() const { return static_cast<int>(heights_.size()); }
    int width(int i) const { return widths_[static_cast<std::size_t>(i)]; }
    int height(int j) const { return heights_[static_cast<std::size_t>(j)]; }
    // Bytes of all levels but (0, 0), and the place of one of them.
    std::size_t size() const { return size_; }
    std::size_t place(int i, int j) const { return places_[index(i, j)]; }
    bool has(int i, int j) const { return i >= j || i == columns() - 1; }

  private:
    std::size_t index(int i, int j) const { return static_cast<std::size_t>(j * columns() + i); }

    std::vector<int> widths_, heights_;
    std::vector<std::size_t> places_;
    std::size_t size_ = 0;
};

// Fills `levels`, shape.size() bytes, from the raster; `north` and `south` are the latitudes of its edges in radians.
void make_raster_levels(const std::uint8_t* raster, const RasterShape& shape, double north, double south,
                        std::uint8_t* levels, Crew& crew, Stop stop);

}  // namespace stereodel::raster
