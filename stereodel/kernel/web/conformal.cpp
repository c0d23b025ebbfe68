// Rotations and conformal maps, composed and at many points. A matrix: its doubles and what they leave, 18 numbers.
// `parts`: the matrix of the left rotation, the magnification, and that of the right rotation: 37 numbers. A map to
// compose: quaternion, magnification and quaternion, nine numbers.
#include "conformal/moebius.hpp"

#include <cstddef>

#include "conformal/group.hpp"
#include "conformal/rotations.hpp"
#include "coordinates/degrees.hpp"
#include "web/answer.hpp"

namespace stereodel::web {

using arithmetic::DoubleDouble;
using conformal::Matrix;
using conformal::MoebiusParts;
using conformal::Quaternion;
using conformal::StoredMap;

namespace {

MoebiusParts to_parts(const double* parts) {
    return {{parts, parts + 9}, parts[18], {parts + 19, parts + 28}};
}

Quaternion exactly(const double* q) {
    return {DoubleDouble{q[0]}, DoubleDouble{q[1]}, DoubleDouble{q[2]}, DoubleDouble{q[3]}};
}

void round(const Quaternion& exact, double* quaternion) {
    for (std::size_t k = 0; k < 4; ++k) {
        quaternion[k] = exact[k].hi + exact[k].lo;
    }
}

}  // namespace

// Counterclockwise about a direction by twice so many degrees.
STEREODEL_EXPORT(rotation_about) void rotation_about(const double* axis, double half, double* quaternion) {
    const auto [sine, cosine] = coordinates::sin_cos_degrees(half);
    const conformal::Vector direction = conformal::unit(axis);
    round({cosine, direction[0] * sine, direction[1] * sine, direction[2] * sine}, quaternion);
}

STEREODEL_EXPORT(rotation_between)
void rotation_between(const double* start, const double* end, double* quaternion) {
    round(conformal::between(conformal::unit(start), conformal::unit(end)), quaternion);
}

STEREODEL_EXPORT(rotation_product)
void rotation_product(const double* then, const double* first, double* quaternion) {
    round(conformal::product(exactly(then), exactly(first)), quaternion);
}

STEREODEL_EXPORT(rotation_matrix) void rotation_matrix(const double* quaternion, double* matrix) {
    const Matrix exact = conformal::matrix_of(exactly(quaternion));
    for (std::size_t k = 0; k < 9; ++k) {
        matrix[k] = exact[k / 3][k % 3].hi;
        matrix[9 + k] = exact[k / 3][k % 3].lo;
    }
}

STEREODEL_EXPORT(rotated) void rotated(const double* quaternion, const double* xyz, std::size_t count, double* images) {
    conformal::rotate(conformal::matrix_of(exactly(quaternion)), xyz, count, images);
}

STEREODEL_EXPORT(moebius_product)
void moebius_product(const StoredMap* then, const StoredMap* first, StoredMap* product) {
    static_assert(sizeof(StoredMap) == 9 * sizeof(double), "a map is nine numbers");
    *product = conformal::composed(*then, *first);
}

STEREODEL_EXPORT(moebius_images)
bool moebius_images(const double* parts, const double* xyz, std::size_t count, double* images) {
    return conformal::moebius_images(to_parts(parts), xyz, count, images, alone, nullptr);
}

STEREODEL_EXPORT(moebius_lonlat)
bool moebius_lonlat(const double* parts, const double* lonlat, std::size_t count, double* images) {
    return conformal::moebius_lonlat(to_parts(parts), lonlat, count, images, alone, nullptr);
}

STEREODEL_EXPORT(moebius_scales)
bool moebius_scales(const double* parts, const double* xyz, std::size_t count, double* scales) {
    return conformal::moebius_scales(to_parts(parts), xyz, count, scales, alone, nullptr);
}

}  // namespace stereodel::web
