// Large arrays without initial values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace stereodel {

// Asks for memory that will be used soon; any address will do. GCC takes a function that does nothing else for one
// without effect and drops the call: hence the empty statement, which counts as an effect. WebAssembly has no such
// instruction.
inline void prefetch(const void* address) {
#if defined(__GNUC__) && !defined(__wasm__)
    __builtin_prefetch(address);
    __asm__ volatile("");
#else
    (void)address;
#endif
}

// An uninitialised array of plain values. Large ones ask for huge pages: random reads in an array of 100 MB miss the
// translation cache on nearly every access otherwise.
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    Buffer() = default;
    explicit Buffer(std::size_t size) : size_(size) {
        if (size > std::numeric_limits<std::size_t>::max() / sizeof(T) / 2) {
            throw std::bad_alloc{};
        }
        capacity_ = size * sizeof(T);
        data_ = static_cast<T*>(::operator new(capacity_, std::align_val_t{alignment()}));
#if defined(__linux__)
        if (capacity_ >= huge_) {
            (void)madvise(data_, capacity_ / huge_ * huge_, MADV_HUGEPAGE);  // advice: a refusal changes nothing
        }
#endif
    }
    // The memory of an array that is no longer needed, if it is large enough: pages that were never touched are slow.
    template <class Used>
    Buffer(Buffer<Used>&& used, std::size_t size) {
        if (size * sizeof(T) > used.capacity_) {
            used = {};
            *this = Buffer(size);
        } else {
            data_ = reinterpret_cast<T*>(std::exchange(used.data_, nullptr));
            capacity_ = std::exchange(used.capacity_, 0);
            size_ = size;
            used.size_ = 0;
        }
    }
    Buffer(Buffer&& other) noexcept { swap(other); }
    Buffer& operator=(Buffer&& other) noexcept {
        Buffer(std::move(other)).swap(*this);
        return *this;
    }
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    ~Buffer() {
        if (data_ != nullptr) {
            ::operator delete(data_, std::align_val_t{alignment()});
        }
    }

    void swap(Buffer& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        std::swap(capacity_, other.capacity_);
    }
    T* data() { return data_; }
    const T* data() const { return data_; }
    std::size_t size() const { return size_; }
    T& operator[](std::size_t k) { return data_[k]; }
    const T& operator[](std::size_t k) const { return data_[k]; }

  private:
    static constexpr std::size_t line_ = 64;  // of the cache
#if defined(__linux__)
    static constexpr std::size_t huge_ = std::size_t{1} << 21;

    std::size_t alignment() const { return capacity_ >= huge_ ? huge_ : line_; }
#else
    static std::size_t alignment() { return line_; }
#endif

    template <class Other>
    friend class Buffer;

    T* data_ = nullptr;
    std::size_t size_ = 0;
    std::size_t capacity_ = 0;  // bytes
};

template <class T>
Buffer<T> copied(const T* values, std::size_t count) {
    Buffer<T> buffer(count);
    std::copy_n(values, count, buffer.data());
    return buffer;
}

// Of a vector, or whatever else has values side by side.
template <class Array>
auto copied(const Array& array) {
    return copied(array.data(), array.size());
}

}  // namespace stereodel
