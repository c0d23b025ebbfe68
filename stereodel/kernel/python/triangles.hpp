// Triangulations as arrays from Python.
#pragma once

#include <cstddef>
#include <optional>

#include "python/arrays.hpp"
#include "queries/queries.hpp"

namespace stereodel::python {

using queries::TriangleArrays;

using Closing = ValuesIn<bool>;

template <class Rows>
TriangleArrays to_triangles(const Rows& points, const RowsIn<Index, 3>& simplices,
                            const RowsIn<Index, 3>& neighbors, const std::optional<Closing>& closing, bool checked) {
    const std::size_t count = simplices.shape(0);
    check_triangles(points, simplices, neighbors, checked);
    if (closing) {
        check_same_length("simplices", count, "closing", closing->shape(0));
    }
    return {points.data(), simplices.data(), neighbors.data(), closing ? closing->data() : nullptr, count};
}

}  // namespace stereodel::python
