// The folder `graphs`: proximity graphs and the shortest spanning tree.
// Reading order: sites (points by number), proximity, lune_search, spanning_tree.
//
// Graphs of nearness as parts of a Delaunay triangulation, decided exactly: Gabriel, Urquhart, relative neighbourhood.
//
// All comparisons are of chords, on the sphere of arcs, which compare alike. So one set of proofs serves both: the
// distance to a site grows with a linear function on the convex surface that the triangles lift to.
//
// An edge ab of two triangles abc and abd: a circle through a and b has a point of the set inside or on it if and only
// if it has c or d, because the circles through a and b that are empty are those between abc's and abd's. So the two
// corners opposite an edge decide whether it is a Gabriel edge (K. Gabriel, R. Sokal 1969; D. Matula, R. Sokal 1980).
//
// RNG < Urquhart < Gabriel: an edge that is strictly the longest of a triangle has its opposite corner strictly nearer
// to both ends; and the opposite corner of an edge that is no Gabriel edge has an angle of 90 degrees or more, so that
// the edge is strictly the longest.
#pragma once

#include <cstddef>

#include "duplicates.hpp"
#include "queries/queries.hpp"

namespace stereodel::graphs {

using queries::TriangleArrays;

enum class Proximity {
    gabriel,   // no other point inside or on the circle that has the edge as diameter
    urquhart,  // not strictly the longest edge of a triangle
    relative,  // no other point strictly nearer to both ends than these are to each other
};

// The edges, lower number first, in lexicographic order, of a triangulation of `size` points with at least one
// triangle. The result does not depend on `workers`. Throws std::bad_alloc, Cancelled.
template <std::size_t Width>
Pairs proximity(const TriangleArrays& triangles, std::size_t size, Proximity graph, int workers, Stop stop);

}  // namespace stereodel::graphs
