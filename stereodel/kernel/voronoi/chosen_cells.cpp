#include "voronoi/chosen_cells.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "growing_array.hpp"
#include "voronoi/dual.hpp"
#include "voronoi/tie_views.hpp"

namespace stereodel::voronoi {

namespace {

using Size = std::size_t;

Size at(Index k) { return static_cast<Size>(k); }

// What vertices are numbered by in a diagram (voronoi.hpp): their three lowest sites, then which way these turn.
struct VertexKey {
    std::int64_t first, second, third;
    bool clockwise;

    bool operator<(const VertexKey& other) const {
        return std::tie(first, second, third, clockwise) <
               std::tie(other.first, other.second, other.third, other.clockwise);
    }
};

class CellChooser {
  public:
    CellChooser(const DualTriangles& dual, Size sites, const std::int64_t* ids, Stop stop)
        : dual_(dual), sites_(sites), ids_(ids), stop_(stop) {
        find_starts();
        find_keys();
    }

    ChosenCells cells(const Index* chosen, Size count) {
        ChosenCells result;
        result.offsets = Buffer<std::int64_t>(sites_ + 1);
        result.order = Buffer<Index>(count);
        vertices_.reserve(6 * count + 6);
        neighbors_.reserve(6 * count + 6);
        Size filled = 0, next = 0;
        for_range(0, count, stop_, [&](Size k) {
            for (; next <= at(chosen[k]); ++next) {
                result.offsets[next] = static_cast<std::int64_t>(neighbors_.size());
            }
            if (add_cell(chosen[k])) {
                result.order[filled++] = chosen[k];
            }
        });
        for (; next <= sites_; ++next) {
            result.offsets[next] = static_cast<std::int64_t>(neighbors_.size());
        }
        result.order = Buffer<Index>(std::move(result.order), filled);
        result.vertices = copied(vertices_);
        result.neighbors = copied(neighbors_);
        return result;
    }

  private:
    // A triangle at each site: at the border, if it lies there.
    void find_starts() {
        start_ = Buffer<Index>(sites_);
        std::fill_n(start_.data(), sites_, -1);
        for_range(0, dual_.count(), stop_, [&](Size k) {
            const Index t = static_cast<Index>(k);
            dual_.for_corners_ahead(k, 16, [this](Index site) { prefetch(start_.data() + site); });
            for (Size place = 0; place < 3; ++place) {
                Index& start = start_[at(dual_.corners(t)[place])];
                const bool at_border = dual_.neighbor({t, (place + 2) % 3}) < 0;
                start = (at_border | (start < 0)) ? static_cast<Index>(3 * k + place) : start;
            }
        });
    }

    // Of vertices that several triangles share.
    void find_keys() {
        if (!dual_.has_ties()) {
            return;
        }
        const TiedPolygons polygons(dual_, stop_);
        std::vector<Index> polygon;
        key_of_ = Buffer<Index>(dual_.count());
        for_range(0, dual_.count(), stop_, [&](Size k) {
            const Index t = static_cast<Index>(k);
            if (dual_.root(t) == t && !dual_.is_triangle(t)) {
                polygons.collect(t, polygon);
                key_of_[k] = static_cast<Index>(keys_.size());
                keys_.push_back(key_of(polygon));
            }
        });
    }

    VertexKey key_of(const std::vector<Index>& polygon) {
        places_.resize(polygon.size());
        for (Size k = 0; k < places_.size(); ++k) {
            places_[k] = k;
        }
        const auto id = [&](Size place) { return ids_[polygon[place]]; };
        std::partial_sort(places_.begin(), places_.begin() + 3, places_.end(),
                          [&](Size a, Size b) { return id(a) < id(b); });
        const auto turn = [&](Size k) { return (places_[k] + polygon.size() - places_[0]) % polygon.size(); };
        return {id(places_[0]), id(places_[1]), id(places_[2]), turn(2) < turn(1)};
    }

    VertexKey key_of(Index t) const {
        if (!dual_.is_triangle(t)) {
            return keys_[at(key_of_[at(dual_.root(t))])];
        }
        const Index* const corner = dual_.corners(t);
        const std::int64_t id[3] = {ids_[corner[0]], ids_[corner[1]], ids_[corner[2]]};
        const Size k = id[0] < id[1] && id[0] < id[2] ? 0 : id[1] < id[2] ? 1 : 2;
        const std::int64_t b = id[(k + 1) % 3], c = id[(k + 2) % 3];
        return {id[k], std::min(b, c), std::max(b, c), c < b};
    }

    // False if the site is no corner of a triangle.
    bool add_cell(Index site) {
        const Index start = start_[at(site)];
        if (start < 0) {
            return false;
        }
        const Index t = start / 3;
        const Size place = at(start) % 3, begin = neighbors_.size();
        Size lowest = begin;
        VertexKey least{};
        const bool closed = dual_.around(t, place, [&](HalfEdge e) {
            if (neighbors_.size() - begin > sites_) {
                throw std::invalid_argument("neighbors do not fit the simplices");
            }
            if (dual_.is_tied(e)) {
                return;
            }
            const VertexKey key = key_of(e.t);
            if (neighbors_.size() == begin || key < least) {
                least = key;
                lowest = neighbors_.size();
            }
            neighbors_.push_back(dual_.origin(e));
        });
        if (!closed) {  // the entry of infinity stands first
            lowest = neighbors_.size();
            neighbors_.push_back(dual_.corners(t)[(place + 1) % 3]);
        }
        Index* const first = neighbors_.data() + begin;
        std::rotate(first, neighbors_.data() + lowest, neighbors_.data() + neighbors_.size());
        vertices_.resize(neighbors_.size());
        std::fill(vertices_.data() + begin, vertices_.data() + vertices_.size(), 0);
        if (!closed) {
            vertices_[begin] = -1;
        }
        return true;
    }

    const DualTriangles& dual_;
    Size sites_;
    const std::int64_t* ids_;
    Stop stop_;
    Buffer<Index> start_;   // of each site: 3 t + place, -1 if it has no triangle
    Buffer<Index> key_of_;  // of each root of several triangles: its place in `keys_`
    std::vector<VertexKey> keys_;
    std::vector<Size> places_;
    GrowingArray<Index> vertices_, neighbors_;
};

}  // namespace

template <std::size_t Width>
ChosenCells chosen_cells(const double* points, std::size_t sites, const Index* simplices, const Index* neighbors,
                         std::size_t triangles, const std::int64_t* ids, const Index* chosen, std::size_t count,
                         Stop stop) {
    DualTriangles dual(simplices, neighbors, triangles);
    Crew crew(1);
    dual.find_ties(crew, stop, views_of<Width>(points, sites));
    return CellChooser(dual, sites, ids, stop).cells(chosen, count);
}

template ChosenCells chosen_cells<2>(const double*, std::size_t, const Index*, const Index*, std::size_t,
                                      const std::int64_t*, const Index*, std::size_t, Stop);
template ChosenCells chosen_cells<3>(const double*, std::size_t, const Index*, const Index*, std::size_t,
                                      const std::int64_t*, const Index*, std::size_t, Stop);

}  // namespace stereodel::voronoi
