// Equal points: the one of lowest number is kept.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "memory.hpp"
#include "tally.hpp"

namespace stereodel {

using Pairs = std::vector<std::pair<Index, Index>>;  // of numbers; of duplicates: dropped, kept

// As rows of two numbers, and back.
Buffer<Index> to_buffer(const Pairs& pairs);
Pairs to_pairs(const Index* rows, std::size_t count);

// Refers to a function of two points that says -1, 0 or 1. One sort is compiled for all of them: what they do takes
// longer than the call.
class Comparison {
  public:
    template <class Compare>
    explicit Comparison(const Compare& compare)
        : compare_(&compare),
          call_([](const void* it, Index a, Index b) -> int { return (*static_cast<const Compare*>(it))(a, b); }) {}

    int operator()(Index a, Index b) const { return call_(compare_, a, b); }

  private:
    const void* compare_;
    int (*call_)(const void*, Index, Index);
};

// Sort points by `compare` (0 for equal ones), equal ones by `number[point]`, or by themselves without numbers. The
// first of equal ones stay, in front; the others follow, and their numbers are added to the duplicates. Returns how
// many stay.
std::size_t sort_and_drop(std::vector<Index>& points, const Comparison& compare, const Index* number,
                          Pairs& duplicates);

}  // namespace stereodel
