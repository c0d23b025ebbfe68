#include "voronoi/diagram_parts.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "input_checks.hpp"

namespace stereodel::voronoi {
namespace {

using Size = std::size_t;

constexpr Size grain = Size{1} << 13;

using Ridge = std::array<Index, 3>;  // the other site, the first vertex and the last

// The ridges between a site and higher ones.
void collect(const Cells& cells, Size site, std::vector<Ridge>& ridges) {
    ridges.clear();
    const Size begin = cells.begin(site), end = cells.end(site);
    for (Size k = begin; k < end; ++k) {
        if (cells.neighbors[k] > static_cast<Index>(site)) {
            ridges.push_back({cells.neighbors[k], cells.vertices[k], cells.vertices[k + 1 < end ? k + 1 : begin]});
        }
    }
    std::sort(ridges.begin(), ridges.end());
}

// A site of a vertex's polygon and the one before it, counterclockwise.
struct Corner {
    Index site, before;
};

// Sorted by their sites. The one after a corner is the one that it stands before.
bool write_polygon(const Corner* corners, Size size, std::vector<Size>& next, Index* polygon) {
    next.assign(size, size);
    for (Size k = 0; k < size; ++k) {
        const Corner* const before = std::lower_bound(corners, corners + size, corners[k].before,
                                                      [](const Corner& c, Index site) { return c.site < site; });
        if (before == corners + size || before->site != corners[k].before) {
            return false;
        }
        next[static_cast<Size>(before - corners)] = k;
    }
    Size here = 0;
    for (Size k = 0; k < size; ++k) {
        if (here == size || (k > 0 && here == 0)) {
            return false;
        }
        polygon[k] = corners[here].site;
        here = next[here];
    }
    return here == 0;
}

}  // namespace

void check_cells(const Cells& cells, std::size_t entries) {
    bool valid = cells.offsets[0] == 0 && cells.offsets[cells.sites] == static_cast<std::int64_t>(entries);
    for (std::size_t site = 0; valid && site < cells.sites; ++site) {
        valid = cells.offsets[site] <= cells.offsets[site + 1];
    }
    bool outside = false;
    for (std::size_t k = 0; valid && k < entries; ++k) {  // vertex -1: at infinity
        outside |= static_cast<std::uint32_t>(cells.vertices[k]) + 1u > cells.vertex_count;
        outside |= static_cast<std::uint32_t>(cells.neighbors[k]) >= cells.sites;
    }
    if (!valid || outside) {
        throw std::invalid_argument("the arrays are not those of a Voronoi diagram");
    }
}

void check_order(const Cells& cells) {
    check_distinct("order", cells.order, cells.filled, cells.sites);
    const auto has_entries = [&cells](std::size_t site) { return cells.begin(site) != cells.end(site); };
    std::size_t filled = 0;
    for (std::size_t site = 0; site < cells.sites; ++site) {
        filled += has_entries(site) ? 1 : 0;
    }
    bool valid = filled == cells.filled;
    for (std::size_t k = 0; valid && k < cells.filled; ++k) {
        valid = has_entries(static_cast<std::size_t>(cells.order[k]));
    }
    if (!valid) {
        throw std::invalid_argument("order must hold each site with entries once");
    }
}

Ridges ridges_of(const Cells& cells, int workers, Stop stop) {
    Crew crew(useful_workers(workers, cells.sites));
    Buffer<Size> first(cells.sites + 1);
    first[0] = 0;
    for_range(0, cells.sites, stop, [&](Size site) {
        const Index* const begin = cells.neighbors + cells.begin(site);
        first[site + 1] = first[site] + static_cast<Size>(std::count_if(begin, cells.neighbors + cells.end(site),
                                                                        [site](Index other) {
                                                                            return other > static_cast<Index>(site);
                                                                        }));
    });
    Ridges ridges{Buffer<Index>(2 * first[cells.sites]), Buffer<Index>(2 * first[cells.sites])};
    in_grains(cells.sites, grain, crew, [&](Size begin, Size end) {
        std::vector<Ridge> room;
        for_range(begin, end, stop, [&](Size site) {
            collect(cells, site, room);
            Index* sites = ridges.sites.data() + 2 * first[site];
            Index* vertices = ridges.vertices.data() + 2 * first[site];
            for (const auto& [other, from, to] : room) {
                *sites++ = static_cast<Index>(site);
                *sites++ = other;
                *vertices++ = from;
                *vertices++ = to;
            }
        });
    });
    return ridges;
}

Polygons polygons_of(const Cells& cells, int workers, Stop stop) {
    const Size entries = cells.begin(cells.sites), count = cells.vertex_count;
    Polygons polygons{Buffer<std::int64_t>(count + 2), Buffer<Index>()};
    std::int64_t* const place = polygons.offsets.data() + 1;  // while they are filled: where the next corner goes
    std::fill_n(place - 1, count + 2, 0);
    for_range(0, entries, stop, [&](Size k) {
        if (cells.vertices[k] >= 0) {
            ++place[cells.vertices[k] + 1];
        }
    });
    for (Size v = 0; v < count; ++v) {
        place[v + 1] += place[v];
    }
    const Size total = static_cast<Size>(place[count]);
    Buffer<Corner> corners(total);
    for_range(0, cells.sites, stop, [&](Size site) {
        for (Size k = cells.begin(site); k < cells.end(site); ++k) {
            if (cells.vertices[k] >= 0) {
                corners[static_cast<Size>(place[cells.vertices[k]]++)] = {static_cast<Index>(site), cells.neighbors[k]};
            }
        }
    });
    polygons.sites = Buffer<Index>(total);
    Crew crew(useful_workers(workers, count));
    in_grains(count, grain, crew, [&](Size begin, Size end) {
        std::vector<Size> room;
        for_range(begin, end, stop, [&](Size v) {
            const Size first = static_cast<Size>(polygons.offsets[v]);
            const Size size = static_cast<Size>(polygons.offsets[v + 1]) - first;
            if (size < 3 || !write_polygon(corners.data() + first, size, room, polygons.sites.data() + first)) {
                throw std::invalid_argument("the cells are not those of a Voronoi diagram");
            }
        });
    });
    return polygons;
}

}  // namespace stereodel::voronoi
