// Sorting by 32-bit keys: one pass over the highest bits that all threads share, then each bucket alone, in its cache.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "order/curve_keys.hpp"
#include "threads.hpp"

namespace stereodel::order {

// Sort `items[0, size)` by key, equal keys in their old order, by passes over `digits` bits from bit `low` of the key
// on. `spare` is as large. The result may end in either array: returns which.
class LeastDigitFirst {
  public:
    static constexpr int digit_bits = 8;
    static constexpr std::size_t values = std::size_t{1} << digit_bits;

    static KeyedPoint* sort(KeyedPoint* items, KeyedPoint* spare, std::size_t size, int bits) {
        for (int low = 0; low < bits; low += digit_bits) {
            std::array<std::uint32_t, values> place{};
            const auto digit = [low](KeyedPoint item) { return (item.key() >> low) % values; };
            for (std::size_t k = 0; k < size; ++k) {
                ++place[digit(items[k])];
            }
            std::uint32_t sum = 0;
            for (std::uint32_t& p : place) {
                sum += std::exchange(p, sum);
            }
            for (std::size_t k = 0; k < size; ++k) {
                spare[place[digit(items[k])]++] = items[k];
            }
            std::swap(items, spare);
        }
        return items;
    }
};

// Sort items[0, size) by key; points of one key stay in the order of their numbers if they come in it. `spare` is as
// large.
inline void sort_by_key(KeyedPoint* items, KeyedPoint* spare, std::size_t size, Crew& crew) {
    constexpr int top = 24;  // the first pass takes the bits from here on
    constexpr std::size_t buckets = std::size_t{1} << (32 - top);
    constexpr std::size_t few = 128;  // fewer are sorted faster by comparison
    if (size < few) {
        std::sort(items, items + size);
        return;
    }
    const std::size_t pieces = crew.size();
    std::vector<std::array<std::uint32_t, buckets>> places(pieces);
    crew.run(pieces, [&](std::size_t k) {
        std::array<std::uint32_t, buckets> counts{};
        const Piece piece(size, k, pieces);
        for (std::size_t i = piece.begin; i < piece.end; ++i) {
            ++counts[items[i].key() >> top];
        }
        places[k] = counts;
    });
    std::array<std::uint32_t, buckets + 1> begins{};
    std::uint32_t sum = 0;
    for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
        begins[bucket] = sum;
        for (auto& place : places) {
            sum += std::exchange(place[bucket], sum);
        }
    }
    begins[buckets] = sum;
    crew.run(pieces, [&](std::size_t k) {
        std::array<std::uint32_t, buckets> place = places[k];
        const Piece piece(size, k, pieces);
        for (std::size_t i = piece.begin; i < piece.end; ++i) {
            spare[place[items[i].key() >> top]++] = items[i];
        }
    });
    crew.run(buckets, [&](std::size_t bucket) {
        const std::size_t begin = begins[bucket], end = begins[bucket + 1];
        KeyedPoint* const source = spare + begin;
        if (end - begin < few) {
            std::sort(source, source + (end - begin));
            std::copy(source, source + (end - begin), items + begin);
        } else {
            LeastDigitFirst::sort(source, items + begin, end - begin, top);  // three passes end in `items`
        }
    });
}

}  // namespace stereodel::order
