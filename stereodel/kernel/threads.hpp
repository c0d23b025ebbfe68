// Threads: a loop over tasks on several of them, and a way to stop all.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace stereodel {

// Thrown out of a computation that somebody asked to stop.
struct Cancelled {};

using Stop = const std::atomic<bool>*;

inline void check(Stop stop) {
    if (stop != nullptr && stop->load(std::memory_order_relaxed)) {
        throw Cancelled{};
    }
}

// Calls task(k) for every k < count, on up to `workers` threads, the calling one among them; tasks are taken in order.
// The first exception ends the loop and is thrown here, after all threads have come back.
template <class Task>
void parallel_for(std::size_t count, int workers, Task&& task) {
    std::atomic<std::size_t> taken{0};
    std::exception_ptr failure;
    std::mutex mutex;
    const auto work = [&] {
        try {
            for (std::size_t k = taken++; k < count; k = taken++) {
                task(k);
            }
        } catch (...) {
            taken = count;
            const std::lock_guard lock(mutex);
            if (!failure) {
                failure = std::current_exception();
            }
        }
    };
    std::vector<std::thread> threads;
    for (std::size_t k = 1; k < static_cast<std::size_t>(workers) && k < count; ++k) {
        try {
            threads.emplace_back(work);
        } catch (const std::exception&) {
            break;  // no more threads to be had: those that run do all the work
        }
    }
    work();
    for (std::thread& thread : threads) {
        thread.join();
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

// Piece `k` of `pieces` of the range [0, size).
struct Piece {
    std::size_t begin, end;
    Piece(std::size_t size, std::size_t k, std::size_t pieces)
        : begin(size / pieces * k + size % pieces * k / pieces), end(size / pieces * (k + 1) + size % pieces * (k + 1) / pieces) {}
};

}  // namespace stereodel
