// The public predicates for Python: arrays of points in, signs out.
#include "predicates/predicate_rows.hpp"
#include "python/arrays.hpp"

namespace stereodel::python {

namespace signs = predicates::signs;

namespace {

using namespace nb::literals;

constexpr std::size_t long_work = 20000;  // rows: some milliseconds

template <class Rows>
signs::PointRows to_points(const char* name, const Rows& rows) {
    return {name, rows.data(), rows.shape(0)};
}

using OfThree = void(signs::PointRows, signs::PointRows, signs::PointRows, std::int8_t*, int, Stop);
using OfFour = void(signs::PointRows, signs::PointRows, signs::PointRows, signs::PointRows, std::int8_t*, int, Stop);

template <class Fill>
ValuesOut<std::int8_t> filled_signs(std::size_t count, Fill&& fill) {
    return to_values(filled<std::int8_t>(count, count > long_work, fill));
}

template <std::size_t Width, OfThree& predicate>
ValuesOut<std::int8_t> of_three(RowsIn<double, Width> a, RowsIn<double, Width> b, RowsIn<double, Width> c,
                                int workers) {
    const signs::PointRows p = to_points("a", a), q = to_points("b", b), r = to_points("c", c);
    return filled_signs(signs::common_count({p, q, r}), [&](std::int8_t* out, Stop stop) {
        predicate(p, q, r, out, workers, stop);
    });
}

// The last point: d, or p among directions.
template <std::size_t Width, OfFour& predicate>
ValuesOut<std::int8_t> of_four(RowsIn<double, Width> a, RowsIn<double, Width> b, RowsIn<double, Width> c,
                               RowsIn<double, Width> d, int workers) {
    const char* const last = &predicate == &signs::in_bubble ? "p" : "d";
    const signs::PointRows p = to_points("a", a), q = to_points("b", b), r = to_points("c", c), s = to_points(last, d);
    return filled_signs(signs::common_count({p, q, r, s}), [&](std::int8_t* out, Stop stop) {
        predicate(p, q, r, s, out, workers, stop);
    });
}

ValuesOut<std::int8_t> compare_directions(RowsIn<double, 3> a, RowsIn<double, 3> b, int workers) {
    const signs::PointRows p = to_points("a", a), q = to_points("b", b);
    return filled_signs(signs::common_count({p, q}), [&](std::int8_t* out, Stop stop) {
        signs::compare(p, q, out, workers, stop);
    });
}

void bind_plane(nb::module_& plane) {
    plane.def("turn", of_three<2, signs::orient2d>, "a"_a, "b"_a, "c"_a, "workers"_a = 1,
              "Exact signs (n,) for rows of points: 1 counterclockwise, -1 clockwise, 0 on one line. One row alone "
              "stands for as many as the others have.");
    plane.def("in_circle", of_four<2, signs::incircle>, "a"_a, "b"_a, "c"_a, "d"_a, "workers"_a = 1,
              "The same: 1 if d lies inside the circle of a counterclockwise triangle a b c.");
}

void bind_sphere(nb::module_& sphere) {
    sphere.def("turn", of_three<3, signs::turn>, "a"_a, "b"_a, "c"_a, "workers"_a = 1,
               "The same for directions: 1 if c lies to the left of the great circle from a to b.");
    sphere.def("in_circle", of_four<3, signs::in_bubble>, "a"_a, "b"_a, "c"_a, "p"_a, "workers"_a = 1,
               "The same: 1 if p lies in the open bubble of a b c.");
    sphere.def("compare", compare_directions, "a"_a, "b"_a, "workers"_a = 1,
               "The lexicographic order of directions: -1, 0 or 1 for each row.");
}

}  // namespace

void bind_predicates(Modules& modules) {
    modules.both.def("orient3d", of_four<3, signs::orient3d>, "a"_a, "b"_a, "c"_a, "d"_a, "workers"_a = 1,
                     "Exact signs of det[b-a c-a d-a] for rows of points of space.");
    bind_plane(modules.plane);
    bind_sphere(modules.sphere);
}

}  // namespace stereodel::python
