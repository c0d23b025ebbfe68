// The public predicates for Python: arrays of points in, signs out.
#include "bind_support.hpp"
#include "predicate_rows.hpp"

namespace stereodel {

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
    constexpr const char* last = &predicate == &signs::in_bubble ? "p" : "d";
    const signs::PointRows p = to_points("a", a), q = to_points("b", b), r = to_points("c", c), s = to_points(last, d);
    return filled_signs(signs::common_count({p, q, r, s}), [&](std::int8_t* out, Stop stop) {
        predicate(p, q, r, s, out, workers, stop);
    });
}

}  // namespace

void bind_signs(nb::module_& module) {
    module.def("orient2d_signs", of_three<2, signs::orient2d>, "a"_a, "b"_a, "c"_a, "workers"_a = 1,
               "Exact signs (n,) for rows of points; one row alone stands for as many as the others have.");
    module.def("incircle_signs", of_four<2, signs::incircle>, "a"_a, "b"_a, "c"_a, "d"_a, "workers"_a = 1,
               "The same for four points of the plane.");
    module.def("orient3d_signs", of_four<3, signs::orient3d>, "a"_a, "b"_a, "c"_a, "d"_a, "workers"_a = 1,
               "The same for four points of space.");
    module.def("in_bubble_signs", of_four<3, signs::in_bubble>, "a"_a, "b"_a, "c"_a, "p"_a, "workers"_a = 1,
               "The same for four directions.");
}

}  // namespace stereodel
