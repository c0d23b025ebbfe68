// Means of neighbouring texels. Weights are floats that sum to 1 within 2^-22, texels below 2^8: a mean is off by less
// than 2^-12 levels before it is rounded, to even where it is half way, so that means of means do not drift upwards.
#include "raster/levels.hpp"

#include <algorithm>

#include "coordinates/degrees.hpp"

namespace stereodel::raster {

using coordinates::RADIAN;
using coordinates::sin_cos_degrees;

namespace {

constexpr int CHANNELS = 4;

int half(int size) { return (size + 1) / 2; }

std::vector<int> halves(int size) {
    std::vector<int> sizes{size};
    while (sizes.back() > 1) sizes.push_back(half(sizes.back()));
    return sizes;
}

// A new texel and the three old ones that it may overlap; those beyond the edge weigh nothing.
struct Mean {
    int first;
    float weights[3];
};

// `measure(a)` is what lies before the place a, from 0 to 1 along the old texels.
template <class Measure>
std::vector<Mean> means(int old_size, int new_size, Measure&& measure) {
    std::vector<Mean> all(static_cast<std::size_t>(new_size));
    for (int k = 0; k < new_size; ++k) {
        const double begin = double(k) / new_size, end = double(k + 1) / new_size;
        const int first = std::min(static_cast<int>(std::int64_t(k) * old_size / new_size), std::max(old_size - 3, 0));
        Mean mean{first, {0.0F, 0.0F, 0.0F}};
        const double whole = measure(end) - measure(begin);
        for (int m = 0; m < 3 && first + m < old_size; ++m) {
            const double from = std::max(begin, double(first + m) / old_size);
            const double to = std::min(end, double(first + m + 1) / old_size);
            mean.weights[m] = to > from ? static_cast<float>((measure(to) - measure(from)) / whole) : 0.0F;
        }
        all[static_cast<std::size_t>(k)] = mean;
    }
    return all;
}

std::uint8_t rounded(float value) {
    constexpr float ROUNDER = 0x1.8p23F;  // adding and subtracting it rounds to the nearest integer, ties to even
    return static_cast<std::uint8_t>((value + ROUNDER) - ROUNDER);
}

void mean_of_rows(const std::uint8_t* const rows[3], const float* weights, std::size_t bytes, std::uint8_t* out) {
    const std::uint8_t *a = rows[0], *b = rows[1], *c = rows[2];
    const float u = weights[0], v = weights[1], w = weights[2];
    for (std::size_t k = 0; k < bytes; ++k) out[k] = rounded(u * float(a[k]) + v * float(b[k]) + w * float(c[k]));
}

void mean_of_pairs(const std::uint8_t* row, int count, std::uint8_t* out) {
    for (int k = 0; k < count; ++k) {
        for (int c = 0; c < CHANNELS; ++c) {
            const int sum = row[8 * k + c] + row[8 * k + 4 + c];
            out[4 * k + c] = static_cast<std::uint8_t>((sum + ((sum >> 1) & 1)) >> 1);
        }
    }
}

void mean_of_columns(const std::uint8_t* row, int width, const std::vector<Mean>& means, std::uint8_t* out) {
    for (std::size_t k = 0; k < means.size(); ++k) {
        const Mean& mean = means[k];
        float sum[CHANNELS] = {0.0F, 0.0F, 0.0F, 0.0F};
        for (int m = 0; m < 3; ++m) {
            const std::uint8_t* texel = row + CHANNELS * std::min(mean.first + m, width - 1);
            for (int c = 0; c < CHANNELS; ++c) sum[c] += mean.weights[m] * float(texel[c]);
        }
        for (int c = 0; c < CHANNELS; ++c) out[CHANNELS * k + static_cast<std::size_t>(c)] = rounded(sum[c]);
    }
}

std::size_t row_bytes(int width) { return std::size_t{CHANNELS} * static_cast<std::size_t>(width); }

void narrow(const RasterLevel& from, int width, std::uint8_t* out, Crew& crew, Stop stop) {
    const bool even = from.width == 2 * width;
    const std::vector<Mean> columns = even ? std::vector<Mean>{} : means(from.width, width, [](double a) { return a; });
    const std::size_t bytes = row_bytes(from.width), new_bytes = row_bytes(width);
    in_grains(static_cast<std::size_t>(from.height), 16, crew, [&](std::size_t begin, std::size_t end) {
        check(stop);
        for (std::size_t k = begin; k < end; ++k) {
            if (even) {
                mean_of_pairs(from.texels + k * bytes, width, out + k * new_bytes);
            } else {
                mean_of_columns(from.texels + k * bytes, from.width, columns, out + k * new_bytes);
            }
        }
    });
}

void lower(const RasterLevel& from, const std::vector<Mean>& rows, std::uint8_t* out, Crew& crew, Stop stop) {
    const std::size_t bytes = row_bytes(from.width);
    in_grains(rows.size(), 16, crew, [&](std::size_t begin, std::size_t end) {
        check(stop);
        for (std::size_t k = begin; k < end; ++k) {
            const std::uint8_t* three[3];
            for (int m = 0; m < 3; ++m) {
                const int row = std::min(rows[k].first + m, from.height - 1);
                three[m] = from.texels + static_cast<std::size_t>(row) * bytes;
            }
            mean_of_rows(three, rows[k].weights, bytes, out + k * bytes);
        }
    });
}

}  // namespace

RasterShape::RasterShape(int width, int height)
    : widths_(halves(width)), heights_(halves(height)), places_(widths_.size() * heights_.size()) {
    for (int j = 0; j < rows(); ++j) {
        for (int i = 0; i < columns(); ++i) {
            if (!has(i, j) || (i == 0 && j == 0)) continue;
            places_[index(i, j)] = size_;
            size_ += row_bytes(this->width(i)) * static_cast<std::size_t>(this->height(j));
        }
    }
}

void make_raster_levels(const std::uint8_t* raster, const RasterShape& shape, double north, double south,
                        std::uint8_t* levels, Crew& crew, Stop stop) {
    const auto level = [&](int i, int j) {
        return RasterLevel{i == 0 && j == 0 ? raster : levels + shape.place(i, j), shape.width(i), shape.height(j)};
    };
    // Not the platform's sine: the same weights on every machine.
    const auto sine = [](double angle) { return sin_cos_degrees(angle / RADIAN.hi).sine.hi; };
    const auto area = [&](double a) { return sine(north) - sine(north + a * (south - north)); };
    for (int j = 0; j < shape.rows(); ++j) {
        const int begin = std::min(j, shape.columns() - 1);
        if (j > 0) {
            const std::vector<Mean> rows = means(shape.height(j - 1), shape.height(j), area);
            lower(level(begin, j - 1), rows, levels + shape.place(begin, j), crew, stop);
        }
        for (int i = begin + 1; i < shape.columns(); ++i) {
            narrow(level(i - 1, j), shape.width(i), levels + shape.place(i, j), crew, stop);
        }
    }
}

}  // namespace stereodel::raster
