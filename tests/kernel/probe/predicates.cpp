// The predicates for Python: arrays of points in, signs out (int8; 2 = the stage that was asked leaves it open). They
// serve the tests, stage by stage; the triangulations call the predicates from C++.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <stdexcept>

#include "arithmetic/ball.hpp"
#include "arithmetic/integer_quotients.hpp"
#include "arithmetic/roots.hpp"
#include "predicates/plane_predicates.hpp"
#include "predicates/ray_integers.hpp"
#include "predicates/ray_predicates.hpp"
#include "predicates/space_predicates.hpp"
#include "stages.hpp"

namespace stereodel::probe {

namespace plane = predicates::plane;
namespace rays = predicates::rays;
namespace space = predicates::space;
using arithmetic::Ball;
using arithmetic::BigInteger;
using arithmetic::RootTerm;
using arithmetic::integer_root;
using arithmetic::round_quotient;
using arithmetic::sign_of_roots;
using predicates::PlanePoints;
using predicates::Rays;
using predicates::bubble;
using predicates::common_granularity;
using predicates::in_bubble;
using predicates::turn;

namespace {

using namespace nb::literals;
using rays::Direction;

// A few points side by side, so that the predicate on numbers 0, 1, ... sees them.
template <std::size_t COUNT>
struct Gathered {
    double xy[2 * COUNT];

    template <class... Points>
    explicit Gathered(const Points*... points) {
        std::size_t k = 0;
        ((xy[k] = points[0], xy[k + 1] = points[1], k += 2), ...);
    }

    PlanePoints view() const { return {xy, 0.0}; }
};

// The last stage ---------------------------------------------------------------------------------------------------

// An integer from its digits to the base 2^30, the highest first.
BigInteger from_digits(const std::vector<std::int64_t>& digits) {
    BigInteger result;
    for (const std::int64_t digit : digits) {
        result = result.shifted(30) + BigInteger(digit);
    }
    return result;
}

using Digits = std::vector<std::int64_t>;

int sign_of_root_sum(const std::vector<std::tuple<Digits, Digits>>& terms) {
    if (terms.size() > 4) {
        throw std::invalid_argument("terms: at most four");
    }
    std::vector<RootTerm> sum;
    for (const auto& [coefficient, radicand] : terms) {
        sum.push_back({from_digits(coefficient), from_digits(radicand)});
    }
    return sign_of_roots(sum.data(), static_cast<int>(sum.size()));
}

double quotient(const Digits& numerator, const Digits& denominator, std::int64_t exponent) {
    const BigInteger divisor = from_digits(denominator);
    if (divisor.sign() == 0) {
        throw std::invalid_argument("denominator: zero");
    }
    return round_quotient(from_digits(numerator), divisor, static_cast<std::ptrdiff_t>(exponent));
}

// Whether the computed root is off by less than 1 in its last bit: (r - 1)^2 < n 2^-2e < (r + 1)^2, e its exponent.
bool root_is_close(const Digits& digits, std::size_t bits) {
    const BigInteger square = from_digits(digits);
    if (square.sign() <= 0 || bits < 54) {
        throw std::invalid_argument("a positive integer, and 54 bits or more");
    }
    const auto [root, exponent] = integer_root(square, bits);
    const auto up = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, -2 * exponent));
    const auto down = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, 2 * exponent));
    const BigInteger one(1), low = (root - one) * (root - one), high = (root + one) * (root + one);
    const BigInteger given = square.shifted(up);
    return root.bit_length() >= bits && (given - low.shifted(down)).sign() > 0 &&
           (high.shifted(down) - given).sign() > 0;
}

// A formula in balls, written with operands first: `v` takes the next value. Its middle in two parts, its radius,
// and the power of two that all are multiplied with.
std::tuple<double, double, double, int> evaluate_balls(const std::vector<double>& values, const std::string& formula) {
    std::vector<Ball> stack;
    std::size_t next = 0;
    const auto pop = [&stack] {
        if (stack.empty()) {
            throw std::invalid_argument("formula: too few operands");
        }
        const Ball top = stack.back();
        stack.pop_back();
        return top;
    };
    for (const char symbol : formula) {
        if (symbol == 'v') {
            stack.emplace_back(values.at(next++));
        } else {
            const Ball b = pop(), a = pop();
            stack.push_back(symbol == '+' ? a + b : symbol == '-' ? a - b : symbol == '*' ? a * b : a / b);
        }
    }
    const Ball result = pop();
    return {result.middle().hi, result.middle().lo, result.radius(), result.power()};
}

