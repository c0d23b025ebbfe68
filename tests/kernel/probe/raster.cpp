// The way back from the page for the tests.
#include <nanobind/stl/array.h>

#include <algorithm>
#include <array>

#include "raster/page_trace.hpp"
#include "stages.hpp"

namespace stereodel::probe {

using raster::PageMap;
using raster::Traced;
using raster::trace_row;

namespace {

using namespace nb::literals;

using Matrix = nb::ndarray<const double, nb::numpy, nb::shape<3, 3>, nb::c_contig, nb::device::cpu>;

PageMap map_of(const Matrix& first, double size, const Matrix& last, const char* projection, double reach) {
    PageMap map{{}, size, {}, raster::page_projection(projection), reach};
    std::copy(first.data(), first.data() + 9, map.first);
    std::copy(last.data(), last.data() + 9, map.last);
    return map;
}

RowsOut<double, 7> traced(const Matrix& first, double size, const Matrix& last, const char* projection,
                          double reach, std::array<double, 4> place, std::size_t count) {
    const PageMap map = map_of(first, size, last, projection, reach);
    Buffer<Traced> points(count);
    trace_row(map, place[0], place[1], {place[2], place[3]}, count, points.data());
    Buffer<double> rows(7 * count);
    for (std::size_t k = 0; k < count; ++k) {
        const Traced& p = points[k];
        const double row[] = {p.lon, p.lat, p.lon_x, p.lon_y, p.lat_x, p.lat_y, p.bend};
        std::copy(row, row + 7, rows.data() + 7 * k);
    }
    return to_rows<7>(std::move(rows));
}

}  // namespace

void bind_raster(nb::module_& m) {
    m.def("trace_page", traced, "first"_a, "size"_a, "last"_a, "projection"_a, "reach"_a, "place"_a, "count"_a,
          "Of page points in a row, place (x, y, step right, up): lon, lat, their changes over steps, the bend.");
}

}  // namespace stereodel::probe
