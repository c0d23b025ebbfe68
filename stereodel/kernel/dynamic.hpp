// A Delaunay triangulation of points that come and go: always the one that a fresh start from the present points would give.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "curve_order.hpp"
#include "insertion.hpp"
#include "landmarks.hpp"
#include "mesh.hpp"
#include "removal.hpp"

namespace stereodel {

using Pairs = std::vector<std::pair<Index, Index>>;

// `Surface`: PlaneSurface or SphereSurface. Points, also those that repeat another one, are numbered from 0 on; duplicates
// are pairs dropped, kept, in the order of the dropped.
//
// After an exception out of `insert` or `remove` the object refuses everything.
template <class Surface>
class DynamicDelaunay {
  public:
    using Chart = typename Surface::Chart;
    static constexpr std::size_t dimension = Chart::dimension;

    DynamicDelaunay(const double* points, std::size_t size, const Index* simplices, const Index* neighbors, std::size_t triangles,
                    Pairs duplicates, Stop stop)
        : mesh_(simplices, neighbors, triangles, size, stop),
          duplicates_(std::move(duplicates)),
          scale_(Surface::scale_of(points, size)) {
        if (!Surface::has_ghost && mesh_.ghosts() != 0) {
            throw std::invalid_argument("neighbors of a closed surface must all be there");
        }
        points_.reserve(dimension * (size + size / 16 + 64));
        points_.append(points, dimension * size);
        std::sort(duplicates_.begin(), duplicates_.end());
    }

    std::size_t size() const { return points_.size() / dimension; }
    const double* points() const { return points_.data(); }
    const Pairs& duplicates() const { return duplicates_; }
    const Tally& tally() const { return tally_; }

    // Whether the points that are left lie on one line (great circle), or are fewer than three: there are no triangles then.
    bool is_flat() const { return flat_; }

    Mesh& mesh() {
        check_usable();
        return mesh_;
    }

    // Append `count` points. Those equal to one that is there already are among the duplicates only.
    void insert(const double* points, std::size_t count, Stop stop) {
        check_round();
        if (count > static_cast<std::size_t>(std::numeric_limits<Index>::max()) / 3 - size()) {
            throw std::invalid_argument("too many points");
        }
        usable_ = false;
        std::vector<Index> fresh(count);
        for (std::size_t k = 0; k < count; ++k) {
            fresh[k] = static_cast<Index>(size() + k);
        }
        points_.append(points, dimension * count);
        scale_ = Surface::common(scale_, Surface::scale_of(points, count));
        insert_all(insertion_order<Chart>(points_.data(), fresh, stop), stop);
        usable_ = true;
    }

    // Take points out and number the others anew, in the same order: `number[old]`, -1 for those removed. If the kept one of
    // equal points goes, the lowest remaining one takes its place. `indices` below size(), in any order, also repeated.
    Buffer<Index> remove(const Index* indices, std::size_t count, Stop stop) {
        check_usable();
        usable_ = false;
        Buffer<Index> number(size());
        std::fill_n(number.data(), size(), 0);
        for (std::size_t k = 0; k < count; ++k) {
            number[static_cast<std::size_t>(indices[k])] = removed_;
        }
        if (flat_) {
            leave_heirs(number);
        } else {
            take_out(number, stop);
        }
        compact(number, stop);
        usable_ = true;
        return number;
    }

  private:
    static constexpr Index removed_ = -1;

    void check_usable() const {
        if (!usable_) {
            throw std::invalid_argument("an earlier change did not come to its end; build the triangulation anew");
        }
    }

    void check_round() const {
        check_usable();
        if (flat_) {
            throw std::invalid_argument("there are no triangles to insert into; build the triangulation anew");
        }
    }

    const double* at(Index p) const { return points_.data() + dimension * static_cast<std::size_t>(p); }

    Landmarks<Chart> landmarks() const {
        return Landmarks<Chart>(static_cast<std::size_t>(mesh_.slots()), [this](Index t) {
            return mesh_.in_use(t) && !mesh_[t].is_ghost() ? at(mesh_[t].corner[0]) : nullptr;
        });
    }

    // A facet in use, for when there is no landmark.
    Index some_facet() const {
        Index t = 0;
        while (!mesh_.in_use(t)) {
            ++t;
        }
        return t;
    }

    Index near(Index p) const {
        const Index best = landmarks().nearest(at(p));
        return best >= 0 ? best : some_facet();
    }

