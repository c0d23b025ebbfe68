#include "graphs/proximity.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "graphs/lune_search.hpp"
#include "graphs/sites.hpp"
#include "memory.hpp"
#include "mesh/corners.hpp"

namespace stereodel::graphs {

using mesh::place_opposite;

namespace {

// An edge: opposite corner k of triangle t.
struct EdgePlace {
    Index t;
    std::uint8_t k;
};

template <class Sites>
bool is_outside_diameter(const Sites& sites, const Index* corner, std::size_t k) {
    return sites.diametral(corner[(k + 1) % 3], corner[(k + 2) % 3], corner[k]) > 0;
}

template <class Sites>
bool is_not_longest(const Sites& sites, const Index* corner, std::size_t k) {
    const Index a = corner[(k + 1) % 3], b = corner[(k + 2) % 3], c = corner[k];
    return sites.compare_lengths(a, b, b, c) <= 0 || sites.compare_lengths(a, b, a, c) <= 0;
}

// The edges that pass a test of the corner opposite, on both sides.
template <class Keeps>
std::vector<EdgePlace> places(const TriangleArrays& triangles, Crew& crew, Stop stop, Keeps&& keeps) {
    const std::size_t count = triangles.count();
    Buffer<std::uint8_t> passed(count);
    for_all(count, crew, stop, [&](std::size_t t) {
        const Index* const corner = triangles.corners(static_cast<Index>(t));
        passed[t] = static_cast<std::uint8_t>(keeps(corner, 0) | keeps(corner, 1) << 1 | keeps(corner, 2) << 2);
    });
    std::vector<EdgePlace> result;
    for_range(0, 3 * count, stop, [&](std::size_t j) {
        const auto t = static_cast<Index>(j / 3);
        const std::size_t k = j % 3;
        const Index other = triangles.neighbors(t)[k];
        if ((other >= 0 && other < t) || !(passed[static_cast<std::size_t>(t)] >> k & 1)) {
            return;
        }
        const Index* const corner = triangles.corners(t);
        const std::size_t mate =
            other < 0 ? 0 : place_opposite(triangles.corners(other), corner[(k + 1) % 3], corner[(k + 2) % 3]);
        if (other < 0 || (passed[static_cast<std::size_t>(other)] >> mate & 1)) {
            result.push_back({t, static_cast<std::uint8_t>(k)});
        }
    });
    return result;
}

// Keeps the edges whose lune is empty.
template <class Sites>
void keep_relative(std::vector<EdgePlace>& edges, const TriangleArrays& triangles, const Sites& sites, Crew& crew,
                   Stop stop) {
    constexpr std::size_t grain = 1024;
    Buffer<bool> is_empty(edges.size());
    in_grains(edges.size(), grain, crew, [&](std::size_t begin, std::size_t end) {
        LuneSearch<Sites> search(triangles, sites, stop);
        for (std::size_t k = begin; k < end; ++k) {
            is_empty[k] = search.is_empty(edges[k].t, edges[k].k);
        }
    });
    std::size_t kept = 0;
    for (std::size_t k = 0; k < edges.size(); ++k) {
        if (is_empty[k]) {
            edges[kept++] = edges[k];
        }
    }
    edges.resize(kept);
}

Pairs sorted_edges(const std::vector<EdgePlace>& edges, const TriangleArrays& triangles) {
    Pairs result;
    result.reserve(edges.size());
    for (const EdgePlace& edge : edges) {
        const Index* const corner = triangles.corners(edge.t);
        result.push_back(std::minmax({corner[(edge.k + 1) % 3], corner[(edge.k + 2) % 3]}));
    }
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace

template <std::size_t Width>
Pairs proximity(const TriangleArrays& triangles, std::size_t size, Proximity graph, int workers, Stop stop) {
    const SitesOf<Width> sites(triangles.points(), size);
    Crew crew(useful_workers(workers, triangles.count()));
    if (graph == Proximity::gabriel) {
        const auto test = [&](const Index* corner, std::size_t k) { return is_outside_diameter(sites, corner, k); };
        return sorted_edges(places(triangles, crew, stop, test), triangles);
    }
    const auto test = [&](const Index* corner, std::size_t k) { return is_not_longest(sites, corner, k); };
    std::vector<EdgePlace> edges = places(triangles, crew, stop, test);
    if (graph == Proximity::relative) {
        keep_relative(edges, triangles, sites, crew, stop);
    }
    return sorted_edges(edges, triangles);
}

template Pairs proximity<2>(const TriangleArrays&, std::size_t, Proximity, int, Stop);
template Pairs proximity<3>(const TriangleArrays&, std::size_t, Proximity, int, Stop);

}  // namespace stereodel::graphs
