// Python: an equirectangular raster at all resolutions, and on a globe seen through a lens.
#include <nanobind/stl/array.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "python/arrays.hpp"
#include "raster/levels.hpp"
#include "raster/warp.hpp"

namespace stereodel::python {

using raster::PageMap;
using raster::PageWindow;
using raster::RasterEdges;
using raster::RasterSampler;
using raster::RasterShape;
using raster::make_raster_levels;
using raster::warp_raster;

namespace {

using namespace nb::literals;

using Texels = nb::ndarray<const std::uint8_t, nb::numpy, nb::shape<-1, -1, 4>, nb::c_contig, nb::device::cpu>;
using Pixels = nb::ndarray<nb::numpy, std::uint8_t, nb::shape<-1, -1, 4>, nb::c_contig>;
using Matrix = nb::ndarray<const double, nb::numpy, nb::shape<3, 3>, nb::c_contig, nb::device::cpu>;
using Edges = nb::ndarray<const double, nb::numpy, nb::shape<4>, nb::c_contig, nb::device::cpu>;

constexpr std::size_t long_work = 100'000;  // texels or pixels: some milliseconds

RasterShape shape_of(const Texels& raster) {
    constexpr std::size_t most = 1 << 20;
    if (raster.shape(0) == 0 || raster.shape(1) == 0 || raster.shape(0) > most || raster.shape(1) > most) {
        throw std::invalid_argument("a raster has 1 to 2^20 rows and columns");
    }
    return {static_cast<int>(raster.shape(1)), static_cast<int>(raster.shape(0))};
}

RasterEdges edges_of(const Edges& edges) {
    return {edges.data()[0], edges.data()[1], edges.data()[2], edges.data()[3]};
}

ValuesOut<std::uint8_t> levels(const Texels& raster, const Edges& edges, int workers) {
    const RasterShape shape = shape_of(raster);
    const RasterEdges sides = edges_of(edges);
    return to_values(filled<std::uint8_t>(shape.size(), raster.size() > long_work, [&](std::uint8_t* out, Stop stop) {
        Crew crew(useful_workers(workers, raster.size() / 4, 1 << 16));
        make_raster_levels(raster.data(), shape, sides.north, sides.south, out, crew, stop);
    }));
}

PageMap map_of(const Matrix& first, double size, const Matrix& last, const char* projection, double reach) {
    PageMap map{{}, size, {}, raster::page_projection(projection), reach};
    std::copy(first.data(), first.data() + 9, map.first);
    std::copy(last.data(), last.data() + 9, map.last);
    return map;
}

Pixels warp(const Texels& raster, const ValuesIn<std::uint8_t>& levels, const Edges& edges,
            const ValuesIn<double>& shifts, const Matrix& first, double size, const Matrix& last,
            const char* projection, double reach, std::array<double, 4> place, std::array<int, 2> pixels, bool covered,
            int workers) {
    const RasterShape shape = shape_of(raster);
    if (levels.shape(0) != shape.size()) {
        throw std::invalid_argument("levels must be those of the raster");
    }
    if (shifts.shape(0) == 1) {
        throw std::invalid_argument("shifts must be none or at two latitudes or more");
    }
    const RasterSampler sampler(shape, raster.data(), levels.data(), edges_of(edges),
                                {shifts.data(), shifts.data() + shifts.shape(0)});
    const PageMap map = map_of(first, size, last, projection, reach);
    const PageWindow window{place[0], place[1], {place[2], place[3]}, pixels[0], pixels[1]};
    const std::size_t width = static_cast<std::size_t>(pixels[0]), height = static_cast<std::size_t>(pixels[1]);
    const bool is_long = width * height > long_work;
    auto buffer = filled<std::uint8_t>(4 * width * height, is_long, [&](std::uint8_t* out, Stop stop) {
        Crew crew(useful_workers(workers, width * height, 1 << 12));
        warp_raster(sampler, map, window, covered, out, crew, stop);
    });
    return to_array<Pixels>(std::move(buffer), {height, width, 4});
}

}  // namespace

void bind_raster(Modules& modules) {
    nb::module_& module = modules.both;
    module.def("raster_levels", levels, "raster"_a, "edges"_a, "workers"_a = 1,
               "Means of a raster (h, w, 4), colour premultiplied, with edges (west, south, east, north) in radians.");
    module.def("warp_raster", warp, "raster"_a, "levels"_a, "edges"_a, "shifts"_a, "first"_a, "size"_a, "last"_a,
               "projection"_a, "reach"_a, "place"_a, "pixels"_a, "covered"_a = true, "workers"_a = 1,
               "Pixels (height, width, 4) of a globe: rotation, fisheye, rotation from page axes to the raster's; "
               "projection orthographic, stereographic (discs, of reach tan(angular radius/2)), gnomonic (tangents) or "
               "equirectangular (radians); place (left, top, pixel's sides) in its units, pixels (width, height).");
}

}  // namespace stereodel::python
