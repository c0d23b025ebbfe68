// The folder `python`: the module stereodel._kernel. Each file binds the folder or the concern that it is named after;
// nothing is computed here.
// Reading order: module, arrays, rows and triangles (what comes from Python), then any other.
//
// What the bindings share: arrays from and to NumPy, and calls that Ctrl-C can stop.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <future>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "duplicates.hpp"
#include "input_checks.hpp"
#include "memory.hpp"
#include "tally.hpp"
#include "threads.hpp"

namespace stereodel::python {

namespace nb = nanobind;

// What is for one space stands in `plane` or `sphere`, under equal names where both have it.
struct Modules {
    nb::module_ both, plane, sphere;
};

template <class T, std::size_t Width>
using RowsIn =
    nb::ndarray<const T, nb::numpy, nb::shape<-1, static_cast<nb::ssize_t>(Width)>, nb::c_contig, nb::device::cpu>;
template <class T, std::size_t Width>
using RowsOut = nb::ndarray<nb::numpy, T, nb::shape<-1, static_cast<nb::ssize_t>(Width)>, nb::c_contig>;

template <class T>
using ValuesIn = nb::ndarray<const T, nb::numpy, nb::shape<-1>, nb::c_contig, nb::device::cpu>;
template <class T>
using ValuesOut = nb::ndarray<nb::numpy, T, nb::shape<-1>, nb::c_contig>;

// Points of the plane, rows of two, or directions, rows of three.
template <class Rows>
void check_points(const char* name, const Rows& points) {
    if (points.shape(1) == 3) {
        check_directions(name, points.data(), points.shape(0));
    } else {
        check_finite(name, points.data(), points.shape(0), points.shape(1));
    }
}

// Triangles of points of the plane, or of directions. checked: all are arrays that the kernel gave away and nobody can
// have changed; many a query takes less time than a look at each of them.
template <class Rows>
void check_triangles(const Rows& points, const RowsIn<Index, 3>& simplices, const RowsIn<Index, 3>& neighbors,
                     bool checked, std::optional<Border> border = {}) {
    check_same_length("simplices", simplices.shape(0), "neighbors", neighbors.shape(0));
    if (checked) {
        return;
    }
    check_points("points", points);
    check_triangles(simplices.data(), neighbors.data(), simplices.shape(0), points.shape(0),
                    border.value_or(points.shape(1) == 3 ? Border::closed : Border::open));
}

// An array of NumPy's that owns the memory of a buffer.
template <class Array, class T>
Array to_array(Buffer<T>&& buffer, std::initializer_list<std::size_t> shape) {
    auto* owned = new Buffer<T>(std::move(buffer));
    const nb::capsule owner(owned, [](void* p) noexcept { delete static_cast<Buffer<T>*>(p); });
    return Array(owned->data(), shape, owner);
}

template <std::size_t Width, class T>
RowsOut<T, Width> to_rows(Buffer<T>&& buffer) {
    const std::size_t count = buffer.size() / Width;
    return to_array<RowsOut<T, Width>>(std::move(buffer), {count, Width});
}

template <class T>
ValuesOut<T> to_values(Buffer<T>&& buffer) {
    const std::size_t count = buffer.size();
    return to_array<ValuesOut<T>>(std::move(buffer), {count});
}

inline RowsOut<Index, 2> to_rows(const Pairs& pairs) {
    return to_rows<2>(to_buffer(pairs));
}

// Pairs (dropped, kept) of `size` points; none if there are no rows.
inline Pairs to_pairs(const std::optional<RowsIn<Index, 2>>& rows, std::size_t size) {
    Pairs pairs;
    for (std::size_t k = 0; rows && k < rows->shape(0); ++k) {
        const Index dropped = rows->data()[2 * k], kept = rows->data()[2 * k + 1];
        if (dropped <= kept || kept < 0 || static_cast<std::size_t>(dropped) >= size) {
            throw std::invalid_argument("duplicates must be pairs dropped, kept of points");
        }
        pairs.emplace_back(dropped, kept);
    }
    return pairs;
}

// Tests left open, by stage; the curvature form is of the sphere alone.
inline nb::dict to_dict(const Tally& tally, bool on_sphere) {
    nb::dict result;
    result["filter"] = tally.filter;
    if (on_sphere) {
        result["curvature"] = tally.curvature;
    }
    result["double_double"] = tally.double_double;
    result["exact"] = tally.exact;
    return result;
}

inline Tally to_tally(const nb::dict& counts) {
    const auto count = [&](const char* stage) {
        return counts.contains(stage) ? nb::cast<std::uint64_t>(counts[stage]) : 0;
    };
    return {count("filter"), count("curvature"), count("double_double"), count("exact")};
}

// Calls work(stop) without the interpreter's lock. Long work runs on a thread of its own, while this one looks for
// Ctrl-C twenty times a second; then `stop` is raised, the work throws `Cancelled`, and Python's exception goes on from
// here. Where the system gives no thread, the work is done on this one and Ctrl-C waits.
template <class Work>
auto run_without_lock(bool is_long, Work&& work) {
    std::atomic<bool> stop{false};
    std::future<decltype(work(Stop{}))> result;
    if (is_long) {
        try {
            result = std::async(std::launch::async, [&] { return work(Stop{&stop}); });
        } catch (const std::system_error&) {
        }
    }
    if (!result.valid()) {
        const nb::gil_scoped_release release;
        return work(Stop{});
    }
    const auto is_ready = [&] {
        const nb::gil_scoped_release release;
        return result.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
    };
    while (!is_ready()) {
        stop = stop || PyErr_CheckSignals() != 0;
    }
    if (stop) {
        throw nb::python_error();
    }
    return result.get();
}

// A buffer that work(data, stop) fills without the interpreter's lock.
template <class T, class Work>
Buffer<T> filled(std::size_t size, bool is_long, Work&& work) {
    return run_without_lock(is_long, [&](Stop stop) {
        Buffer<T> buffer(size);
        work(buffer.data(), stop);
        return buffer;
    });
}

}  // namespace stereodel::python
