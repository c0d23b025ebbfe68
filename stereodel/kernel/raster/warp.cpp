// Each pixel by itself, so that neither threads nor windows change it. Where the map bends within a pixel (at the limb,
// next to a pole, opposite a strong lens) the pixel is cut into small ones, each traced through view and lens.
#include "raster/warp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stereodel::raster {

namespace {

constexpr std::size_t BLOCK = 64;  // points traced at once
constexpr double STRAIGHT = 0.2;   // bend up to which a pixel's image is taken for a parallelogram
constexpr int COARSE = 4, FINE = 8;  // cuts of a pixel each way, up to four times that bend and beyond

// The part of a unit square in the half plane whose edge lies at `distance` inside the square's centre, the edge's
// normal being (a, b) with |(a, b)| = 1: the integral of a trapezoid of width a + b and of height 1/max(a, b).
double half_plane_share(double distance, double a, double b) {
    const double wide = std::max(std::abs(a), std::abs(b)), narrow = std::min(std::abs(a), std::abs(b));
    const double side = std::abs(distance), flat = 0.5 * (wide - narrow), end = 0.5 * (wide + narrow);
    double half = 0.5;
    if (side < flat) {
        half = side / wide;
    } else if (side < end) {
        half = 0.5 - 0.5 * (end - side) * (end - side) / (wide * narrow);
    }
    return distance < 0.0 ? 0.5 - half : 0.5 + half;
}

class Painter {
  public:
    Painter(const RasterSampler& raster, const PageMap& map, const PageWindow& window, bool covered)
        : raster_(raster), map_(map), window_(window), covered_(covered && map.is_disc()) {}

    void row(int number, std::uint8_t* pixels) const {
        const double y = window_.top - (number + 0.5) * window_.step.up;
        int begin = 0, end = window_.width;
        std::fill(pixels, pixels + 4 * std::size_t(window_.width), std::uint8_t{0});
        if (map_.is_disc()) {
            // Pixels whose centre is farther out than their half diagonal do not touch the disc; half a pixel to spare.
            const double reach = 1.0 + 1.3 * window_.step.longer(), rest = reach * reach - y * y;
            if (rest <= 0.0) return;
            const double half = std::sqrt(rest);
            begin = column_at(-half), end = std::min(window_.width, column_at(half) + 1);
        }
        for (int first = begin; first < end; first += static_cast<int>(BLOCK)) {
            block(first, std::min(end - first, static_cast<int>(BLOCK)), y, pixels);
        }
    }

  private:
    int column_at(double x) const {
        const double column = std::floor((x - window_.left) / window_.step.right);
        return static_cast<int>(std::min(std::max(column, 0.0), double(window_.width)));
    }

    void block(int first, int count, double y, std::uint8_t* pixels) const {
        Traced traced[BLOCK];
        const auto x_of = [&](int k) { return window_.left + (first + k + 0.5) * window_.step.right; };
        trace_row(map_, x_of(0), y, window_.step, static_cast<std::size_t>(count), traced);
        for (int k = 0; k < count; ++k) {
            const double x = x_of(k);
            ColorSum sum;
            if (traced[k].bend <= STRAIGHT) {
                raster_.add(traced[k], sum);
            } else {
                cut(x, y, traced[k].bend <= 4.0 * STRAIGHT ? COARSE : FINE, sum);
            }
            put(sum, covered_ ? share_in_disc(x, y) : 1.0, pixels + 4 * (first + k));
        }
    }

    // The parts of a pixel that lie in the disc; where none has its centre in it, the nearest point of the disc.
    void cut(double x, double y, int parts, ColorSum& sum) const {
        const Step step{window_.step.right / parts, window_.step.up / parts};
        const double left = x + 0.5 * (step.right - window_.step.right), low = y + 0.5 * (step.up - window_.step.up);
        Traced traced[FINE];
        for (int r = 0; r < parts; ++r) {
            trace_row(map_, left, low + r * step.up, step, static_cast<std::size_t>(parts), traced);
            for (int k = 0; k < parts; ++k) {
                if (traced[k].bend < std::numeric_limits<double>::infinity()) raster_.add(traced[k], sum);
            }
        }
        if (sum.weight == 0.0F) {
            trace_row(map_, x, y, step, 1, traced);
            raster_.add(traced[0], sum);
        }
    }

    double share_in_disc(double x, double y) const {
        const double radius = std::sqrt(x * x + y * y), distance = (1.0 - radius) / window_.step.longer();
        return distance > 1.0 ? 1.0 : half_plane_share(distance, x / radius, y / radius);
    }

    static void put(const ColorSum& sum, double share, std::uint8_t* pixel) {
        // The cubic may overshoot: colour is that of what it weighs, however much.
        const float opacity = sum.channels[3];
        if (!(opacity > 0.0F)) return;
        for (int c = 0; c < 3; ++c) pixel[c] = rounded(255.0F / opacity * sum.channels[c]);
        pixel[3] = rounded(std::min(opacity / sum.weight, 255.0F) * static_cast<float>(share));
    }

    static std::uint8_t rounded(float value) {
        return static_cast<std::uint8_t>(std::min(std::max(value, 0.0F), 255.0F) + 0.5F);
    }

    const RasterSampler& raster_;
    const PageMap& map_;
    const PageWindow& window_;
    bool covered_;
};

}  // namespace

void warp_raster(const RasterSampler& raster, const PageMap& map, const PageWindow& window, bool covered,
                 std::uint8_t* pixels, Crew& crew, Stop stop) {
    const Painter painter(raster, map, window, covered);
    const std::size_t bytes = 4 * static_cast<std::size_t>(window.width);
    in_grains(static_cast<std::size_t>(window.height), 4, crew, [&](std::size_t begin, std::size_t end) {
        check(stop);
        for (std::size_t k = begin; k < end; ++k) painter.row(static_cast<int>(k), pixels + k * bytes);
    });
}

}  // namespace stereodel::raster
