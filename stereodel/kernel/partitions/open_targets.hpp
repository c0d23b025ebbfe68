// Which targets of an interpolation are certainly answered as if all points were at hand.
#pragma once

#include <cstddef>

#include "partitions/open_bubbles.hpp"
#include "queries/queries.hpp"

namespace stereodel::partitions {

// What the answer at a target rests on: the triangle (or, on an edge or at a point, the triangles) that hold it; and if
// `natural`, all triangles whose bubbles hold it, and those that it would have at itself. Where no triangle holds it,
// the hull's edge or the closing facet beyond which it lies.
struct Targets {
    const queries::TriangleArrays& triangles;
    std::size_t points;
    const double* queries;
    std::size_t count;
    bool natural;
};

// `openness.is_open`: of each target.
template <std::size_t Width>
void open_targets(const Targets& targets, const BoxTree<Width>& tree, const Openness& openness, Stop stop);

}  // namespace stereodel::partitions