// The plane ----------------------------------------------------------------------------------------------------------

Signs orient2d(const PlaneArray& a, const PlaneArray& b, const PlaneArray& c, const std::string& stage) {
    const Stage only = stage_of(stage);
    return over_rows(common_rows(a, b, c), [&](std::size_t k) {
        const double *p = row(a, k), *q = row(b, k), *r = row(c, k);
        const plane::Estimate e = plane::orient_estimate(p, q, r);
        return by_stage(
            only, [&] { return Gathered<3>(p, q, r).view().orient(0, 1, 2); }, [&] { return decide(e.value, e.bound); },
            [&] { return plane::orient_double_double(p, q, r); },
            [&] { return plane::orient_exact(p, q, r); });
    });
}

Signs incircle(const PlaneArray& a, const PlaneArray& b, const PlaneArray& c, const PlaneArray& d,
               const std::string& stage) {
    const Stage only = stage_of(stage);
    return over_rows(common_rows(a, b, c, d), [&](std::size_t k) {
        const double *p = row(a, k), *q = row(b, k), *r = row(c, k), *s = row(d, k);
        const plane::Estimate e = plane::incircle_estimate(p, q, r, s);
        return by_stage(
            only, [&] { return Gathered<4>(p, q, r, s).view().incircle(0, 1, 2, 3); },
            [&] { return decide(e.value, e.bound); }, [&] { return plane::incircle_double_double(p, q, r, s); },
            [&] { return plane::incircle_exact(p, q, r, s); });
    });
}

Signs orient3d(const SpaceArray& a, const SpaceArray& b, const SpaceArray& c, const SpaceArray& d,
               const std::string& stage) {
    const Stage only = stage_of(stage);
    return over_rows(common_rows(a, b, c, d), [&](std::size_t k) {
        const double *p = row(a, k), *q = row(b, k), *r = row(c, k), *s = row(d, k);
        switch (only) {
            case Stage::filter: return space::orient_filter(p, q, r, s);
            case Stage::double_double: return space::orient_double_double(p, q, r, s);
            case Stage::exact: return space::orient_exact(p, q, r, s);
            default: return space::orient(p, q, r, s);
        }
    });
}

Signs compare_distances(const PlaneArray& q, const PlaneArray& a, const PlaneArray& b, const std::string& stage) {
    const Stage only = stage_of(stage);
    return over_rows(common_rows(q, a, b), [&](std::size_t k) {
        const double *query = row(q, k), *p = row(a, k), *r = row(b, k);
        const plane::Estimate e = plane::distance_estimate(query, p, query, r);
        return by_stage(
            only, [&] { return Gathered<2>(p, r).view().compare_distances(query, 0, 1); },
            [&] { return decide(e.value, e.bound); },
            [&] { return plane::distances_double_double(query, p, query, r); },
            [&] { return plane::distances_exact(query, p, query, r); });
    });
}

// By number, on the grid of the points: what the triangulations call. Signs, and the tests that the stages left open.
std::tuple<Signs, TallyTuple> orient_numbered(const PlaneArray& points, const Numbers& numbers) {
    check_numbers(numbers, 3, points.shape(0));
    PlanePoints view(points.data(), common_granularity(points.data(), points.shape(0)));
    Signs signs = over_rows(numbers.shape(0), [&](std::size_t k) {
        const Index* n = numbers.data() + 3 * k;
        return view.orient(n[0], n[1], n[2]);
    });
    return {signs, as_tuple(view.tally)};
}

std::tuple<Signs, TallyTuple> incircle_numbered(const PlaneArray& points, const Numbers& numbers, bool displaced) {
    check_numbers(numbers, 4, points.shape(0));
    PlanePoints view(points.data(), common_granularity(points.data(), points.shape(0)));
    Signs signs = over_rows(numbers.shape(0), [&](std::size_t k) -> int {
        const Index* n = numbers.data() + 4 * k;
        return displaced ? view.in_circle(n[0], n[1], n[2], n[3]) : view.incircle(n[0], n[1], n[2], n[3]);
    });
    return {signs, as_tuple(view.tally)};
}

