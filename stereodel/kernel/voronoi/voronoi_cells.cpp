#include "voronoi/voronoi_cells.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

namespace stereodel::voronoi {
namespace {

using Size = std::size_t;

Size at(Index k) { return static_cast<Size>(k); }

// Vertices with the same lowest site stand in the order of these: of the two next sites, given counterclockwise after
// it, and whether the lower of the two comes later.
std::uint64_t vertex_key(Index b, Index c) {
    return std::uint64_t{at(std::min(b, c))} << 33 | std::uint64_t{at(std::max(b, c))} << 1 | std::uint64_t{c < b};
}

// Of sites counterclockwise from the lowest.
std::uint64_t vertex_key(const std::vector<Index>& polygon) {
    Size lower = 1, higher = 2;
    if (polygon[higher] < polygon[lower]) {
        std::swap(lower, higher);
    }
    for (Size k = 3; k < polygon.size(); ++k) {
        if (polygon[k] < polygon[lower]) {
            higher = std::exchange(lower, k);
        } else if (polygon[k] < polygon[higher]) {
            higher = k;
        }
    }
    return vertex_key(polygon[std::min(lower, higher)], polygon[std::max(lower, higher)]);
}

// Where to begin to turn around a site: at the border, if it lies there, else in a triangle of its lowest vertex. That
// vertex, from 1 on, and 3 t + place are one number, of which the lowest is kept: no branch that would be guessed wrong
// in half of the cells.
class Start {
  public:
    // In the first pass, before vertices have numbers.
    void meet_unnumbered(std::uint32_t corner, bool at_border) {
        bits_ = at_border ? corner : is_unmet() ? MET : bits_;
    }
    void meet(std::uint32_t corner, Index vertex) {
        bits_ = std::min(bits_, (std::uint64_t{at(vertex)} + 1) << 32 | corner);
    }

    bool is_unmet() const { return bits_ == UNMET; }
    bool is_at_border() const { return bits_ >> 32 == 0; }
    Index triangle() const { return static_cast<Index>(static_cast<std::uint32_t>(bits_) / 3); }
    Size place() const { return static_cast<std::uint32_t>(bits_) % 3; }

  private:
    static constexpr std::uint64_t UNMET = ~std::uint64_t{0}, MET = UNMET - 1;

    std::uint64_t bits_ = UNMET;
};

class CellBuilder {
  public:
    CellBuilder(const DualTriangles& dual, Size sites, Crew& crew, Stop stop)
        : dual_(dual), crew_(crew), stop_(stop), polygons_(dual, stop), sites_(sites) {
        std::fill_n(sites_.data(), sites, Site{});
    }

    Diagram build() {
        find_lowest();
        count();
        list_vertices();
        number_vertices();
        if (dual_.has_ties()) {
            list_sites();
            rank_triangles();
        }
        name_triangles();
        find_starts();
        write_cells();
        return std::move(diagram_);
    }

  private:
    static constexpr Size grain = Size{1} << 13;

    struct Site {
        Start start;
        Index entries = 0;   // its untied edges, and one for infinity
        Index list_end = 0;  // of the vertices of which it is the lowest site: first how many they are
    };

    // The lowest sites of vertices that several triangles share; roots come before the others.
    void find_lowest() {
        if (!dual_.has_ties()) {
            return;
        }
        lowest_ = Buffer<Index>(dual_.count());
        for_range(0, dual_.count(), stop_, [&](Size k) {
            const Index t = static_cast<Index>(k), root = dual_.root(t), lowest = lowest_corner(t);
            lowest_[at(root)] = root == t ? lowest : std::min(lowest, lowest_[at(root)]);
        });
    }

    Index lowest_corner(Index t) const { return dual_.corners(t)[place_of_least(dual_.corners(t))]; }
    Index lowest_site(Index root) const { return dual_.has_ties() ? lowest_[at(root)] : lowest_corner(root); }

    void count() {
        diagram_.order = Buffer<Index>(sites_.size() + 1);
        Size size = 0;
        for_triangles([&](Index t, std::uint32_t corner) {
            for (Size place = 0; place < 3; ++place) {
                const Index number = dual_.corners(t)[place];
                Site& site = sites_[at(number)];
                const bool at_border = dual_.neighbor({t, place_before(place)}) < 0;
                diagram_.order[size] = number;
                size += Size{site.start.is_unmet()};
                site.start.meet_unnumbered(corner + static_cast<std::uint32_t>(place), at_border);
                site.entries += Index{!dual_.is_tied({t, place_after(place)})} + Index{at_border};
            }
            if (dual_.root(t) == t) {
                ++sites_[at(lowest_site(t))].list_end;
            }
        });
        diagram_.order = Buffer<Index>(std::move(diagram_.order), size);
    }

