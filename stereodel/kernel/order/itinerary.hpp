// A way through a mesh that visits many queries with short walks: along a curve, past landmarks.
//
// E. Muecke, I. Saias, B. Zhu, "Fast randomized point location without preprocessing in two- and three-dimensional
// Delaunay triangulations" (1996): for one query about n^(1/3) of n triangles are worth looking at; for q queries
// q^(2/3) n^(1/3) by the same calculation. They are sorted along the curve together with the queries; each walk begins
// at the landmark before or after it or where the last walk ended, whichever seems nearest. Many queries are each
// other's landmarks.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "order/curve_order.hpp"
#include "order/landmarks.hpp"

namespace stereodel::order {

// `at(k)`: query number k.
template <class Chart, class At>
class Itinerary {
  public:
    // `point_of(t)`: a point of triangle t, or nullptr if no walk may begin there; `fallback`: a triangle where one
    // may.
    template <class PointOf>
    Itinerary(std::size_t queries, At at, std::size_t triangles, PointOf&& point_of, Index fallback, Crew& crew,
              Stop stop)
        : at_(at), queries_(queries), fallback_(fallback) {
        const double n = static_cast<double>(triangles), q = static_cast<double>(queries);
        sorted_landmarks_ = queries > few && queries < triangles / 16;
        const double count = std::cbrt(n) * (sorted_landmarks_ ? std::cbrt(q) * std::cbrt(q) : 1.0);
        landmarks_ = Landmarks<Chart>(static_cast<std::size_t>(count) + 1, triangles, point_of);
        if (queries > std::numeric_limits<std::uint32_t>::max() - landmarks_.size()) {
            throw std::invalid_argument("too many queries for one call");
        }
        items_ = Buffer<KeyedPoint>(queries + (sorted_landmarks_ ? landmarks_.size() : 0));
        for (std::size_t k = 0; k < items_.size(); ++k) {
            items_[k] = {0, static_cast<std::uint32_t>(k)};
        }
        if (queries > few) {
            const auto any = [this](std::uint32_t k) {
                return k < queries_ ? at_(k) : landmarks_.vector(k - queries_);
            };
            CurveOrder<Chart, decltype(any)>(any, crew, stop).sort(items_);
        }
    }

    // Stations: queries and landmarks.
    std::size_t size() const { return items_.size(); }

    // Calls visit(k, near) for the queries among the stations [begin, end): a walk may begin at triangle `near`, which
    // becomes the one where it ended.
    template <class Visit>
    void travel(std::size_t begin, std::size_t end, Visit&& visit) const {
        if (!sorted_landmarks_) {
            travel_without(begin, end, visit);
            return;
        }
        std::size_t behind = begin;
        while (behind > 0 && is_query(behind)) {
            --behind;
        }
        std::size_t ahead = begin;
        Index near = -1;
        std::array<double, Chart::dimension> last{};
        for (std::size_t k = begin; k < end; ++k) {
            if (!is_query(k)) {
                behind = k;
                continue;
            }
            while (ahead < items_.size() && (ahead < k || is_query(ahead))) {
                ++ahead;
            }
            std::array<double, Chart::dimension> here;
            Chart::prepare(at_(items_[k].point()), here.data());
            double least = near < 0 ? HUGE_VAL : Chart::rough_distance(here.data(), last.data());
            consider(behind, here.data(), least, near);
            consider(ahead, here.data(), least, near);
            near = near < 0 ? fallback_ : near;
            visit(items_[k].point(), near);
            last = here;
        }
    }

  private:
    static constexpr std::size_t few = 16;  // so many queries are compared with all landmarks

    bool is_query(std::size_t k) const { return items_[k].point() < queries_; }

    template <class Visit>
    void travel_without(std::size_t begin, std::size_t end, Visit&& visit) const {
        Index near = -1;
        for (std::size_t k = begin; k < end; ++k) {
            if (k == begin || queries_ <= few) {
                near = landmarks_.nearest(at_(items_[k].point()));
                near = near < 0 ? fallback_ : near;
            }
            visit(items_[k].point(), near);
        }
    }

    // Begin at the landmark of a station, if it seems nearer.
    void consider(std::size_t station, const double* here, double& least, Index& near) const {
        if (station < items_.size() && !is_query(station)) {
            const std::size_t landmark = items_[station].point() - queries_;
            const double distance = Chart::rough_distance(here, landmarks_.vector(landmark));
            if (distance < least) {
                least = distance;
                near = landmarks_.triangle(landmark);
            }
        }
    }

    At at_;
    std::size_t queries_;
    Index fallback_;
    bool sorted_landmarks_;
    Landmarks<Chart> landmarks_;
    Buffer<KeyedPoint> items_;
};

}  // namespace stereodel::order
