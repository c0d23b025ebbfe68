// The mean of an equirectangular raster over the image of a small square of the page.
//
// Where the image is smaller than a texel, the raster is the surface through its texels that the cubic convolution of
// Catmull and Rom gives; where it is larger, a level of means stands for it, and several samples make up its shape.
//
// Source: R. Keys, "Cubic convolution interpolation for digital image processing", IEEE Trans. ASSP 29 (1981), with
// a = -1/2; P. Heckbert, "Fundamentals of texture mapping and image warping" (1989), for footprints by derivatives.
#pragma once

#include <cstdint>
#include <vector>

#include "raster/levels.hpp"
#include "raster/page_trace.hpp"

namespace stereodel::raster {

// Edges in radians, west < east <= west + 2 pi, south < north.
struct RasterEdges {
    double west, south, east, north;
};

// Colour times opacity and opacity, times weight, in levels of 255.
struct ColorSum {
    float channels[4] = {0.0F, 0.0F, 0.0F, 0.0F};
    float weight = 0.0F;
};

class RasterSampler {
  public:
    // `shifts`: what is added to a latitude of the sphere to get that of the rows, at as many latitudes from -90 to 90
    // degrees as there are entries; none for 0.
    RasterSampler(const RasterShape& shape, const std::uint8_t* raster, const std::uint8_t* levels,
                  const RasterEdges& edges, std::vector<double> shifts);

    // Adds the mean over the image of a square of one step about a traced point.
    void add(const Traced& traced, ColorSum& sum) const;

  private:
    struct Footprint {
        double u, v, u_x, u_y, v_x, v_y;
    };

    // What the grains of a footprint have in common: the level, its texels in those of the raster, a grain's sides.
    struct Grain {
        const RasterLevel* level;
        double across, down;
        double u_side, v_side;  // of the raster
        double u_rest, v_rest;  // of the level, without the spread of its means
        float weight;
    };

    Footprint footprint(const Traced& traced) const;
    double row_latitude(double lat) const;
    void add_grain(const Footprint& center, const Grain& grain, double x, double y, ColorSum& sum) const;
    void find_lines(const RasterLevel& level, int column, int row, const std::uint8_t** lines,
                    std::uint8_t* copies) const;
    int row_of(int row, int height, bool& across) const;
    const std::uint8_t* texel(const RasterLevel& level, int column, int row) const;
    const RasterLevel& level(int i, int j) const { return levels_[static_cast<std::size_t>(j * columns_ + i)]; }

    std::vector<RasterLevel> levels_;
    std::vector<double> across_, down_;  // columns and rows of a level in one of the raster
    int columns_, rows_;
    double width_, height_;  // of the raster
    std::vector<double> shifts_;
    double middle_, north_;  // longitude in [-pi, pi), latitude of the upper edge
    double columns_per_radian_, rows_per_radian_;
    bool around_, north_pole_, south_pole_;
};

}  // namespace stereodel::raster
