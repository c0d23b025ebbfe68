#include "graphs/sites.hpp"

#include "predicates/ray_integers.hpp"
#include "predicates/symmetry.hpp"

namespace stereodel::graphs {

using predicates::all_unit;
using predicates::common_granularity;
using predicates::equal_by_symmetry_in_plane;
using predicates::equal_by_symmetry_on_sphere;
using rays::Direction;

PlaneSites::PlaneSites(const double* xy, std::size_t size) : xy_(xy) {
    const double g = common_granularity(xy, size);
    exact_up_to_ = g > 0.0 ? 0x1p52 * (g * g) : -1.0;
}

int PlaneSites::compare_lengths_open(Index a, Index b, Index c, Index d) const {
    if (equal_by_symmetry_in_plane(at(a), at(b), at(c), at(d))) {
        return 0;
    }
    const Sign sign = plane::distances_double_double(at(a), at(b), at(c), at(d));
    return sign != OPEN ? sign : plane::distances_exact(at(a), at(b), at(c), at(d));
}

int PlaneSites::diametral(Index a, Index b, Index p) const {
    const plane::Estimate e = plane::diametral_estimate(at(a), at(b), at(p));
    Sign sign = e.permanent <= exact_up_to_ ? sign_of(e.value) : decide(e.value, e.bound);
    if (sign == OPEN) {
        sign = plane::diametral_double_double(at(a), at(b), at(p));
    }
    return sign != OPEN ? sign : plane::diametral_exact(at(a), at(b), at(p));
}

int PlaneSites::compare(Index a, Index b) const {
    const double *p = at(a), *q = at(b);
    const int k = p[0] != q[0] ? 0 : 1;
    return (p[k] > q[k]) - (p[k] < q[k]);
}

SphereSites::SphereSites(const double* xyz, std::size_t size) : xyz_(xyz), unit_(all_unit(xyz, size)) {
    if (!unit_) {
        directions_.reserve(size);
        for (std::size_t k = 0; k < size; ++k) {
            directions_.emplace_back(xyz + 3 * k);
        }
    }
}

int SphereSites::compare_lengths_open(Index a, Index b, Index c, Index d) const {
    if (equal_by_symmetry_on_sphere(at(a), at(b), at(c), at(d)) ||
        equal_by_symmetry_on_sphere(at(a), at(b), at(d), at(c))) {
        return 0;
    }
    const Sign sign = rays::compare_lengths_double_double(direction(a), direction(b), direction(c), direction(d));
    return sign != OPEN ? sign : rays::compare_lengths_exact(at(a), at(b), at(c), at(d));
}

int SphereSites::diametral(Index a, Index b, Index p) const {
    Sign sign = unit_ ? rays::diametral_filter(at(a), at(b), at(p)) : OPEN;
    if (sign != OPEN) {
        return sign;
    }
    const Direction da = direction(a), db = direction(b), dp = direction(p);
    sign = unit_ ? OPEN : rays::diametral_filter(da, db, dp);
    if (sign == OPEN) {
        sign = rays::diametral_double_double(da, db, dp);
    }
    return sign != OPEN ? sign : rays::diametral_exact(at(a), at(b), at(p));
}

}  // namespace stereodel::graphs
