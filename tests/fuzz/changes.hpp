// Points that come and go: after insertions and removals the triangles must be those of a fresh start.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "checks.hpp"
#include "mesh/dynamic.hpp"

namespace fuzz {

using Coordinates = std::vector<double>;

template <class Surface>
void check_state(stereodel::mesh::DynamicDelaunay<Surface>& delaunay, const Triangulation& fresh, const char* what) {
    require(delaunay.duplicates() == fresh.duplicates, what);
    require(delaunay.is_flat() == (fresh.triangles.count() == 0), what);
    if (delaunay.is_flat()) {
        return;
    }
    const std::size_t count = delaunay.mesh().triangles();
    Triangulation changed;
    changed.triangles.corners = stereodel::Buffer<Index>(3 * count);
    changed.triangles.neighbors = stereodel::Buffer<Index>(3 * count);
    delaunay.mesh().write(changed.triangles.corners.data(), changed.triangles.neighbors.data(), nullptr);
    require(sorted_rows(Rows(changed)) == sorted_rows(Rows(fresh)), what);
}

// fresh(coordinates): the triangulation of points. Insert the second half of them, then remove every third.
template <class Surface, class Fresh>
void check_changes(const Coordinates& all, Fresh&& fresh) {
    constexpr std::size_t width = stereodel::mesh::DynamicDelaunay<Surface>::dimension;
    const std::size_t size = all.size() / width, half = size / 2;
    const Coordinates first(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(width * half));
    Triangulation start = fresh(first);
    if (start.triangles.count() == 0) {
        return;
    }
    stereodel::mesh::DynamicDelaunay<Surface> delaunay(first.data(), half, start.triangles.corners.data(),
                                                 start.triangles.neighbors.data(), start.triangles.count(),
                                                 std::move(start.duplicates), nullptr);
    delaunay.insert(all.data() + width * half, size - half, nullptr);
    check_state(delaunay, fresh(all), "insertion gives other triangles");

    std::vector<Index> gone;
    Coordinates left;
    for (std::size_t k = 0; k < size; ++k) {
        if (k % 3 == 1) {
            gone.push_back(static_cast<Index>(k));
        } else {
            left.insert(left.end(), all.begin() + static_cast<std::ptrdiff_t>(width * k),
                        all.begin() + static_cast<std::ptrdiff_t>(width * (k + 1)));
        }
    }
    delaunay.remove(gone.data(), gone.size(), nullptr);
    check_state(delaunay, fresh(left), "removal gives other triangles");
}

}  // namespace fuzz
