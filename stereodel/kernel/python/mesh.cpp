#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <utility>

#include "engine/plane.hpp"
#include "engine/sphere.hpp"
#include "growing_array.hpp"
#include "mesh/dynamic.hpp"
#include "mesh/plane_surface.hpp"
#include "mesh/sphere_surface.hpp"
#include "python/arrays.hpp"

namespace stereodel::python {

using engine::Pole;
using engine::Triangulation;
using engine::triangulate_plane;
using engine::triangulate_sphere;
using mesh::DynamicDelaunay;
using mesh::Mesh;
using mesh::PlaneSurface;
using mesh::SphereSurface;

namespace {

using namespace nb::literals;

constexpr std::size_t long_changes = 500;    // points: some milliseconds
constexpr std::size_t long_copies = 100000;  // points: the same

// For many who read at a time, or for one alone who writes. All pass a gate. Who is to be alone shuts it and then waits
// for those inside to leave: readers who keep coming do not keep a writer out for good.
struct PatientMutex {
    std::timed_mutex gate;
    std::shared_timed_mutex inside;
};

// Waits until `stop` is raised, and looks at that now and then.
template <template <class> class Lock, class Mutex>
Lock<Mutex> patiently(Mutex& mutex, Stop stop) {
    Lock<Mutex> lock(mutex, std::defer_lock);
    do {
        check(stop);
    } while (!lock.try_lock_for(std::chrono::milliseconds(20)));
    return lock;
}

template <template <class> class Lock>
Lock<std::shared_timed_mutex> locked(PatientMutex& mutex, Stop stop) {
    const auto gate = patiently<std::unique_lock>(mutex.gate, stop);
    return patiently<Lock>(mutex.inside, stop);
}

// What a mesh is between two changes, in arrays that nobody changes. Whoever asks gets the same ones.
struct State {
    std::uint64_t changes;
    Buffer<double> points;
    Buffer<Index> simplices, neighbors, duplicates;
    int dimension;
    Tally tally;
};

// Rows of a state as an array of NumPy's, read-only, that keeps the state alive.
template <std::size_t Width, class T>
nb::ndarray<nb::numpy, const T, nb::shape<-1, static_cast<nb::ssize_t>(Width)>, nb::c_contig> rows_of(
    const std::shared_ptr<const State>& state, const Buffer<T>& buffer) {
    using Holder = std::shared_ptr<const State>;
    auto* holder = new Holder(state);
    const nb::capsule owner(holder, [](void* p) noexcept { delete static_cast<Holder*>(p); });
    return {buffer.data(), {buffer.size() / Width, Width}, owner};
}

// A triangulation that Python holds, and any number of threads with it. Who reads shares the lock, who changes has it
// alone, and all the others wait.
//
// * Nobody waits while they hold the interpreter's lock, so that whoever has ours and wants that one gets it; and
//   nobody runs Python while they have ours. Long work, and work that has to wait, is done and has the lock on a thread
//   of its own, while the calling one looks for signals: their handlers may ask, even change, this same mesh, and wait
//   for it.
// * A state is written out under the lock, whole, so it is never that of two changes. `changes` counts those that are
//   done, and is increased under the lock: while it is that of a state, the state is the present one.
// * A change that does not come to its end leaves the points of before, and does not count. One that Ctrl-C comes too
//   late for is made, and counts, though its caller is told of the interruption.
template <class Surface>
class BoundMesh {
  public:
    static constexpr std::size_t width = DynamicDelaunay<Surface>::dimension;
    using Points = RowsIn<double, width>;

    BoundMesh(Points points, RowsIn<Index, 3> simplices, RowsIn<Index, 3> neighbors,
              const std::optional<RowsIn<Index, 2>>& duplicates, const std::optional<nb::dict>& inconclusive,
              bool checked)
        : size_(points.shape(0)) {
        Pairs pairs = to_pairs(duplicates, size_);
        if (inconclusive) {
            tally_ = to_tally(*inconclusive);
        }
        const nb::gil_scoped_release release;
        check_triangles(points, simplices, neighbors, checked);
        if (simplices.shape(0) == 0) {
            points_.append(points.data(), width * size_);
        } else {
            delaunay_.emplace(points.data(), size_, simplices.data(), neighbors.data(), simplices.shape(0),
                              std::move(pairs), Stop{});
        }
        is_bare_ = !delaunay_;
    }

    std::size_t insert(Points points, int workers, std::size_t anew) {
        const std::size_t count = points.shape(0);
        check_points("points", points);
        return change(count > long_changes, [&](Stop stop) {
            const std::size_t old = size_;
            if (delaunay_ && anew * count <= old) {
                try {
                    delaunay_->insert(points.data(), count, stop);
                } catch (...) {
                    give_up(old);
                    throw;
                }
            } else {
                GrowingArray<double> all;
                all.reserve(width * (old + count));
                all.append(coordinates(), width * old);
                all.append(points.data(), width * count);
                start(std::move(all), workers, stop);
            }
            size_ = old + count;
            return old;
        });
    }

