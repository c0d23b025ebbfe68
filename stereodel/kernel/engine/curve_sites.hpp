// Points in the order of a space-filling curve, and the triangulation of them all by tasks of the curve's ranges.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "duplicates.hpp"
#include "engine/divide_and_conquer.hpp"
#include "memory.hpp"
#include "order/curve_keys.hpp"
#include "order/radix_sort.hpp"
#include "order/square_grid.hpp"
#include "threads.hpp"

namespace stereodel::engine {

using order::KeyedPoint;
using order::Point2;
using order::sort_by_key;

// By place along the curve: plane coordinates (of the sphere's points the projected ones) and the key, both needed
// until the triangulation is complete, and the number of the point for those who asked.
struct CurveArrays {
    Buffer<Point2> points;
    Buffer<std::uint32_t> keys;
    Buffer<Index> source;
    Buffer<KeyedPoint> sorted_items;  // no longer needed: memory for others
    Stop stop = nullptr;

    // `number(k)` for k < size are the points to take, `point` and `key` know them by these numbers.
    template <class NumberOf, class PointOf, class KeyOf>
    static CurveArrays sorted(std::size_t size, NumberOf&& number, PointOf&& point, KeyOf&& key, Crew& crew,
                              Stop stop) {
        Buffer<KeyedPoint> items(3 * size);  // two for sorting; three are as large as the triangles
        for_all(size, crew, stop, [&](std::size_t k) {
            const Index p = number(k);
            items[k] = {key(p), static_cast<std::uint32_t>(p)};
        });
        sort_by_key(items.data(), items.data() + size, size, crew);
        CurveArrays arrays{Buffer<Point2>(size + size / 2 + 1),  // as large as the neighbours will be
                           Buffer<std::uint32_t>(size), Buffer<Index>(size), {}, stop};
        for_all(size, crew, stop, [&](std::size_t k) {
            arrays.source[k] = static_cast<Index>(items[k].point());
            arrays.points[k] = point(arrays.source[k]);
            arrays.keys[k] = items[k].key();
        });
        arrays.sorted_items = std::move(items);
        return arrays;
    }
};

// What plane and sphere have in common as sites of `DivideAndConquer`. A task's own view of arrays that all share; no
// two tasks work on the same range of places.
class CurveSites {
  public:
    explicit CurveSites(CurveArrays& arrays)
        : points_(arrays.points.data()), source_(arrays.source.data()), keys_(arrays.keys.data()), stop_(arrays.stop) {}

    std::uint32_t key(Index a) const { return keys_[a]; }

    // What is asked concerns the places [low, high) alone, until `leave`: a sphere's filter gets cheaper by it.
    void stay_within(Index, Index) {}
    void leave() {}

    // Points found to be equal: those that were dropped, each with the one that was kept.
    Pairs duplicates;

  protected:
    // Give the places of a range new keys and sort by them.
    template <class KeyOf>
    void sort_range(Index low, Index high, KeyOf&& key) {
        const std::size_t size = static_cast<std::size_t>(high - low);
        Buffer<KeyedPoint> items(2 * size);
        for (Index a = low; a < high; ++a) {
            poll();
            items[static_cast<std::size_t>(a - low)] = {key(a), static_cast<std::uint32_t>(a)};
        }
        Crew alone(1);
        sort_by_key(items.data(), items.data() + size, size, alone);
        reorder(low, high, [&](Index k) { return static_cast<Index>(items[static_cast<std::size_t>(k)].point()); });
        for (Index a = low; a < high; ++a) {
            keys_[a] = items[static_cast<std::size_t>(a - low)].key();
        }
    }

    // Put the places `order(0)`, `order(1)`, … of a range into that order.
    template <class Order>
    void reorder(Index low, Index high, Order&& order) {
        const std::size_t size = static_cast<std::size_t>(high - low);
        Buffer<Point2> points(size);
        Buffer<Index> source(size);
        for (std::size_t k = 0; k < size; ++k) {
            points[k] = points_[order(static_cast<Index>(k))];
            source[k] = source_[order(static_cast<Index>(k))];
        }
        std::copy(points.data(), points.data() + size, points_ + low);
        std::copy(source.data(), source.data() + size, source_ + low);
    }

    // Sort a few places by `before`, by insertion.
    template <class Before>
    void insertion_sort(Index low, Index high, Before&& before) {
        for (Index a = low + 1; a < high; ++a) {
            for (Index b = a; b > low && before(b, b - 1); --b) {
                std::swap(points_[b], points_[b - 1]);
                std::swap(source_[b], source_[b - 1]);
            }
        }
    }

