// The folder `order`: points along a curve, so that what is near in place is near in memory and in time.
// Reading order: curve_keys, square_grid, charts (where in the grid a point lies), radix_sort, curve_order, landmarks,
// itinerary (a walk over queries); flat_order, points of one line or great circle in their exact order.
//
// Points in the order of a space-filling curve, so that a walk from one to the next is short; clusters have curves of
// their own, however tight they are.
//
// For insertion in rounds: N. Amenta, S. Choi, G. Rote, "Incremental constructions con BRIO", Symposium on
// Computational Geometry (2003). Each point is in the last round with probability 7/8, otherwise in the one before with
// 7/8, and so on. What is drawn depends on the point alone: of equal points the one of lowest number always comes
// first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "memory.hpp"
#include "order/charts.hpp"
#include "order/radix_sort.hpp"
#include "order/square_grid.hpp"
#include "tally.hpp"
#include "threads.hpp"

namespace stereodel::order {

template <class Chart, class At>
class CurveOrder {
  public:
    // `at(k)`: point number k.
    CurveOrder(At at, Crew& crew, Stop stop) : at_(at), crew_(crew), stop_(stop) {}

    // Sort items, whose keys are anything, along the curve; equal points by number if they come in that order.
    void sort(Buffer<KeyedPoint>& items) {
        const std::size_t size = items.size();
        if (size < 2) {
            return;
        }
        if constexpr (Chart::dimension == 2) {
            SquareGrid grid;
            const Chart chart(at(items[0]));
            if (!fit(grid, chart, items.data(), size)) {
                return;
            }
            give_keys(items, [&](const double* p) { return grid.key(chart(p)); });
        } else {
            give_keys(items, [](const double* p) { return Chart::key(p); });
        }
        Buffer<KeyedPoint> spare(size);
        sort_by_key(items.data(), spare.data(), size, crew_);
        refine(items.data(), spare.data(), size);
    }

  private:
    static constexpr std::size_t few = 8;  // so many in one cell stay as they are

    const double* at(KeyedPoint item) const { return at_(item.point()); }

    template <class KeyOf>
    void give_keys(Buffer<KeyedPoint>& items, KeyOf&& key) {
        for_all(items.size(), crew_, stop_, [&](std::size_t k) {
            items[k] = {key(at(items[k])), items[k].point()};
        });
    }

    bool fit(SquareGrid& grid, const Chart& chart, const KeyedPoint* items, std::size_t size) const {
        for (std::size_t k = 0; k < size; ++k) {
            grid.include(chart(at(items[k])));
        }
        return grid.fit();
    }

    // Runs of equal keys get a grid of their own. Each level has cells 2^16 times smaller, so few levels exhaust
    // doubles.
    void refine(KeyedPoint* items, KeyedPoint* spare, std::size_t size) {
        for (std::size_t begin = 0, end = 0; begin < size; begin = end) {
            for (end = begin + 1; end < size && items[end].key() == items[begin].key(); ++end) {
            }
            if (end - begin > few) {
                check(stop_);
                refine_run(items + begin, spare, end - begin);
            }
        }
    }

    void refine_run(KeyedPoint* items, KeyedPoint* spare, std::size_t size) {
        const Chart chart(at(items[0]));
        SquareGrid grid;
        if (!fit(grid, chart, items, size)) {
            return;
        }
        for (std::size_t k = 0; k < size; ++k) {
            items[k] = {grid.key(chart(at(items[k]))), items[k].point()};
        }
        sort_by_key(items, spare, size, alone_);
        refine(items, spare, size);
    }

    At at_;
    Crew& crew_;
    Crew alone_{1};
    Stop stop_;
};

// A number that depends on a point alone, as good as random (the finaliser of G. Steele, D. Lea, C. Flood, "Fast
// splittable pseudorandom number generators", 2014).
template <class Chart>
std::uint64_t scrambled(const double* p) {
    const Chart chart(p);
    const Point2 place = chart(p);
    std::uint64_t bits[2];
    std::memcpy(bits, &place, sizeof bits);
    std::uint64_t z = bits[0] * 0x9E3779B97F4A7C15u + bits[1] + chart.face;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

// The points `numbers`, ascending, in rounds. `points`: all of them.
template <class Chart>
std::vector<std::vector<Index>> insertion_rounds(const double* points, const std::vector<Index>& numbers) {
    constexpr std::size_t one_round = 32;  // so few need no others
    std::size_t rounds = 1;
    for (std::size_t size = numbers.size(); size > one_round; size /= 8) {
        ++rounds;
    }
    std::vector<std::vector<Index>> members(rounds);
    for (const Index p : numbers) {
        std::size_t round = rounds - 1;
        if (round > 0) {
            std::uint64_t drawn = scrambled<Chart>(points + Chart::dimension * static_cast<std::size_t>(p));
            for (; round > 0 && drawn % 8 == 0; drawn /= 8) {
                --round;
            }
        }
        members[round].push_back(p);
    }
    return members;
}

}  // namespace stereodel::order
