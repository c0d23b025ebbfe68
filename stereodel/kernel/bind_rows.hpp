// Arrays of points between Python and the kernel: what the bindings of predicates and projection share.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>

#include "bind_support.hpp"
#include "ray_predicates.hpp"
#include "tally.hpp"

namespace stereodel {

using PlaneArray = RowsIn<double, 2>;
using SpaceArray = RowsIn<double, 3>;
using Numbers = nb::ndarray<const Index, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Values = ValuesIn<double>;
using Signs = ValuesOut<std::int8_t>;

// Which stage of a predicate is asked: all of them in turn, or one alone, which may answer OPEN.
enum class Stage { all, filter, double_double, balls, integers, exact };

inline Stage stage_of(const std::string& name) {
    const char* names[] = {"all", "filter", "double_double", "balls", "integers", "exact"};
    for (int k = 0; k < 6; ++k) {
        if (name == names[k]) {
            return static_cast<Stage>(k);
        }
    }
    throw std::invalid_argument("stage: all, filter, double_double, balls, integers or exact");
}

// One stage of a predicate, or the predicate itself.
template <class Whole, class Filter, class Middle, class Balls, class Integers, class Exact>
Sign by_stage(Stage stage, Whole&& whole, Filter&& filter, Middle&& double_double, Balls&& balls, Integers&& integers,
              Exact&& exact) {
    switch (stage) {
        case Stage::filter: return filter();
        case Stage::double_double: return double_double();
        case Stage::balls: return balls();
        case Stage::integers: return integers();
        case Stage::exact: return exact();
        default: return whole();
    }
}

// sign(k) for all rows, without the interpreter's lock.
template <class SignOf>
Signs over_rows(std::size_t count, SignOf&& sign) {
    return to_values(filled<std::int8_t>(count, false, [&](std::int8_t* out, Stop) {
        for (std::size_t k = 0; k < count; ++k) {
            out[k] = static_cast<std::int8_t>(sign(k));
        }
    }));
}

template <class First, class... Others>
std::size_t common_rows(const First& first, const Others&... others) {
    if (((others.shape(0) != first.shape(0)) || ...)) {
        throw std::invalid_argument("arrays of different length");
    }
    return first.shape(0);
}

inline const double* row(const PlaneArray& array, std::size_t k) {
    return array.data() + 2 * k;
}

inline const double* row(const SpaceArray& array, std::size_t k) {
    return array.data() + 3 * k;
}

// Whether the vectors can be taken as they stand, if the caller does not say.
template <class... Arrays>
bool decide_unit(const std::optional<bool>& unit, const Arrays&... arrays) {
    return unit ? *unit : (all_unit(arrays.data(), arrays.shape(0)) && ...);
}

// Rows of `width` numbers of points below `count`.
inline void check_numbers(const Numbers& numbers, std::size_t width, std::size_t count) {
    if (numbers.shape(1) != width) {
        throw std::invalid_argument("numbers: wrong number of columns");
    }
    check_indices("numbers", numbers.data(), numbers.shape(0), count, width);
}

using TallyTuple = std::tuple<std::uint64_t, std::uint64_t, std::uint64_t, std::uint64_t>;

inline TallyTuple as_tuple(const Tally& tally) {
    return {tally.filter, tally.curvature, tally.double_double, tally.exact};
}

}  // namespace stereodel
