// Triangles that fill a hole in a convex hull: the facets of the hull of the hole's border that a removed vertex saw.
//
// L. P. Chew, "Building Voronoi diagrams for convex polygons in linear expected time" (1990), for holes as in K.
// Buchin, O. Devillers, W. Mulzer, O. Schrijvers, J. Shewchuk, "Vertex deletion for 3D Delaunay triangulations" (2013):
// take the vertices out of the cycle in random order down to three, put them back in reverse order. One that comes back
// lies beyond the edge between its two neighbours at that time, so what it sees is found there without a search, and
// expected to be of constant size. No step asks for orientations: on a closed hull a facet is what no point sees.
//
// Seen from the removed vertex, the border and every part of it is a convex polygon; the facets of the far side of its
// hull are a triangulation of this polygon. So at every time the triangles here are those of one polygon.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/corners.hpp"
#include "tally.hpp"
#include "threads.hpp"

namespace stereodel::mesh {

// Fills holes; keeps its memory from one to the next.
class PolygonFill {
  public:
    static constexpr Index border = -1;  // the neighbour across an edge of the polygon

    // Corners are places in the cycle, counterclockwise; neighbours opposite each corner.
    struct Triangle {
        std::array<Index, 3> corner, neighbor;
    };

    // The triangles after `run`: two fewer than the cycle has vertices.
    const std::vector<Triangle>& triangles() const { return triangles_; }

    // The triangle on the left of the edge from place k to the next one.
    Index triangle_at(std::size_t k) const { return at_edge_[k]; }

    // `cycle`: vertices around the hole, counterclockwise seen from outside, the hole on the left; at least three, all
    // different. `in_bubble(a, b, c, p)`: whether p sees the facet a b c, never undecided.
    template <class InBubble>
    void run(const std::vector<Index>& cycle, InBubble&& in_bubble, Stop stop) {
        take_out(cycle.size());
        const Index a = order_[0], b = following_[at(a)], c = following_[at(b)];
        triangles_.assign(1, {{a, b, c}, {border, border, border}});
        at_edge_.assign(cycle.size(), 0);
        for (std::size_t k = 3; k < order_.size(); ++k) {
            if (k % 4096 == 0) {
                check(stop);
            }
            put_back(order_[k], cycle, in_bubble);
        }
    }

  private:
    // An edge u → v of what is taken away, and the triangle across it.
    struct Front {
        Index u, v, across;
    };

    static std::size_t at(Index k) { return static_cast<std::size_t>(k); }

    // Order the places, and take out all but the first three, the last one first. Afterwards each remembers between
    // which two it stood.
    void take_out(std::size_t size) {
        put_in_order(size);
        before_.resize(size);
        following_.resize(size);
        for (std::size_t k = 0; k < size; ++k) {
            before_[k] = static_cast<Index>(k == 0 ? size - 1 : k - 1);
            following_[k] = static_cast<Index>(k + 1 == size ? 0 : k + 1);
        }
        for (std::size_t k = size; k-- > 3;) {
            const Index out = order_[k];
            following_[at(before_[at(out)])] = following_[at(out)];
            before_[at(following_[at(out)])] = before_[at(out)];
        }
    }

    // A biased random order, the same every time (N. Amenta, S. Choi, G. Rote, "Incremental constructions con BRIO",
    // 2003): each place belongs with probability 1/2 to the last round, else with probability 1/2 to the one before,
    // and so on. Rounds are random, which is enough; within one, neighbours follow one another, and memory is read in
    // order.
    void put_in_order(std::size_t size) {
        round_.resize(size);
        std::array<std::size_t, rounds_ + 1> begin{};  // of each round
        std::uint64_t state = 1;
        for (std::size_t k = 0; k < size; ++k) {
            state = state * 6364136223846793005u + 1442695040888963407u;  // D. Knuth, MMIX
            round_[k] = rounds_ - 1;
            for (std::uint64_t coins = state >> 32 | std::uint64_t{1} << (rounds_ - 1); coins % 2 == 0; coins /= 2) {
                --round_[k];
            }
            ++begin[round_[k] + 1u];
        }
        for (std::size_t r = 0; r < rounds_; ++r) {
            begin[r + 1] += begin[r];
        }
        order_.resize(size);
        for (std::size_t k = 0; k < size; ++k) {
            order_[begin[round_[k]]++] = static_cast<Index>(k);
        }
    }

    template <class InBubble>
    void put_back(Index p, const std::vector<Index>& cycle, InBubble&& in_bubble) {
        const Index left = before_[at(p)], right = following_[at(p)];
        free_.clear();
        front_.clear();
        front_.push_back({right, left, at_edge_[at(left)]});
        Index last = border;  // the triangle of the fan made last
        while (!front_.empty()) {
            const Front edge = front_.back();
            front_.pop_back();
            if (edge.across != border) {
                const Triangle& other = triangles_[at(edge.across)];
                const auto& c = other.corner;
                if (in_bubble(cycle[at(c[0])], cycle[at(c[1])], cycle[at(c[2])], cycle[at(p)])) {
                    cross(edge, other);
                    continue;
                }
            }
            last = add_to_fan(edge, p, last);
        }
        at_edge_[at(left)] = last;
    }

    // Take away the triangle across an edge; go on at its two other edges, that at u first, so that the border of what
    // is taken away comes in the order of a cycle.
    void cross(Front edge, const Triangle& other) {
        const std::size_t k = place_opposite(other.corner.data(), edge.u, edge.v);
        const Index w = other.corner[k];
        free_.push_back(edge.across);
        front_.push_back({w, edge.v, other.neighbor[(k + 2) % 3]});
        front_.push_back({edge.u, w, other.neighbor[(k + 1) % 3]});
    }

    // The triangle u v p. Its edge v → p belongs to the next one of the fan, p → u to the one before it.
    Index add_to_fan(Front edge, Index p, Index last) {
        const Triangle triangle{{edge.u, edge.v, p}, {border, last, edge.across}};
        Index made = static_cast<Index>(triangles_.size());
        if (free_.empty()) {
            triangles_.push_back(triangle);
        } else {
            made = free_.back();
            free_.pop_back();
            triangles_[at(made)] = triangle;
        }
        if (last == border) {
            at_edge_[at(p)] = made;
        } else {
            triangles_[at(last)].neighbor[0] = made;
        }
        if (edge.across == border) {
            at_edge_[at(edge.u)] = made;
        } else {
            Triangle& other = triangles_[at(edge.across)];
            other.neighbor[place_opposite(other.corner.data(), edge.u, edge.v)] = made;
        }
        return made;
    }

    static constexpr std::uint8_t rounds_ = 24;

    std::vector<std::uint8_t> round_;
    std::vector<Index> order_, before_, following_, at_edge_, free_;
    std::vector<Front> front_;
    std::vector<Triangle> triangles_;
};

}  // namespace stereodel::mesh
