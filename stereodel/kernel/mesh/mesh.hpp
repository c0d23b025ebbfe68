// The folder `mesh`: triangulations that points are added to and taken from.
// Reading order: corners (places in a triangle), mesh, walk, mesh_walk; plane_surface and sphere_surface, what the mesh
// asks of points; insertion, polygon_fill, removal; dynamic, all of it together.
//
// A closed surface of triangles that can be taken apart and put together: integers alone, nothing here knows a
// coordinate.
//
// The plane's triangles are closed by a ghost vertex, the projection pole: beyond each edge u -> v of their hull lies
// the ghost facet v u GHOST.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "growing_array.hpp"
#include "mesh/corners.hpp"
#include "tally.hpp"
#include "threads.hpp"

namespace stereodel::mesh {

constexpr Index GHOST = -1;

// Corners counterclockwise seen from outside, the smallest first, so that a ghost stands there; neighbours opposite
// each.
struct Facet {
    std::array<Index, 3> corner, neighbor;

    bool is_ghost() const { return corner[0] == GHOST; }
    bool has(Index vertex) const { return corner[0] == vertex || corner[1] == vertex || corner[2] == vertex; }
    std::size_t place(Index vertex) const { return place_of(corner.data(), vertex); }
    std::size_t opposite(Index u, Index v) const { return place_opposite(corner.data(), u, v); }
};

class Mesh {
  public:
    Mesh() = default;

    // From rows of triangles, at least one, and their neighbours, -1 for none: there a ghost facet is added.
    Mesh(const Index* simplices, const Index* neighbors, std::size_t count, Stop stop);

    const Facet& operator[](Index t) const { return facets_[static_cast<std::size_t>(t)]; }

    // Facets have numbers below this one; some are not in use.
    Index slots() const { return static_cast<Index>(facets_.size()); }
    bool in_use(Index t) const { return (*this)[t].corner[0] != unused; }

    std::size_t triangles() const { return facets_.size() - free_.size() - ghosts_; }

    // The triangles, smallest corner first, without ghosts, and their neighbours, -1 for none, into arrays of three
    // times `triangles()`. Facets get other numbers, so that row k is facet k; nearly all keep the number that they
    // have.
    void write(Index* simplices, Index* neighbors, Stop stop);

    // A number for a new facet.
    Index take() {
        if (free_.empty()) {
            facets_.push_back({{unused, unused, unused}, {}});
            return slots() - 1;
        }
        const Index t = free_.back();
        free_.pop_back();
        return t;
    }

    void release(Index t) {
        ghosts_ -= (*this)[t].is_ghost();
        at(t).corner[0] = unused;
        free_.push_back(t);
    }

    // The facet a b c, with its neighbours opposite each, at a number that was taken.
    void put(Index t, std::array<Index, 3> corner, std::array<Index, 3> neighbor) {
        const std::size_t first = place_of_least(corner.data());
        const std::size_t second = (first + 1) % 3, third = (first + 2) % 3;
        at(t) = {{corner[first], corner[second], corner[third]}, {neighbor[first], neighbor[second], neighbor[third]}};
        if (at(t).is_ghost()) {
            ++ghosts_;
            last_ghost_ = t;
        }
    }

    // The neighbour of t across its edge of u and v.
    void set_neighbor(Index t, Index u, Index v, Index neighbor) { at(t).neighbor[at(t).opposite(u, v)] = neighbor; }

    // The facet after t counterclockwise around a vertex of both.
    Index next_around(Index t, Index vertex) const {
        const Facet& facet = (*this)[t];
        return facet.neighbor[(facet.place(vertex) + 1) % 3];
    }

    // Put another vertex in the place of one, which t has.
    void rename(Index t, Index vertex, Index other);

    // Give vertices the numbers `number[vertex]`, which must be in the same order.
    void renumber(const Index* number, Stop stop);

  private:
    static constexpr Index unused = -2;  // in place of the first corner

    Facet& at(Index t) { return facets_[static_cast<std::size_t>(t)]; }
    std::vector<Index> copy_rows(const Index* simplices, const Index* neighbors, std::size_t count, Stop stop);
    void add_ghost(Index t, std::size_t opposite);
    void link_ghost(Index ghost);
    std::vector<Index> all_ghosts() const;
    void move(Index from, Index to);
    void tidy();

    GrowingArray<Facet> facets_;
    std::vector<Index> free_;
    std::size_t ghosts_ = 0;
    Index last_ghost_ = -1;  // whoever takes ghosts away makes new ones afterwards, so it is always in use
};

}  // namespace stereodel::mesh
