// The stereographic projection for Python, and the exact comparisons of projected coordinates.
#include <nanobind/stl/string.h>

#include <algorithm>
#include <cmath>

#include "engine/projected_sites.hpp"
#include "engine/projection.hpp"
#include "stages.hpp"

namespace stereodel::probe {

using engine::Estimated;
using engine::InCircleEstimate;
using engine::Pole;
using engine::ProjectedRays;
using engine::compare_projected;
using engine::compare_projected_double_double;
using engine::compare_projected_exact;
using engine::compare_projected_filter;
using engine::compare_to_line;
using engine::compare_to_line_double_double;
using engine::compare_to_line_exact;
using engine::compare_to_line_filter;
using engine::orient_estimate;
using engine::project;
using engine::project_double_double;
using order::Point2;

namespace {

using namespace nb::literals;

Pole checked_pole(int axis, int sign) {
    if (axis < 0 || axis > 2 || (sign != 1 && sign != -1)) {
        throw std::invalid_argument("axis: 0, 1, 2; sign: -1, 1");
    }
    return {axis, sign};
}

template <void (*Project)(const double*, Pole, double*), std::size_t WIDTH>
RowsOut<double, WIDTH> project_rows(const SpaceArray& p, int axis, int sign) {
    const Pole pole = checked_pole(axis, sign);
    return to_rows<WIDTH>(filled<double>(WIDTH * p.shape(0), false, [&](double* out, Stop) {
        for (std::size_t k = 0; k < p.shape(0); ++k) {
            Project(row(p, k), pole, out + WIDTH * k);
        }
    }));
}

Signs compare_projected_rows(const SpaceArray& p, const SpaceArray& q, int axis, int sign, int coordinate,
                             const std::string& stage) {
    const Stage only = stage_of(stage);
    const Pole pole = checked_pole(axis, sign);
    return over_rows(common_rows(p, q), [&](std::size_t k) {
        const double *a = row(p, k), *b = row(q, k);
        return by_stage(
            only, [&] { return compare_projected(a, b, pole, coordinate); },
            [&] { return compare_projected_filter(a, b, pole, coordinate); },
            [&] { return compare_projected_double_double(a, b, pole, coordinate); },
            [&] { return compare_projected_exact(a, b, pole, coordinate); });
    });
}

Signs compare_to_line_rows(const SpaceArray& p, int axis, int sign, int coordinate, const Values& hi, const Values& lo,
                           const std::string& stage) {
    const Stage only = stage_of(stage);
    const Pole pole = checked_pole(axis, sign);
    return over_rows(common_rows(p, hi, lo), [&](std::size_t k) {
        const double *a = row(p, k), h = hi.data()[k], l = lo.data()[k];
        return by_stage(
            only, [&] { return compare_to_line(a, pole, coordinate, h, l); },
            [&] { return compare_to_line_filter(a, pole, coordinate, h, l); },
            [&] { return compare_to_line_double_double(a, pole, coordinate, h, l); },
            [&] { return compare_to_line_exact(a, pole, coordinate, h, l); });
    });
}

ProjectedRays checked_rays(const SpaceArray& p, int axis, int sign) {
    return {p.data(), all_unit(p.data(), p.shape(0)), checked_pole(axis, sign), true};
}

// X, Y of the first filter.
RowsOut<double, 2> projected_rows(const SpaceArray& p, int axis, int sign) {
    const ProjectedRays rays = checked_rays(p, axis, sign);
    return to_rows<2>(filled<double>(2 * p.shape(0), false, [&](double* out, Stop) {
        for (std::size_t k = 0; k < p.shape(0); ++k) {
            const Point2 image = rays.ratio(static_cast<Index>(k)).point();
            out[2 * k] = image.x;
            out[2 * k + 1] = image.y;
        }
    }));
}

// The first filter of points in fours, the orientation of each row's first three and the incircle test of all: value,
// bound, and of the latter the bound without a root, infinite where it does not apply.
RowsOut<double, 5> projected_estimates(const SpaceArray& p, int axis, int sign) {
    const ProjectedRays rays = checked_rays(p, axis, sign);
    const std::size_t fours = p.shape(0) / 4;
    return to_rows<5>(filled<double>(5 * fours, false, [&](double* out, Stop) {
        for (std::size_t k = 0; k < fours; ++k) {
            const auto image = [&](std::size_t j) { return rays.ratio(static_cast<Index>(4 * k + j)).point(); };
            const Estimated turn = orient_estimate(image(0), image(1), image(2));
            const InCircleEstimate circle(image(0), image(1), image(2), image(3));
            const double wide = circle.is_wide() ? circle.wide_bound() : HUGE_VAL;
            const double row[] = {turn.value, turn.bound, circle.value, circle.bound(), wide};
            std::copy(row, row + 5, out + 5 * k);
        }
    }));
}

}  // namespace

void bind_projection(nb::module_& m) {
    m.def("project", &project_rows<project, 2>, "p"_a, "axis"_a, "sign"_a);
    m.def("project_double_double", &project_rows<project_double_double, 4>, "p"_a, "axis"_a, "sign"_a);
    m.def("projected", &projected_rows, "p"_a, "axis"_a, "sign"_a);
    m.def("projected_estimates", &projected_estimates, "fours"_a, "axis"_a, "sign"_a);
    m.def("compare_projected", &compare_projected_rows, "p"_a, "q"_a, "axis"_a, "sign"_a, "coordinate"_a,
          "stage"_a = "all");
    m.def("compare_to_line", &compare_to_line_rows, "p"_a, "axis"_a, "sign"_a, "coordinate"_a, "hi"_a, "lo"_a,
          "stage"_a = "all");
}

}  // namespace stereodel::probe
