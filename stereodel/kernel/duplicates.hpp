// Equal points: the one of lowest number is kept.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "tally.hpp"

namespace stereodel {

using Pairs = std::vector<std::pair<Index, Index>>;  // of numbers; of duplicates: dropped, kept

// Sort points by `compare` (-1, 0, 1; 0 for equal ones), equal ones by `number(point)`. The first of equal ones stay,
// in front; the others follow, and their numbers are added to the duplicates. Returns how many stay.
template <class Compare, class NumberOf>
std::size_t sort_and_drop(std::vector<Index>& points, Compare&& compare, NumberOf&& number, Pairs& duplicates) {
    std::sort(points.begin(), points.end(), [&](Index a, Index b) {
        const int sign = a == b ? 0 : compare(a, b);
        return sign != 0 ? sign < 0 : number(a) < number(b);
    });
    std::vector<Index> dropped;
    std::size_t kept = 0;
    for (const Index point : points) {
        if (kept > 0 && compare(points[kept - 1], point) == 0) {
            duplicates.emplace_back(number(point), number(points[kept - 1]));
            dropped.push_back(point);
        } else {
            points[kept++] = point;
        }
    }
    std::copy(dropped.begin(), dropped.end(), points.begin() + static_cast<std::ptrdiff_t>(kept));
    return kept;
}

}  // namespace stereodel