    // Calls visit(t, 3 t) for all triangles. Sites come in any order, triangles along a curve.
    template <class Visit>
    void for_triangles(Visit&& visit) {
        for_range(0, dual_.count(), stop_, [&](Size k) {
            dual_.for_corners_ahead(k, 16, [this](Index site) { prefetch(sites_.data() + site); });
            visit(static_cast<Index>(k), static_cast<std::uint32_t>(3 * k));
        });
    }

    // The roots in one list for each lowest site, the lists one after the other.
    void list_vertices() {
        diagram_.offsets = Buffer<std::int64_t>(sites_.size() + 1);
        std::int64_t entries = 0;
        Index vertices = 0;
        for (Size k = 0; k < sites_.size(); ++k) {
            diagram_.offsets[k] = entries;
            entries += sites_[k].entries;
            vertices += std::exchange(sites_[k].list_end, vertices);
        }
        diagram_.offsets[sites_.size()] = entries;
        roots_ = Buffer<Index>(at(vertices));
        for_triangles([&](Index t, std::uint32_t) {
            if (dual_.root(t) == t) {
                roots_[at(sites_[at(lowest_site(t))].list_end++)] = t;
            }
        });
    }

    Index list_begin(Index site) const { return site == 0 ? 0 : sites_[at(site) - 1].list_end; }

    using Keys = std::vector<std::pair<std::uint64_t, Index>>;  // of vertices, and their roots

    // In the order of the keys in each list. Sites come in the order of the triangles, whose corners are near then.
    void number_vertices() {
        number_ = Buffer<Index>(dual_.count());
        in_grains(diagram_.order.size(), grain, crew_, [&](Size first, Size last) {
            std::vector<Index> polygon;
            Keys keys;
            for_range(first, last, stop_, [&](Size k) {
                if (constexpr Size ahead = 16; k + ahead < diagram_.order.size()) {
                    prefetch(roots_.data() + list_begin(diagram_.order[k + ahead]));
                }
                const Index site = diagram_.order[k], begin = list_begin(site);
                keys.clear();
                for (Index place = begin; place < sites_[at(site)].list_end; ++place) {
                    const Index root = roots_[at(place)];
                    keys.emplace_back(key_of(root, polygon), root);
                }
                number_list(keys, begin);
            });
        });
    }

    std::uint64_t key_of(Index root, std::vector<Index>& polygon) const {
        if (dual_.is_triangle(root)) {
            const Index* const corner = dual_.corners(root);
            const Size k = place_of_least(corner);
            return vertex_key(corner[place_after(k)], corner[place_before(k)]);
        }
        polygon_of(root, polygon);
        return vertex_key(polygon);
    }

    // The sites around the vertex of a root, counterclockwise from the lowest.
    void polygon_of(Index root, std::vector<Index>& polygon) const {
        polygons_.collect(root, polygon);
        std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
    }

    // Numbers from `first` on. The place in a short list is counted, which takes no branches.
    void number_list(Keys& keys, Index first) {
        if (constexpr Size few = 8; keys.size() > few) {
            std::sort(keys.begin(), keys.end());
            for (const auto& item : keys) {
                number_[at(item.second)] = first++;
            }
            return;
        }
        for (const auto& item : keys) {
            Index number = first;
            for (const auto& other : keys) {
                number += Index{other.first < item.first};
            }
            number_[at(item.second)] = number;
        }
    }

    void list_sites() {
        const Size vertices = roots_.size();
        diagram_.vertex_sites = Buffer<Index>(3 * vertices);
        diagram_.row_vertex = Buffer<Index>(vertices);
        Index* sites = diagram_.vertex_sites.data();
        Index* vertex = diagram_.row_vertex.data();
        std::vector<Index> polygon;
        for_range(0, dual_.count(), stop_, [&](Size k) {
            const Index t = static_cast<Index>(k);
            if (dual_.root(t) != t) {
                return;
            }
            if (dual_.is_triangle(t)) {
                polygon.assign(dual_.corners(t), dual_.corners(t) + 3);
            } else {
                polygon_of(t, polygon);
            }
            for (Size third = 0; third < 3; ++third) {
                *sites++ = polygon[third * polygon.size() / 3];
            }
            *vertex++ = number_[k];
        });
    }

    // The way back writes the triangles of a vertex by their corners: this says in which of its rows each belongs.
    void rank_triangles() {
        diagram_.simplex_rank = Buffer<Index>(dual_.count());
        in_grains(dual_.count(), grain, crew_, [&](Size begin, Size end) {
            std::vector<Member> members;
            for_range(begin, end, stop_, [&](Size k) {
                const Index t = static_cast<Index>(k);
                if (dual_.is_triangle(t)) {
                    diagram_.simplex_rank[k] = 0;
                } else if (dual_.root(t) == t && !rank_pair(t)) {
                    collect_members(t, members);
                    std::sort(members.begin(), members.end());
                    for (Size rank = 0; rank < members.size(); ++rank) {
                        diagram_.simplex_rank[at(members[rank].second)] = static_cast<Index>(rank);
                    }
                }
            });
        });
    }

