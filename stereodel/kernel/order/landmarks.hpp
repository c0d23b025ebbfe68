// Triangles spread over a mesh, as places where a walk may begin.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "tally.hpp"

namespace stereodel::order {

template <class Chart>
class Landmarks {
  public:
    Landmarks() = default;

    // About `count` of `triangles`. `at(t)`: a point of triangle t, or nullptr if no walk may begin there.
    template <class At>
    Landmarks(std::size_t count, std::size_t triangles, At&& at) {
        triangles_.reserve(count);
        vectors_.reserve(count);
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t t = triangles / count * k + triangles % count * k / count;
            if (const double* const p = at(static_cast<Index>(t))) {
                triangles_.push_back(static_cast<Index>(t));
                vectors_.emplace_back();
                Chart::prepare(p, vectors_.back().data());
            }
        }
    }

    std::size_t size() const { return triangles_.size(); }
    Index triangle(std::size_t k) const { return triangles_[k]; }
    const double* vector(std::size_t k) const { return vectors_[k].data(); }

    // The triangle of the one that seems nearest, -1 without any. Where distances overflow any one will do.
    Index nearest(const double* query) const {
        std::array<double, Chart::dimension> prepared;
        Chart::prepare(query, prepared.data());
        double least = std::numeric_limits<double>::infinity();
        std::size_t best = 0;
        for (std::size_t k = 0; k < size(); ++k) {
            const double distance = Chart::rough_distance(prepared.data(), vector(k));
            if (distance < least) {
                least = distance;
                best = k;
            }
        }
        return size() == 0 ? -1 : triangle(best);
    }

  private:
    std::vector<Index> triangles_;
    std::vector<std::array<double, Chart::dimension>> vectors_;
};

}  // namespace stereodel::order