double granularity(const PlaneArray& points) {
    return common_granularity(points.data(), points.shape(0));
}

// Directions ---------------------------------------------------------------------------------------------------------

Signs bubble_rows(const SpaceArray& a, const SpaceArray& b, const SpaceArray& c, const SpaceArray& p,
                  std::optional<bool> unit, const std::string& stage) {
    const Stage only = stage_of(stage);
    const bool plain = decide_unit(unit, a, b, c, p);
    return over_rows(common_rows(a, b, c, p), [&](std::size_t k) {
        const double *u = row(a, k), *v = row(b, k), *w = row(c, k), *x = row(p, k);
        const Direction du(u), dv(v), dw(w), dx(x);
        const plane::Estimate e = plain ? rays::bubble_estimate(u, v, w, x) : rays::bubble_estimate(du, dv, dw, dx);
        Tally tally;
        return by_stage(
            only, [&] { return bubble(u, v, w, x, plain, tally); }, [&] { return decide(e.value, e.bound); },
            [&] { return plain ? rays::bubble_double_double(u, v, w, x) : rays::bubble_double_double(du, dv, dw, dx); },
            [&] { return rays::bubble_exact(u, v, w, x); });
    });
}

Signs bubble_plane_rows(const SpaceArray& a, const SpaceArray& b, const SpaceArray& c, const SpaceArray& p) {
    if (!decide_unit({}, a, b, c, p)) {
        throw std::invalid_argument("vectors must have length one");
    }
    return over_rows(common_rows(a, b, c, p), [&](std::size_t k) {
        return rays::BubblePlane(row(a, k), row(b, k), row(c, k)).side(row(a, k), row(p, k));
    });
}

Signs in_bubble_rows(const SpaceArray& a, const SpaceArray& b, const SpaceArray& c, const SpaceArray& p,
                     std::optional<bool> unit, int first) {
    const bool plain = decide_unit(unit, a, b, c, p);
    Tally tally;
    return over_rows(common_rows(a, b, c, p), [&](std::size_t k) {
        return in_bubble(row(a, k), row(b, k), row(c, k), row(p, k), plain, first, tally);
    });
}

std::tuple<Signs, TallyTuple> bubble_numbered(const SpaceArray& vectors, const Numbers& numbers, bool displaced,
                                              std::optional<bool> unit) {
    check_numbers(numbers, 4, vectors.shape(0));
    Rays view(vectors.data(), decide_unit(unit, vectors));
    Signs signs = over_rows(numbers.shape(0), [&](std::size_t k) -> int {
        const Index* n = numbers.data() + 4 * k;
        return displaced ? view.in_bubble(n[0], n[1], n[2], n[3]) : view.bubble(n[0], n[1], n[2], n[3]);
    });
    return {signs, as_tuple(view.tally)};
}

Signs turn_rows(const SpaceArray& a, const SpaceArray& b, const SpaceArray& c, std::optional<bool> unit,
                const std::string& stage) {
    const Stage only = stage_of(stage);
    const bool plain = decide_unit(unit, a, b, c);
    return over_rows(common_rows(a, b, c), [&](std::size_t k) {
        const double *u = row(a, k), *v = row(b, k), *w = row(c, k);
        const Direction du(u), dv(v), dw(w);
        Tally tally;
        return by_stage(
            only, [&] { return turn(u, v, w, plain, tally); },
            [&] { return plain ? rays::turn_filter(u, v, w) : rays::turn_filter(du, dv, dw); },
            [&] { return plain ? rays::turn_double_double(u, v, w) : rays::turn_double_double(du, dv, dw); },
            [&] { return rays::turn_exact(u, v, w); });
    });
}

// Great circles through two vectors by number, and queries of any length.
Signs turn_queries(const SpaceArray& vectors, const Numbers& numbers, const SpaceArray& queries,
                   std::optional<bool> unit) {
    check_numbers(numbers, 2, vectors.shape(0));
    Rays view(vectors.data(), decide_unit(unit, vectors));
    return over_rows(common_rows(queries, numbers), [&](std::size_t k) {
        return view.turn(numbers.data()[2 * k], numbers.data()[2 * k + 1], row(queries, k));
    });
}