    ValuesOut<Index> remove(ValuesIn<Index> indices, int workers, std::size_t anew) {
        const std::size_t count = indices.shape(0);
        return to_values(change(count > long_changes || size_ > long_copies, [&](Stop stop) {
            const std::size_t old = size_;
            check_indices("indices", indices.data(), count, old);
            std::size_t left = 0;
            Buffer<Index> number = numbers_without(indices, old, left);
            if (delaunay_ && anew * (old - left) <= left) {
                try {
                    delaunay_->remove(indices.data(), count, stop);
                } catch (...) {
                    give_up(old);
                    throw;
                }
                if (delaunay_->is_flat()) {
                    tally_ = {};  // as if they had never been more; the rest is found out when somebody reads
                    leave_triangles();
                    is_tallied_ = false;
                }
            } else {
                GrowingArray<double> rest;
                rest.resize(width * left);
                double* to = rest.data();
                for (std::size_t p = 0; p < old; ++p) {
                    if (number[p] >= 0) {
                        to = std::copy_n(coordinates() + width * p, width, to);
                    }
                }
                start(std::move(rest), workers, stop);
            }
            size_ = left;
            return number;
        }));
    }

    nb::tuple read(int workers) {
        using Holder = std::shared_ptr<const State>;
        const bool is_long = size_ > long_copies || is_bare_ || changing_ > 0;
        const Holder state = run_without_lock(is_long, [&](Stop stop) -> Holder {
            {
                const auto lock = locked<std::shared_lock>(mutex_, stop);
                if (state_) {
                    return state_;
                }
            }
            const auto lock = locked<std::unique_lock>(mutex_, stop);  // writing out moves facets
            if (!state_) {
                state_ = written(workers, stop);
            }
            return state_;
        });
        return nb::make_tuple(state->changes, rows_of<width>(state, state->points), rows_of<3>(state, state->simplices),
                              rows_of<3>(state, state->neighbors), rows_of<2>(state, state->duplicates),
                              state->dimension, to_dict(state->tally, !Surface::has_ghost));
    }

    // Asked before each query: where nobody changes anything, nobody waits for it.
    std::uint64_t changes() {
        return changing_ == 0 ? changes_.load() : run_without_lock(true, [&](Stop stop) {
            const auto lock = locked<std::shared_lock>(mutex_, stop);
            return changes_.load();
        });
    }

    std::size_t size() {
        return changing_ == 0 ? size_.load() : run_without_lock(true, [&](Stop stop) {
            const auto lock = locked<std::shared_lock>(mutex_, stop);
            return size_.load();
        });
    }

  private:
    // A thread that is changing the mesh, or waits until it may.
    struct Changing {
        explicit Changing(std::atomic<int>& number) : count(number) { ++count; }
        Changing(const Changing&) = delete;
        Changing& operator=(const Changing&) = delete;
        ~Changing() { --count; }
        std::atomic<int>& count;
    };

    template <class Work>
    auto change(bool is_long, Work&& work) {
        const Changing mark(changing_);
        return run_without_lock(is_long || is_bare_ || changing_ > 1, [&](Stop stop) {
            const auto lock = locked<std::unique_lock>(mutex_, stop);
            auto result = work(stop);
            state_.reset();
            ++changes_;
            return result;
        });
    }

    const double* coordinates() const { return delaunay_ ? delaunay_->points() : points_.data(); }

    // New number of each of `size` points, -1 for those that go; how many are left.
    static Buffer<Index> numbers_without(const ValuesIn<Index>& gone, std::size_t size, std::size_t& left) {
        Buffer<Index> number(size);
        std::fill_n(number.data(), size, 0);
        for (std::size_t k = 0; k < gone.shape(0); ++k) {
            number[static_cast<std::size_t>(gone.data()[k])] = -1;
        }
        for (std::size_t p = 0; p < size; ++p) {
            if (number[p] == 0) {
                number[p] = static_cast<Index>(left++);
            }
        }
        return number;
    }

    static Triangulation triangulated(const double* points, std::size_t size, int workers, Stop stop) {
        if constexpr (width == 2) {
            return triangulate_plane(points, size, true, workers, stop);
        } else {
            return triangulate_sphere(points, size, true, workers, Pole{0, -1}, stop);
        }
    }

