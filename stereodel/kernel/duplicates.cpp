#include "duplicates.hpp"

#include <algorithm>

namespace stereodel {

Buffer<Index> to_buffer(const Pairs& pairs) {
    Buffer<Index> rows(2 * pairs.size());
    Index* to = rows.data();
    for (const auto& [first, second] : pairs) {
        *to++ = first;
        *to++ = second;
    }
    return rows;
}

Pairs to_pairs(const Index* rows, std::size_t count) {
    Pairs pairs(count);
    for (std::size_t k = 0; k < count; ++k) {
        pairs[k] = {rows[2 * k], rows[2 * k + 1]};
    }
    return pairs;
}

std::size_t sort_and_drop(std::vector<Index>& points, const Comparison& compare, const Index* number,
                          Pairs& duplicates) {
    const auto number_of = [number](Index point) { return number == nullptr ? point : number[point]; };
    std::sort(points.begin(), points.end(), [&](Index a, Index b) {
        const int sign = a == b ? 0 : compare(a, b);
        return sign != 0 ? sign < 0 : number_of(a) < number_of(b);
    });
    std::vector<Index> dropped;
    std::size_t kept = 0;
    for (const Index point : points) {
        if (kept > 0 && compare(points[kept - 1], point) == 0) {
            duplicates.emplace_back(number_of(point), number_of(points[kept - 1]));
            dropped.push_back(point);
        } else {
            points[kept++] = point;
        }
    }
    std::copy(dropped.begin(), dropped.end(), points.begin() + static_cast<std::ptrdiff_t>(kept));
    return kept;
}

}  // namespace stereodel
