// Diagonals of cocircular polygons by the tie rule: the triangulation of slightly displaced points.
//
// Each point is displaced infinitesimally, the first one in the order by far the most. If the displacement carries
// points out of the hull, the first point sees the whole polygon and is joined to all other corners. If it carries them
// in, the first point sinks below the rest and is cut off as an ear; then the next one of what remains, down to a
// triangle. In the plane it lifts them, away from the lower hull: in.
#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "mesh/corners.hpp"
#include "predicates/ray_predicates.hpp"
#include "voronoi/diagram_parts.hpp"

namespace stereodel::voronoi {

namespace rays = predicates::rays;
using mesh::place_of_least;
using predicates::all_unit;
using predicates::displaced_turn;

namespace {

using Size = std::size_t;

class Diagonals {
  public:
    // The triangles of `polygon`, whose corners come in the order of displacements `ranked` (places in it), three
    // numbers each to `out`; returns where they end.
    Index* draw(const Index* polygon, Size size, const std::vector<Size>& ranked, bool outward, Index* out) {
        return outward ? fan(polygon, size, ranked[0], out) : ears(polygon, size, ranked, out);
    }

    static Index* put(Index a, Index b, Index c, Index* out) {
        const Index corner[] = {a, b, c};
        const Size k = place_of_least(corner);
        out[0] = corner[k];
        out[1] = corner[(k + 1) % 3];
        out[2] = corner[(k + 2) % 3];
        return out + 3;
    }

  private:
    static Index* fan(const Index* polygon, Size size, Size apex, Index* out) {
        for (Size k = 1; k + 1 < size; ++k) {
            out = put(polygon[apex], polygon[(apex + k) % size], polygon[(apex + k + 1) % size], out);
        }
        return out;
    }

    Index* ears(const Index* polygon, Size size, const std::vector<Size>& ranked, Index* out) {
        before_.resize(size);
        after_.resize(size);
        for (Size k = 0; k < size; ++k) {
            before_[k] = (k + size - 1) % size;
            after_[k] = (k + 1) % size;
        }
        for (Size turn = 0; turn + 2 < size; ++turn) {
            const Size k = ranked[turn], a = before_[k], b = after_[k];
            out = put(polygon[a], polygon[k], polygon[b], out);
            after_[a] = b;
            before_[b] = a;
        }
        return out;
    }

