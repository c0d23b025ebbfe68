// Conformal maps at many points. `parts`: the matrix of the left rotation, what its doubles leave, the magnification,
// and the right rotation as the left one: 37 numbers.
#include "conformal/moebius.hpp"

#include <cstddef>

#include "web/answer.hpp"

namespace stereodel::web {

using conformal::MoebiusParts;

namespace {

MoebiusParts to_parts(const double* parts) {
    return {{parts, parts + 9}, parts[18], {parts + 19, parts + 28}};
}

}  // namespace

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
