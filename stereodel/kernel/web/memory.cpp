// Room for what the page hands in, and the end of what it has read.
#include <cstddef>
#include <new>

#include "web/answer.hpp"

namespace stereodel::web {

constexpr std::align_val_t for_any_array{16};

STEREODEL_EXPORT(allocate) void* allocate(std::size_t bytes) { return ::operator new(bytes, for_any_array); }

STEREODEL_EXPORT(release) void release(void* memory) { ::operator delete(memory, for_any_array); }

STEREODEL_EXPORT(discard) void discard(Answer* answer) { delete answer; }

}  // namespace stereodel::web
