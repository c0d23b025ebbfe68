// From directed edges to arrays of triangles and their neighbours.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <vector>

#include "engine/edges.hpp"
#include "mesh/corners.hpp"
#include "threads.hpp"

namespace stereodel::engine {

using mesh::place_of_least;

constexpr Index outside = -1;  // no triangle

// Triangles, counterclockwise, smallest point first; `neighbors` opposite each corner, or nothing.
struct Triangles {
    Buffer<Index> corners, neighbors;  // three a triangle

    std::size_t count() const { return corners.size() / 3; }
};

// Writes the triangles of a subdivision in the order of its edges: that of the curve, but for edges across wide cuts. A
// triangle belongs to the least of its edges.
//
// Around the face on the left of e = (u, v) all goes by `next`: f = next(e) leads to the third corner w, f ^ 1 back
// from it, and g = next(f ^ 1) from w to v. So `next` of an edge serves the face on its left alone, and `prev` is no
// longer needed: it takes the number of the triangle on the left of each edge.
class TriangleWriter {
  public:
    // `source`: the number of each place's point for those who asked.
    TriangleWriter(Edges& edges, const Index* source) : edges_(edges), source_(source) {}

    // The face on the left of this edge is no triangle of this subdivision, but number `left`, or `outside`.
    void leave_out(Index e, Index left) {
        edges_[e].next = e ^ 1;  // now it is not the least edge of anything
        edges_[e].prev = left;
    }

    // The triangles that belong to the edges of the points [begin, end), a range that was triangulated as one: three
    // edges each. They are collected without a branch that would be guessed wrong half of the time.
    std::vector<Index> collect(std::size_t begin, std::size_t end) const {
        constexpr std::size_t block = 3 * 1024;
        std::vector<Index> triples(6 * (end - begin) + block);  // about two triangles a point
        std::size_t filled = 0;
        const Index last = static_cast<Index>(6 * end);
        for (Index e = static_cast<Index>(6 * begin); e < last;) {
            if (triples.size() < filled + block) {
                triples.resize(triples.size() + triples.size() / 2);
            }
            for (const Index stop = std::min(last, e + 1024); e < stop; ++e) {
                const DirectedEdge edge = edges_[e];
                if (edge.origin < 0) {
                    e += -2 * edge.origin - 1;  // a block of unused edges
                    continue;
                }
                const Index wu = edge.next ^ 1;
                const Index vw = edges_.next(wu) ^ 1;
                triples[filled] = e;
                triples[filled + 1] = vw;
                triples[filled + 2] = wu;
                filled += 3 * static_cast<std::size_t>((e < wu) & (e < vw));
            }
        }
        triples.resize(filled);
        return triples;
    }

    // Write their corners from row `first` on, and the edges across which their neighbours lie, opposite each corner.
    void write(const std::vector<Index>& triples, std::size_t first, Triangles& triangles) {
        Index triangle = static_cast<Index>(first);
        Index* corners = triangles.corners.data() + 3 * first;
        Index* neighbors = triangles.neighbors.size() == 0 ? nullptr : triangles.neighbors.data() + 3 * first;
        for (std::size_t k = 0; k < triples.size(); k += 3) {
            const Index uv = triples[k], vw = triples[k + 1], wu = triples[k + 2];
            edges_[uv].prev = edges_[vw].prev = edges_[wu].prev = triangle++;
            const Index u = source(uv), v = source(vw), w = source(wu);
            const std::array<Index, 5> cycle{u, v, w, u, v};
            const std::size_t least = place_of_least(cycle.data());
            corners = put(corners, cycle, least);
            if (neighbors != nullptr) {
                neighbors = put(neighbors, {vw ^ 1, wu ^ 1, uv ^ 1, vw ^ 1, wu ^ 1}, least);
            }
        }
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

    Edges& edges_;
    const Index* source_;
};

// Where each of several ranges of rows begins; known one after the other, by threads that take the ranges in order.
class RowsInOrder {
  public:
    explicit RowsInOrder(std::size_t ranges) : first_(ranges + 1) {
        for (auto& first : first_) {
            first = unknown_;
        }
        first_[0] = 0;
    }

    // Waits for the range before. Throws Cancelled if that failed.
    std::size_t first(std::size_t k) const {
        std::size_t row = unknown_;
        while ((row = first_[k].load(std::memory_order_acquire)) == unknown_) {
            wait_for_others();
        }
        if (row == failed_) {
            throw Cancelled{};
        }
        return row;
    }

    void set(std::size_t k, std::size_t row) { first_[k].store(row, std::memory_order_release); }
    void fail(std::size_t k) { set(k, failed_); }

  private:
    static constexpr std::size_t unknown_ = static_cast<std::size_t>(-1), failed_ = static_cast<std::size_t>(-2);

    std::vector<std::atomic<std::size_t>> first_;
};

// Write the triangles of all ranges (with members `low` and `high`), in their order, into rows from 0 on.
template <class Ranges>
void write_triangles(TriangleWriter& writer, const Ranges& ranges, Triangles& triangles, Crew& crew, Stop stop) {
    RowsInOrder rows(ranges.size());
    crew.run(ranges.size(), [&](std::size_t k) {
        try {
            check(stop);
            const auto low = static_cast<std::size_t>(ranges[k].low), high = static_cast<std::size_t>(ranges[k].high);
            const std::vector<Index> triples = writer.collect(low, high);
            const std::size_t first = rows.first(k);
            rows.set(k + 1, first + triples.size() / 3);
            writer.write(triples, first, triangles);
        } catch (...) {
            rows.fail(k + 1);
            throw;
        }
    });
    if (triangles.neighbors.size() != 0) {
        crew.run(ranges.size(), [&](std::size_t k) {
            check(stop);
            writer.link(rows.first(k), rows.first(k + 1), triangles);
        });
    }
}

}  // namespace stereodel::engine
