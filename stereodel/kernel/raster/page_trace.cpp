// The fisheye on u = 1 + z and w = 1 - z as in stereodel/conformal/moebius.py: u/S, S w and the rest unchanged are the
// image times `total`. The smaller of u and w comes from (x^2 + y^2)/(the larger), so that nothing cancels near the
// axis; what is left is the rounding of the unit vector, 2^-52, times the scale there.
#include "raster/page_trace.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "raster/rough_angle.hpp"

namespace stereodel::raster {


namespace {

struct Vector {
    double x, y, z;
};

Vector turned(const double* rows, Vector v) {
    return {rows[0] * v.x + rows[1] * v.y + rows[2] * v.z, rows[3] * v.x + rows[4] * v.y + rows[5] * v.z,
            rows[6] * v.x + rows[7] * v.y + rows[8] * v.z};
}

Vector times(double factor, Vector v) { return {factor * v.x, factor * v.y, factor * v.z}; }

// A point of the sphere, its changes over a step right and up on the page, and how much those change themselves.
struct Moving {
    Vector at, right, up;
    double bend;
};

// At the limb the derivative 1/z has no bound; over a step it is at most that of a chord of the last step,
// sqrt(2/step).
Moving orthographic(double x, double y, Step step) {
    const double r2 = x * x + y * y;
    const bool outside = r2 > 1.0;
    const double shrink = outside ? 1.0 / std::sqrt(r2) : 1.0;
    const double z = outside ? 0.0 : std::sqrt(1.0 - r2), least = std::sqrt(0.5 * step.longer());
    const double slope = z > least ? z : least;
    return {{x * shrink, y * shrink, z},
            {step.right, 0.0, -x * step.right / slope},
            {0.0, step.up, -y * step.up / slope},
            outside ? std::numeric_limits<double>::infinity() : step.longer() / (slope * slope)};
}

Moving stereographic(double x, double y, double reach, Step step) {
    const double a = reach * x, b = reach * y, below = 1.0 + a * a + b * b;
    const double scale = 2.0 * reach / below, right = scale * step.right, up = scale * step.up;
    const Vector at{2.0 * a / below, 2.0 * b / below, 2.0 / below - 1.0};
    const double bend = x * x + y * y > 1.0 ? std::numeric_limits<double>::infinity() : scale * step.longer();
    return {at,
            {right * (1.0 - a * at.x), -right * a * at.y, -right * a * (at.z + 1.0)},
            {-up * b * at.x, up * (1.0 - b * at.y), -up * b * (at.z + 1.0)},
            bend};
}

Moving gnomonic(double x, double y, Step step) {
    const double scale = 1.0 / std::sqrt(1.0 + x * x + y * y), right = scale * step.right, up = scale * step.up;
    const Vector at{x * scale, y * scale, scale};
    return {at,
            {right * (1.0 - at.x * at.x), -right * at.x * at.y, -right * at.x * at.z},
            {-up * at.x * at.y, up * (1.0 - at.y * at.y), -up * at.y * at.z},
            step.longer()};
}

// Rows shrink toward a pole: over a step up by tan(lat) steps, and at the pole to nothing.
Moving equirectangular(double lon, double lat, Step step) {
    const double east = std::sin(lon), ahead = std::cos(lon), north = std::sin(lat), level = std::cos(lat);
    const double steepness = std::abs(north) > std::abs(level) ? std::abs(north / level) : 1.0;
    return {{level * east, north, level * ahead},
            {level * ahead * step.right, 0.0, -level * east * step.right},
            {-north * east * step.up, level * step.up, -north * ahead * step.up},
            steepness * step.longer()};
}

Moving on_page(const PageMap& map, double x, double y, Step step) {
    switch (map.projection) {
        case PageProjection::stereographic: return stereographic(x, y, map.reach, step);
        case PageProjection::gnomonic: return gnomonic(x, y, step);
        case PageProjection::equirectangular: return equirectangular(x, y, step);
        default: return orthographic(x, y, step);
    }
}

Moving through_fisheye(const Moving& from, double size) {
    const double shrink = 1.0 / size, across = from.at.x * from.at.x + from.at.y * from.at.y;
    const bool above = from.at.z > 0.0;
    const double larger = 1.0 + std::abs(from.at.z), smaller = across / larger;
    const double lower = (above ? larger : smaller) * shrink, upper = (above ? smaller : larger) * size;
    const double scale = 2.0 / (lower + upper);
    const Vector at{from.at.x * scale, from.at.y * scale, (lower - upper) / (lower + upper)};
    double most = 0.0;
    const auto moved = [&](Vector d) {
        const double change = 0.5 * d.z * (shrink - size), stretch = 0.5 * d.z * (shrink + size);
        most = std::abs(change) > most ? std::abs(change) : most;
        return times(scale, {d.x - at.x * change, d.y - at.y * change, stretch - at.z * change});
    };
    const Vector right = moved(from.right), up = moved(from.up);
    const double bend = scale * most;
    return {at, right, up, from.bend > bend ? from.bend : bend};
}

Traced on_globe(const Moving& seen, const double* last) {
    const Vector p = turned(last, seen.at), right = turned(last, seen.right), up = turned(last, seen.up);
    const double across = p.x * p.x + p.y * p.y, radius = std::sqrt(across);
    const double inverse = 1.0 / (radius > 1e-150 ? radius : 1e-150), square = inverse * inverse;
    Traced out{};
    out.lon = rough_angle(p.y, p.x);
    out.lat = rough_angle(p.z, radius);
    out.lon_x = (p.x * right.y - p.y * right.x) * square;
    out.lon_y = (p.x * up.y - p.y * up.x) * square;
    out.lat_x = right.z * inverse;
    out.lat_y = up.z * inverse;
    // Of a cap about the pole the meridians turn once in its circumference.
    const double turn = std::abs(out.lon_x) > std::abs(out.lon_y) ? std::abs(out.lon_x) : std::abs(out.lon_y);
    out.bend = seen.bend > turn ? seen.bend : turn;
    return out;
}

}  // namespace

PageProjection page_projection(std::string_view name) {
    if (name == "orthographic") return PageProjection::orthographic;
    if (name == "stereographic") return PageProjection::stereographic;
    if (name == "gnomonic") return PageProjection::gnomonic;
    if (name == "equirectangular") return PageProjection::equirectangular;
    throw std::invalid_argument("projection must be orthographic, stereographic, gnomonic or equirectangular");
}

void trace_row(const PageMap& map, double x, double y, Step step, std::size_t count, Traced* out) {
    for (std::size_t k = 0; k < count; ++k) {
        const double along = x + static_cast<double>(k) * step.right;
        const Moving seen = on_page(map, along, y, step);
        const Moving in_lens{turned(map.first, seen.at), turned(map.first, seen.right), turned(map.first, seen.up),
                             seen.bend};
        out[k] = on_globe(through_fisheye(in_lens, map.size), map.last);
    }
}

}  // namespace stereodel::raster
