// Keys of cells along the Z-shaped curve of G. M. Morton (1966).
#pragma once

#include <cstdint>

namespace stereodel::order {

constexpr int cell_bits = 16;
constexpr std::uint32_t cells = std::uint32_t{1} << cell_bits;  // along each axis

// The lower 16 bits, a zero before each.
inline std::uint32_t spread(std::uint32_t bits) {
    bits = (bits | bits << 8) & 0x00FF00FFu;
    bits = (bits | bits << 4) & 0x0F0F0F0Fu;
    bits = (bits | bits << 2) & 0x33333333u;
    return (bits | bits << 1) & 0x55555555u;
}

// The bits of column and row in turns, the column's first: the first cut is across x.
inline std::uint32_t curve_key(std::uint32_t column, std::uint32_t row) { return spread(column) << 1 | spread(row); }

// What is sorted: a key above the number of a point.
struct KeyedPoint {
    std::uint64_t bits;

    KeyedPoint() = default;
    KeyedPoint(std::uint32_t key, std::uint32_t point) : bits(std::uint64_t{key} << 32 | point) {}
    std::uint32_t key() const { return static_cast<std::uint32_t>(bits >> 32); }
    std::uint32_t point() const { return static_cast<std::uint32_t>(bits); }
    bool operator<(KeyedPoint other) const { return bits < other.bits; }
};

}  // namespace stereodel::order
