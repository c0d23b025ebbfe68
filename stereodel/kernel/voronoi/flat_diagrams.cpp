#include "voronoi/flat_diagrams.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "coordinates/degrees.hpp"
#include "duplicates.hpp"
#include "voronoi/great_circles.hpp"
#include "voronoi/unit_vectors.hpp"

namespace stereodel::voronoi {

using coordinates::RADIAN;
using coordinates::SineCosine;
using coordinates::sin_cos_degrees;

namespace {

using Size = std::size_t;

// Offsets of cells that have `entries` each, if their site is in the order.
Diagram cells(const std::vector<Index>& order, Size count, Size entries) {
    Diagram diagram;
    diagram.offsets = Buffer<std::int64_t>(count + 1);
    std::fill_n(diagram.offsets.data(), count + 1, 0);
    for (const Index site : order) {
        diagram.offsets[static_cast<Size>(site) + 1] = static_cast<std::int64_t>(entries);
    }
    std::partial_sum(diagram.offsets.data(), diagram.offsets.data() + count + 1, diagram.offsets.data());
    diagram.vertices = Buffer<Index>(entries * order.size());
    diagram.neighbors = Buffer<Index>(entries * order.size());
    diagram.order = copied(order);
    return diagram;
}

// Half of the difference and half of the sum of the gaps beside the site in place k.
struct Lune {
    double turn, width;

    Lune(const std::vector<double>& gaps, Size k) {
        const double before = gaps[k == 0 ? gaps.size() - 1 : k - 1], after = gaps[k];
        turn = 0.5 * (after - before);
        width = 0.5 * (after + before);
    }
};

}  // namespace

Diagram line_diagram(const std::vector<Index>& order, std::size_t count) {
    Diagram diagram = cells(order, count, 1);
    std::fill_n(diagram.vertices.data(), order.size(), -1);
    std::fill_n(diagram.neighbors.data(), order.size(), -1);
    return diagram;
}

Buffer<Index> line_ridges(const std::vector<Index>& order) {
    Pairs pairs;
    for (Size k = 1; k < order.size(); ++k) {
        pairs.push_back(std::minmax(order[k - 1], order[k]));
    }
    std::sort(pairs.begin(), pairs.end());
    return to_buffer(pairs);
}

// From vertex 0 a cell is bounded by the ridge to the site before, down to vertex 1, then by that to the site after.
Diagram circle_diagram(const std::vector<Index>& order, std::size_t count) {
    const Size size = order.size();
    if (size < 2) {
        return cells({}, count, 2);
    }
    Diagram diagram = cells(order, count, 2);
    for (Size k = 0; k < size; ++k) {
        const Size entry = static_cast<Size>(diagram.offsets[static_cast<Size>(order[k])]);
        diagram.vertices[entry] = 0;
        diagram.vertices[entry + 1] = 1;
        diagram.neighbors[entry] = order[k == 0 ? size - 1 : k - 1];
        diagram.neighbors[entry + 1] = order[k + 1 == size ? 0 : k + 1];
    }
    return diagram;
}

void circle_areas(const std::vector<Index>& order, const std::vector<double>& gaps, std::size_t count, double* areas) {
    std::fill_n(areas, count, 0.0);
    for (Size k = 0; k < order.size(); ++k) {  // a lune of width w has 2 w
        areas[order[k]] = order.size() == 1 ? 2 * FULL_TURN : 2 * Lune(gaps, k).width;
    }
}

void circle_centroids(const double* xyz, const std::vector<Index>& order, const std::vector<double>& gaps,
                      const double* axis, std::size_t count, double* centroids) {
    std::fill_n(centroids, 3 * count, std::numeric_limits<double>::quiet_NaN());
    for (Size k = 0; k < order.size(); ++k) {
        const UnitVector p = unit_vector(xyz + 3 * static_cast<Size>(order[k]));
        // The middle of a lune is half of the turn away.
        const double turn = order.size() == 1 ? 0.0 : 0.5 * Lune(gaps, k).turn / RADIAN.hi;
        const SineCosine angle = sin_cos_degrees(turn);
        Pair middle[3];
        for (int j = 0; j < 3; ++j) {
            const int i = (j + 1) % 3, m = (j + 2) % 3;
            const double east = axis[i] * p.hi[m] - axis[m] * p.hi[i];
            middle[j] = angle.cosine.hi * Pair{p.hi[j], p.lo[j]} + Pair{angle.sine.hi * east, 0.0};
        }
        round_unit(middle, centroids + 3 * static_cast<Size>(order[k]));
    }
}

}  // namespace stereodel::voronoi
