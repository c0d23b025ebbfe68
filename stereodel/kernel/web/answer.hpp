// The folder `web`: the kernel as a module of WebAssembly, for stereodel/web. Plain C functions on the module's memory,
// named after the space and what they do; one folder of the kernel a file, and nothing is computed here. Who calls has
// checked the arguments (stereodel/web/script/kernel/checks.ts).
// Reading order: answer, failures (how a call ends that does not succeed), delaunay, then any other.
//
// Arrays whose lengths a call finds out stay in the module until the page has read them and calls `discard`. Where the
// lengths are known, the page makes room by `allocate` and the call fills it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "duplicates.hpp"
#include "memory.hpp"
#include "tally.hpp"

// A function that the page calls by its own name.
#define STEREODEL_EXPORT(name) extern "C" __attribute__((used, visibility("default"), export_name(#name)))

namespace stereodel::web {

constexpr int alone = 1;  // thread

class Answer {
  public:
    // Arrays are read in the order in which they were added.
    template <class T>
    void add(Buffer<T>&& array) {
        auto* kept = new Buffer<T>(std::move(array));
        owners_.emplace_back(kept, [](void* owned) { delete static_cast<Buffer<T>*>(owned); });
        slots_[count_++] = {kept->data(), kept->size()};
    }

    template <class T>
    void add(const std::vector<T>& numbers) {
        add(copied(numbers));
    }

    void add(const Pairs& pairs) {
        add(to_buffer(pairs));
    }

    // Counts of cells and entries, all below 2^31.
    void add_offsets(const Buffer<std::int64_t>& offsets) {
        Buffer<Index> narrow(offsets.size());
        for (std::size_t k = 0; k < offsets.size(); ++k) {
            narrow[k] = static_cast<Index>(offsets[k]);
        }
        add(std::move(narrow));
    }

    // Filter, curvature, double-double, exact: doubles, which hold every count.
    void add(const Tally& tally) {
        add(std::vector<double>{static_cast<double>(tally.filter), static_cast<double>(tally.curvature),
                                static_cast<double>(tally.double_double), static_cast<double>(tally.exact)});
    }

  private:
    using Owner = std::unique_ptr<void, void (*)(void*)>;

    struct Slot {
        const void* address;
        std::size_t length;
    };

    static constexpr std::size_t most = 8;

    Slot slots_[most];  // the page reads these, two numbers of 32 bits each: they come first
    std::size_t count_ = 0;
    std::vector<Owner> owners_;
};

}  // namespace stereodel::web
