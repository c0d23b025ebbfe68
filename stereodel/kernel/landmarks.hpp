// Triangles spread over a mesh: a walk begins at the one that seems nearest.
//
// E. Muecke, I. Saias, B. Zhu, "Fast randomized point location without preprocessing in two- and three-dimensional Delaunay
// triangulations" (1996): of n triangles about the cube root of n are worth looking at.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "tally.hpp"

namespace stereodel {

template <class Chart>
class Landmarks {
  public:
    // `at(t)`: a point of triangle t, or nullptr if no walk may begin there.
    template <class At>
    Landmarks(std::size_t triangles, At&& at) {
        const std::size_t count = static_cast<std::size_t>(std::cbrt(static_cast<double>(triangles))) + 1;
        places_.reserve(count);
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t t = triangles / count * k + triangles % count * k / count;
            if (const double* const p = at(static_cast<Index>(t))) {
                places_.push_back({static_cast<Index>(t), {}});
                Chart::prepare(p, places_.back().vector.data());
            }
        }
    }

    std::size_t size() const { return places_.size(); }

    // -1 if there is none. Where distances overflow any one will do.
    Index nearest(const double* query) const {
        std::array<double, Chart::dimension> vector;
        Chart::prepare(query, vector.data());
        Index best = places_.empty() ? -1 : places_.front().triangle;
        double least = std::numeric_limits<double>::infinity();
        for (const Landmark& landmark : places_) {
            const double distance = Chart::rough_distance(vector.data(), landmark.vector.data());
            if (distance < least) {
                least = distance;
                best = landmark.triangle;
            }
        }
        return best;
    }

  private:
    struct Landmark {
        Index triangle;
        std::array<double, Chart::dimension> vector;
    };

    std::vector<Landmark> places_;
};

}  // namespace stereodel
