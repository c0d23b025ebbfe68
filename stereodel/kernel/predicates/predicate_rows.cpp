#include "predicates/predicate_rows.hpp"

#include <stdexcept>
#include <string>

#include "input_checks.hpp"
#include "predicates/plane_predicates.hpp"
#include "predicates/ray_predicates.hpp"
#include "predicates/space_predicates.hpp"

namespace stereodel::predicates::signs {

namespace {

// Checked points, of which one may stand for all.
template <std::size_t Width>
class Argument {
  public:
    explicit Argument(PointRows rows) : rows_(rows), step_(rows.count == 1 ? 0 : Width) {
        check_finite(rows.name, rows.coordinates, rows.count, Width);
    }

    const double* operator[](std::size_t k) const { return rows_.coordinates + step_ * k; }
    PointRows rows() const { return rows_; }

  private:
    PointRows rows_;
    std::size_t step_;
};

struct Directions : Argument<3> {
    explicit Directions(PointRows given) : Argument<3>(given) {
        check_directions(given.name, given.coordinates, given.count);
    }

    bool are_unit() const { return all_unit(rows().coordinates, rows().count); }
};

// sign(k) for all rows. Each may take microseconds, where integers decide.
template <class Sign>
void fill(std::size_t count, std::int8_t* signs, int workers, Stop stop, Sign&& sign) {
    Crew crew(useful_workers(workers, count));
    constexpr std::size_t grain = 1024;
    in_grains(count, grain, crew, [&](std::size_t begin, std::size_t end) {
        check(stop);
        for (std::size_t k = begin; k < end; ++k) {
            signs[k] = static_cast<std::int8_t>(sign(k));
        }
    });
}

// A few points side by side, with a grid of their own: exact ties of whole numbers need no integers then.
template <class... Points>
struct Gathered {
    static constexpr std::size_t count = sizeof...(Points);
    double xy[2 * count];

    explicit Gathered(Points... points) {
        std::size_t k = 0;
        ((xy[k] = points[0], xy[k + 1] = points[1], k += 2), ...);
    }

    PlanePoints on_grid() const { return {xy, common_granularity(xy, count)}; }
};

int orient_sign(const double* a, const double* b, const double* c) {
    const plane::Estimate e = plane::orient_estimate(a, b, c);
    const Sign sign = decide(e.value, e.bound);
    return sign != OPEN ? sign : Gathered(a, b, c).on_grid().orient(0, 1, 2);
}

int incircle_sign(const double* a, const double* b, const double* c, const double* d) {
    const plane::Estimate e = plane::incircle_estimate(a, b, c, d);
    const Sign sign = decide(e.value, e.bound);
    return sign != OPEN ? sign : Gathered(a, b, c, d).on_grid().incircle(0, 1, 2, 3);
}

}  // namespace

std::size_t common_count(std::initializer_list<PointRows> points) {
    const PointRows* longest = points.begin();
    for (const PointRows& rows : points) {
        if (longest->count == 1) {
            longest = &rows;
        }
        if (rows.count != 1 && rows.count != longest->count) {
            throw std::invalid_argument(std::string(rows.name) + " has " + std::to_string(rows.count) + " rows, but " +
                                        longest->name + " has " + std::to_string(longest->count) +
                                        "; all must have as many, or one");
        }
    }
    return longest->count;
}

void orient2d(PointRows a, PointRows b, PointRows c, std::int8_t* signs, int workers, Stop stop) {
    const Argument<2> p(a), q(b), r(c);
    fill(common_count({a, b, c}), signs, workers, stop,
         [&](std::size_t k) { return orient_sign(p[k], q[k], r[k]); });
}

void incircle(PointRows a, PointRows b, PointRows c, PointRows d, std::int8_t* signs, int workers, Stop stop) {
    const Argument<2> p(a), q(b), r(c), s(d);
    fill(common_count({a, b, c, d}), signs, workers, stop,
         [&](std::size_t k) { return incircle_sign(p[k], q[k], r[k], s[k]); });
}

void orient3d(PointRows a, PointRows b, PointRows c, PointRows d, std::int8_t* signs, int workers, Stop stop) {
    const Argument<3> p(a), q(b), r(c), s(d);
    fill(common_count({a, b, c, d}), signs, workers, stop,
         [&](std::size_t k) { return space::orient(p[k], q[k], r[k], s[k]); });
}

void in_bubble(PointRows a, PointRows b, PointRows c, PointRows p, std::int8_t* signs, int workers, Stop stop) {
    const Directions u(a), v(b), w(c), x(p);
    const bool unit = u.are_unit() && v.are_unit() && w.are_unit() && x.are_unit();
    fill(common_count({a, b, c, p}), signs, workers, stop, [&](std::size_t k) {
        Tally tally;
        return bubble(u[k], v[k], w[k], x[k], unit, tally);
    });
}

void turn(PointRows a, PointRows b, PointRows c, std::int8_t* signs, int workers, Stop stop) {
    const Directions u(a), v(b), w(c);
    const bool unit = u.are_unit() && v.are_unit() && w.are_unit();
    fill(common_count({a, b, c}), signs, workers, stop, [&](std::size_t k) {
        Tally tally;
        return predicates::turn(u[k], v[k], w[k], unit, tally);
    });
}

void compare(PointRows a, PointRows b, std::int8_t* signs, int workers, Stop stop) {
    const Directions u(a), v(b);
    const bool unit = u.are_unit() && v.are_unit();
    fill(common_count({a, b}), signs, workers, stop, [&](std::size_t k) { return rays::compare(u[k], v[k], unit); });
}

}  // namespace stereodel::predicates::signs
