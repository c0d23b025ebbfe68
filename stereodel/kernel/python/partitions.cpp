#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "engine/sphere.hpp"
#include "partitions/blocks.hpp"
#include "partitions/box_tree.hpp"
#include "partitions/final_cells.hpp"
#include "partitions/open_bubbles.hpp"
#include "partitions/open_targets.hpp"
#include "python/triangles.hpp"
#include "queries/query_pieces.hpp"

namespace stereodel::python {

using partitions::Blocks;
using partitions::BoxTree;
using partitions::Discs;
using partitions::Faces;
using partitions::FinalCells;
using partitions::FinalTriangles;
using partitions::Openness;
using partitions::PartialMesh;
using partitions::Splits;
using partitions::Targets;

namespace {

using namespace nb::literals;

constexpr std::size_t long_work = 20000;  // points: some milliseconds

using Levels = ValuesIn<std::int64_t>;
using Ids = ValuesIn<std::int64_t>;
using Counts = ValuesIn<std::int32_t>;
using Mask = ValuesIn<bool>;

// Blocks and boxes ----------------------------------------------------------------------------------------------------

template <std::size_t Width>
ValuesOut<std::int32_t> part_of(RowsIn<double, Width> points, Counts axis, ValuesIn<double> value) {
    const std::size_t count = points.shape(0);
    check_same_length("axis", axis.shape(0), "value", value.shape(0));
    check_indices("axis", axis.data(), axis.shape(0), Width);
    const Splits splits{axis.data(), value.data(), axis.shape(0)};
    return to_values(filled<std::int32_t>(count, count > long_work, [&](std::int32_t* parts, Stop stop) {
        check_points("points", points);
        partitions::parts<Width>(points.data(), count, splits, parts, stop);
    }));
}

template <std::size_t Width>
nb::tuple blocks(RowsIn<double, Width> points, std::size_t size) {
    const std::size_t count = points.shape(0);
    if (size == 0) {
        throw std::invalid_argument("size must be at least 1");
    }
    Blocks made = run_without_lock(count > long_work, [&](Stop stop) {
        check_points("points", points);
        return partitions::blocks<Width>(points.data(), count, size, stop);
    });
    return nb::make_tuple(to_values(std::move(made.order)), to_values(copied(made.starts)),
                          to_rows<Width>(copied(made.lows)), to_rows<Width>(copied(made.highs)));
}

template <std::size_t Width>
nb::tuple box_tree(RowsIn<double, Width> lows, RowsIn<double, Width> highs) {
    check_same_length("lows", lows.shape(0), "highs", highs.shape(0));
    const std::vector<std::int64_t> first = partitions::tree_levels(lows.shape(0));
    Buffer<double> all_lows(Width * static_cast<std::size_t>(first.back())), all_highs(all_lows.size());
    std::copy_n(lows.data(), Width * lows.shape(0), all_lows.data());
    std::copy_n(highs.data(), Width * highs.shape(0), all_highs.data());
    {
        const nb::gil_scoped_release release;
        partitions::fill_boxes(first, Width, all_lows.data(), all_highs.data());
    }
    return nb::make_tuple(to_rows<Width>(std::move(all_lows)), to_rows<Width>(std::move(all_highs)),
                          to_values(copied(first)));
}

ValuesOut<std::int32_t> unread_counts(Mask unread, Levels first) {
    const std::size_t levels = first.shape(0);
    const std::int64_t nodes = levels == 0 ? 0 : first.data()[levels - 1];
    partitions::check_levels(first.data(), levels, nodes < 0 ? 0 : static_cast<std::size_t>(nodes));
    check_same_length("unread", unread.shape(0), "leaves", static_cast<std::size_t>(first.data()[1]));
    return to_values(filled<std::int32_t>(static_cast<std::size_t>(nodes), false, [&](std::int32_t* counts, Stop) {
        std::copy_n(unread.data(), unread.shape(0), counts);
        partitions::fill_counts(first.data(), levels - 1, counts);
    }));
}

template <std::size_t Width>
BoxTree<Width> to_tree(const RowsIn<double, Width>& lows, const RowsIn<double, Width>& highs, const Levels& first,
                       const Counts& unread) {
    partitions::check_levels(first.data(), first.shape(0), lows.shape(0));
    check_same_length("lows", lows.shape(0), "highs", highs.shape(0));
    check_same_length("lows", lows.shape(0), "unread", unread.shape(0));
    return {lows.data(), highs.data(), first.data(), first.shape(0) - 1, unread.data()};
}

template <std::size_t Width>
ValuesOut<bool> near_blocks(Mask chosen, double reach, RowsIn<double, Width> lows, RowsIn<double, Width> highs,
                            Levels first, Counts unread) {
    const BoxTree<Width> tree = to_tree<Width>(lows, highs, first, unread);
    check_same_length("chosen", chosen.shape(0), "leaves", tree.leaves());
    return to_values(filled<bool>(tree.leaves(), tree.leaves() > long_work, [&](bool* near, Stop stop) {
        partitions::near_blocks(tree, chosen.data(), reach, near, stop);
    }));
}

// What is open --------------------------------------------------------------------------------------------------------

template <std::size_t Width, class Work>
nb::tuple openness(std::size_t count, const BoxTree<Width>& tree, Work&& work) {
    auto found = run_without_lock(count > long_work || tree.leaves() > long_work, [&](Stop stop) {
        std::pair<Buffer<bool>, Buffer<double>> made{Buffer<bool>(count), Buffer<double>(tree.leaves())};
        work(Openness{made.first.data(), made.second.data()}, stop);
        return made;
    });
    return nb::make_tuple(to_values(std::move(found.first)), to_values(std::move(found.second)));
}

// Edges of the plane's hull have -1 in the last place.
template <std::size_t Width>
void check_faces(const RowsIn<Index, 3>& faces, std::size_t size) {
    bool fits = true;
    for (std::size_t k = 0; k < 3 * faces.shape(0); ++k) {
        const Index corner = faces.data()[k];
        fits &= corner < 0 ? Width == 2 && k % 3 == 2 && corner == -1 : static_cast<std::size_t>(corner) < size;
    }
    if (!fits) {
        check_indices("faces", faces.data(), faces.shape(0), size, 3);  // says which
    }
}

template <std::size_t Width>
nb::tuple open_bubbles(RowsIn<double, Width> points, RowsIn<Index, 3> faces, RowsIn<double, Width> lows,
                       RowsIn<double, Width> highs, Levels first, Counts unread, std::optional<Mask> wanted) {
    const BoxTree<Width> tree = to_tree<Width>(lows, highs, first, unread);
    const std::size_t size = points.shape(0), count = faces.shape(0);
    if (wanted) {
        check_same_length("wanted", wanted->shape(0), "points", size);
    }
    check_faces<Width>(faces, size);
    const Faces asked{points.data(), size, faces.data(), count, wanted ? wanted->data() : nullptr};
    return openness(count, tree, [&](const Openness& found, Stop stop) {
        check_points("points", points);
        partitions::open_bubbles(asked, tree, found, stop);
    });
}

template <std::size_t Width>
nb::tuple open_discs(RowsIn<double, Width> centers, RowsIn<double, Width> rims, RowsIn<double, Width> lows,
                     RowsIn<double, Width> highs, Levels first, Counts unread) {
    const BoxTree<Width> tree = to_tree<Width>(lows, highs, first, unread);
    const std::size_t count = centers.shape(0);
    check_same_length("centers", count, "rims", rims.shape(0));
    check_points("centers", centers);
    check_points("rims", rims);
    const Discs discs{centers.data(), rims.data(), count};
    return openness(count, tree, [&](const Openness& found, Stop stop) {
        partitions::open_discs(discs, tree, found, stop);
    });
}

template <std::size_t Width>
nb::tuple open_targets(RowsIn<double, Width> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                       RowsIn<double, Width> queries, RowsIn<double, Width> lows, RowsIn<double, Width> highs,
                       Levels first, Counts unread, std::optional<Closing> closing, bool natural, bool checked) {
    const BoxTree<Width> tree = to_tree<Width>(lows, highs, first, unread);
    const TriangleArrays triangles = to_triangles(points, simplices, neighbors, closing, checked);
    if (queries::first_open(triangles) == static_cast<Index>(triangles.count())) {
        throw std::invalid_argument("simplices: there is none that a target may lie in");
    }
    check_points("queries", queries);
    const Targets targets{triangles, points.shape(0), queries.data(), queries.shape(0), natural};
    return openness(targets.count, tree, [&](const Openness& found, Stop stop) {
        partitions::open_targets(targets, tree, found, stop);
    });
}

// What is final -------------------------------------------------------------------------------------------------------

template <std::size_t Width>
nb::tuple final_cells(RowsIn<double, Width> points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                      RowsIn<Index, 2> duplicates, Ids ids, ValuesIn<Index> rows, bool checked) {
    const std::size_t size = points.shape(0), count = rows.shape(0);
    check_triangles(points, simplices, neighbors, checked, Border::open);
    check_same_length("points", size, "ids", ids.shape(0));
    check_indices("rows", rows.data(), count, size);
    if (!std::is_sorted(rows.data(), rows.data() + count)) {
        throw std::invalid_argument("rows must ascend");
    }
    const Pairs pairs = to_pairs(duplicates, size);
    const PartialMesh mesh{points.data(), size, simplices.data(), neighbors.data(), simplices.shape(0), pairs,
                           ids.data()};
    FinalCells cells = run_without_lock(size > long_work, [&](Stop stop) {
        return partitions::final_cells<Width>(mesh, rows.data(), count, stop);
    });
    return nb::make_tuple(to_values(std::move(cells.kept)), to_values(std::move(cells.degree)),
                          to_values(std::move(cells.area)), to_values(std::move(cells.nearest)),
                          to_values(std::move(cells.distance)));
}

template <std::size_t Width>
nb::tuple final_triangles(RowsIn<double, Width> points, RowsIn<Index, 3> simplices, RowsIn<Index, 2> duplicates,
                          Ids ids, Mask is_final) {
    const std::size_t size = points.shape(0), count = simplices.shape(0);
    check_indices("simplices", simplices.data(), count, size, 3);
    check_same_length("points", size, "ids", ids.shape(0));
    check_same_length("points", size, "final", is_final.shape(0));
    const Pairs pairs = to_pairs(duplicates, size);
    const PartialMesh mesh{points.data(), size, simplices.data(), nullptr, count, pairs, ids.data()};
    FinalTriangles triangles = run_without_lock(count > long_work, [&](Stop stop) {
        check_points("points", points);
        return partitions::final_triangles(mesh, is_final.data(), stop);
    });
    return nb::make_tuple(to_rows<3>(std::move(triangles.corners)), to_values(std::move(triangles.rows)));
}

template <std::size_t Width>
void bind_space(nb::module_& space) {
    space.def("part_of", part_of<Width>, "points"_a, "axis"_a, "value"_a,
              "The leaf of a k-d tree that each point belongs to. axis, value: of the inner nodes, in the order of a "
              "heap, any number of them: node k has the children 2k + 1 (coordinates up to the value) and 2k + 2, and "
              "what comes after the inner nodes is leaf 0, 1, ... Directions of any length are taken as unit vectors.");
    space.def("blocks", blocks<Width>, "points"_a, "size"_a,
              "Rows in the order of blocks of at most `size` points (more only if all are equal), where each block "
              "begins and the last one ends (blocks + 1), low and high corners of boxes that hold them; on the sphere "
              "those of the unit vectors, rounded outward.");
    space.def("box_tree", box_tree<Width>, "lows"_a, "highs"_a,
              "Low and high corners of all nodes of a tree over boxes, which stand first, and the first node of each "
              "level and one beyond.");
    space.def("near_blocks", near_blocks<Width>, "chosen"_a, "reach"_a, "lows"_a, "highs"_a, "first"_a, "unread"_a,
              "Which unread blocks are near chosen ones: the gap along each axis is at most `reach` times the smaller "
              "diagonal. lows, highs, first: of box_tree; unread: of unread_counts.");
    space.def("open_bubbles", open_bubbles<Width>, "points"_a, "faces"_a, "lows"_a, "highs"_a, "first"_a, "unread"_a,
              "wanted"_a = nb::none(),
              "Whether each triangle's closed bubble may touch an unread block, never false where it does; and for "
              "each block how deep an open bubble reaches into it, 0 if none does. Triangles are counterclockwise; in "
              "the plane (u, v, -1) is an edge of the hull that has all points on its left. wanted: which points' "
              "triangles matter.");
    space.def("open_discs", open_discs<Width>, "centers"_a, "rims"_a, "lows"_a, "highs"_a, "first"_a, "unread"_a,
              "The same for the closed discs around centers through the points beside them.");
    space.def("open_targets", open_targets<Width>, "points"_a, "simplices"_a, "neighbors"_a, "queries"_a, "lows"_a,
              "highs"_a, "first"_a, "unread"_a, "closing"_a = nb::none(), "natural"_a = false, "checked"_a = false,
              "The same for what the answer at each target rests on: triangles that hold it, or the one or the hull's "
              "edge that it lies beyond; natural: also all triangles whose bubbles hold it, and those that it would "
              "have at itself.");
    space.def("final_cells", final_cells<Width>, "points"_a, "simplices"_a, "neighbors"_a, "duplicates"_a, "ids"_a,
              "rows"_a, "checked"_a = false,
              "Of ascending rows whose triangles are final: the lowest id of equal points, degree, area (both 0 where "
              "that id is another one), the id of the nearest other point (the lowest of several, -1 if there is "
              "none), its distance (radians on the sphere). ids: of all rows, in any order. There must be simplices.");
    space.def("final_triangles", final_triangles<Width>, "points"_a, "simplices"_a, "duplicates"_a, "ids"_a, "final"_a,
              "Triangles by ids (m, 3), the lowest first, counterclockwise, of which that point is final, and their "
              "rows among the simplices. final: of each row; of equal points the one of lowest id counts.");
}

}  // namespace

void bind_partitions(Modules& modules) {
    modules.both.def("unread_counts", unread_counts, "unread"_a, "first"_a,
                     "How many unread leaves each node of a box_tree has, from those of the leaves.");
    bind_space<2>(modules.plane);
    bind_space<3>(modules.sphere);
}

}  // namespace stereodel::python
