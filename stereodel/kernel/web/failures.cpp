// Failures leave the module through one import, which throws in JavaScript. Nothing is unwound: the page drops the
// instance and makes another from the compiled module. So no support for exceptions is asked of the browser, and what
// the failed call held is gone with its memory. The kernel catches exceptions only to stop threads, of which there are
// none here.
//
// This file stands for parts of the C++ runtime: the functions that `throw` calls (names of the Itanium C++ ABI),
// `operator new` and `delete`, and the library's last words, which would bring printing and its imports with them.
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <new>
#include <typeinfo>

extern "C" {

// What failed, and the message: texts that end with 0.
[[noreturn]] __attribute__((import_module("page"), import_name("fail"))) void page_fail(const char* kind,
                                                                                        const char* message);

void* __cxa_allocate_exception(std::size_t size) noexcept {
    alignas(16) static char room[256];  // one alone is ever thrown
    return size <= sizeof room ? room : std::malloc(size);
}

void __cxa_free_exception(void*) noexcept {}

[[noreturn]] void __cxa_throw(void* object, std::type_info* type, void (*)(void*)) {
    const char* name = type->name();
    const bool is_standard = name[0] == 'S' && name[1] == 't';  // std::..., all of them exceptions here
    page_fail(name, is_standard ? static_cast<std::exception*>(object)->what() : "");
}

void* __cxa_begin_catch(void*) noexcept { std::abort(); }
void __cxa_end_catch() {}
[[noreturn]] void __cxa_rethrow() { std::abort(); }

[[noreturn]] void __assert_fail(const char* what, const char*, int, const char*) { page_fail("assert", what); }

}  // extern "C"

namespace {

void* taken(void* memory) {
    if (memory == nullptr) {
        page_fail("St9bad_alloc", "out of memory");
    }
    return memory;
}

void* taken_aligned(std::size_t size, std::align_val_t alignment) {
    const auto step = static_cast<std::size_t>(alignment);
    return taken(std::aligned_alloc(step, (size + step - 1) / step * step));
}

}  // namespace

void* operator new(std::size_t size) { return taken(std::malloc(size == 0 ? 1 : size)); }
void* operator new[](std::size_t size) { return taken(std::malloc(size == 0 ? 1 : size)); }
void* operator new(std::size_t size, std::align_val_t alignment) { return taken_aligned(size, alignment); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

_LIBCPP_BEGIN_NAMESPACE_STD
[[noreturn]] void __libcpp_verbose_abort(const char* format, ...) noexcept { page_fail("abort", format); }
_LIBCPP_END_NAMESPACE_STD
