// Points of a part in blocks, and which part of a k-d tree a point belongs to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "memory.hpp"
#include "tally.hpp"
#include "threads.hpp"

namespace stereodel::partitions {

// A k-d tree of any number of leaves, in the order of a heap: the children of inner node k are 2k + 1 and 2k + 2, and
// what comes after the inner nodes is a leaf. Points with a coordinate up to the value go to the first child.
struct Splits {
    const std::int32_t* axis;
    const double* value;
    std::size_t count;
};

// Directions are taken as unit vectors.
template <std::size_t Width>
void parts(const double* points, std::size_t size, const Splits& splits, std::int32_t* parts, Stop stop);

// Rows in the order of blocks of at most `most` different points, where each block begins and the last one ends, and
// boxes that hold them: in the plane the narrowest, on the sphere of the unit vectors, rounded outward.
struct Blocks {
    Buffer<Index> order;
    std::vector<std::int64_t> starts;
    std::vector<double> lows, highs;
};

// Halves by the widest axis, between points that differ there: so equal points stay together. (Equal vectors: those of
// one direction and different lengths may be rounded apart.)
template <std::size_t Width>
Blocks blocks(const double* points, std::size_t size, std::size_t most, Stop stop);

}  // namespace stereodel::partitions
