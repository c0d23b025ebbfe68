// The files beside the folders are what all of them share: memory, threads, tally (signs and counts of open tests),
// duplicates, growing_array and index_set; input_checks, for callers from outside; assumptions, which a build must
// keep. The folders, from the ground: arithmetic, coordinates, predicates, order, mesh, engine, queries, voronoi,
// graphs, interpolation, conformal, raster, partitions, and two doors, python and web. Each includes those before it
// alone; the main header of each begins with what the folder is for.
//
// Threads: loops over tasks on several of them, and a way to stop all.
//
// Where there are none (STEREODEL_THREADS = 0, as in WebAssembly without shared memory, whose C++ library has neither
// std::thread nor std::mutex), every crew is the calling thread alone; the results are the same. So they are where a
// system has threads and gives none. Beside this file only the folder `python` asks for threads and locks.
#pragma once

#if !defined(STEREODEL_THREADS)
#if defined(__wasm__) && !defined(_REENTRANT)
#define STEREODEL_THREADS 0
#else
#define STEREODEL_THREADS 1
#endif
#endif

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <vector>

#if STEREODEL_THREADS
#include <condition_variable>
#include <mutex>
#include <thread>
#endif

namespace stereodel {

// Thrown out of a computation that somebody asked to stop.
struct Cancelled {};

using Stop = const std::atomic<bool>*;

inline void check(Stop stop) {
    if (stop != nullptr && stop->load(std::memory_order_relaxed)) {
        throw Cancelled{};
    }
}

// As many of `workers` as a call on `size` points can keep busy, with about `worth_a_thread` of them each.
inline int useful_workers(int workers, std::size_t size, std::size_t worth_a_thread = 1024) {
    const std::size_t most = (size + worth_a_thread - 1) / worth_a_thread;
    return static_cast<std::size_t>(workers) < most ? workers : static_cast<int>(most);
}

#if STEREODEL_THREADS

using Mutex = std::mutex;
using Lock = std::lock_guard<Mutex>;

// Lets other threads go first, while this one waits for what they do.
inline void wait_for_others() {
    std::this_thread::yield();
}

// Threads that wait for loops. The calling thread is one of them: a crew of one starts none.
class Crew {
  public:
    explicit Crew(int workers) {
        for (int k = 1; k < workers; ++k) {
            try {
                threads_.emplace_back([this] { serve(); });
            } catch (const std::exception&) {
                break;  // no more threads to be had: those that run do all the work
            }
        }
    }
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;
    ~Crew() {
        {
            const Lock lock(mutex_);
            leave_ = true;
        }
        begins_.notify_all();
        for (std::thread& thread : threads_) {
            thread.join();
        }
    }

    std::size_t size() const { return threads_.size() + 1; }

    // Calls task(k) for every k < count; tasks are taken in order. The first exception ends the loop and is thrown
    // here, after all threads have come back.
    template <class Task>
    void run(std::size_t count, Task&& task) {
        std::atomic<std::size_t> taken{0};
        std::exception_ptr failure;
        bool failed = false;  // by more than being cancelled, which often follows from the failure of another task
        const auto end_with = [&](bool by_more) {
            taken = count;
            const Lock lock(mutex_);
            if (!failure || (by_more && !failed)) {
                failure = std::current_exception();
                failed = by_more;
            }
        };
        const auto work = [&] {
            try {
                for (std::size_t k = taken++; k < count; k = taken++) {
                    task(k);
                }
            } catch (const Cancelled&) {
                end_with(false);
            } catch (...) {
                end_with(true);
            }
        };
        if (count > 1 && !threads_.empty()) {
            together(work);
        } else {
            work();
        }
        if (failure) {
            std::rethrow_exception(failure);
        }
    }

  private:
    // All threads do the same work.
    void together(const std::function<void()>& work) {
        {
            const Lock lock(mutex_);
            work_ = &work;
            busy_ = threads_.size();
            ++round_;
        }
        begins_.notify_all();
        work();
        std::unique_lock lock(mutex_);
        ends_.wait(lock, [this] { return busy_ == 0; });
    }

    void serve() {
        std::size_t seen = 0;
        std::unique_lock lock(mutex_);
        for (;;) {
            begins_.wait(lock, [&] { return leave_ || round_ != seen; });
            if (leave_) {
                return;
            }
            seen = round_;
            const std::function<void()>& work = *work_;
            lock.unlock();
            work();
            lock.lock();
            if (--busy_ == 0) {
                ends_.notify_one();
            }
        }
    }

    std::vector<std::thread> threads_;
    Mutex mutex_;
    std::condition_variable begins_, ends_;
    const std::function<void()>* work_ = nullptr;
    std::size_t round_ = 0, busy_ = 0;
    bool leave_ = false;
};

#else

struct Mutex {};

struct Lock {
    explicit Lock(Mutex&) {}
    ~Lock() {}  // not trivial: a lock that is named and not used is meant
};

inline void wait_for_others() {}

// The calling thread.
class Crew {
  public:
    explicit Crew(int) {}
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;

    std::size_t size() const { return 1; }

    template <class Task>
    void run(std::size_t count, Task&& task) {
        for (std::size_t k = 0; k < count; ++k) {
            task(k);
        }
    }
};

#endif

// Calls task(begin, end) for the ranges that make up [0, size): `grain` numbers each, the last one fewer.
template <class Task>
void in_grains(std::size_t size, std::size_t grain, Crew& crew, Task&& task) {
    crew.run((size + grain - 1) / grain, [&](std::size_t k) { task(k * grain, std::min(size, (k + 1) * grain)); });
}

// Calls body(k) for all k of [begin, end) and looks at `stop` now and then.
template <class Body>
void for_range(std::size_t begin, std::size_t end, Stop stop, Body&& body) {
    constexpr std::size_t between_looks = 4096;
    while (begin < end) {
        check(stop);
        for (const std::size_t pause = std::min(end, begin + between_looks); begin < pause; ++begin) {
            body(begin);
        }
    }
}

// The same for all k below `size`, in any order.
template <class Body>
void for_all(std::size_t size, Crew& crew, Stop stop, Body&& body) {
    constexpr std::size_t grain = std::size_t{1} << 14;
    in_grains(size, grain, crew, [&](std::size_t begin, std::size_t end) { for_range(begin, end, stop, body); });
}

// Piece `k` of `pieces` of the range [0, size).
struct Piece {
    std::size_t begin, end;
    Piece(std::size_t size, std::size_t k, std::size_t pieces)
        : begin(size / pieces * k + size % pieces * k / pieces),
          end(size / pieces * (k + 1) + size % pieces * (k + 1) / pieces) {}
};

}  // namespace stereodel
