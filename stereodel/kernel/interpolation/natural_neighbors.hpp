// The folder `interpolation`: values between points, as far as they need more than the triangle that holds a query.
// Reading order: natural_neighbors, stolen_areas.
//
// Natural neighbour interpolation: each point counts with the area that the query's Voronoi cell takes from its own.
//
// R. Sibson, "A brief description of natural neighbour interpolation", in: Interpreting Multivariate Data (1981). The
// derivative of an area is the integral of y - q over the edge between the two cells, divided by the distance of the
// two points: B. Piper, "Properties of local coordinates based on Dirichlet tesselations" (1993). On the sphere the
// same holds with spherical areas and the chord as distance.
#pragma once

#include <cstddef>
#include <cstdint>

#include "queries/queries.hpp"

namespace stereodel::interpolation {

using queries::TriangleArrays;

// What is asked: values and gradients; or how many points count for each query, and then these with their weights.
struct NaturalNeighborTask {
    TriangleArrays triangles;
    const double *units = nullptr, *unit_rests = nullptr;  // sphere: the points as unit vectors in double-double
    const double* queries = nullptr;
    const double *query_units = nullptr, *query_rests = nullptr;  // sphere
    std::size_t count = 0;
    const double* values = nullptr;  // `width` for each point
    std::size_t width = 0;
    double* found = nullptr;  // `width` for each query; NaN where no triangle holds it
    // Dimension times `width` for each query, or null; NaN at points and on the plane's hull too.
    double* gradients = nullptr;
    std::int64_t* counts = nullptr;        // one for each query
    const std::int64_t* starts = nullptr;  // where to put the points of each query
    Index* members = nullptr;
    double* weights = nullptr;  // of sum one up to rounding
};

// The result does not depend on `workers`. Throws std::bad_alloc, Cancelled.
template <std::size_t Width>
void natural_neighbors(const NaturalNeighborTask& task, int workers, Stop stop);

}  // namespace stereodel::interpolation
