// Triangulations as arrays from Python.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>

#include "bind_support.hpp"
#include "queries.hpp"

namespace stereodel {

using Closing = ValuesIn<bool>;

inline TriangleArrays to_triangles(const double* points, const RowsIn<Index, 3>& simplices,
                                   const RowsIn<Index, 3>& neighbors, const std::optional<Closing>& closing) {
    const std::size_t count = simplices.shape(0);
    if (neighbors.shape(0) != count || (closing && closing->shape(0) != count)) {
        throw std::invalid_argument("simplices, neighbors and closing must have the same length");
    }
    return {points, simplices.data(), neighbors.data(), closing ? closing->data() : nullptr, count};
}

}  // namespace stereodel
