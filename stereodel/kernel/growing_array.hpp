// An array that grows at its end and gives no value to what nobody has written.
#pragma once

#include <algorithm>
#include <cstddef>

#include "memory.hpp"

namespace stereodel {

template <class T>
class GrowingArray {
  public:
    std::size_t size() const { return size_; }
    T* data() { return buffer_.data(); }
    const T* data() const { return buffer_.data(); }
    T& operator[](std::size_t k) { return buffer_[k]; }
    const T& operator[](std::size_t k) const { return buffer_[k]; }

    // Room for so many; growing by half, or by what is asked for if that is more, keeps the cost of copying linear.
    void reserve(std::size_t size) {
        if (size > buffer_.size()) {
            Buffer<T> larger(std::max(size, buffer_.size() + buffer_.size() / 2));
            std::copy(data(), data() + size_, larger.data());
            buffer_.swap(larger);
        }
    }

    // New values at the end are whatever the memory holds.
    void resize(std::size_t size) {
        reserve(size);
        size_ = size;
    }

    void push_back(const T& value) {
        const T copy = value;
        resize(size_ + 1);
        buffer_[size_ - 1] = copy;
    }

    void append(const T* values, std::size_t count) {
        const std::size_t old = size_;
        resize(old + count);
        std::copy(values, values + count, data() + old);
    }

  private:
    Buffer<T> buffer_;
    std::size_t size_ = 0;
};

}  // namespace stereodel
