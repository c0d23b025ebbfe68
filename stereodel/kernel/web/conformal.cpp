// Conformal maps, composed and at many points. `parts`: the matrix of the left rotation, what its doubles leave, the
// magnification, and the right rotation as the left one: 37 numbers. A map to compose: quaternion, magnification and
// quaternion, nine numbers.
#include "conformal/moebius.hpp"

#include <algorithm>
#include <cstddef>

#include "conformal/group.hpp"
#include "web/answer.hpp"

namespace stereodel::web {

using conformal::MoebiusParts;
using conformal::StoredMap;

namespace {

MoebiusParts to_parts(const double* parts) {
    return {{parts, parts + 9}, parts[18], {parts + 19, parts + 28}};
}

StoredMap to_map(const double* numbers) {
    StoredMap map;
    std::copy_n(numbers, 4, map.left.begin());
    map.magnification = numbers[4];
    std::copy_n(numbers + 5, 4, map.right.begin());
    return map;
}

}  // namespace

STEREODEL_EXPORT(moebius_product) void moebius_product(const double* then, const double* first, double* product) {
    const StoredMap map = conformal::composed(to_map(then), to_map(first));
    std::copy(map.left.begin(), map.left.end(), product);
    product[4] = map.magnification;
    std::copy(map.right.begin(), map.right.end(), product + 5);
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
