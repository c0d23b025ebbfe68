#include "input_checks.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace stereodel {
namespace {

// The checks leave a highest bit behind where something is wrong: those of all rows are joined by "or".
constexpr std::uint64_t TOP = std::uint64_t{1} << 63;
constexpr std::uint64_t EXPONENT = std::uint64_t{0x7FF} << 52;
constexpr std::uint64_t EXPONENT_UNIT = std::uint64_t{1} << 52;

std::uint64_t bits_of(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

// Infinity and NaN have all bits of the exponent; one more carries into the highest.
std::uint64_t if_not_finite(std::uint64_t bits) {
    return (bits & EXPONENT) + EXPONENT_UNIT;
}

// Less one, zero alone has the highest bit.
std::uint64_t if_zero(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    return ((x | y | z) & ~TOP) - 1;
}

std::uint64_t if_no_direction(const double* p) {
    const std::uint64_t x = bits_of(p[0]), y = bits_of(p[1]), z = bits_of(p[2]);
    return if_not_finite(x) | if_not_finite(y) | if_not_finite(z) | if_zero(x, y, z);
}

// Of numbers below 2^31, one of these two is negative unless 0 <= number < size.
std::uint32_t if_outside(std::uint32_t number, std::uint32_t size) {
    return number | (size - 1u - number);
}

bool has_top(std::uint32_t joined) {
    return (joined >> 31) != 0;
}

// "points[3, 0]", or "points[3]" in rows of one.
std::string place_in(const char* name, std::size_t k, std::size_t width) {
    const std::string row = std::to_string(k / width);
    const std::string column = width == 1 ? "" : ", " + std::to_string(k % width);
    return std::string(name) + "[" + row + column + "]";
}

// Of a number that is not finite. Not std::to_string, which would bring all printing of numbers with it.
const char* word_for(double value) {
    return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
}

[[noreturn]] void refuse(const std::string& message) {
    throw std::invalid_argument(message);
}

[[noreturn]] void refuse_number(const char* name, std::size_t k, std::size_t width, Index value, std::size_t size) {
    refuse(place_in(name, k, width) + " is " + std::to_string(value) + ", out of range: there are " +
           std::to_string(size));
}

// Whether the edge opposite corner k of triangle t is an edge of the neighbour there, backwards.
bool is_shared(const Index* simplices, const Index* neighbors, std::size_t t, std::size_t k) {
    const Index across = neighbors[3 * t + k];
    const Index from = simplices[3 * t + (k + 1) % 3], to = simplices[3 * t + (k + 2) % 3];
    const Index* const corner = simplices + 3 * static_cast<std::size_t>(across);
    const Index* const back = neighbors + 3 * static_cast<std::size_t>(across);
    for (std::size_t j = 0; j < 3; ++j) {
        if (back[j] == static_cast<Index>(t) && corner[(j + 1) % 3] == to && corner[(j + 2) % 3] == from) {
            return true;
        }
    }
    return false;
}

void refuse_too_many(const char* name, std::size_t count, std::size_t width) {
    if (count > static_cast<std::size_t>(std::numeric_limits<Index>::max()) / width) {
        refuse(std::string(name) + ": too many rows");
    }
}

}  // namespace

void check_finite(const char* name, const double* values, std::size_t count, std::size_t width) {
    std::uint64_t joined = 0;
    for (std::size_t k = 0; k < count * width; ++k) {
        joined |= if_not_finite(bits_of(values[k]));
    }
    for (std::size_t k = 0; (joined & TOP) != 0 && k < count * width; ++k) {
        if (!std::isfinite(values[k])) {
            refuse(place_in(name, k, width) + " is " + word_for(values[k]) + ", not a finite number");
        }
    }
}

void check_directions(const char* name, const double* xyz, std::size_t count) {
    std::uint64_t joined = 0;
    for (std::size_t k = 0; k < count; ++k) {
        joined |= if_no_direction(xyz + 3 * k);
    }
    if ((joined & TOP) == 0) {
        return;
    }
    check_finite(name, xyz, count, 3);
    for (std::size_t k = 0; k < count; ++k) {
        if ((if_no_direction(xyz + 3 * k) & TOP) != 0) {
            refuse(place_in(name, k, 1) + " is the zero vector, which has no direction");
        }
    }
}

void check_same_length(const char* first, std::size_t one, const char* second, std::size_t other) {
    if (one != other) {
        refuse(std::string(first) + " and " + second + " must have the same length, not " + std::to_string(one) +
               " and " + std::to_string(other));
    }
}

void check_indices(const char* name, const Index* numbers, std::size_t count, std::size_t size, std::size_t width) {
    std::uint32_t joined = 0;
    const std::uint32_t limit = static_cast<std::uint32_t>(size);
    for (std::size_t k = 0; k < count * width; ++k) {
        joined |= if_outside(static_cast<std::uint32_t>(numbers[k]), limit);
    }
    for (std::size_t k = 0; has_top(joined) && k < count * width; ++k) {
        if (has_top(if_outside(static_cast<std::uint32_t>(numbers[k]), limit))) {
            refuse_number(name, k, width, numbers[k], size);
        }
    }
}

void check_distinct(const char* name, const Index* numbers, std::size_t count, std::size_t size) {
    check_indices(name, numbers, count, size);
    std::vector<bool> taken(size);
    for (std::size_t k = 0; k < count; ++k) {
        const auto number = static_cast<std::size_t>(numbers[k]);
        if (taken[number]) {
            refuse(place_in(name, k, 1) + " is " + std::to_string(number) + " a second time; give each number once");
        }
        taken[number] = true;
    }
}

void check_triangles(const Index* simplices, const Index* neighbors, std::size_t count, std::size_t points,
                     Border border) {
    refuse_too_many("simplices", count, 3);
    check_indices("simplices", simplices, count, points, 3);
    const std::uint32_t none = border == Border::open ? 1 : 0, limit = static_cast<std::uint32_t>(count) + none;
    std::uint32_t joined = 0;
    for (std::size_t k = 0; k < 3 * count; ++k) {
        joined |= if_outside(static_cast<std::uint32_t>(neighbors[k]) + none, limit);
    }
    for (std::size_t k = 0; has_top(joined) && k < 3 * count; ++k) {
        if (has_top(if_outside(static_cast<std::uint32_t>(neighbors[k]) + none, limit))) {
            if (neighbors[k] == -1) {
                refuse(place_in("neighbors", k, 3) + " is -1, out of range: a closed surface has no border");
            }
            refuse_number("neighbors", k, 3, neighbors[k], count);
        }
    }
    for (std::size_t t = 0; t < count; ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (neighbors[3 * t + k] >= 0 && !is_shared(simplices, neighbors, t, k)) {
                refuse(place_in("neighbors", 3 * t + k, 3) + " does not fit: the triangles do not share that edge");
            }
        }
    }
}

}  // namespace stereodel
