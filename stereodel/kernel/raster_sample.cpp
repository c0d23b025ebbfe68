// A square of the page becomes a parallelogram of the raster with sides u_x, v_x and u_y, v_y, in texels. It is cut
// along its sides into equal grains; a grain counts as the upright rectangle with the same spread along rows and
// columns: sides hypot(u_x, u_y) and hypot(v_x, v_y), the standard deviations of both being 1/sqrt(12) of that.
//
// The mean of a cubic over a side s is that of its values at +-s/sqrt(12) (Gauss's rule with two points; the
// convolution is cubic between texels). A level holds means over its texels, spread 1, already: what is left of s is
// sqrt(s^2 - 1). Texels of a level are at most a third as wide as the whole footprint, so that its shape is that of the
// square of the page and not of the texels: against 256 samples a pixel, white noise is met to 36 dB everywhere, at
// limb, poles and antipodes; with a half it would be 33 dB.
#include "raster_sample.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "arctangent.hpp"

namespace stereodel {

namespace {

constexpr int TAPS = 5;           // texels that two cubics less than one texel apart reach
constexpr double LARGEST = 1.25;  // side of a grain in texels, along the way that it is cut
constexpr int MOST_GRAINS = 16;   // along a side
constexpr double GAUSS = 0.28867513459481287;  // 1/sqrt(12)

double length_of(double a, double b) { return std::sqrt(a * a + b * b); }

// Of numbers that fit into an int.
int floor_of(double value) {
    const int cut = static_cast<int>(value);
    return value < cut ? cut - 1 : cut;
}

// Places of the first of five texels and their weights.
struct Taps {
    int first;
    float weights[TAPS];
};

void cubic(float t, float w[4]) {
    const float t2 = t * t, t3 = t2 * t;
    w[0] = 0.5F * (2.0F * t2 - t - t3);
    w[1] = 0.5F * (2.0F - 5.0F * t2 + 3.0F * t3);
    w[2] = 0.5F * (t + 4.0F * t2 - 3.0F * t3);
    w[3] = 0.5F * (t3 - t2);
}

// Of the mean over `side` < 1.73 texels about a place, texel k being centred at k + 1/2.
Taps taps(double place, double side) {
    const double reach = GAUSS * side, left = place - 0.5 - reach, right = place - 0.5 + reach;
    const int begin = floor_of(left), last = floor_of(right);
    float a[4], b[4];
    cubic(static_cast<float>(left - begin), a);
    cubic(static_cast<float>(right - last), b);
    const float shift = last > begin ? 1.0F : 0.0F;
    Taps found{begin - 1, {}};
    // The second cubic, one texel later or not: a choice by arithmetic, which needs no memory.
    found.weights[0] = 0.5F * (a[0] + (1.0F - shift) * b[0]);
    for (int k = 1; k < 4; ++k) found.weights[k] = 0.5F * (a[k] + (b[k] + shift * (b[k - 1] - b[k])));
    found.weights[4] = 0.5F * shift * b[3];
    return found;
}

int clamped(int value, int size) { return std::min(std::max(value, 0), size - 1); }

int wrapped(int value, int size) {
    const int rest = value % size;
    return rest < 0 ? rest + size : rest;
}

// The part of an interval of a length about a place that lies in [0, size].
double share(double place, double length, double size) {
    const double side = std::max(length, 1e-9);
    const double inside = std::min(place + 0.5 * side, size) - std::max(place - 0.5 * side, 0.0);
    return std::min(std::max(inside / side, 0.0), 1.0);
}

// The last level whose texels are at most a third of a side.
int level_of(double side, int count) {
    int level = 0;
    for (; level + 1 < count && side >= 6.0; side *= 0.5) {
        ++level;
    }
    return level;
}

int grains_along(double length) { return static_cast<int>(std::min(length / LARGEST, MOST_GRAINS - 1.0)) + 1; }

// No side of a footprint is longer than the raster; what is no number, opposite a lens beyond all reason, is that long.
double bounded(double side, double longest) { return side < longest ? (side > -longest ? side : -longest) : longest; }

double rest_of(double side, bool is_mean) {
    const double rest = is_mean ? std::sqrt(std::max(0.0, side * side - 1.0)) : side;
    return std::min(rest, 1.7);
}

}  // namespace

struct RasterSampler::Footprint {
    double u, v, u_x, u_y, v_x, v_y;
};

// What the grains of a footprint have in common: the level, its texels in those of the raster, a grain's sides.
struct RasterSampler::Grain {
    const RasterLevel* level;
    double across, down;
    double u_side, v_side;  // of the raster
    double u_rest, v_rest;  // of the level, without the spread of its means
    float weight;
};

RasterSampler::RasterSampler(const RasterShape& shape, const std::uint8_t* raster, const std::uint8_t* levels,
                             const RasterEdges& edges)
    : columns_(shape.columns()),
      rows_(shape.rows()),
      width_(shape.width(0)),
      height_(shape.height(0)),
      edges_(edges),
      columns_per_radian_(width_ / (edges.east - edges.west)),
      rows_per_radian_(height_ / (edges.north - edges.south)) {
    constexpr double ROUNDED = 1e-9;  // radians: edges come from degrees
    around_ = edges.east - edges.west > 2.0 * PI - ROUNDED;
    north_pole_ = around_ && edges.north > 0.5 * PI - ROUNDED;
    south_pole_ = around_ && edges.south < -0.5 * PI + ROUNDED;
    for (int j = 0; j < rows_; ++j) {
        for (int i = 0; i < columns_; ++i) {
            const std::uint8_t* texels = i == 0 && j == 0 ? raster : levels + (shape.has(i, j) ? shape.place(i, j) : 0);
            levels_.push_back({texels, shape.width(i), shape.height(j)});
        }
    }
}

RasterSampler::Footprint RasterSampler::footprint(const Traced& traced) const {
    const double middle = 0.5 * (edges_.west + edges_.east);
    double east = traced.lon - middle;
    east -= 2.0 * PI * std::floor(east / (2.0 * PI) + 0.5);
    return {0.5 * width_ + east * columns_per_radian_,
            (edges_.north - traced.lat) * rows_per_radian_,
            bounded(traced.lon_x * columns_per_radian_, width_),
            bounded(traced.lon_y * columns_per_radian_, width_),
            bounded(-traced.lat_x * rows_per_radian_, height_),
            bounded(-traced.lat_y * rows_per_radian_, height_)};
}

void RasterSampler::add(const Traced& traced, ColorSum& sum) const {
    const Footprint whole = footprint(traced);
    const double u_side = length_of(whole.u_x, whole.u_y), v_side = length_of(whole.v_x, whole.v_y);
    const int i = level_of(u_side, columns_), j = std::min(level_of(v_side, rows_), i == columns_ - 1 ? rows_ - 1 : i);
    Grain grain{&level(i, j), 0, 0, 0, 0, 0, 0, 1.0F};
    grain.across = grain.level->width / width_;
    grain.down = grain.level->height / height_;
    const int m = grains_along(length_of(whole.u_x * grain.across, whole.v_x * grain.down));
    const int n = grains_along(length_of(whole.u_y * grain.across, whole.v_y * grain.down));
    grain.u_side = length_of(whole.u_x / m, whole.u_y / n);
    grain.v_side = length_of(whole.v_x / m, whole.v_y / n);
    grain.u_rest = rest_of(grain.u_side * grain.across, i > 0);
    grain.v_rest = rest_of(grain.v_side * grain.down, j > 0);
    grain.weight = 1.0F / static_cast<float>(m * n);
    for (int k = 0; k < n; ++k) {
        for (int l = 0; l < m; ++l) add_grain(whole, grain, (l + 0.5) / m - 0.5, (k + 0.5) / n - 0.5, sum);
    }
}

void RasterSampler::add_grain(const Footprint& center, const Grain& grain, double x, double y, ColorSum& sum) const {
    const double u = center.u + x * center.u_x + y * center.u_y, v = center.v + x * center.v_x + y * center.v_y;
    sum.weight += grain.weight;
    float weight = grain.weight;
    if (!around_) weight *= static_cast<float>(share(u, grain.u_side, width_));
    if (!north_pole_ || !south_pole_) {
        const double above = north_pole_ ? std::max(v, 0.5 * grain.v_side) : v;
        weight *= static_cast<float>(share(south_pole_ ? std::min(above, height_ - 0.5 * grain.v_side) : above,
                                           grain.v_side, height_));
    }
    if (weight == 0.0F) return;
    const RasterLevel& level = *grain.level;
    const Taps across = taps(u * grain.across, grain.u_rest), down = taps(v * grain.down, grain.v_rest);
    std::uint8_t texels[4 * TAPS * TAPS];
    gather(level, across.first, down.first, texels);
    // One loop for each step, of a fixed length: compilers make vector instructions of them.
    float values[4 * TAPS * TAPS], rows[4 * TAPS] = {};
    for (int k = 0; k < 4 * TAPS * TAPS; ++k) values[k] = static_cast<float>(texels[k]);
    for (int r = 0; r < TAPS; ++r) {
        for (int k = 0; k < 4 * TAPS; ++k) rows[k] += down.weights[r] * values[4 * TAPS * r + k];
    }
    for (int c = 0; c < TAPS; ++c) {
        for (int b = 0; b < 4; ++b) sum.channels[b] += weight * across.weights[c] * rows[4 * c + b];
    }
}

// The square of texels with a given first column and row.
void RasterSampler::gather(const RasterLevel& level, int column, int row, std::uint8_t* texels) const {
    const bool inside = column >= 0 && column + TAPS <= level.width && row >= 0 && row + TAPS <= level.height;
    const std::size_t width = 4 * static_cast<std::size_t>(level.width);
    if (inside) {
        const std::uint8_t* place = level.texels + static_cast<std::size_t>(row) * width + 4 * std::size_t(column);
        for (int r = 0; r < TAPS; ++r) std::memcpy(texels + 4 * TAPS * r, place + std::size_t(r) * width, 4 * TAPS);
        return;
    }
    for (int r = 0; r < TAPS; ++r) {
        for (int c = 0; c < TAPS; ++c) std::memcpy(texels + 4 * (TAPS * r + c), texel(level, column + c, row + r), 4);
    }
}

// Beyond a pole the raster goes on along the opposite meridian; beyond other edges its last texel is repeated.
const std::uint8_t* RasterSampler::texel(const RasterLevel& level, int column, int row) const {
    bool across = false;
    const int line = row_of(row, level.height, across);
    const int shifted = column + (across ? level.width / 2 : 0);
    const int place = around_ ? wrapped(shifted, level.width) : clamped(shifted, level.width);
    return level.texels + 4 * (std::size_t(line) * std::size_t(level.width) + std::size_t(place));
}

int RasterSampler::row_of(int row, int height, bool& across) const {
    across = (row < 0 && north_pole_) || (row >= height && south_pole_);
    if (!across) return clamped(row, height);
    return clamped(row < 0 ? -1 - row : 2 * height - 1 - row, height);
}

}  // namespace stereodel
