// A triangulation as the dual of a Voronoi diagram: which triangles share a vertex, which lie around a site.
//
// Triangles across a tied edge, whose four corners lie on one circle, share their Voronoi vertex: their union is the
// polygon of its sites, and the edge has no ridge. Integers alone; who is tied is told from outside.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "memory.hpp"
#include "mesh/corners.hpp"
#include "threads.hpp"

namespace stereodel::voronoi {

using mesh::place_after;
using mesh::place_before;
using mesh::place_of_least;
using mesh::place_opposite;

// An edge: the one opposite corner `place` of triangle t, from corner place + 1 to place + 2.
struct HalfEdge {
    Index t;
    std::size_t place;
};

// The same in four bytes, or that there is none.
class PackedEdge {
  public:
    PackedEdge() = default;
    PackedEdge(HalfEdge e) : bits_(static_cast<std::uint32_t>(e.t) << 2 | static_cast<std::uint32_t>(e.place)) {}
    operator HalfEdge() const { return {static_cast<Index>(bits_ >> 2), bits_ & 3}; }

    static PackedEdge none() { return HalfEdge{-1, 3}; }
    bool is_none() const { return (bits_ & 3) == 3; }

  private:
    std::uint32_t bits_;
};

class DualTriangles {
  public:
    // Neighbours opposite each corner, -1 for none; rows and numbers must fit together.
    DualTriangles(const Index* corners, const Index* neighbors, std::size_t count)
        : corners_(corners), neighbors_(neighbors), count_(count) {}

    std::size_t count() const { return count_; }
    const Index* corners(Index t) const { return corners_ + 3 * static_cast<std::size_t>(t); }
    std::array<Index, 3> corners_from_lowest(Index t) const {
        const Index* const corner = corners(t);
        const std::size_t k = place_of_least(corner);
        return {corner[k], corner[place_after(k)], corner[place_before(k)]};
    }
    Index neighbor(HalfEdge e) const { return neighbors_[3 * static_cast<std::size_t>(e.t) + e.place]; }
    Index origin(HalfEdge e) const { return corners(e.t)[place_after(e.place)]; }
    Index target(HalfEdge e) const { return corners(e.t)[place_before(e.place)]; }

    // The same edge of the triangle beyond, which there is; after `find_ties`.
    HalfEdge twin(HalfEdge e) const { return twins_[3 * static_cast<std::size_t>(e.t) + e.place]; }

    bool is_tied(HalfEdge e) const {
        return !tied_.empty() && ((tied_[static_cast<std::size_t>(e.t)] >> e.place) & 1) != 0;
    }
    bool has_ties() const { return !tied_.empty(); }
    // Whether no other triangle shares its vertex.
    bool is_triangle(Index t) const { return !has_ties() || tied_[static_cast<std::size_t>(t)] == 0; }

    // The lowest triangle with the same vertex.
    Index root(Index t) const { return root_.size() == 0 ? t : root_[static_cast<std::size_t>(t)]; }

    // Find the twins of all edges, and ask for each edge inside, once: view.is_tied(dual, e, twin), with a view of the
    // points for each thread; view.fetch(site) and view.prepare(dual, begin, end), for a range of triangles, come some
    // time before.
    template <class MakeView>
    void find_ties(Crew& crew, Stop stop, MakeView&& make_view) {
        constexpr std::size_t grain = std::size_t{1} << 14;
        twins_ = Buffer<PackedEdge>(3 * count_);
        std::fill_n(twins_.data(), twins_.size(), PackedEdge::none());  // at the border, and neighbours that do not fit
        std::vector<std::vector<HalfEdge>> found((count_ + grain - 1) / grain);
        in_grains(count_, grain, crew, [&](std::size_t begin, std::size_t end) {
            auto view = make_view();
            for (std::size_t next = begin; next < end; next += block_) {
                check(stop);
                find_ties(next, std::min(end, next + block_), view, found[begin / grain]);
            }
        });
        for (const std::vector<HalfEdge>& some : found) {
            check(stop);
            for (const HalfEdge e : some) {
                join(e, twin(e));
            }
        }
        for (std::size_t t = 0; t < root_.size(); ++t) {
            root_[t] = root(root_[t]);  // whose root is known: it is lower
        }
    }

    // Calls visit(corner) for the triangle `distance` after t, if there is one. Sites come in any order, triangles
    // along a curve: what is kept of a site is asked for when its first triangle draws near.
    template <class Visit>
    void for_corners_ahead(std::size_t t, std::size_t distance, Visit&& visit) const {
        if (t + distance < count_) {
            const Index* const corner = corners(static_cast<Index>(t + distance));
            visit(corner[0]);
            visit(corner[1]);
            visit(corner[2]);
        }
    }

