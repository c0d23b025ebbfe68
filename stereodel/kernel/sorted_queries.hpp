// Queries in the order of a curve, in pieces for several threads; where the walks begin.
#pragma once

#include <algorithm>
#include <cstddef>

#include "curve_order.hpp"
#include "landmarks.hpp"
#include "queries.hpp"

namespace stereodel {

// Landmarks among the triangles that may be entered; at least one, if there is any such triangle.
template <class Chart>
class Starts {
  public:
    explicit Starts(const TriangleArrays& triangles)
        : landmarks_(triangles.count(), [&](Index t) {
              const std::size_t v = static_cast<std::size_t>(*triangles.corners(t));
              return triangles.may_enter(t) ? triangles.points() + Chart::dimension * v : nullptr;
          }) {
        while (first_ < static_cast<Index>(triangles.count()) && !triangles.may_enter(first_)) {
            ++first_;
        }
        none_ = first_ == static_cast<Index>(triangles.count());
    }

    bool none() const { return none_; }
    std::size_t size() const { return landmarks_.size(); }

    Index nearest(const double* query) const {
        const Index best = landmarks_.nearest(query);
        return best >= 0 ? best : first_;
    }

  private:
    Landmarks<Chart> landmarks_;
    Index first_ = 0;
    bool none_ = false;
};

// Calls answer(query, number, start) for all queries, where `start` is the triangle to begin at and becomes the one where
// the next walk may begin. `begin_piece()` returns `answer` for the use of one thread.
template <class Chart, class BeginPiece>
void for_sorted_queries(const Starts<Chart>& starts, const double* queries, std::size_t count, int workers, Stop stop,
                        BeginPiece&& begin_piece) {
    constexpr std::size_t grain = std::size_t{1} << 12;
    Buffer<KeyedPoint> items(count);
    for (std::size_t k = 0; k < count; ++k) {
        items[k] = {0, static_cast<std::uint32_t>(k)};
    }
    // So few queries lie farther from each other than from a landmark, each.
    const bool few = count <= starts.size();
    if (!few) {
        CurveOrder<Chart>(queries, workers, stop).sort(items);
    }
    parallel_for((count + grain - 1) / grain, workers, [&](std::size_t piece) {
        check(stop);
        auto answer = begin_piece();
        const std::size_t begin = piece * grain, end = std::min(count, begin + grain);
        Index start = -1;
        for (std::size_t k = begin; k < end; ++k) {
            const std::size_t number = items[k].point();
            const double* const query = queries + Chart::dimension * number;
            if (few || k == begin) {
                start = starts.nearest(query);
            }
            answer(query, number, start);
        }
    });
}

}  // namespace stereodel
