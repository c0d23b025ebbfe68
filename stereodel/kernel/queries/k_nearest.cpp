#include "queries/k_nearest.hpp"

#include <algorithm>
#include <vector>

#include "index_set.hpp"
#include "queries/equal_points.hpp"
#include "queries/nearest_finder.hpp"
#include "queries/query_pieces.hpp"

namespace stereodel::queries {
namespace {

// The points in turn, for one query after another, by one thread.
template <class Query>
class Outward {
  public:
    Outward(const TriangleArrays& triangles, const EqualPoints& equal, std::size_t k, Stop stop)
        : triangles_(triangles), equal_(equal), k_(k), stop_(stop), finder_(triangles, stop) {}

    void find(const double* query, Index& near, Index* found) {
        front_.clear();
        seen_.clear();
        const auto add = [this](Near point) { reach(point); };
        const Near nearest = finder_.settle(query, near);
        add(nearest);
        finder_.visit_equal(nearest, add);
        for (std::size_t j = 0; j < k_; ++j) {
            check(stop_);
            Candidate next = pop();
            found[j] = next.place.number;
            const bool is_first = next.place.number == next.place.kept;
            if (j + 1 < k_ && is_first) {
                triangles_.neighbors_around({next.place.kept, next.triangle}, add);
            }
            if (j + 1 < k_ && equal_.step(next.place)) {
                push(next);
            }
        }
    }

  private:
    // A point that was reached, a triangle at it, and the next one of its numbers.
    struct Candidate {
        double square;
        Index triangle;
        EqualPoints::Place place;
    };

    bool is_before(const Candidate& a, const Candidate& b) {
        Sign sign = finder_.query().compare_squares(a.square, b.square);
        if (sign == OPEN) {
            sign = finder_.query().compare(a.place.kept, b.place.kept);
        }
        return sign != 0 ? sign < 0 : a.place.number < b.place.number;
    }

    auto last_first() {
        return [this](const Candidate& a, const Candidate& b) { return is_before(b, a); };
    }

    void reach(Near point) {
        if (!seen_.insert(point.point)) {
            return;
        }
        push({finder_.query().square(point.point), point.triangle, equal_.first(point.point)});
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
    const EqualPoints& equal_;
    std::size_t k_;
    Stop stop_;
    NearestFinder<Query> finder_;
    std::vector<Candidate> front_;
    IndexSet seen_;
};

}  // namespace

template <std::size_t Width>
void k_nearest(const KNearestTask& task, int workers, Stop stop) {
    using Query = QueryOf<Width>;
    const EqualPoints equal(task.duplicates);
    const auto begin_piece = [&] {
        return [task, outward = Outward<Query>(task.triangles, equal, task.k, stop)](
                   std::size_t q, const double* query, Index& near) mutable {
            outward.find(query, near, task.found + task.k * q);
        };
    };
    for_queries<typename Query::Chart>(task.triangles, first_open(task.triangles), task.queries, task.count, workers,
                                       stop, begin_piece);
}

template void k_nearest<2>(const KNearestTask&, int, Stop);
template void k_nearest<3>(const KNearestTask&, int, Stop);

}  // namespace stereodel::queries
