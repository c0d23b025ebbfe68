// What every triangulation must be, checked with as little of the kernel as possible: its exact predicates alone.
//
// Plane: triangles counterclockwise, each inner edge between two of them and locally Delaunay, one convex border, every
// point that is no duplicate a corner, as many triangles as Euler's formula wants. Sphere: the same without a border.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

#include "engine/plane.hpp"

namespace fuzz {

using stereodel::Index;
using stereodel::engine::Triangulation;

inline void require(bool holds, const char* what) {
    if (!holds) {
        std::fprintf(stderr, "not valid: %s\n", what);
        std::abort();
    }
}

// The triangles of a result by row.
class Rows {
  public:
    explicit Rows(const Triangulation& result) : triangles_(result.triangles) {}

    std::size_t count() const { return triangles_.count(); }
    Index corner(std::size_t row, int k) const { return triangles_.corners[3 * row + static_cast<std::size_t>(k % 3)]; }
    Index neighbor(std::size_t row, int k) const {
        return triangles_.neighbors[3 * row + static_cast<std::size_t>(k % 3)];
    }
    // The corner of a triangle that does not lie on its edge opposite corner k of `row`; -1 beyond the border.
    Index beyond(std::size_t row, int k) const {
        const Index other = neighbor(row, k);
        if (other < 0) {
            return -1;
        }
        for (int j = 0; j < 3; ++j) {
            if (neighbor(static_cast<std::size_t>(other), j) == static_cast<Index>(row) &&
                corner(static_cast<std::size_t>(other), j + 1) == corner(row, k + 2) &&
                corner(static_cast<std::size_t>(other), j + 2) == corner(row, k + 1)) {
                return corner(static_cast<std::size_t>(other), j);
            }
        }
        require(false, "neighbors do not agree");
        return -1;
    }

  private:
    const stereodel::engine::Triangles& triangles_;
};

inline void check_corners(const Rows& rows, std::size_t points, const Triangulation& result) {
    std::vector<char> used(points, 0), dropped(points, 0);
    for (std::size_t row = 0; row < rows.count(); ++row) {
        for (int k = 0; k < 3; ++k) {
            const Index a = rows.corner(row, k);
            require(a >= 0 && static_cast<std::size_t>(a) < points, "a corner is no point");
            require(a != rows.corner(row, k + 1), "a corner twice");
            require(rows.corner(row, 0) <= a, "the smallest corner is not the first");
            require(rows.neighbor(row, k) < static_cast<Index>(rows.count()), "a neighbor is no triangle");
            used[static_cast<std::size_t>(a)] = 1;
        }
    }
    for (const auto& [gone, kept] : result.duplicates) {
        require(kept < gone, "the kept one of duplicates is not the lowest");
        dropped[static_cast<std::size_t>(gone)] = 1;
    }
    for (std::size_t a = 0; a < points && rows.count() > 0; ++a) {
        require(used[a] != dropped[a], "a point is neither corner nor duplicate, or both");
    }
}

// inside(a, b, c, d): whether d lies strictly inside the circle of the triangle a, b, c, ties displaced.
// Returns the edges on the border, from start to end, counterclockwise.
template <class Inside>
std::map<Index, Index> check_edges(const Rows& rows, Inside&& inside) {
    std::map<Index, Index> border;
    for (std::size_t row = 0; row < rows.count(); ++row) {
        const std::array<Index, 3> t{rows.corner(row, 0), rows.corner(row, 1), rows.corner(row, 2)};
        for (int k = 0; k < 3; ++k) {
            const Index d = rows.beyond(row, k);
            if (d < 0) {
                require(border.emplace(rows.corner(row, k + 1), rows.corner(row, k + 2)).second, "two borders meet");
            } else if (std::find(t.begin(), t.end(), d) == t.end()) {
                require(!inside(t[0], t[1], t[2], d), "an edge is not locally Delaunay");
            }
        }
    }
    return border;
}

// One closed border that turns left or goes straight on. Returns how many edges it has.
template <class Orient>
std::size_t check_border(const std::map<Index, Index>& border, Orient&& orient) {
    require(!border.empty(), "no border");
    std::size_t steps = 0;
    Index a = border.begin()->first;
    do {
        const auto edge = border.find(a);
        require(edge != border.end() && border.count(edge->second) == 1, "the border is open");
        const Index b = edge->second, c = border.at(b);
        require(orient(a, b, c) >= 0, "the border is not convex");
        a = b;
        ++steps;
    } while (a != border.begin()->first && steps <= border.size());
    require(steps == border.size(), "more than one border");
    return steps;
}

// The rows in an order of their own, to compare results.
inline std::vector<std::array<Index, 3>> sorted_rows(const Rows& rows) {
    std::vector<std::array<Index, 3>> result;
    for (std::size_t row = 0; row < rows.count(); ++row) {
        result.push_back({rows.corner(row, 0), rows.corner(row, 1), rows.corner(row, 2)});
    }
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace fuzz
