// A square of the page becomes a parallelogram of the raster with sides u_x, v_x and u_y, v_y, in texels. It is cut
// along its sides into equal grains; a grain counts as the upright rectangle with the same spread along rows and
// columns: sides hypot(u_x, u_y) and hypot(v_x, v_y), the standard deviations of both being 1/sqrt(12) of that.
//
// The mean of a cubic over a side s is that of its values at +-s/sqrt(12) (Gauss's rule with two points; the
// convolution is cubic between texels). A level holds means over its texels, spread 1, already: what is left of s is
// sqrt(s^2 - 1). Texels of a level are at most a third as wide as the whole footprint, so that its shape is that of the
// square of the page and not of the texels: against 256 samples a pixel, white noise is met to 35 dB everywhere, at
// limb, poles and antipodes; with a half it would be 33 dB.
#include "raster/sample.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "arithmetic/arc_tangent.hpp"

namespace stereodel::raster {

using arithmetic::PI;

namespace {

constexpr int TAPS = 5;                        // texels that two cubics less than one texel apart reach
constexpr double LARGEST = 1.33;               // side of a grain in texels, along the way that it is cut
constexpr int MOST_GRAINS = 16;                // along a side
constexpr double GAUSS = 0.28867513459481287;  // 1/sqrt(12)

double length_of(double a, double b) { return std::sqrt(a * a + b * b); }

// Of numbers that fit into an int.
int floor_of(double value) {
    const int cut = static_cast<int>(value);
    return value < cut ? cut - 1 : cut;
}

// The first column and row of a square of texels, and the weights of its columns and rows.
struct Taps {
    int column, row;
    float across[TAPS], down[TAPS];
};

// Of the means over `u_side` and `v_side` < 1.73 texels about a place, texel k being centred at k + 1/2. The four
// places at which cubics are evaluated (left, right, above, below) go through all steps together, as vector
// instructions do.
Taps taps(double u, double v, double u_side, double v_side) {
    const int column = floor_of(u - 0.5), row = floor_of(v - 0.5);
    const float x = static_cast<float>(u - 0.5 - column), y = static_cast<float>(v - 0.5 - row);
    const float a = static_cast<float>(GAUSS * u_side), b = static_cast<float>(GAUSS * v_side);
    const float places[4] = {x - a, x + a, y - b, y + b};
    float begin[4], w[4][4];
    for (int k = 0; k < 4; ++k) {
        // The places lie between -1/2 and 3/2.
        begin[k] = (places[k] < 0.0F ? -1.0F : 0.0F) + (places[k] >= 1.0F ? 1.0F : 0.0F);
        const float t = places[k] - begin[k], t2 = t * t, t3 = t2 * t;
        w[0][k] = 0.25F * (2.0F * t2 - t - t3);
        w[1][k] = 0.25F * (2.0F - 5.0F * t2 + 3.0F * t3);
        w[2][k] = 0.25F * (t + 4.0F * t2 - 3.0F * t3);
        w[3][k] = 0.25F * (t3 - t2);
    }
    // The second cubic, one texel later or not: a choice by arithmetic, which needs no memory.
    const float right = begin[1] - begin[0], below = begin[3] - begin[2];
    Taps found{column + static_cast<int>(begin[0]) - 1, row + static_cast<int>(begin[2]) - 1, {}, {}};
    for (int k = 0; k < TAPS; ++k) {
        const float left = k < 4 ? w[k][0] + (1.0F - right) * w[k][1] : 0.0F;
        const float above = k < 4 ? w[k][2] + (1.0F - below) * w[k][3] : 0.0F;
        found.across[k] = left + (k > 0 ? right * w[k - 1][1] : 0.0F);
        found.down[k] = above + (k > 0 ? below * w[k - 1][3] : 0.0F);
    }
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
    for (; level + 1 < count && side >= 6.0; side *= 0.5) ++level;
    return level;
}

// Into how many grains a side (x, y) is cut; most are not, and need no root.
int grains_along(double x, double y) {
    const double square = x * x + y * y;
    if (square < LARGEST * LARGEST) return 1;
    return static_cast<int>(std::min(std::sqrt(square) / LARGEST, MOST_GRAINS - 1.0)) + 1;
}

// No side of a footprint is longer than the raster; what is no number, opposite a lens beyond all reason, is that long.
double bounded(double side, double longest) { return side < longest ? (side > -longest ? side : -longest) : longest; }

// What is left of a side beside the spread of means. Five texels reach as far as 1.73; a grain may be longer only along
// the rows of a raster whose texels are very narrow, or where a side would need more grains than there may be.
double rest_of(double side, bool is_mean) {
    const double rest = is_mean ? std::sqrt(std::max(0.0, side * side - 1.0)) : side;
    return std::min(rest, 1.7);
}

}  // namespace

RasterSampler::RasterSampler(const RasterShape& shape, const std::uint8_t* raster, const std::uint8_t* levels,
                             const RasterEdges& edges, std::vector<double> shifts)
    : columns_(shape.columns()),
      rows_(shape.rows()),
      width_(shape.width(0)),
      height_(shape.height(0)),
      shifts_(std::move(shifts)),
      north_(edges.north),
      columns_per_radian_(width_ / (edges.east - edges.west)),
      rows_per_radian_(height_ / (edges.north - edges.south)) {
    const double middle = 0.5 * (edges.west + edges.east);
    middle_ = middle - 2.0 * PI * std::floor(middle / (2.0 * PI) + 0.5);
    constexpr double ROUNDED = 1e-9;  // radians: edges come from degrees
    around_ = edges.east - edges.west > 2.0 * PI - ROUNDED;
    north_pole_ = around_ && edges.north > 0.5 * PI - ROUNDED;
    south_pole_ = around_ && edges.south < -0.5 * PI + ROUNDED;
    for (int i = 0; i < columns_; ++i) across_.push_back(shape.width(i) / width_);
    for (int j = 0; j < rows_; ++j) {
        down_.push_back(shape.height(j) / height_);
        for (int i = 0; i < columns_; ++i) {
            const std::uint8_t* texels = i == 0 && j == 0 ? raster : levels + (shape.has(i, j) ? shape.place(i, j) : 0);
            levels_.push_back({texels, shape.width(i), shape.height(j)});
        }
    }
}

RasterSampler::Footprint RasterSampler::footprint(const Traced& traced) const {
    double east = traced.lon - middle_;  // between -2 pi and 2 pi
    east = east > PI ? east - 2.0 * PI : (east < -PI ? east + 2.0 * PI : east);
    return {0.5 * width_ + east * columns_per_radian_,
            (north_ - row_latitude(traced.lat)) * rows_per_radian_,
            bounded(traced.lon_x * columns_per_radian_, width_),
            bounded(traced.lon_y * columns_per_radian_, width_),
            bounded(-traced.lat_x * rows_per_radian_, height_),
            bounded(-traced.lat_y * rows_per_radian_, height_)};
}

// Between two entries a shift runs straight.
double RasterSampler::row_latitude(double lat) const {
    if (shifts_.empty()) return lat;
    const int last = static_cast<int>(shifts_.size()) - 1;
    const double place = (lat + 0.5 * PI) * (last / PI);
    const int k = std::min(std::max(static_cast<int>(place), 0), last - 1);
    const double part = place - k, *shift = shifts_.data() + k;
    return lat + (1.0 - part) * shift[0] + part * shift[1];
}

void RasterSampler::add(const Traced& traced, ColorSum& sum) const {
    const Footprint whole = footprint(traced);
    const double u_side = length_of(whole.u_x, whole.u_y), v_side = length_of(whole.v_x, whole.v_y);
    const int i = level_of(u_side, columns_), j = std::min(level_of(v_side, rows_), i == columns_ - 1 ? rows_ - 1 : i);
    const double across = across_[static_cast<std::size_t>(i)], down = down_[static_cast<std::size_t>(j)];
    const int m = grains_along(whole.u_x * across, whole.v_x * down);
    const int n = grains_along(whole.u_y * across, whole.v_y * down);
    Grain grain{&level(i, j), across, down, u_side, v_side, 0.0, 0.0, 1.0F};
    if (m * n > 1) {
        grain.u_side = length_of(whole.u_x / m, whole.u_y / n);
        grain.v_side = length_of(whole.v_x / m, whole.v_y / n);
        grain.weight = 1.0F / static_cast<float>(m * n);
    }
    grain.u_rest = rest_of(grain.u_side * across, i > 0);
    grain.v_rest = rest_of(grain.v_side * down, j > 0);
    if (m * n == 1) return add_grain(whole, grain, 0.0, 0.0, sum);
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
    const Taps found = taps(u * grain.across, v * grain.down, grain.u_rest, grain.v_rest);
    std::uint8_t copies[4 * TAPS * TAPS];
    const std::uint8_t* lines[TAPS];
    find_lines(level, found.column, found.row, lines, copies);
    // Loops of fixed lengths, sixteen bytes and four: compilers make vector instructions of them.
    float first[16] = {}, last[4] = {};
    for (int r = 0; r < TAPS; ++r) {
        const float height = weight * found.down[r];
        for (int k = 0; k < 16; ++k) first[k] += height * static_cast<float>(lines[r][k]);
        for (int k = 0; k < 4; ++k) last[k] += height * static_cast<float>(lines[r][16 + k]);
    }
    const float* across = found.across;
    for (int b = 0; b < 4; ++b) {
        sum.channels[b] += across[0] * first[b] + across[1] * first[4 + b] + across[2] * first[8 + b] +
                           across[3] * first[12 + b] + across[4] * last[b];
    }
}

// Where five texels of each of five rows begin: in the level, or copied where they lie beyond an edge.
void RasterSampler::find_lines(const RasterLevel& level, int column, int row, const std::uint8_t** lines,
                               std::uint8_t* copies) const {
    const bool inside = column >= 0 && column + TAPS <= level.width && row >= 0 && row + TAPS <= level.height;
    const std::size_t width = 4 * static_cast<std::size_t>(level.width);
    for (int r = 0; r < TAPS; ++r) {
        if (inside) {
            lines[r] = level.texels + static_cast<std::size_t>(row + r) * width + 4 * static_cast<std::size_t>(column);
            continue;
        }
        lines[r] = copies + 4 * TAPS * r;
        for (int c = 0; c < TAPS; ++c) std::memcpy(copies + 4 * (TAPS * r + c), texel(level, column + c, row + r), 4);
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

}  // namespace stereodel::raster