    // The next untied edge around the polygon of a vertex, counterclockwise; `e` is one.
    HalfEdge next_side(HalfEdge e) const {
        e.place = place_after(e.place);
        while (is_tied(e)) {
            e = twin(e);
            e.place = place_after(e.place);
        }
        return e;
    }

    // Calls visit(edge) for the edges that lead to a corner from the one before it, in the triangles around the corner,
    // counterclockwise from `start` on: the edge opposite corner place + 1 if `place` is that of the corner. Returns
    // whether the triangles go all round; after `find_ties`.
    template <class Visit>
    bool around(Index start, std::size_t place, Visit&& visit) const {
        HalfEdge e{start, place_after(place)};
        for (;;) {
            visit(e);
            const PackedEdge beyond = twins_[3 * static_cast<std::size_t>(e.t) + e.place];  // leaves the corner
            if (beyond.is_none()) {
                return false;
            }
            e = beyond;
            e.place = place_before(e.place);
            if (e.t == start) {
                return true;
            }
        }
    }

  private:
    static constexpr std::size_t block_ = 512;

    // For the edges of triangles [begin, end) that lead to a higher one. Every second edge does, in no order that a
    // processor could guess: they are collected without a branch, and what follows is one loop over them.
    template <class View>
    void find_ties(std::size_t begin, std::size_t end, View& view, std::vector<HalfEdge>& found) {
        view.prepare(*this, begin, end);
        std::array<PackedEdge, 3 * block_ + 1> edges;
        std::size_t size = 0;
        for (std::size_t t = begin; t < end; ++t) {
            for_corners_ahead(t, 16, [&view](Index site) { view.fetch(site); });
            for (std::size_t place = 0; place < 3; ++place) {
                const HalfEdge e{static_cast<Index>(t), place};
                edges[size] = e;
                size += std::size_t{neighbor(e) > e.t};
            }
        }
        for (std::size_t k = 0; k < size; ++k) {
            const HalfEdge e = edges[k];
            const Index across = neighbor(e);  // two triangles may share all their edges
            const HalfEdge other{across, place_opposite(corners(across), origin(e), target(e))};
            twins_[3 * static_cast<std::size_t>(e.t) + e.place] = other;
            twins_[3 * static_cast<std::size_t>(other.t) + other.place] = e;
            if (view.is_tied(*this, e, other)) {
                found.push_back(e);
            }
        }
    }

    void join(HalfEdge e, HalfEdge other) {
        if (tied_.empty()) {
            tied_.assign(count_, 0);
            root_ = Buffer<Index>(count_);
            for (std::size_t t = 0; t < count_; ++t) {
                root_[t] = static_cast<Index>(t);
            }
        }
        for (const HalfEdge side : {e, other}) {
            tied_[static_cast<std::size_t>(side.t)] |= static_cast<std::uint8_t>(1u << side.place);
        }
        const Index a = find(e.t), b = find(other.t);
        root_[static_cast<std::size_t>(a < b ? b : a)] = a < b ? a : b;
    }

    // With path halving.
    Index find(Index t) {
        while (root(t) != t) {
            Index& above = root_[static_cast<std::size_t>(t)];
            above = root(above);
            t = above;
        }
        return t;
    }

    const Index* corners_;
    const Index* neighbors_;
    std::size_t count_;
    Buffer<PackedEdge> twins_;
    std::vector<std::uint8_t> tied_;  // three bits a triangle; empty without ties
    Buffer<Index> root_;
};

// The sites around vertices that several triangles share; after `find_ties`.
class TiedPolygons {
  public:
    TiedPolygons(const DualTriangles& dual, Stop stop) : dual_(dual), side_(dual.has_ties() ? dual.count() : 0) {
        std::fill_n(side_.data(), side_.size(), -1);
        for_range(0, side_.size(), stop, [&](std::size_t t) {
            Index& side = side_[static_cast<std::size_t>(dual.root(static_cast<Index>(t)))];
            for (std::size_t place = 0; place < 3 && side < 0; ++place) {
                if (!dual.is_tied({static_cast<Index>(t), place})) {
                    side = static_cast<Index>(3 * t + place);
                }
            }
        });
    }

    // Counterclockwise, of the vertex of a root.
    void collect(Index root, std::vector<Index>& polygon) const {
        const Index side = side_[static_cast<std::size_t>(root)];
        const HalfEdge start{side / 3, static_cast<std::size_t>(side) % 3};
        polygon.clear();
        HalfEdge e = start;
        do {
            polygon.push_back(dual_.origin(e));
            e = dual_.next_side(e);
        } while (e.t != start.t || e.place != start.place);
    }

  private:
    const DualTriangles& dual_;
    Buffer<Index> side_;  // of each root: 3 t + place of a side of its polygon, where that can be entered
};

}  // namespace stereodel::voronoi
