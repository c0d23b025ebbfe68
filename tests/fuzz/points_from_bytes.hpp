// Bytes to points: the first byte chooses plane or sphere, how numbers are written, and the pole of the projection.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "engine/projection.hpp"

namespace fuzz {

struct Points {
    bool on_sphere = false;
    stereodel::engine::Pole pole{0, 1};
    std::size_t count = 0;
    std::vector<double> coordinates;  // two or three a point; finite, no zero vector on the sphere
};

// Reads one number after the other, in one of four ways.
class Numbers {
  public:
    Numbers(const std::uint8_t* data, std::size_t size, unsigned way) : data_(data), end_(data + size), way_(way) {}

    bool more() const { return static_cast<std::size_t>(end_ - data_) >= bytes_each(); }

    double next() {
        const std::uint8_t* at = data_;
        data_ += bytes_each();
        switch (way_) {
            case 0: return any_double(at);
            case 1: return small_integer(at[0]);
            case 2: return std::ldexp(small_integer(at[0]), 4 * static_cast<std::int8_t>(at[1]));
            default: return awkward(at[0]);
        }
    }

  private:
    std::size_t bytes_each() const { return way_ == 0 ? 8 : way_ == 2 ? 2 : 1; }

    static double small_integer(std::uint8_t byte) { return static_cast<std::int8_t>(byte); }

    static double any_double(const std::uint8_t* at) {
        double value = 0;
        std::memcpy(&value, at, sizeof value);
        return std::isfinite(value) ? value : 1.0;
    }

    static double awkward(std::uint8_t byte) {
        static const double values[] = {
            0.0,   1.0,      3.0,         4.0,         5.0,     12.0,  13.0,           45.0,
            0.1,   0.2,      0.3,         0.6,         0.8,     1. / 3, std::sqrt(0.5), std::sqrt(3.0) / 2,
            1e-8,  1 - 1e-9, 1 + 0x1p-52, 1 - 0x1p-53, 0x1p500, 1e-16, 1.7e308,        2e-308,
            0x1p-540, 5e-324,
        };
        constexpr std::size_t count = sizeof values / sizeof *values;
        const double value = values[(byte >> 1) % count];
        return (byte & 1) != 0 ? -value : value;
    }

    const std::uint8_t* data_;
    const std::uint8_t* end_;
    unsigned way_;
};

inline Points points_from_bytes(const std::uint8_t* data, std::size_t size) {
    Points points;
    if (size == 0) {
        return points;
    }
    points.on_sphere = (data[0] & 1) != 0;
    points.pole = {(data[0] >> 3) % 3, (data[0] & 128) != 0 ? -1 : 1};
    const std::size_t width = points.on_sphere ? 3 : 2;
    Numbers numbers(data + 1, size - 1, (data[0] >> 1) & 3u);
    while (numbers.more()) {
        points.coordinates.push_back(numbers.next());
    }
    points.count = points.coordinates.size() / width;
    points.coordinates.resize(points.count * width);
    for (std::size_t k = 0; points.on_sphere && k < points.count; ++k) {
        double* vector = points.coordinates.data() + 3 * k;
        if (vector[0] == 0 && vector[1] == 0 && vector[2] == 0) {
            vector[2] = 1;
        }
    }
    return points;
}

}  // namespace fuzz
