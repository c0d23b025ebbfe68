// The circle that many points were found to lie on, so that they are not proved to lie there again and again: sets of
// thousands of exactly cocircular points ask about little else.
//
// One circle is remembered, by three of its points, and which points, by number, were found on it. Three different
// points have one circle (or line): four points of which three are known are all on it. It is for points that keep
// their numbers and coordinates while this lives.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "tally.hpp"

namespace stereodel::predicates {

class CircleMemo {
  public:
    CircleMemo() = default;
    CircleMemo(const CircleMemo&) {}  // a copy begins with nothing: copying views stays cheap
    CircleMemo& operator=(const CircleMemo&) = delete;
    ~CircleMemo() = default;

    // Whether four points are known to lie on one circle; false says nothing.
    bool knows(Index a, Index b, Index c, Index d) {
        const bool known = places_ && holds(a) && holds(b) && holds(c) && holds(d);
        balance_ += known;
        return known;
    }

    // Four different points were found to lie on one circle. `cocircular(a, b, c, d)` is the exact test of any four.
    template <class Cocircular>
    void learn(Index a, Index b, Index c, Index d, Cocircular&& cocircular) {
        if (balance_ < 0) {
            return;
        }
        const std::array<Index, 4> points = {a, b, c, d};
        if (!places_ || !is_the_one(points, cocircular)) {
            begin(points);
        }
        for (const Index p : points) {
            add(p);
        }
    }

  private:
    // 64 points and the circle that this was noted for; another block at its place is forgotten.
    struct Place {
        std::uint64_t owner = 0;  // circle and block; 0: nothing is noted here
        std::uint64_t points = 0;
    };
    static constexpr std::size_t SIZE = 16384;
    static constexpr std::int64_t CREDIT = 256, PRICE = 8;  // of a change of circle, in tests that were spared

    static std::uint32_t block(Index p) { return static_cast<std::uint32_t>(p) / 64; }
    static std::uint64_t bit(Index p) { return std::uint64_t{1} << (static_cast<std::uint32_t>(p) % 64); }
    std::uint64_t owner(Index p) const { return circle_ << 32 | block(p); }
    Place& place(Index p) const { return (*places_)[block(p) % SIZE]; }

    bool holds(Index p) const {
        const Place& found = place(p);
        return found.owner == owner(p) && (found.points & bit(p)) != 0;
    }

    void add(Index p) {
        Place& found = place(p);
        if (found.owner != owner(p)) {
            found = {owner(p), 0};
        }
        found.points |= bit(p);
    }

    // Whether the points lie on the remembered circle: three of them do.
    template <class Cocircular>
    bool is_the_one(const std::array<Index, 4>& points, Cocircular&& cocircular) const {
        int on_it = 0;
        for (const Index p : points) {
            on_it += holds(p);
        }
        for (const Index p : points) {
            if (on_it >= 3) {
                return true;
            }
            if (!holds(p)) {
                if (!cocircular(leaders_[0], leaders_[1], leaders_[2], p)) {
                    return false;
                }
                ++on_it;
            }
        }
        return true;
    }

    // Another circle. Sets in which every few points have their own give up soon: then nothing is noted any more.
    void begin(const std::array<Index, 4>& points) {
        if (!places_) {
            places_ = std::make_unique<std::array<Place, SIZE>>();
        }
        balance_ -= PRICE;
        ++circle_;
        leaders_ = {points[0], points[1], points[2]};
    }

    std::unique_ptr<std::array<Place, SIZE>> places_;
    std::array<Index, 3> leaders_{};
    std::uint64_t circle_ = 0;  // the first is 1; below 2^32: each but a few is paid for by tests that are spared
    std::int64_t balance_ = CREDIT;
};

}  // namespace stereodel::predicates