    // From the points alone. What throws, throws before anything is changed.
    void start(GrowingArray<double>&& points, int workers, Stop stop) {
        const std::size_t size = points.size() / width;
        Triangulation made = triangulated(points.data(), size, workers, stop);
        if (made.dimension == 2) {
            const engine::Triangles& rows = made.triangles;
            delaunay_ = DynamicDelaunay<Surface>(points.data(), size, rows.corners.data(), rows.neighbors.data(),
                                                 rows.count(), std::move(made.duplicates), stop);
            points_ = {};
        } else {
            delaunay_.reset();
            points_ = std::move(points);
            duplicates_ = std::move(made.duplicates);
        }
        dimension_ = made.dimension;
        tally_ = made.tally;
        is_tallied_ = true;
        is_bare_ = !delaunay_;
    }

    // After a change that did not end: the first `size` points are those of before.
    void give_up(std::size_t size) {
        tally_ += delaunay_->tally();
        leave_triangles();
        points_.resize(width * size);
    }

    void leave_triangles() {
        points_ = delaunay_->leave_points();
        delaunay_.reset();
        dimension_ = unknown;
        is_bare_ = true;
    }

    std::shared_ptr<const State> written(int workers, Stop stop) {
        if (!delaunay_ && dimension_ == unknown) {
            const Tally known = tally_;
            const bool is_tallied = is_tallied_;
            GrowingArray<double> points;
            points.append(points_.data(), points_.size());
            start(std::move(points), workers, stop);
            if (is_tallied) {
                tally_ = known;
            }
        }
        auto state = std::make_shared<State>();
        state->changes = changes_;
        state->points = copied(coordinates(), width * size_);
        state->dimension = delaunay_ ? 2 : dimension_;
        state->tally = tally_;
        std::size_t triangles = 0;
        if (delaunay_) {
            state->tally += delaunay_->tally();
            triangles = delaunay_->mesh().triangles();
        }
        state->simplices = Buffer<Index>(3 * triangles);
        state->neighbors = Buffer<Index>(3 * triangles);
        if (delaunay_) {
            delaunay_->mesh().write(state->simplices.data(), state->neighbors.data(), stop);
        }
        state->duplicates = to_buffer(delaunay_ ? delaunay_->duplicates() : duplicates_);
        return state;
    }

    static constexpr int unknown = -2;  // dimension of points that nobody has looked at since they were left

    // Under the lock; the atomic ones are looked at without it, too, to guess how long something will take.
    std::optional<DynamicDelaunay<Surface>> delaunay_;
    GrowingArray<double> points_;  // where that is not there, and so are the next two
    Pairs duplicates_;
    int dimension_ = unknown;
    Tally tally_;  // before delaunay_
    bool is_tallied_ = true;
    std::shared_ptr<const State> state_;  // if somebody asked since the last change
    std::atomic<std::size_t> size_;
    std::atomic<bool> is_bare_{false};  // no triangles: whoever changes or asks takes up all points
    std::atomic<std::uint64_t> changes_{0};

    PatientMutex mutex_;
    std::atomic<int> changing_{0};
};

template <class Surface>
void bind(nb::module_& space, const char* doc) {
    using Bound = BoundMesh<Surface>;
    nb::class_<Bound>(space, "Mesh", doc)
        .def(nb::init<typename Bound::Points, RowsIn<Index, 3>, RowsIn<Index, 3>, std::optional<RowsIn<Index, 2>>,
                      std::optional<nb::dict>, bool>(),
             "points"_a, "simplices"_a, "neighbors"_a, "duplicates"_a = nb::none(), "inconclusive"_a = nb::none(),
             "checked"_a = false,
             "The triangulation of `points`, as `triangulate` gives it. Copies everything. While one thread changes "
             "it, the others wait, without the interpreter's lock.")
        .def("insert", &Bound::insert, "points"_a, "workers"_a = 1, "anew"_a = 0,
             "Append points. Returns the number of the first. anew: all are triangulated anew if so many times the new "
             "ones are more than the old ones.")
        .def("remove", &Bound::remove, "indices"_a, "workers"_a = 1, "anew"_a = 0,
             "Take points out, number the others anew in the same order. Returns old -> new, -1 = removed. anew: as "
             "for `insert`, of those removed and of those left.")
        .def("read", &Bound::read, "workers"_a = 1,
             "All of one state, in arrays that nobody changes: changes so far, points, then what `triangulate` gives; "
             "pairs [dropped, kept] by dropped.")
        .def_prop_ro("changes", &Bound::changes, "Number of changes that have come to their end.")
        .def_prop_ro("size", &Bound::size, "Number of points, duplicates included.");
}

}  // namespace

void bind_mesh(Modules& modules) {
    bind<PlaneSurface>(modules.plane,
                       "Delaunay triangulation of the plane that points can be added to and taken from.");
    bind<SphereSurface>(modules.sphere,
                        "Delaunay triangulation of directions that points can be added to and taken from.");
}

}  // namespace stereodel::python
