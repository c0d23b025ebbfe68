// Many queries to a triangulation as plain arrays, in pieces for several threads.
#pragma once

#include <cstddef>

#include "order/itinerary.hpp"
#include "queries/queries.hpp"

namespace stereodel::queries {

using order::Itinerary;

// The lowest triangle that may be entered, or the number of triangles.
inline Index first_open(const TriangleArrays& triangles) {
    Index t = 0;
    while (t < static_cast<Index>(triangles.count()) && !triangles.may_enter(t)) {
        ++t;
    }
    return t;
}

// Calls answer(k, query, near) for all queries; a walk may begin at triangle `near`, which becomes the one where the
// next may begin. `begin_piece()` returns `answer` for the use of one thread. `start` may be entered.
template <class Chart, class BeginPiece>
void for_queries(const TriangleArrays& triangles, Index start, const double* queries, std::size_t count, int workers,
                 Stop stop, BeginPiece&& begin_piece) {
    constexpr std::size_t grain = std::size_t{1} << 12;
    const auto at = [queries](std::size_t k) { return queries + Chart::dimension * k; };
    const auto point_of = [&](Index t) {
        const std::size_t v = static_cast<std::size_t>(*triangles.corners(t));
        return triangles.may_enter(t) ? triangles.points() + Chart::dimension * v : nullptr;
    };
    Crew crew(useful_workers(workers, count, grain));
    const Itinerary<Chart, decltype(at)> way(count, at, triangles.count(), point_of, start, crew, stop);
    in_grains(way.size(), grain, crew, [&](std::size_t begin, std::size_t end) {
        auto answer = begin_piece();
        way.travel(begin, end, [&](std::size_t k, Index& near) {
            check(stop);
            answer(k, at(k), near);
        });
    });
}

}  // namespace stereodel::queries
