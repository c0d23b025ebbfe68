// Points of the plane or the sphere by number, as graphs on a triangulation ask them: which of two distances is larger,
// which point lies in which diametral circle, which comes first.
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "predicates/plane_predicates.hpp"
#include "predicates/ray_lengths.hpp"
#include "predicates/ray_predicates.hpp"

namespace stereodel::graphs {

namespace plane = predicates::plane;
namespace rays = predicates::rays;

class PlaneSites {
  public:
    PlaneSites(const double* xy, std::size_t size);

    // The square of a length, rounded; which of two such squares is smaller, if that is certain. Where all roundings
    // are seen to be none it is, ties included: see `exact_up_to_`.
    double square(Index a, Index b) const { return plane::squared_length(at(a), at(b)); }
    Sign compare_squares(double aa, double bb) const {
        return aa + bb <= exact_up_to_ ? sign_of(aa - bb) : plane::compare_squares(aa, bb);
    }

    // Sign of |ab| - |cd|.
    int compare_lengths(Index a, Index b, Index c, Index d) const {
        const Sign sign = compare_squares(square(a, b), square(c, d));
        return sign != OPEN ? sign : compare_lengths_open(a, b, c, d);
    }

    // 1 if p lies outside the circle with the diameter ab, 0 on it, -1 inside.
    int diametral(Index a, Index b, Index p) const;

    // Lexicographic order: -1, 0, 1.
    int compare(Index a, Index b) const;

  private:
    const double* at(Index a) const { return xy_ + 2 * static_cast<std::size_t>(a); }
    int compare_lengths_open(Index a, Index b, Index c, Index d) const;

    const double* xy_;
    // Coordinates that are multiples of g have differences, squares and sums of two squares that are multiples of g or
    // g^2, and exact below 2^53 times that; 2^52 leaves room for the roundings of what is compared with it. Negative
    // without such a grid.
    double exact_up_to_;
};

class SphereSites {
  public:
    SphereSites(const double* xyz, std::size_t size);

    // The square of a chord, rounded; which of two such squares is smaller, if that is certain.
    double square(Index a, Index b) const {
        if (!unit_) {
            return rays::squared_chord(direction(a), direction(b));
        }
        const double *p = at(a), *q = at(b);
        const double gap[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
        return rays::dot_form(gap, gap);
    }
    Sign compare_squares(double aa, double bb) const { return rays::compare_squared_chords(aa, bb); }

    // Sign of the angle between a and b less that between c and d.
    int compare_lengths(Index a, Index b, Index c, Index d) const {
        const Sign sign = compare_squares(square(a, b), square(c, d));
        return sign != OPEN ? sign : compare_lengths_open(a, b, c, d);
    }

    // 1 if p lies outside the smaller bubble that has a and b as ends of a diameter, 0 on its circle, -1 inside; 0 for
    // all p if a and b are opposite.
    int diametral(Index a, Index b, Index p) const;

    // Lexicographic order of directions: -1, 0, 1.
    int compare(Index a, Index b) const { return rays::compare(at(a), at(b), unit_); }

  private:
    const double* at(Index a) const { return xyz_ + 3 * static_cast<std::size_t>(a); }
    rays::Direction direction(Index a) const {
        return unit_ ? rays::Direction(at(a)) : directions_[static_cast<std::size_t>(a)];
    }
    int compare_lengths_open(Index a, Index b, Index c, Index d) const;

    const double* xyz_;
    bool unit_;
    std::vector<rays::Direction> directions_;  // of vectors that are not all of length one
};

// Of points with so many coordinates.
template <std::size_t Width>
using SitesOf = std::conditional_t<Width == 2, PlaneSites, SphereSites>;

}  // namespace stereodel::graphs
