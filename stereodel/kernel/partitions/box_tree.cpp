#include "partitions/box_tree.hpp"

#include <cmath>
#include <stdexcept>

namespace stereodel::partitions {

std::vector<std::int64_t> tree_levels(std::size_t leaves) {
    std::vector<std::int64_t> first{0};
    for (std::size_t size = leaves;; size = (size + FAN - 1) / FAN) {
        first.push_back(first.back() + static_cast<std::int64_t>(size));
        if (size <= FAN) {
            return first;
        }
    }
}

void check_levels(const std::int64_t* first, std::size_t count, std::size_t nodes) {
    const bool has_leaves = count >= 2 && first[1] >= 0 && static_cast<std::size_t>(first[1]) <= nodes;
    const std::vector<std::int64_t> levels = tree_levels(has_leaves ? static_cast<std::size_t>(first[1]) : 0);
    if (!has_leaves || levels.size() != count || !std::equal(levels.begin(), levels.end(), first) ||
        static_cast<std::size_t>(levels.back()) != nodes) {
        throw std::invalid_argument("first, lows and highs must be what box_tree gives");
    }
}

void fill_boxes(const std::vector<std::int64_t>& first, std::size_t width, double* lows, double* highs) {
    for (std::size_t level = 0; level + 2 < first.size(); ++level) {
        const auto begin = static_cast<std::size_t>(first[level]), end = static_cast<std::size_t>(first[level + 1]);
        for (std::size_t node = end; node < static_cast<std::size_t>(first[level + 2]); ++node) {
            const std::size_t child = begin + FAN * (node - end), last = std::min(child + FAN, end);
            for (std::size_t k = 0; k < width; ++k) {
                double low = lows[width * child + k], high = highs[width * child + k];
                for (std::size_t next = child + 1; next < last; ++next) {
                    low = std::min(low, lows[width * next + k]);
                    high = std::max(high, highs[width * next + k]);
                }
                lows[width * node + k] = low;
                highs[width * node + k] = high;
            }
        }
    }
}

void fill_counts(const std::int64_t* first, std::size_t levels, std::int32_t* counts) {
    for (std::size_t level = 0; level + 1 < levels; ++level) {
        const auto begin = static_cast<std::size_t>(first[level]), end = static_cast<std::size_t>(first[level + 1]);
        std::fill(counts + end, counts + first[level + 2], 0);
        for (std::size_t child = begin; child < end; ++child) {
            counts[end + (child - begin) / FAN] += counts[child];
        }
    }
}

template <std::size_t Width>
void near_blocks(const BoxTree<Width>& tree, const bool* chosen, double reach, bool* near, Stop stop) {
    const auto diagonal = [](const double* low, const double* high) {
        double square = 0.0;
        for (std::size_t k = 0; k < Width; ++k) {
            square += (high[k] - low[k]) * (high[k] - low[k]);
        }
        return std::sqrt(square);
    };
    BoxSearch<Width> search(tree);
    std::fill_n(near, tree.leaves(), false);
    for_range(0, tree.leaves(), stop, [&](std::size_t leaf) {
        if (!chosen[leaf]) {
            return;
        }
        const double *low = tree.low(leaf), *high = tree.high(leaf), own = reach * diagonal(low, high);
        const auto is_beyond = [&](double gap, const double* other_low, const double* other_high) {
            bool beyond = false;
            for (std::size_t k = 0; k < Width; ++k) {
                beyond |= other_low[k] - high[k] > gap || low[k] - other_high[k] > gap;
            }
            return beyond;
        };
        search.find_left([&](const double* a, const double* b) { return is_beyond(own, a, b); },
                         [&](std::size_t other) {
                             const double *a = tree.low(other), *b = tree.high(other);
                             if (!is_beyond(std::min(own, reach * diagonal(a, b)), a, b)) {
                                 near[other] = true;
                                 search.leave_out(other);
                             }
                             return false;
                         });
    });
}

template void near_blocks<2>(const BoxTree<2>&, const bool*, double, bool*, Stop);
template void near_blocks<3>(const BoxTree<3>&, const bool*, double, bool*, Stop);

}  // namespace stereodel::partitions