    // Sort places by `compare` (-1, 0, 1; 0 for equal points), equal ones by number; the first of equal ones stay, in
    // front. Returns how many.
    template <class Compare>
    Index sort_and_drop(Index low, Index high, Compare&& compare) {
        std::vector<Index> order(static_cast<std::size_t>(high - low));
        std::iota(order.begin(), order.end(), low);
        const auto polling = [&](Index a, Index b) {
            poll();
            return compare(a, b);
        };
        const std::size_t kept = stereodel::sort_and_drop(order, Comparison(polling), source_, duplicates);
        reorder(low, high, [&](Index k) { return order[static_cast<std::size_t>(k)]; });
        return static_cast<Index>(kept);
    }

    // To be called in long loops: looks at `stop` now and then.
    void poll() {
        if (++steps_ % 4096 == 0) {
            check(stop_);
        }
    }

    Point2* points_;
    Index* source_;
    std::uint32_t* keys_;

  private:
    Stop stop_;
    std::uint32_t steps_ = 0;
};

// A triangulation by tasks. The tasks are the same for any number of threads, and so is everything else.
template <class Sites>
class CurveTriangulation {
  public:
    // `memory`: for the edges, if there is enough of it.
    template <class Used>
    CurveTriangulation(CurveArrays& arrays, const Sites& sites, Crew& crew, Buffer<Used>&& memory)
        : edges(arrays.source.size(), std::move(memory)), sites_(sites), stop_(arrays.stop) {
        const Index size = static_cast<Index>(arrays.source.size());
        plan(0, size, std::min(size / tasks_at_least_ + 1, large_));
        arrived_ = std::vector<std::atomic<int>>(nodes_.size());
        crew.run(ranges.size(), [&](std::size_t k) { solve(k); });
        whole = nodes_.back().part;
        for (const std::unique_ptr<Sites>& view : views_) {
            tally += view->tally();
            duplicates.insert(duplicates.end(), view->duplicates.begin(), view->duplicates.end());
        }
        std::sort(duplicates.begin(), duplicates.end());
    }

    // What one task triangulates.
    struct Range {
        Index low, high;
        std::size_t node;
    };

    Edges edges;
    std::vector<Range> ranges;  // along the curve
    Part whole;
    Pairs duplicates;
    Tally tally;

  private:
    static constexpr Index tasks_at_least_ = 48;  // enough to keep many threads busy to the end
    static constexpr Index small_ = 2048;         // a range that is not worth a task of its own
    static constexpr Index large_ = 1 << 13;      // one whose triangles still find room in a thread's cache
    static constexpr std::size_t none_ = static_cast<std::size_t>(-1);

    // A task, or a cut between two nodes; the root is the last one.
    struct Node {
        std::size_t left, right, parent;
        Axis axis;
        Part part;
    };

    std::size_t plan(Index low, Index high, Index most) {
        const bool divisible = high - low > std::max(most, small_);
        if (divisible && (sites_.key(low) != sites_.key(high - 1) || sites_.refine(low, high))) {
            const typename DivideAndConquer<Sites>::Cut cut(sites_, low, high);
            const std::size_t left = plan(low, cut.place, most), right = plan(cut.place, high, most);
            nodes_[left].parent = nodes_[right].parent = nodes_.size();
            nodes_.push_back({left, right, none_, cut.axis, {}});
        } else {
            ranges.push_back({low, high, nodes_.size()});
            nodes_.push_back({none_, none_, none_, Axis::x, {}});
        }
        return nodes_.size() - 1;
    }

    // Triangulate a range, then join all whose other half is done already: what comes last does the rest.
    void solve(std::size_t k) {
        const Range& range = ranges[k];
        if (range.low == range.high) {
            return;
        }
        std::unique_ptr<Sites> view = take_view();
        Sites& sites = *view;
        DivideAndConquer<Sites> engine(edges, sites, stop_);
        sites.stay_within(range.low, range.high);
        nodes_[range.node].part = engine.solve(range.low, range.high);
        sites.leave();
        for (std::size_t up = nodes_[range.node].parent; up != none_ && arrived_[up]++ == 1; up = nodes_[up].parent) {
            Node& node = nodes_[up];
            node.part = engine.merge(nodes_[node.left].part, nodes_[node.right].part, node.axis);
        }
        const Lock lock(mutex_);
        views_.push_back(std::move(view));
    }

    // A view that a task before this one has left, with what it remembers of its points, or a new one.
    std::unique_ptr<Sites> take_view() {
        {
            const Lock lock(mutex_);
            if (!views_.empty()) {
                std::unique_ptr<Sites> view = std::move(views_.back());
                views_.pop_back();
                return view;
            }
        }
        return std::make_unique<Sites>(sites_);
    }

    Sites sites_;
    Stop stop_;
    std::vector<Node> nodes_;
    std::vector<std::atomic<int>> arrived_;      // how many halves of each node are done
    std::vector<std::unique_ptr<Sites>> views_;  // that no task is using: never more than there are threads
    Mutex mutex_;                                // of the views
};

}  // namespace stereodel::engine
