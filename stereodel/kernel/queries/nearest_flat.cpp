#include "queries/nearest_flat.hpp"

#include <numeric>
#include <stdexcept>
#include <utility>

#include "queries/equal_points.hpp"
#include "queries/queries.hpp"

namespace stereodel::queries {
namespace {

// For one query after another, by one thread. Places of the order are counted from 0; around a circle all integers are
// places, those that differ by `size` the same.
template <class Query>
class FlatFinder {
  public:
    FlatFinder(const NearestFlatTask& task, const EqualPoints& equal)
        : task_(task), equal_(equal), query_(task.points), size_(static_cast<std::ptrdiff_t>(task.size)) {}

    void find(const double* query, Index* found) {
        query_.take(query);
        const auto roughly = [this](std::ptrdiff_t a, std::ptrdiff_t b) { return compare_roughly(a, b); };
        const auto exactly = [this](std::ptrdiff_t a, std::ptrdiff_t b) { return compare(a, b); };
        std::ptrdiff_t left = nearest_place(roughly);
        if (!is_nearest(left)) {
            if (is_closed() && all_equally_near()) {
                std::iota(found, found + task_.k, 0);
                return;
            }
            left = nearest_place(exactly);
        }
        found_ = found;
        missing_ = task_.k;
        std::ptrdiff_t right = left + 1;
        while (missing_ > 0 && right - left <= size_) {
            const int sign = compare_ends(left, right);
            if (sign < 0) {
                add(at(left--));
            } else if (sign > 0) {
                add(at(right++));
            } else {
                add(at(left--), at(right++));
            }
        }
        if (missing_ > 0) {
            throw std::invalid_argument("order and duplicates must hold every point");
        }
    }

  private:
    // Whether the order has no ends. Two directions alone are treated as two points of a line.
    bool is_closed() const { return Query::Chart::dimension == 3 && size_ > 2; }

    Index at(std::ptrdiff_t place) const { return task_.order[(place + size_) % size_]; }

    // Sign of the distance at one place less that at another.
    int compare(std::ptrdiff_t a, std::ptrdiff_t b) { return query_.compare(at(a), at(b)); }

    // The same, rounded: a guess.
    int compare_roughly(std::ptrdiff_t a, std::ptrdiff_t b) const {
        const double to_a = query_.rough_distance(at(a)), to_b = query_.rough_distance(at(b));
        return int{to_a > to_b} - int{to_a < to_b};
    }

    // Three directions of a great circle are on one circle around the query only at the ends of its axis. The kept
    // points and their duplicates are all points then.
    bool all_equally_near() { return compare(0, 1) == 0 && compare(1, 2) == 0; }

    // How many of the places 0, 1, ... below `end` come first for which a condition holds; it holds for no later one.
    template <class Condition>
    static std::ptrdiff_t partition_place(std::ptrdiff_t end, Condition&& holds) {
        std::ptrdiff_t begin = 0;
        while (begin < end) {
            const std::ptrdiff_t middle = begin + (end - begin) / 2;
            if (holds(middle)) {
                begin = middle + 1;
            } else {
                end = middle;
            }
        }
        return begin;
    }

    // The place of a nearest point, the first one of two, if `compare` is right.
    template <class Compare>
    std::ptrdiff_t nearest_place(Compare&& compare) const {
        return is_closed() ? nearest_around(compare) : nearest_along(compare);
    }

    template <class Compare>
    std::ptrdiff_t nearest_along(Compare&& compare) const {
        return partition_place(size_ - 1, [&](std::ptrdiff_t k) { return compare(k + 1, k) < 0; });
    }

    // Seen from the first place the angle falls, rises and falls again to its start, or rises, falls and rises again;
    // it stands still between two places at most, where it turns.
    template <class Compare>
    std::ptrdiff_t nearest_around(Compare&& compare) const {
        // How many places beyond `start`, where the angle falls, it falls to its least value.
        const auto end_of_fall = [&](std::ptrdiff_t start) {
            return partition_place(size_, [&](std::ptrdiff_t k) {
                return compare(start + k + 1, start + k) < 0 && compare(start + k, start) <= 0;
            });
        };
        const int step = compare(1, 0);
        if (step == 0) {  // a turn: the two nearest, or the two farthest
            return compare(2, 1) > 0 ? 0 : 1 + end_of_fall(1);
        }
        if (step < 0) {
            return end_of_fall(0);
        }
        return partition_place(
            size_, [&](std::ptrdiff_t k) { return compare(k + 1, k) < 0 || k == 0 || compare(k, 0) > 0; });
    }

    // Whether a place is what `nearest_place` looks for: least beside its neighbours is least of all.
    bool is_nearest(std::ptrdiff_t place) {
        const bool first = !is_closed() && place == 0, last = !is_closed() && place == size_ - 1;
        return (first || compare(place, place - 1) < 0) && (last || compare(place, place + 1) <= 0);
    }

    // Sign of the distance of the next place to the left less that to the right; a side where none is left is beyond
    // all.
    int compare_ends(std::ptrdiff_t left, std::ptrdiff_t right) {
        if (is_closed() ? right - left == size_ : right == size_) {
            return -1;
        }
        return !is_closed() && left < 0 ? 1 : compare(left, right);
    }

    void add(Index point) {
        EqualPoints::Place place = equal_.first(point);
        do {
            put(place.number);
        } while (missing_ > 0 && equal_.step(place));
    }

    // Two equally near points, by number.
    void add(Index a, Index b) {
        EqualPoints::Place low = equal_.first(a), high = equal_.first(b);
        for (bool both = true; both && missing_ > 0;) {
            if (high.number < low.number) {
                std::swap(low, high);
            }
            put(low.number);
            both = equal_.step(low);
        }
        while (missing_ > 0) {
            put(high.number);
            if (!equal_.step(high)) {
                return;
            }
        }
    }

    void put(Index number) {
        *found_++ = number;
        --missing_;
    }

    const NearestFlatTask& task_;
    const EqualPoints& equal_;
    Query query_;
    std::ptrdiff_t size_;
    Index* found_ = nullptr;
    std::size_t missing_ = 0;
};

}  // namespace

template <std::size_t Width>
void nearest_flat(const NearestFlatTask& task, int workers, Stop stop) {
    using Query = QueryOf<Width>;
    constexpr std::size_t grain = 256;
    const Pairs none;
    const EqualPoints equal(task.k > 1 ? task.duplicates : none);  // the kept one of equal points is the lowest
    Crew crew(useful_workers(workers, task.count, grain));
    in_grains(task.count, grain, crew, [&](std::size_t begin, std::size_t end) {
        FlatFinder<Query> finder(task, equal);
        for (std::size_t q = begin; q < end; ++q) {
            check(stop);
            finder.find(task.queries + Query::Chart::dimension * q, task.found + task.k * q);
        }
    });
}

template void nearest_flat<2>(const NearestFlatTask&, int, Stop);
template void nearest_flat<3>(const NearestFlatTask&, int, Stop);

}  // namespace stereodel::queries