    void insert_all(const std::vector<Index>& order, Stop stop) {
        if (order.empty()) {
            return;
        }
        Surface surface(points_.data(), scale_);
        Insertion<Surface> insertion(mesh_, surface, stop);
        const std::size_t old = duplicates_.size();
        Index facet = near(order.front());
        for (const Index p : order) {
            const Index equal = insertion.insert(p, facet);
            if (equal != nobody) {
                duplicates_.emplace_back(p, equal);
            }
        }
        std::sort(duplicates_.begin() + static_cast<std::ptrdiff_t>(old), duplicates_.end());
        tally_ += surface.tally();
    }

    // Duplicates as they will be without the removed points, old numbers; returns which kept ones are followed by which.
    Pairs leave_heirs(const Buffer<Index>& number) {
        const auto stays = [&](Index p) { return number[static_cast<std::size_t>(p)] != removed_; };
        Pairs heirs, rest;
        for (const auto& [dropped, kept] : duplicates_) {
            if (stays(dropped) && !stays(kept)) {
                heirs.emplace_back(kept, dropped);
            }
        }
        std::sort(heirs.begin(), heirs.end());
        heirs.erase(std::unique(heirs.begin(), heirs.end(), [](auto a, auto b) { return a.first == b.first; }), heirs.end());
        for (const auto& [dropped, kept] : duplicates_) {
            if (stays(dropped)) {
                const Index heir = stays(kept) ? kept : heir_of(heirs, kept);
                if (heir != dropped) {
                    rest.emplace_back(dropped, heir);
                }
            }
        }
        duplicates_ = std::move(rest);
        return heirs;
    }

    // What stands beside `key`, or nobody.
    static Index heir_of(const Pairs& pairs, Index key) {
        const auto found = std::lower_bound(pairs.begin(), pairs.end(), std::pair<Index, Index>(key, -1));
        return found != pairs.end() && found->first == key ? found->second : nobody;
    }

    void take_out(const Buffer<Index>& number, Stop stop) {
        std::vector<Index> leaving;  // vertices
        for (std::size_t p = 0; p < size(); ++p) {
            if (number[p] == removed_ && heir_of(duplicates_, static_cast<Index>(p)) == nobody) {
                leaving.push_back(static_cast<Index>(p));
            }
        }
        const std::size_t vertices = size() - duplicates_.size();
        const Pairs heirs = leave_heirs(number);
        if (vertices + heirs.size() < leaving.size() + 3) {
            flat_ = true;
            return;
        }
        if (leaving.empty()) {
            return;
        }
        Surface surface(points_.data(), scale_);
        Buffer<Index> facet_at(size());
        std::fill_n(facet_at.data(), size(), -1);
        const std::vector<Index> order = insertion_order<Chart>(points_.data(), leaving, stop);
        find_all(surface, order, facet_at, stop);
        for (const auto& [kept, heir] : heirs) {
            mesh_.rename(facet_at[static_cast<std::size_t>(kept)], kept, heir);
            facet_at[static_cast<std::size_t>(kept)] = -1;
        }
        Removal<Surface> removal(mesh_, surface, facet_at.data(), stop);
        for (std::size_t k = order.size(); k-- > 0 && !flat_;) {  // first those that would be inserted last
            if (facet_at[static_cast<std::size_t>(order[k])] >= 0) {
                removal.remove(order[k]);
                flat_ = Surface::has_ghost && mesh_.triangles() == 0;
            }
        }
        flat_ = flat_ || surface.is_flat(mesh_);
        tally_ += surface.tally();
    }

    void find_all(Surface& surface, const std::vector<Index>& order, Buffer<Index>& facet_at, Stop stop) {
        Index facet = near(order.front());
        for (const Index p : order) {
            facet = surface.locate(mesh_, facet, p, stop).facet;
            facet_at[static_cast<std::size_t>(p)] = facet;
        }
    }

    // Close the gaps in the numbers.
    void compact(Buffer<Index>& number, Stop stop) {
        Index count = 0;
        double* const coordinates = points_.data();
        for (std::size_t p = 0; p < number.size(); ++p) {
            if (number[p] != removed_) {
                std::copy_n(coordinates + dimension * p, dimension, coordinates + dimension * static_cast<std::size_t>(count));
                number[p] = count++;
            }
        }
        points_.resize(dimension * static_cast<std::size_t>(count));
        if (flat_) {
            mesh_ = Mesh();
        } else {
            mesh_.renumber(number.data(), stop);
        }
        for (auto& [dropped, kept] : duplicates_) {
            dropped = number[static_cast<std::size_t>(dropped)];
            kept = number[static_cast<std::size_t>(kept)];
        }
    }

    Mesh mesh_;
    GrowingArray<double> points_;
    Pairs duplicates_;
    typename Surface::Scale scale_;
    Tally tally_;
    bool flat_ = false;
    bool usable_ = true;
};

}  // namespace stereodel
