#include "predicates/ray_predicates.hpp"

#include <algorithm>

#include "predicates/ray_integers.hpp"

namespace stereodel::predicates {

namespace {

using rays::Direction;

int counted(int sign, Tally& tally) {
    tally.exact += sign == 0;
    return sign;
}

Sign bubble_of_directions(const Direction& a, const Direction& b, const Direction& c, const Direction& p,
                          Tally& tally) {
    const plane::Estimate e = rays::bubble_estimate(a, b, c, p);
    const Sign sign = decide(e.value, e.bound);
    if (sign != OPEN) {
        return sign;
    }
    ++tally.curvature;
    return rays::bubble_double_double(a, b, c, p);
}

Sign turn_of_directions(const Direction& a, const Direction& b, const Direction& c, Tally& tally) {
    const Sign sign = rays::turn_filter(a, b, c);
    if (sign != OPEN) {
        return sign;
    }
    ++tally.filter;
    return rays::turn_double_double(a, b, c);
}

// Four points of a great circle: the cofactor of column k is (-1)^k times the area of the triangle of the others, seen
// along axis k. Whether that is zero depends on the normal of the plane alone, so the first axis that counts is the
// same for all.
int great_circle_tie(const double* const* others, bool unit) {
    for (int axis = 0; axis < 3; ++axis) {
        if (const int sign = rays::shadow(others[0], others[1], others[2], axis, unit)) {
            return axis == 1 ? -sign : sign;
        }
    }
    return 1;  // fewer than three directions: excluded by contract
}

}  // namespace

bool all_unit(const double* xyz, std::size_t count) {
    bool unit = true;
    for (std::size_t k = 0; k < count; ++k) {
        unit &= rays::is_unit(xyz + 3 * k);
    }
    return unit;
}

int bubble_open(const double* a, const double* b, const double* c, const double* p, bool unit, Tally& tally) {
    if (rays::cocircular_by_symmetry(a, b, c, p)) {
        return counted(0, tally);
    }
    Sign sign = OPEN;
    if (unit) {
        ++tally.curvature;
        sign = rays::bubble_double_double(a, b, c, p);
    } else if (sign = rays::bubble_units(a, b, c, p); sign != OPEN) {
        return counted(sign, tally);
    } else {
        sign = bubble_of_directions(Direction(a), Direction(b), Direction(c), Direction(p), tally);
    }
    if (sign != OPEN) {
        return sign;
    }
    ++tally.double_double;
    return counted(rays::bubble_exact(a, b, c, p), tally);
}

bool in_bubble_open(const double* a, const double* b, const double* c, const double* p, bool unit, int first,
                    Tally& tally) {
    const int sign = bubble_open(a, b, c, p, unit, tally);
    return (sign != 0 ? sign : bubble_tie(a, b, c, p, unit, first)) > 0;
}

// The test is minus the determinant with rows (x, y, z, 1) of the unit vectors; moving p to p(1 + e) is, up to a
// positive factor of its row, moving the 1 to 1 - e. The cofactor of that entry of the first point in the order is
// (-1)^(its row + 1) times the turn of the others. Three points of a small circle are independent: the first point
// decides there.
int bubble_tie(const double* a, const double* b, const double* c, const double* p, bool unit, int first) {
    const double* points[] = {a, b, c, p};
    if (first < 0) {
        first = static_cast<int>(std::min_element(points, points + 4,
                                                  [unit](const double* u, const double* v) {
                                                      return rays::compare(u, v, unit) < 0;
                                                  }) -
                                 points);
    }
    std::copy(points + first + 1, points + 4, points + first);
    const int sign = displaced_turn(points[0], points[1], points[2], unit);
    return first % 2 == 0 ? -sign : sign;
}

int displaced_turn(const double* a, const double* b, const double* c, bool unit) {
    Tally uncounted;
    const double* const points[] = {a, b, c};
    const int sign = turn(a, b, c, unit, uncounted);
    return sign != 0 ? sign : great_circle_tie(points, unit);
}

int turn_open(const double* a, const double* b, const double* c, bool unit, Tally& tally) {
    if (rays::on_mirror(a, b, c)) {
        return counted(0, tally);
    }
    Sign sign = OPEN;
    if (unit) {
        ++tally.filter;
        sign = rays::turn_double_double(a, b, c);
    } else if (sign = rays::turn_units(a, b, c); sign != OPEN) {
        return counted(sign, tally);
    } else {
        sign = turn_of_directions(Direction(a), Direction(b), Direction(c), tally);
    }
    if (sign != OPEN) {
        return sign;
    }
    ++tally.double_double;
    return counted(rays::turn_exact(a, b, c), tally);
}

int compare_angles(const double* q, const double* a, const double* b, Tally& tally) {
    const Direction dq(q), da(a), db(b);
    Sign sign = rays::compare_angles_filter(dq, da, db);
    if (sign != OPEN) {
        return sign;
    }
    ++tally.filter;
    sign = rays::compare_angles_double_double(dq, da, db);
    if (sign != OPEN) {
        return sign;
    }
    ++tally.double_double;
    return counted(rays::compare_angles_exact(q, a, b), tally);
}

}  // namespace stereodel::predicates
