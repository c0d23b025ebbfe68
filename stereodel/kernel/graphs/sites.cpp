#include "graphs/sites.hpp"

#include <algorithm>
#include <utility>

#include "arithmetic/double_double.hpp"
#include "predicates/ray_integers.hpp"

namespace stereodel::graphs {

using arithmetic::DoubleDouble;
using arithmetic::two_difference;
using predicates::all_unit;
using predicates::common_granularity;

using rays::Direction;

namespace {

// The exact size of a difference as the unevaluated sum of two doubles.
std::pair<double, double> step(double from, double to) {
    const DoubleDouble d = two_difference(std::max(from, to), std::min(from, to));
    return {d.hi, d.lo};
}

// Whether the steps along the axes are the same for ab and cd, perhaps exchanged: the ties of lattices.
bool has_same_steps(const double* a, const double* b, const double* c, const double* d) {
    const auto x = step(a[0], b[0]), y = step(a[1], b[1]), u = step(c[0], d[0]), v = step(c[1], d[1]);
    return (x == u && y == v) || (x == v && y == u);
}

}  // namespace

PlaneSites::PlaneSites(const double* xy, std::size_t size) : xy_(xy) {
    const double g = common_granularity(xy, size);
    exact_up_to_ = g > 0.0 ? 0x1p52 * (g * g) : -1.0;
}

int PlaneSites::compare_lengths_open(Index a, Index b, Index c, Index d) const {
    if (has_same_steps(at(a), at(b), at(c), at(d))) {
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
    if (rays::equal_by_symmetry(at(a), at(b), at(c), at(d))) {
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
