#include "voronoi/voronoi_cells.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace stereodel::voronoi {
namespace {

using Size = std::size_t;

Size at(Index k) { return static_cast<Size>(k); }

// The lowest site of a vertex, and its key among those with the same one: the two next sites, and whether the three are
// clockwise.
struct LowestSites {
    Index first;
    std::uint64_t key;

    LowestSites(Index a, Index b, Index c, bool clockwise)
        : first(a), key(std::uint64_t{at(b)} << 33 | std::uint64_t{at(c)} << 1 | std::uint64_t{clockwise}) {}
};

LowestSites of_triangle(const Index* corner) {
    const Size k = place_of_least(corner);
    const Index b = corner[(k + 1) % 3], c = corner[(k + 2) % 3];
    return {corner[k], std::min(b, c), std::max(b, c), c < b};
}

LowestSites of_polygon(const std::vector<Index>& polygon) {
    std::vector<Size> place(polygon.size());
    for (Size k = 0; k < place.size(); ++k) {
        place[k] = k;
    }
    std::partial_sort(place.begin(), place.begin() + 3, place.end(),
                      [&](Size a, Size b) { return polygon[a] < polygon[b]; });
    const auto turn = [&](Size k) { return (place[k] + polygon.size() - place[0]) % polygon.size(); };
    return {polygon[place[0]], polygon[place[1]], polygon[place[2]], turn(2) < turn(1)};
}

class CellBuilder {
  public:
    CellBuilder(const DualTriangles& dual, Size sites, Crew& crew, Stop stop)
        : dual_(dual), sites_(sites), crew_(crew), stop_(stop), polygons_(dual, stop) {}

    Diagram build() {
        // Neither can be divided; they can go side by side.
        crew_.run(2, [this](Size task) { task == 0 ? list_vertices() : count_entries(); });
        number_vertices();
        diagram_.vertices = Buffer<Index>(entries_);
        diagram_.neighbors = Buffer<Index>(entries_);
        in_grains(order_size_, grain, crew_, [&](Size begin, Size end) {
            std::vector<Entry> room;
            for_range(begin, end, stop_, [&](Size k) {
                fetch_ahead(k);
                write_cell(diagram_.order[k], room);
            });
        });
        return std::move(diagram_);
    }

  private:
    static constexpr Size grain = Size{1} << 13;

    // The sites around the vertex of a root, counterclockwise from the lowest.
    void polygon_of(Index root, std::vector<Index>& polygon) const {
        polygons_.collect(root, polygon);
        std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
    }

    LowestSites lowest_sites(Index root, std::vector<Index>& polygon) const {
        if (dual_.is_triangle(root)) {
            return of_triangle(dual_.corners(root));
        }
        polygon_of(root, polygon);
        return of_polygon(polygon);
    }

    // The roots in one list for each lowest site, the lists one after the other; list_end_[site] is where one ends.
    void list_vertices() {
        std::vector<Index> polygon;
        list_end_ = Buffer<Index>(sites_ + 1);
        Index* const end = list_end_.data();
        std::fill_n(end, sites_ + 1, 0);
        number_ = Buffer<Index>(dual_.count());  // until vertices have their numbers: the lowest site
        Size vertices = 0;
        for_range(0, dual_.count(), stop_, [&](Size k) {
            const Index t = static_cast<Index>(k);
            dual_.for_corners_ahead(k, 16, [end](Index site) { prefetch(end + site); });
            number_[k] = -1;
            if (dual_.root(t) == t) {
                number_[k] = lowest_sites(t, polygon).first;
                ++end[at(number_[k]) + 1];
                ++vertices;
            }
        });
        for (Size site = 0; site < sites_; ++site) {
            end[site + 1] += end[site];
        }
        roots_ = Buffer<Index>(vertices);
        for_range(0, dual_.count(), stop_, [&](Size k) {
            if (number_[k] >= 0) {
                roots_[at(end[at(number_[k])]++)] = static_cast<Index>(k);
            }
        });
    }

    // In the order of the keys in each list. Sites come in the order of the triangles, whose corners are near then.
    void number_vertices() {
        in_grains(order_size_, grain, crew_, [&](Size first, Size last) {
            std::vector<Index> polygon;
            std::vector<std::pair<std::uint64_t, Index>> list;
            for_range(first, last, stop_, [&](Size k) {
                if (constexpr Size ahead = 16; k + ahead < order_size_) {
                    prefetch(roots_.data() + list_begin(diagram_.order[k + ahead]));
                }
                const Index site = diagram_.order[k];
                const Index begin = list_begin(site);
                list.clear();
                for (Index place = begin; place < list_end_[at(site)]; ++place) {
                    const Index root = roots_[at(place)];
                    list.emplace_back(lowest_sites(root, polygon).key, root);
                }
                number_list(list, begin);
            });
        });
        const Size vertices = roots_.size();
        roots_ = {};
        if (dual_.has_ties()) {
            list_sites(vertices);
            rank_triangles();
        }
        name_triangles();
    }

    Index list_begin(Index site) const { return site == 0 ? 0 : list_end_[at(site) - 1]; }

