#include "k_nearest.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "index_set.hpp"
#include "nearest_finder.hpp"
#include "query_pieces.hpp"

namespace stereodel {
namespace {

// The dropped points by the one that was kept.
class Dropped {
  public:
    explicit Dropped(const Pairs& duplicates) {
        by_kept_.reserve(duplicates.size());
        for (const auto& [dropped, kept] : duplicates) {
            by_kept_.emplace_back(kept, dropped);
        }
        std::sort(by_kept_.begin(), by_kept_.end());
    }

    template <class Visit>
    void of(Index kept, Visit&& visit) const {
        auto pair = std::lower_bound(by_kept_.begin(), by_kept_.end(), std::pair<Index, Index>(kept, 0));
        for (; pair != by_kept_.end() && pair->first == kept; ++pair) {
            visit(pair->second);
        }
    }

  private:
    std::vector<std::pair<Index, Index>> by_kept_;
};

// The points in turn, for one query after another, by one thread.
template <class Query>
class Outward {
  public:
    Outward(const TriangleArrays& triangles, const Dropped& dropped, std::size_t k, Stop stop)
        : triangles_(triangles), dropped_(dropped), k_(k), stop_(stop), finder_(triangles, stop) {}

    void find(const double* query, Index& near, Index* found) {
        front_.clear();
        seen_.clear();
        const auto add = [this](Near point) { reach(point); };
        const Near nearest = finder_.settle(query, near);
        add(nearest);
        finder_.visit_equal(nearest, add);
        for (std::size_t j = 0; j < k_; ++j) {
            check(stop_);
            const Candidate next = pop();
            found[j] = next.number;
            if (next.number == next.at.point && j + 1 < k_) {
                triangles_.neighbors_around(next.at, add);
            }
        }
    }

  private:
    // A point that was reached, and its number or that of a duplicate.
    struct Candidate {
        double square;
        Index number;
        Near at;
    };

    bool is_before(const Candidate& a, const Candidate& b) {
        Sign sign = finder_.query().compare_squares(a.square, b.square);
        if (sign == OPEN) {
            sign = a.at.point == b.at.point ? 0 : finder_.query().compare(a.at.point, b.at.point);
        }
        return sign != 0 ? sign < 0 : a.number < b.number;
    }

    auto last_first() {
        return [this](const Candidate& a, const Candidate& b) { return is_before(b, a); };
    }

    void reach(Near point) {
        if (!seen_.insert(point.point)) {
            return;
        }
        const double square = finder_.query().square(point.point);
        push({square, point.point, point});
        dropped_.of(point.point, [&](Index number) { push({square, number, point}); });
    }

    void push(const Candidate& candidate) {
        front_.push_back(candidate);
        std::push_heap(front_.begin(), front_.end(), last_first());
    }

    Candidate pop() {
        std::pop_heap(front_.begin(), front_.end(), last_first());
        const Candidate least = front_.back();
        front_.pop_back();
        return least;
    }

    const TriangleArrays& triangles_;
    const Dropped& dropped_;
    std::size_t k_;
    Stop stop_;
    NearestFinder<Query> finder_;
    std::vector<Candidate> front_;
    IndexSet seen_;
};

template <class Query>
void sort_all(const KNearestTask& task, int workers, Stop stop) {
    constexpr std::size_t grain = 16;
    Crew crew(useful_workers(workers, task.count, grain));
    in_grains(task.count, grain, crew, [&](std::size_t begin, std::size_t end) {
        Query query(task.triangles.points());
        std::vector<Index> order(task.size);
        for (std::size_t q = begin; q < end; ++q) {
            check(stop);
            query.take(task.queries + Query::Chart::dimension * q);
            std::iota(order.begin(), order.end(), 0);
            const auto middle = order.begin() + static_cast<std::ptrdiff_t>(task.k);
            std::partial_sort(order.begin(), middle, order.end(), [&query](Index a, Index b) {
                const int sign = query.compare(a, b);
                return sign != 0 ? sign < 0 : a < b;
            });
            std::copy(order.begin(), middle, task.found + task.k * q);
        }
    });
}

template <class Query>
void find_k(const KNearestTask& task, int workers, Stop stop) {
    if (task.triangles.count() == 0) {
        sort_all<Query>(task, workers, stop);
        return;
    }
    const Dropped dropped(task.duplicates);
    const auto begin_piece = [&] {
        return [task, outward = Outward<Query>(task.triangles, dropped, task.k, stop)](
                   std::size_t q, const double* query, Index& near) mutable {
            outward.find(query, near, task.found + task.k * q);
        };
    };
    for_queries<typename Query::Chart>(task.triangles, first_open(task.triangles), task.queries, task.count, workers,
                                       stop, begin_piece);
}

}  // namespace

void k_nearest_plane(const KNearestTask& task, int workers, Stop stop) {
    find_k<PlaneQuery>(task, workers, stop);
}

void k_nearest_sphere(const KNearestTask& task, int workers, Stop stop) {
    find_k<SphereQuery>(task, workers, stop);
}

}  // namespace stereodel