    std::vector<Size> before_, after_;
};

// Lexicographically, for the rank of `TriangleOrder`.
void sort_rows(Index* rows, Size count) {
    if (count == 2) {  // most polygons are quadrangles
        if (std::lexicographical_compare(rows + 3, rows + 6, rows, rows + 3)) {
            std::swap_ranges(rows, rows + 3, rows + 3);
        }
        return;
    }
    std::vector<std::array<Index, 3>> sorted(count);
    for (Size k = 0; k < count; ++k) {
        sorted[k] = {rows[3 * k], rows[3 * k + 1], rows[3 * k + 2]};
    }
    std::sort(sorted.begin(), sorted.end());
    for (const std::array<Index, 3>& row : sorted) {
        rows = std::copy(row.begin(), row.end(), rows);
    }
}

// A number from outside, as one that there is.
Size at_most(Index number, Size most) {
    return std::min(static_cast<Size>(static_cast<std::uint32_t>(number)), most);
}

// From the triangles vertex by vertex, k - 2 of them for a polygon of k corners.
Buffer<Index> in_order(const Buffer<Index>& triangles, const Polygons& polygons, const TriangleOrder& order,
                       Crew& crew, Stop stop) {
    const auto refuse = [] { throw std::invalid_argument("simplex_vertex: not that of the diagram"); };
    if (3 * order.count != triangles.size()) {
        refuse();
    }
    const Size vertices = polygons.offsets.size() - 2;
    Buffer<Index> rows(triangles.size());
    // Rows lie along a curve, vertices in the order of their sites' numbers: each row is somewhere else.
    const auto fetch_ahead = [&](Size t) {
        constexpr Size near = 12, far = 24;
        if (t + far < order.count) {
            prefetch(polygons.offsets.data() + at_most(order.vertex[t + far], vertices));
            const Size next = at_most(order.vertex[t + near], vertices);
            prefetch(triangles.data() + 3 * (static_cast<Size>(polygons.offsets[next]) - 2 * next));
        }
    };
    for_all(order.count, crew, stop, [&](Size t) {
        fetch_ahead(t);
        const Size v = static_cast<Size>(static_cast<std::uint32_t>(order.vertex[t]));
        const Size rank = order.rank == nullptr ? 0 : static_cast<Size>(static_cast<std::uint32_t>(order.rank[t]));
        if (v >= vertices ||
            rank + 2 >= static_cast<Size>(polygons.offsets[v + 1]) - static_cast<Size>(polygons.offsets[v])) {
            refuse();
        }
        const Size from = static_cast<Size>(polygons.offsets[v]) - 2 * v + rank;
        std::copy_n(triangles.data() + 3 * from, 3, rows.data() + 3 * t);
    });
    return rows;
}

// comes_first(a, b): the order of displacements. is_outward(polygon, size): which way they go.
template <class ComesFirst, class IsOutward>
Buffer<Index> triangles(const Polygons& polygons, const TriangleOrder& order, int workers, Stop stop,
                        ComesFirst&& comes_first, IsOutward&& is_outward) {
    const Size count = polygons.offsets.size() - 2;
    // A polygon of k corners has k - 2 triangles.
    Buffer<Index> out(3 * (static_cast<Size>(polygons.offsets[count]) - 2 * count));
    Crew crew(useful_workers(workers, count));
    in_grains(count, Size{1} << 13, crew, [&](Size begin, Size end) {
        Diagonals diagonals;
        std::vector<Size> ranked;
        for_range(begin, end, stop, [&](Size v) {
            const Size first = static_cast<Size>(polygons.offsets[v]);
            const Size size = static_cast<Size>(polygons.offsets[v + 1]) - first;
            const Index* const polygon = polygons.sites.data() + first;
            Index* const here = out.data() + 3 * (first - 2 * v);
            if (size == 3) {
                Diagonals::put(polygon[0], polygon[1], polygon[2], here);
                return;
            }
            ranked.resize(size);
            std::iota(ranked.begin(), ranked.end(), Size{0});
            std::sort(ranked.begin(), ranked.end(),
                      [&](Size a, Size b) { return comes_first(polygon[a], polygon[b]); });
            diagonals.draw(polygon, size, ranked, is_outward(polygon, size), here);
            sort_rows(here, size - 2);
        });
    });
    return in_order(out, polygons, order, crew, stop);
}

}  // namespace

template <std::size_t Width>
Buffer<Index> triangles_of(const double* points, std::size_t sites, const Polygons& polygons,
                           const TriangleOrder& order, int workers, Stop stop) {
    const auto at = [points](Index a) { return points + Width * static_cast<Size>(a); };
    if constexpr (Width == 2) {
        const auto comes_first = [&](Index a, Index b) {
            return std::lexicographical_compare(at(a), at(a) + 2, at(b), at(b) + 2);
        };
        return triangles(polygons, order, workers, stop, comes_first, [](const Index*, Size) { return false; });
    } else {
        const bool unit = all_unit(points, sites);
        const auto comes_first = [&](Index a, Index b) { return rays::compare(at(a), at(b), unit) < 0; };
        const auto is_outward = [&](const Index* polygon, Size size) {
            return displaced_turn(at(polygon[0]), at(polygon[size / 3]), at(polygon[2 * size / 3]), unit) > 0;
        };
        return triangles(polygons, order, workers, stop, comes_first, is_outward);
    }
}

template Buffer<Index> triangles_of<2>(const double*, std::size_t, const Polygons&, const TriangleOrder&, int, Stop);
template Buffer<Index> triangles_of<3>(const double*, std::size_t, const Polygons&, const TriangleOrder&, int, Stop);

}  // namespace stereodel::voronoi
