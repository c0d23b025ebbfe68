// Directed edges of a planar subdivision, as L. Guibas and J. Stolfi use them ("Primitives for the manipulation of
// general subdivisions and the computation of Voronoi diagrams", ACM Transactions on Graphics 4, 1985), without the
// dual half.
#pragma once

#include "memory.hpp"
#include "tally.hpp"

namespace stereodel::engine {

// Edge e goes from its origin to that of its reverse, e ^ 1. `next` and `prev` are its neighbours counterclockwise and
// clockwise around the origin.
struct DirectedEdge {
    Index origin, next, prev;
};

// Unused edges, as a chain of blocks. A block of k edges is described in its first one: origin = -k, next = the first
// edge of the next block. So the used edges and the blocks tile the whole array, and it can be read from end to end.
struct FreeBlocks {
    Index first = -1, last = -1;
};

// n points have fewer than 3n edges, 6n directed ones. Each range [low, high) of points owns the range [6 low, 6 high)
// of directed edges: parts of the triangulation never share edges, and nothing is allocated on the way.
class Edges {
  public:
    // `memory` is used if it is large enough.
    template <class Used>
    Edges(std::size_t points, Buffer<Used>&& memory) : edges_(std::move(memory), 6 * points) {}

    static constexpr std::size_t bytes_a_point = 6 * sizeof(DirectedEdge);

    Index origin(Index e) const { return edges_[static_cast<std::size_t>(e)].origin; }
    Index target(Index e) const { return edges_[static_cast<std::size_t>(e ^ 1)].origin; }
    Index next(Index e) const { return edges_[static_cast<std::size_t>(e)].next; }
    Index prev(Index e) const { return edges_[static_cast<std::size_t>(e)].prev; }
    DirectedEdge& operator[](Index e) { return edges_[static_cast<std::size_t>(e)]; }
    const DirectedEdge& operator[](Index e) const { return edges_[static_cast<std::size_t>(e)]; }
    std::size_t size() const { return edges_.size(); }

    // Edges [first, end) become one block.
    FreeBlocks block(Index first, Index end) {
        if (first == end) {
            return {};
        }
        (*this)[first] = {-(end - first) / 2, -1, -1};
        return {first, first};
    }

    FreeBlocks chain(FreeBlocks a, FreeBlocks b) {
        if (a.first < 0) {
            return b;
        }
        if (b.first >= 0) {
            (*this)[a.last].next = b.first;
            a.last = b.last;
        }
        return a;
    }

    // A new edge from u to v; its ends are in no ring yet.
    Index make(FreeBlocks& free, Index u, Index v) {
        DirectedEdge& head = (*this)[free.first];
        const Index e = free.first + 2 * (-head.origin - 1);  // the block's last edge
        if (e == free.first) {
            free.first = head.next;
        } else {
            ++head.origin;
        }
        (*this)[e] = {u, e, e};
        (*this)[e ^ 1] = {v, e ^ 1, e ^ 1};
        return e;
    }

    // Put edge e, alone at its origin, into the ring there: counterclockwise after x.
    void insert_after(Index e, Index x) {
        const Index y = next(x);
        (*this)[e].next = y;
        (*this)[e].prev = x;
        (*this)[x].next = e;
        (*this)[y].prev = e;
    }

    void insert_before(Index e, Index x) { insert_after(e, prev(x)); }

    void remove(FreeBlocks& free, Index e) {
        unlink(e);
        unlink(e ^ 1);
        const Index k = e & ~1;
        (*this)[k] = {-1, free.first, -1};
        if (free.first < 0) {
            free.last = k;
        }
        free.first = k;
    }

  private:
    void unlink(Index e) {
        const Index x = prev(e), y = next(e);
        (*this)[x].next = y;
        (*this)[y].prev = x;
    }

    Buffer<DirectedEdge> edges_;
};

}  // namespace stereodel::engine
