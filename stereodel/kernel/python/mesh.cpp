#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>

#include <atomic>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>

#include "mesh/dynamic.hpp"
#include "mesh/plane_surface.hpp"
#include "mesh/sphere_surface.hpp"
#include "python/arrays.hpp"

namespace stereodel::python {

using mesh::DynamicDelaunay;
using mesh::Mesh;
using mesh::PlaneSurface;
using mesh::SphereSurface;

namespace {

using namespace nb::literals;

constexpr std::size_t long_changes = 500;    // points: some milliseconds
constexpr std::size_t long_copies = 100000;  // points: the same

// A triangulation that Python holds; several threads may have it. While one changes it, the others are refused.
template <class Surface>
class BoundMesh {
  public:
    using Points = RowsIn<double, DynamicDelaunay<Surface>::dimension>;

    BoundMesh(Points points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
              const std::optional<RowsIn<Index, 2>>& duplicates, bool checked)
        : delaunay_(make(points, simplices, neighbors, duplicates, checked)) {}

    RowsOut<Index, 2> insert(Points points) {
        const std::size_t count = points.shape(0);
        check_points("points", points);
        const Pairs added = change(count > long_changes, [&](Stop stop) {
            const std::size_t old = delaunay_.duplicates().size();
            delaunay_.insert(points.data(), count, stop);
            return Pairs(delaunay_.duplicates().begin() + static_cast<std::ptrdiff_t>(old),
                         delaunay_.duplicates().end());
        });
        return to_rows(added);
    }

    ValuesOut<Index> remove(ValuesIn<Index> indices) {
        const std::size_t count = indices.shape(0);
        Buffer<Index> number = change(count > long_changes || size() > long_copies, [&](Stop stop) {
            check_indices("indices", indices.data(), count, delaunay_.size());
            return delaunay_.remove(indices.data(), count, stop);
        });
        return to_values(std::move(number));
    }

    nb::tuple arrays() {
        auto rows = read(size() > long_copies, [&](Stop stop) {
            Mesh& mesh = delaunay_.mesh();
            std::pair<Buffer<Index>, Buffer<Index>> out(3 * mesh.triangles(), 3 * mesh.triangles());
            mesh.write(out.first.data(), out.second.data(), stop);
            return out;
        });
        return nb::make_tuple(to_rows<3>(std::move(rows.first)), to_rows<3>(std::move(rows.second)));
    }

    RowsOut<Index, 2> duplicates() {
        return to_rows(read(false, [&](Stop) { return delaunay_.duplicates(); }));
    }

    bool is_flat() {
        return read(false, [&](Stop) { return delaunay_.is_flat(); });
    }

    std::size_t size() {
        return read(false, [&](Stop) { return delaunay_.size(); });
    }

    nb::dict inconclusive() {
        return to_dict(read(false, [&](Stop) { return delaunay_.tally(); }), !Surface::has_ghost);
    }

    std::uint64_t changes() const { return changes_; }

  private:
    static DynamicDelaunay<Surface> make(Points points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
                                         const std::optional<RowsIn<Index, 2>>& duplicates, bool checked) {
        Pairs pairs = to_pairs(duplicates, points.shape(0));
        const nb::gil_scoped_release release;
        check_triangles(points, simplices, neighbors, checked);
        return DynamicDelaunay<Surface>(points.data(), points.shape(0), simplices.data(), neighbors.data(),
                                        simplices.shape(0), std::move(pairs), Stop{});
    }

    // Both call work(stop) without the interpreter's lock, one thread at a time. All wait for reads, which soon end
    // (even writing out the arrays moves facets); nothing waits for a change.
    template <class Work>
    auto read(bool is_long, Work&& work) {
        return run_without_lock(is_long, [&](Stop stop) {
            const PatientLock lock(mutex_, [&] { refuse_if(changing_); });
            return work(stop);
        });
    }

    template <class Work>
    auto change(bool is_long, Work&& work) {
        return run_without_lock(is_long, [&](Stop stop) {
            refuse_if(changing_.exchange(true));
            const Changing mark(*this);
            const PatientLock lock(mutex_, [] {});
            return work(stop);
        });
    }

    static void refuse_if(bool in_use) {
        if (in_use) {
            throw std::runtime_error(
                "another thread is changing this mesh; let one wait for the other by a lock, or query a copy");
        }
    }

    // Counts a change, and ends it.
    struct Changing {
        explicit Changing(BoundMesh& mesh) : changing(mesh.changing_) { ++mesh.changes_; }
        Changing(const Changing&) = delete;
        Changing& operator=(const Changing&) = delete;
        ~Changing() { changing = false; }
        std::atomic<bool>& changing;
    };

    DynamicDelaunay<Surface> delaunay_;
    PatientMutex mutex_;
    std::atomic<bool> changing_{false};
    std::atomic<std::uint64_t> changes_{0};
};

template <class Surface>
void bind(nb::module_& space, const char* doc) {
    using Bound = BoundMesh<Surface>;
    nb::class_<Bound>(space, "Mesh", doc)
        .def(nb::init<typename Bound::Points, RowsIn<Index, 3>, RowsIn<Index, 3>, std::optional<RowsIn<Index, 2>>,
                      bool>(),
             "points"_a, "simplices"_a, "neighbors"_a, "duplicates"_a = nb::none(), "checked"_a = false,
             "The triangulation of `points`, as `triangulate_...` gives it; at least one triangle. Copies everything.")
        .def("insert", &Bound::insert, "points"_a,
             "Append points. Returns the pairs [dropped, kept] of those that repeat an earlier one.")
        .def("remove", &Bound::remove, "indices"_a,
             "Take points out, number the others anew in the same order. Returns old -> new, -1 = removed.")
        .def("arrays", &Bound::arrays, "Simplices, smallest index first, and neighbors, -1 for none, as new arrays.")
        .def_prop_ro("duplicates", &Bound::duplicates, nb::rv_policy::automatic,  // the array owns its memory
                     "All pairs [dropped, kept], by dropped; the lowest index is kept.")
        .def_prop_ro("is_flat", &Bound::is_flat, "Whether no triangles are left: then points can only be removed.")
        .def_prop_ro("size", &Bound::size, "Number of points, duplicates included.")
        .def_prop_ro("changes", &Bound::changes, "Number of changes that have begun, failed ones too.")
        .def_prop_ro("inconclusive", &Bound::inconclusive, "Tests that each stage left open, in changes so far.");
}

}  // namespace

void bind_mesh(Modules& modules) {
    bind<PlaneSurface>(modules.plane,
                       "Delaunay triangulation of the plane that points can be added to and taken from.");
    bind<SphereSurface>(modules.sphere,
                        "Delaunay triangulation of directions that points can be added to and taken from.");
}

}  // namespace stereodel::python
