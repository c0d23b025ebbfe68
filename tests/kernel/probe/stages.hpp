// Arrays of points for the tests, and predicates asked stage by stage.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>

#include "predicates/ray_predicates.hpp"
#include "python/rows.hpp"
#include "tally.hpp"

namespace stereodel::probe {

namespace nb = nanobind;
using predicates::all_unit;
using python::RowsIn;
using python::RowsOut;
using python::Numbers;
using python::Signs;
using python::ValuesIn;
using python::ValuesOut;
using python::check_numbers;
using python::filled;
using python::over_rows;
using python::to_rows;
using python::to_values;

using PlaneArray = RowsIn<double, 2>;
using SpaceArray = RowsIn<double, 3>;
using Values = ValuesIn<double>;

// Which stage of a predicate is asked: all of them in turn, or one alone, which may answer OPEN.
enum class Stage { all, filter, double_double, exact };

inline Stage stage_of(const std::string& name) {
    const char* names[] = {"all", "filter", "double_double", "exact"};
    for (int k = 0; k < 4; ++k) {
        if (name == names[k]) {
            return static_cast<Stage>(k);
        }
    }
    throw std::invalid_argument("stage: all, filter, double_double or exact");
}

// One stage of a predicate, or the predicate itself.
template <class Whole, class Filter, class Middle, class Exact>
Sign by_stage(Stage stage, Whole&& whole, Filter&& filter, Middle&& double_double, Exact&& exact) {
    switch (stage) {
        case Stage::filter: return filter();
        case Stage::double_double: return double_double();
        case Stage::exact: return exact();
        default: return whole();
    }
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

using TallyTuple = std::tuple<std::uint64_t, std::uint64_t, std::uint64_t, std::uint64_t>;

inline TallyTuple as_tuple(const Tally& tally) {
    return {tally.filter, tally.curvature, tally.double_double, tally.exact};
}

}  // namespace stereodel::probe
