// A Delaunay triangulation of points that come and go: always the one that a fresh start from the present points would
// give.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "duplicates.hpp"
#include "mesh/insertion.hpp"
#include "mesh/mesh.hpp"
#include "mesh/removal.hpp"
#include "order/itinerary.hpp"

namespace stereodel::mesh {

using order::Itinerary;
using order::insertion_rounds;

// `Surface`: PlaneSurface or SphereSurface. Points, also those that repeat another one, are numbered from 0 on;
// duplicates are pairs dropped, kept, in the order of the dropped.
//
// After an exception out of `insert` or `remove` the object has lost its triangles and refuses everything but
// `leave_points`: the points from before the change are still there, in the same order, and come first.
template <class Surface>
class DynamicDelaunay {
  public:
    using Chart = typename Surface::Chart;
    static constexpr std::size_t dimension = Chart::dimension;

    DynamicDelaunay(const double* points, std::size_t size, const Index* simplices, const Index* neighbors,
                    std::size_t triangles, Pairs duplicates, Stop stop)
        : mesh_(simplices, neighbors, triangles, stop),
          duplicates_(std::move(duplicates)),
          scale_(Surface::scale_of(points, size)) {
        points_.reserve(dimension * (size + size / 16 + 64));
        points_.append(points, dimension * size);
        std::sort(duplicates_.begin(), duplicates_.end());
    }

    std::size_t size() const { return points_.size() / dimension; }
    const Pairs& duplicates() const { return duplicates_; }
    const Tally& tally() const { return tally_; }

    // Whether the points that are left lie on one line (great circle), or are fewer than three: there are no triangles
    // then.
    bool is_flat() const { return flat_; }

    Mesh& mesh() {
        check_usable();
        return mesh_;
    }

    const double* points() const { return points_.data(); }

    // The points alone, when nothing else is asked any more.
    GrowingArray<double> leave_points() { return std::move(points_); }

    // Append `count` points. Those equal to one that is there already are among the duplicates only.
    void insert(const double* points, std::size_t count, Stop stop) {
        check_has_triangles();
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
        insert_all(fresh, stop);
        usable_ = true;
    }

    // Take points out and number the others anew, in the same order: `number[old]`, -1 for those removed. If the kept
    // one of equal points goes, the lowest remaining one takes its place. `indices` below size(), in any order, also
    // repeated.
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
        compact(number);
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

    void check_has_triangles() const {
        check_usable();
        if (flat_) {
            throw std::invalid_argument("there are no triangles to insert into; build the triangulation anew");
        }
    }

    const double* at(Index p) const { return points_.data() + dimension * static_cast<std::size_t>(p); }

    // Calls visit(k, near) for all k below size; near: a facet near the point numbers[k], which becomes one where the
    // next may be looked for.
    template <class Visit>
    void travel(const std::vector<Index>& numbers, Stop stop, Visit&& visit) {
        if (numbers.empty()) {
            return;
        }
        const auto point = [&](std::size_t k) { return at(numbers[k]); };
        const auto point_of = [this](Index t) {
            return mesh_.in_use(t) && !mesh_[t].is_ghost() ? at(mesh_[t].corner[0]) : nullptr;
        };
        Index fallback = 0;
        while (!mesh_.in_use(fallback)) {
            ++fallback;
        }
        Crew alone(1);
        const Itinerary<Chart, decltype(point)> way(numbers.size(), point, static_cast<std::size_t>(mesh_.slots()),
                                                    point_of, fallback, alone, stop);
        way.travel(0, way.size(), [&](std::size_t k, Index& near) {
            check(stop);
            visit(k, near);
        });
    }

    // Points equal to one before are among the duplicates only: of equal ones the lowest comes first.
    void insert_all(const std::vector<Index>& fresh, Stop stop) {
        Surface surface(points_.data(), scale_);
        Insertion<Surface> insertion(mesh_, surface, stop);
        const std::size_t old = duplicates_.size();
        for (const std::vector<Index>& round : insertion_rounds<Chart>(points_.data(), fresh)) {
            travel(round, stop, [&](std::size_t k, Index& near) {
                const Index equal = insertion.insert(round[k], near);
                if (equal != nobody) {
                    duplicates_.emplace_back(round[k], equal);
                }
            });
        }
        std::sort(duplicates_.begin() + static_cast<std::ptrdiff_t>(old), duplicates_.end());
        tally_ += surface.tally();
    }

    // Duplicates as they will be without the removed points, old numbers; returns which kept ones are followed by
    // which.
    Pairs leave_heirs(const Buffer<Index>& number) {
        const auto stays = [&](Index p) { return number[static_cast<std::size_t>(p)] != removed_; };
        Pairs heirs, rest;
        for (const auto& [dropped, kept] : duplicates_) {
            if (stays(dropped) && !stays(kept)) {
                heirs.emplace_back(kept, dropped);
            }
        }
        std::sort(heirs.begin(), heirs.end());
        heirs.erase(std::unique(heirs.begin(), heirs.end(), [](auto a, auto b) { return a.first == b.first; }),
                    heirs.end());
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
        travel(leaving, stop, [&](std::size_t k, Index& near) {
            near = surface.locate(mesh_, near, leaving[k], stop).facet;
            facet_at[static_cast<std::size_t>(leaving[k])] = near;
        });
        for (const auto& [kept, heir] : heirs) {
            mesh_.rename(facet_at[static_cast<std::size_t>(kept)], kept, heir);
            facet_at[static_cast<std::size_t>(kept)] = -1;
        }
        remove_all(surface, leaving, facet_at, stop);
        flat_ = flat_ || surface.is_flat(mesh_);
        tally_ += surface.tally();
    }

    // The order of insertion reversed: where many go, stars stay small.
    void remove_all(Surface& surface, const std::vector<Index>& leaving, Buffer<Index>& facet_at, Stop stop) {
        Removal<Surface> removal(mesh_, surface, facet_at.data(), stop);
        std::vector<std::vector<Index>> rounds = insertion_rounds<Chart>(points_.data(), leaving);
        for (; !rounds.empty(); rounds.pop_back()) {
            for (const Index p : rounds.back()) {
                check(stop);
                if (facet_at[static_cast<std::size_t>(p)] >= 0) {
                    removal.remove(p);
                    if (Surface::has_ghost && surface.is_flat(mesh_)) {
                        return;
                    }
                }
            }
        }
    }

    // Close the gaps in the numbers. What lies between two of them moves in one piece. Nothing stops this halfway: the
    // points from before would be lost.
    void compact(Buffer<Index>& number) {
        double* const coordinates = points_.data();
        Index *const all = number.data(), *const end = all + number.size();
        std::size_t count = 0;
        for (Index* begin = all; begin != end;) {
            Index* const gap = std::find(begin, end, removed_);
            const std::size_t from = static_cast<std::size_t>(begin - all), to = static_cast<std::size_t>(gap - all);
            if (count != from) {
                std::copy(coordinates + dimension * from, coordinates + dimension * to,
                          coordinates + dimension * count);
            }
            std::iota(begin, gap, static_cast<Index>(count));
            count += to - from;
            begin = std::find_if(gap, end, [](Index n) { return n != removed_; });
        }
        points_.resize(dimension * count);
        if (flat_) {
            mesh_ = Mesh();
        } else {
            mesh_.renumber(number.data(), nullptr);
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

}  // namespace stereodel::mesh