Signs compare_directions(const SpaceArray& a, const SpaceArray& b, std::optional<bool> unit) {
    const bool plain = decide_unit(unit, a, b);
    return over_rows(common_rows(a, b), [&](std::size_t k) { return rays::compare(row(a, k), row(b, k), plain); });
}

Signs compare_component(const SpaceArray& a, const SpaceArray& b, int axis, std::optional<bool> unit,
                        const std::string& stage) {
    const Stage only = stage_of(stage);
    const bool plain = decide_unit(unit, a, b);
    return over_rows(common_rows(a, b), [&](std::size_t k) {
        const double *u = row(a, k), *v = row(b, k);
        return by_stage(
            only, [&] { return rays::compare_component(u, v, axis, plain); },
            [&] { return plain ? rays::compare_component_filter(u, v, axis) : OPEN; },
            [&] { return rays::compare_component_double_double(u, v, axis); },
            [&] { return rays::compare_component_exact(u, v, axis); });
    });
}

Signs compare_angles(const SpaceArray& q, const SpaceArray& a, const SpaceArray& b, const std::string& stage) {
    const Stage only = stage_of(stage);
    return over_rows(common_rows(q, a, b), [&](std::size_t k) {
        const double *u = row(q, k), *v = row(a, k), *w = row(b, k);
        const Direction du(u), dv(v), dw(w);
        Tally tally;
        return by_stage(
            only, [&] { return predicates::compare_angles(u, v, w, tally); },
            [&] { return rays::compare_angles_filter(du, dv, dw); },
            [&] { return rays::compare_angles_double_double(du, dv, dw); },
            [&] { return rays::compare_angles_exact(u, v, w); });
    });
}

void bind_plane(nb::module_& m) {
    m.def("orient2d", &orient2d, "a"_a, "b"_a, "c"_a, "stage"_a = "all");
    m.def("incircle", &incircle, "a"_a, "b"_a, "c"_a, "d"_a, "stage"_a = "all");
    m.def("orient3d", &orient3d, "a"_a, "b"_a, "c"_a, "d"_a, "stage"_a = "all");
    m.def("compare_distances", &compare_distances, "q"_a, "a"_a, "b"_a, "stage"_a = "all");
    m.def("orient_numbered", &orient_numbered, "points"_a, "numbers"_a);
    m.def("incircle_numbered", &incircle_numbered, "points"_a, "numbers"_a, "displaced"_a);
    m.def("common_granularity", &granularity, "points"_a);
    m.def("sign_of_roots", &sign_of_root_sum, "terms"_a);
    m.def("round_quotient", &quotient, "numerator"_a, "denominator"_a, "exponent"_a);
    m.def("root_is_close", &root_is_close, "square"_a, "bits"_a);
    m.def("evaluate_balls", &evaluate_balls, "values"_a, "formula"_a);
}

void bind_rays(nb::module_& m) {
    const auto unknown = nb::none();
    m.def("bubble", &bubble_rows, "a"_a, "b"_a, "c"_a, "p"_a, "unit"_a = unknown, "stage"_a = "all");
    m.def("bubble_plane", &bubble_plane_rows, "a"_a, "b"_a, "c"_a, "p"_a);
    m.def("in_bubble", &in_bubble_rows, "a"_a, "b"_a, "c"_a, "p"_a, "unit"_a = unknown, "first"_a = -1);
    m.def("bubble_numbered", &bubble_numbered, "vectors"_a, "numbers"_a, "displaced"_a, "unit"_a = unknown);
    m.def("turn", &turn_rows, "a"_a, "b"_a, "c"_a, "unit"_a = unknown, "stage"_a = "all");
    m.def("turn_queries", &turn_queries, "vectors"_a, "numbers"_a, "queries"_a, "unit"_a = unknown);
    m.def("compare_directions", &compare_directions, "a"_a, "b"_a, "unit"_a = unknown);
    m.def("compare_component", &compare_component, "a"_a, "b"_a, "axis"_a, "unit"_a = unknown, "stage"_a = "all");
    m.def("compare_angles", &compare_angles, "q"_a, "a"_a, "b"_a, "stage"_a = "all");
    m.def(
        "all_unit", [](const SpaceArray& vectors) { return all_unit(vectors.data(), vectors.shape(0)); }, "vectors"_a);
}

}  // namespace

void bind_predicates(nb::module_& m) {
    bind_plane(m);
    bind_rays(m);
}

}  // namespace stereodel::probe
