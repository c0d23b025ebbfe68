// From directed edges to arrays of triangles and their neighbours.
#pragma once

#include <array>
#include <cstddef>
#include <numeric>
#include <vector>

#include "edges.hpp"
#include "threads.hpp"

namespace stereodel {

constexpr Index outside = -1;  // no triangle

// Triangles, counterclockwise, smallest point first; `neighbors` opposite each corner, or nothing.
struct Triangles {
    Buffer<Index> corners, neighbors;  // three a triangle

    std::size_t count() const { return corners.size() / 3; }
};

// Writes the triangles of a subdivision in the order of its edges: that of the curve, but for edges across wide cuts. A
// triangle belongs to the least of its edges.
//
// Around the face on the left of e = (u, v) all goes by `next`: f = next(e) leads to the third corner w, f ^ 1 back from
// it, and g = next(f ^ 1) from w to v. So `next` of an edge serves the face on its left alone, and `prev` is no longer
// needed: it takes the number of the triangle on the left of each edge.
class TriangleWriter {
  public:
    // `source`: the number of each place's point for those who asked.
    TriangleWriter(Edges& edges, const Index* source) : edges_(edges), source_(source) {}

    // The face on the left of this edge is no triangle of this subdivision, but number `left`, or `outside`.
    void leave_out(Index e, Index left) {
        edges_[e].next = e ^ 1;  // now it is not the least edge of anything
        edges_[e].prev = left;
    }

    // Triangles that belong to the edges of the points [begin, end), a range that was triangulated as one.
    std::size_t count(std::size_t begin, std::size_t end) const {
        std::size_t result = 0;
        each(begin, end, [&](Index, Index, Index) { ++result; });
        return result;
    }

    // Write their corners from row `first` on, and the edges across which their neighbours lie, opposite each corner.
    // Returns the row after the last one.
    std::size_t write(std::size_t begin, std::size_t end, std::size_t first, Triangles& triangles) {
        Index triangle = static_cast<Index>(first);
        Index* corners = triangles.corners.data() + 3 * first;
        Index* neighbors = triangles.neighbors.size() == 0 ? nullptr : triangles.neighbors.data() + 3 * first;
        each(begin, end, [&](Index uv, Index vw, Index wu) {
            edges_[uv].prev = edges_[vw].prev = edges_[wu].prev = triangle++;
            const Index u = source(uv), v = source(vw), w = source(wu);
            const std::size_t least = v < u ? (w < v ? 2 : 1) : (w < u ? 2 : 0);
            corners = put(corners, {u, v, w, u, v}, least);
            if (neighbors != nullptr) {
                neighbors = put(neighbors, {vw ^ 1, wu ^ 1, uv ^ 1, vw ^ 1, wu ^ 1}, least);
            }
        });
        return static_cast<std::size_t>(triangle);
    }

    // Edges to the triangles on their left, in rows [first, end), once all have their numbers.
    void link(std::size_t first, std::size_t end, Triangles& triangles) const {
        Index* const neighbors = triangles.neighbors.data();
        for (std::size_t k = 3 * first; k < 3 * end; ++k) {
            neighbors[k] = edges_.prev(neighbors[k]);
        }
    }

  private:
    Index source(Index e) const { return source_[edges_.origin(e)]; }

    // Three values in a cycle, given twice, from the one at `start` on.
    static Index* put(Index* row, const std::array<Index, 5>& values, std::size_t start) {
        row[0] = values[start];
        row[1] = values[start + 1];
        row[2] = values[start + 2];
        return row + 3;
    }

    // Every triangle of a range by its three edges. They are collected first, without a branch that would be guessed
    // wrong half of the time, then visited.
    template <class Visit>
    void each(std::size_t begin, std::size_t end, Visit&& visit) const {
        constexpr std::size_t many = 256;
        std::array<Index, 3 * (many + 1)> collected;
        std::size_t filled = 0;
        const auto visit_collected = [&] {
            for (std::size_t k = 0; k < filled; k += 3) {
                visit(collected[k], collected[k + 1], collected[k + 2]);
            }
            filled = 0;
        };
        const Index last = static_cast<Index>(6 * end);
        for (Index e = static_cast<Index>(6 * begin); e < last; ++e) {
            const DirectedEdge edge = edges_[e];
            if (edge.origin < 0) {
                e += -2 * edge.origin - 1;  // a block of unused edges
                continue;
            }
            const Index wu = edge.next ^ 1;
            const Index vw = edges_.next(wu) ^ 1;
            collected[filled] = e;
            collected[filled + 1] = vw;
            collected[filled + 2] = wu;
            filled += 3 * static_cast<std::size_t>((e < wu) & (e < vw));
            if (filled == 3 * many) {
                visit_collected();
            }
        }
        visit_collected();
    }

    Edges& edges_;
    const Index* source_;
};

// Write the triangles of all ranges (with members `low` and `high`), in their order, into rows from 0 on.
template <class Ranges>
void write_triangles(TriangleWriter& writer, const Ranges& ranges, Triangles& triangles, Crew& crew, Stop stop) {
    const auto begin = [&](std::size_t k) { return static_cast<std::size_t>(ranges[k].low); };
    const auto end = [&](std::size_t k) { return static_cast<std::size_t>(ranges[k].high); };
    std::vector<std::size_t> first(ranges.size() + 1, 0);
    const auto write = [&](std::size_t k) {
        check(stop);
        return writer.write(begin(k), end(k), first[k], triangles);
    };
    if (crew.size() == 1) {
        for (std::size_t k = 0; k < ranges.size(); ++k) {
            first[k + 1] = write(k);
        }
    } else {
        crew.run(ranges.size(), [&](std::size_t k) { first[k + 1] = writer.count(begin(k), end(k)); });
        std::partial_sum(first.begin(), first.end(), first.begin());
        crew.run(ranges.size(), write);
    }
    if (triangles.neighbors.size() != 0) {
        crew.run(ranges.size(), [&](std::size_t k) {
            check(stop);
            writer.link(first[k], first[k + 1], triangles);
        });
    }
}

}  // namespace stereodel
