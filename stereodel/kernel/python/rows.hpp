// Numbers of points from Python, and signs for rows of them.
#pragma once

#include <cstdint>
#include <stdexcept>

#include "input_checks.hpp"
#include "python/arrays.hpp"

namespace stereodel::python {

using Numbers = nb::ndarray<const Index, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Signs = ValuesOut<std::int8_t>;

// sign(k) for all rows, without the interpreter's lock.
template <class SignOf>
Signs over_rows(std::size_t count, SignOf&& sign) {
    return to_values(filled<std::int8_t>(count, false, [&](std::int8_t* out, Stop) {
        for (std::size_t k = 0; k < count; ++k) {
            out[k] = static_cast<std::int8_t>(sign(k));
        }
    }));
}

// Rows of `width` numbers of points below `count`.
inline void check_numbers(const Numbers& numbers, std::size_t width, std::size_t count) {
    if (numbers.shape(1) != width) {
        throw std::invalid_argument("numbers: wrong number of columns");
    }
    check_indices("numbers", numbers.data(), numbers.shape(0), count, width);
}

}  // namespace stereodel::python
