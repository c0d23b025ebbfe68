// The predicates on directions by number: the answers of exact arithmetic on the rays through the given doubles.
//
// in_bubble: inside the circle of a, b, c that appear counterclockwise from outside the hull; turn > 0: c left of the
// great circle from a to b. Ties are decided by infinitesimal displacement (tests/reference.py): directions
// move outward, the more the earlier they stand in lexicographic order; four of a great circle move along x, then y,
// then z.
#pragma once

#include <cstddef>

#include "predicates/ray_order.hpp"
#include "predicates/ray_stages.hpp"
#include "tally.hpp"

namespace stereodel::predicates {

// Whether every length is within 2^-49 of 1, so that the vectors can be taken as they stand.
bool all_unit(const double* xyz, std::size_t count);

// What the filters below leave open, or all that is asked of vectors that are not of length one.
int bubble_open(const double* a, const double* b, const double* c, const double* p, bool unit, Tally& tally);
bool in_bubble_open(const double* a, const double* b, const double* c, const double* p, bool unit, int first,
                    Tally& tally);
int turn_open(const double* a, const double* b, const double* c, bool unit, Tally& tally);

// For four different directions of one circle: 1 or -1. `first`: the place (0..3) of an artificial pole that comes
// before all others in the order of displacement, -1 = none.
int bubble_tie(const double* a, const double* b, const double* c, const double* p, bool unit, int first);

// Whether displacements of three different directions lead out of the hull (1) or into it (-1) on the side from which
// they appear counterclockwise. Ties of great circles are turned by the first component of the normal that is not zero.
int displaced_turn(const double* a, const double* b, const double* c, bool unit);

// The predicates on vectors. unit: every length within 2^-49 of 1.
inline int bubble(const double* a, const double* b, const double* c, const double* p, bool unit, Tally& tally) {
    if (unit) {
        const plane::Estimate e = rays::bubble_estimate(a, b, c, p);
        const Sign sign = decide(e.value, e.bound);
        if (sign != OPEN) {
            return sign;
        }
    }
    return bubble_open(a, b, c, p, unit, tally);
}

inline bool in_bubble(const double* a, const double* b, const double* c, const double* p, bool unit, int first,
                      Tally& tally) {
    if (unit) {
        const plane::Estimate e = rays::bubble_estimate(a, b, c, p);
        if (e.value > e.bound) {
            return true;
        }
        if (e.value < -e.bound) {
            return false;
        }
    }
    return in_bubble_open(a, b, c, p, unit, first, tally);
}

inline int turn(const double* a, const double* b, const double* c, bool unit, Tally& tally) {
    if (unit) {
        const Sign sign = rays::turn_filter(a, b, c);
        if (sign != OPEN) {
            return sign;
        }
    }
    return turn_open(a, b, c, unit, tally);
}

// Sign of the angle between q and a less that between q and b.
int compare_angles(const double* q, const double* a, const double* b, Tally& tally);

// A cheap view of the vectors; every thread has its own, with its own tally.
class Rays {
  public:
    // unit: every length within 2^-49 of 1.
    Rays(const double* xyz, bool unit) : xyz_(xyz), unit_(unit) {}

    const double* at(Index a) const { return xyz_ + 3 * static_cast<std::ptrdiff_t>(a); }
    bool unit() const { return unit_; }

    // Four different directions; ties are displaced.
    bool in_bubble(Index a, Index b, Index c, Index p) {
        return predicates::in_bubble(at(a), at(b), at(c), at(p), unit_, -1, tally);
    }

    // Exact sign, ties stay 0.
    int bubble(Index a, Index b, Index c, Index p) {
        return predicates::bubble(at(a), at(b), at(c), at(p), unit_, tally);
    }

    // Sign of det[a b c].
    int turn(Index a, Index b, Index c) { return predicates::turn(at(a), at(b), at(c), unit_, tally); }

    // query: any length.
    int turn(Index a, Index b, const double* query) {
        const double square = rays::dot_form(query, query);
        return predicates::turn(at(a), at(b), query, unit_ && square > 0.3 && square < 3.9, tally);
    }

    // Lexicographic order of directions, 0 = the same direction.
    int compare(Index a, Index b) { return rays::compare(at(a), at(b), unit_); }

    // Sign of the angle between the query and a less that between the query and b.
    int compare_distances(const double* query, Index a, Index b) {
        return compare_angles(query, at(a), at(b), tally);
    }

    Tally tally;

  private:
    const double* xyz_;
    bool unit_;
};

}  // namespace stereodel::predicates