    // Two triangles, as most polygons have: false if there are more.
    bool rank_pair(Index t) {
        const Size tied = first_tied(t);
        const HalfEdge other = dual_.twin({t, tied});
        if (ties_of(t) != 1 || ties_of(other.t) != 1) {
            return false;
        }
        const bool later = dual_.corners_from_lowest(other.t) < dual_.corners_from_lowest(t);
        diagram_.simplex_rank[at(t)] = later ? 1 : 0;
        diagram_.simplex_rank[at(other.t)] = later ? 0 : 1;
        return true;
    }

    Size first_tied(Index t) const { return dual_.is_tied({t, 0}) ? 0 : dual_.is_tied({t, 1}) ? 1 : 2; }
    int ties_of(Index t) const {
        return int{dual_.is_tied({t, 0})} + int{dual_.is_tied({t, 1})} + int{dual_.is_tied({t, 2})};
    }

    using Member = std::pair<std::array<Index, 3>, Index>;  // corners from the lowest, triangle

    // The triangles of a root's polygon: over tied edges these are a tree.
    void collect_members(Index root, std::vector<Member>& members) const {
        members.assign(1, {dual_.corners_from_lowest(root), root});
        std::vector<HalfEdge> doors;  // edges to enter through
        const auto look_around = [&](Index t, Size entered) {
            for (Size place = 0; place < 3; ++place) {
                if (place != entered && dual_.is_tied({t, place})) {
                    doors.push_back(dual_.twin({t, place}));
                }
            }
        };
        look_around(root, 3);
        while (!doors.empty()) {
            const HalfEdge door = doors.back();
            doors.pop_back();
            if (members.size() == dual_.count()) {
                throw misfit();
            }
            members.push_back({dual_.corners_from_lowest(door.t), door.t});
            look_around(door.t, door.place);
        }
    }

    void name_triangles() {
        if (!dual_.has_ties()) {
            diagram_.simplex_vertex = std::move(number_);
            return;
        }
        diagram_.simplex_vertex = Buffer<Index>(dual_.count());
        for_all(dual_.count(), crew_, stop_, [&](Size t) {
            diagram_.simplex_vertex[t] = number_[at(dual_.root(static_cast<Index>(t)))];
        });
    }

    void find_starts() {
        for_triangles([&](Index t, std::uint32_t corner) {
            for (Size place = 0; place < 3; ++place) {
                sites_[at(dual_.corners(t)[place])].start.meet(corner + static_cast<std::uint32_t>(place),
                                                               diagram_.simplex_vertex[at(t)]);
            }
        });
    }

    void write_cells() {
        diagram_.vertices = Buffer<Index>(static_cast<Size>(diagram_.offsets[sites_.size()]));
        diagram_.neighbors = Buffer<Index>(diagram_.vertices.size());
        in_grains(diagram_.order.size(), grain, crew_, [&](Size begin, Size end) {
            for_range(begin, end, stop_, [&](Size k) {
                fetch_ahead(k);
                write_cell(at(diagram_.order[k]));
            });
        });
    }

    void fetch_ahead(Size k) const {
        if (constexpr Size far = 16, near = 8; k + far < diagram_.order.size()) {
            const Size soon = at(diagram_.order[k + far]), next = at(diagram_.order[k + near]);
            prefetch(sites_.data() + soon);
            prefetch(diagram_.offsets.data() + soon);
            prefetch(diagram_.vertices.data() + diagram_.offsets[next]);
            prefetch(diagram_.neighbors.data() + diagram_.offsets[next]);
        }
    }

    void write_cell(Size site) {
        const Start start = sites_[site].start;
        Size place = static_cast<Size>(diagram_.offsets[site]);
        const Size end = static_cast<Size>(diagram_.offsets[site + 1]);
        const auto add = [&](Index vertex, Index neighbor) {
            if (place == end) {
                throw misfit();
            }
            diagram_.vertices[place] = vertex;
            diagram_.neighbors[place++] = neighbor;
        };
        if (start.is_at_border()) {
            add(-1, dual_.corners(start.triangle())[place_after(start.place())]);
        }
        dual_.around(start.triangle(), start.place(), [&](HalfEdge e) {
            if (!dual_.is_tied(e)) {
                add(diagram_.simplex_vertex[at(e.t)], dual_.origin(e));
            }
        });
        if (place != end) {
            throw misfit();
        }
    }

    static std::invalid_argument misfit() { return std::invalid_argument("neighbors do not fit the simplices"); }

    const DualTriangles& dual_;
    Crew& crew_;
    Stop stop_;
    TiedPolygons polygons_;
    Buffer<Site> sites_;
    Buffer<Index> lowest_;  // of each root, if there are ties
    Buffer<Index> roots_;   // of the vertices
    Buffer<Index> number_;  // of each root: its vertex
    Diagram diagram_;
};

}  // namespace

Diagram cells_of(const DualTriangles& dual, std::size_t sites, Crew& crew, Stop stop) {
    return CellBuilder(dual, sites, crew, stop).build();
}

}  // namespace stereodel::voronoi