    // Numbers from `first` on. The place in a short list is counted, which takes no branches.
    void number_list(std::vector<std::pair<std::uint64_t, Index>>& list, Index first) {
        if (constexpr Size few = 8; list.size() > few) {
            std::sort(list.begin(), list.end());
            for (const auto& item : list) {
                number_[at(item.second)] = first++;
            }
            return;
        }
        for (const auto& item : list) {
            Index number = first;
            for (const auto& other : list) {
                number += Index{other.first < item.first};
            }
            number_[at(item.second)] = number;
        }
    }

    void list_sites(Size vertices) {
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
                throw std::invalid_argument("neighbors do not fit the simplices");
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

    // A site's entries: its untied edges, and one for infinity. Where to begin to turn around it: at the border, if it
    // lies there, else in its lowest triangle.
    void count_entries() {
        start_ = Buffer<Index>(sites_);
        std::fill_n(start_.data(), sites_, -1);
        diagram_.offsets = Buffer<std::int64_t>(sites_ + 1);
        std::int64_t* const count = diagram_.offsets.data();
        std::fill_n(count, sites_ + 1, 0);
        diagram_.order = Buffer<Index>(sites_ + 1);
        for_range(0, dual_.count(), stop_, [&](Size k) {
            const Index t = static_cast<Index>(k);
            dual_.for_corners_ahead(k, 16, [&](Index site) {
                prefetch(start_.data() + site);
                prefetch(count + site);
            });
            for (Size place = 0; place < 3; ++place) {
                const Size site = at(dual_.corners(t)[place]);
                const bool at_border = dual_.neighbor({t, (place + 2) % 3}) < 0, is_first = start_[site] < 0;
                count[site + 1] += std::int64_t{!dual_.is_tied({t, (place + 1) % 3})} + std::int64_t{at_border};
                diagram_.order[order_size_] = static_cast<Index>(site);
                order_size_ += Size{is_first};
                start_[site] = (at_border | is_first) ? static_cast<Index>(3 * k + place) : start_[site];
            }
        });
        for (Size site = 0; site < sites_; ++site) {
            count[site + 1] += count[site];
        }
        entries_ = static_cast<Size>(count[sites_]);
        diagram_.order = Buffer<Index>(std::move(diagram_.order), order_size_);
    }

    void fetch_ahead(Size k) const {
        if (constexpr Size far = 16, near = 8; k + far < order_size_) {
            const Size soon = at(diagram_.order[k + far]), next = at(diagram_.order[k + near]);
            prefetch(start_.data() + soon);
            prefetch(diagram_.offsets.data() + soon);
            prefetch(diagram_.vertices.data() + diagram_.offsets[next]);
            prefetch(diagram_.neighbors.data() + diagram_.offsets[next]);
        }
    }

    struct Entry {
        Index vertex, neighbor;
    };

    void write_cell(Index site, std::vector<Entry>& entries) {
        const Index start = start_[at(site)], t = start / 3;
        const Size offset = static_cast<Size>(diagram_.offsets[at(site)]);
        const Size most = static_cast<Size>(diagram_.offsets[at(site) + 1]) - offset;
        if (entries.size() < most) {
            entries.resize(2 * most);
        }
        Size size = 0;
        // Vertex and place in one number: no branch that would be guessed wrong in half of the cells.
        std::int64_t least = std::numeric_limits<std::int64_t>::max();
        const auto add = [&](Index vertex, Index neighbor) {
            least = std::min(least, vertex * (std::int64_t{1} << 32) + static_cast<std::int64_t>(size));
            if (size == most) {
                throw std::invalid_argument("neighbors do not fit the simplices");
            }
            entries[size++] = {vertex, neighbor};
        };
        const bool closed = dual_.around(t, at(start) % 3, [&](HalfEdge e) {
            if (!dual_.is_tied(e)) {
                add(diagram_.simplex_vertex[at(e.t)], dual_.origin(e));
            }
        });
        if (!closed) {
            add(-1, dual_.corners(t)[(at(start) % 3 + 1) % 3]);
        }
        const Size lowest = static_cast<Size>(least & 0xFFFFFFFF);
        for (Size k = 0; k < size; ++k) {
            const Entry entry = entries[lowest + k < size ? lowest + k : lowest + k - size];
            diagram_.vertices[offset + k] = entry.vertex;
            diagram_.neighbors[offset + k] = entry.neighbor;
        }
    }

    const DualTriangles& dual_;
    Size sites_, entries_ = 0, order_size_ = 0;
    Crew& crew_;
    Stop stop_;
    TiedPolygons polygons_;
    Diagram diagram_;
    Buffer<Index> roots_, list_end_;
    Buffer<Index> number_;  // of each root: its vertex
    Buffer<Index> start_;   // of each site: 3 t + place
};

}  // namespace

Diagram cells_of(const DualTriangles& dual, std::size_t sites, Crew& crew, Stop stop) {
    return CellBuilder(dual, sites, crew, stop).build();
}

}  // namespace stereodel::voronoi
