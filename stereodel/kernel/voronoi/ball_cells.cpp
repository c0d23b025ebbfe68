#include "voronoi/ball_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "arithmetic/big_ball.hpp"
#include "predicates/ray_forms.hpp"

namespace stereodel::voronoi {

using arithmetic::BigBall;

namespace {

using Vector = std::array<BigBall, 3>;

Vector vector_of(const double* v, std::size_t limbs) {
    return {BigBall(v[0], limbs), BigBall(v[1], limbs), BigBall(v[2], limbs)};
}

BigBall dot(const Vector& a, const Vector& b) { return rays::dot_form(a.data(), b.data()); }

BigBall length(const Vector& a) { return sqrt(dot(a, a)); }

Vector product(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector operator+(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector operator*(const BigBall& factor, const Vector& a) { return {factor * a[0], factor * a[1], factor * a[2]}; }

bool is_zero(const Vector& a) { return a[0].is_zero() && a[1].is_zero() && a[2].is_zero(); }

// A site as given, its length, and its direction.
struct BallDirection {
    Vector given, unit;
    BigBall length;

    BallDirection(const double* point, std::size_t limbs) : given(vector_of(point, limbs)) {
        length = sqrt(dot(given, given));
        unit = (length.like(1.0) / length) * given;
    }
};

// The difference q - p of two directions and their sum, each relatively right: with w the product of the vectors as
// given, whose components are differences of two products of doubles, sine and cosine of the angle a between them are
// |w| and p.q over the lengths, and the part of q across p is w x p over its length and them. So the shorter one of
// q -+ p is that part less p (1 - |cos a|), 1 - |cos a| = sin^2 a/(1 + |cos a|).
struct Chord {
    bool is_far;  // beyond 90 degrees
    Vector difference, sum;
    BigBall difference_length, sum_length;

    Chord(const BallDirection& p, const BallDirection& q) {
        const BigBall one = p.length.like(1.0), lengths = one / (p.length * q.length);
        const Vector w = lengths * product(p.given, q.given);
        const BigBall cosine = dot(p.given, q.given) * lengths;
        is_far = cosine.sign() < 0;
        const BigBall size = is_far ? -cosine : cosine, less = dot(w, w) / (one + size);
        const Vector across = product(w, p.unit);
        Vector& small = is_far ? sum : difference;
        Vector& large = is_far ? difference : sum;
        small = is_far ? across + less * p.unit : across - less * p.unit;
        large = is_far ? q.unit - p.unit : q.unit + p.unit;
        (is_far ? sum_length : difference_length) = sqrt(less.times_power(1));
        (is_far ? difference_length : sum_length) = sqrt((one + size).times_power(1));
    }
};

// The lesser of a vector's length and the component along an axis, in the direction of `sign`: |v| - s v_k.
BigBall behind(const BallDirection& v, std::size_t axis, int sign) {
    const BigBall along = sign > 0 ? v.given[axis] : -v.given[axis];
    if (along.sign() <= 0) {
        return v.length - along;
    }
    const BigBall &a = v.given[(axis + 1) % 3], &b = v.given[(axis + 2) % 3];
    return (a * a + b * b) / (v.length + along);
}

// The absolute value of the determinant with rows (x, y, z, |p|), by 2 x 2 minors, with |p| less the component of the
// axis along which p is longest: near that axis nothing cancels.
BigBall bubble(const BallDirection& p, const BallDirection& q, const BallDirection& r, const BallDirection& s) {
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
        const auto size = [&p](std::size_t j) { return std::fabs(p.given[j].middle(0)); };
        axis = size(k) > size(axis) ? k : axis;
    }
    const int sign = p.given[axis].sign();
    const auto row = [axis, sign](const BallDirection& v) {
        return std::array<BigBall, 4>{v.given[0], v.given[1], v.given[2], behind(v, axis, sign)};
    };
    const std::array<BigBall, 4> a = row(p), b = row(q), c = row(r), d = row(s);
    using Four = std::array<BigBall, 4>;
    const auto minor = [](const Four& x, const Four& y, std::size_t i, std::size_t j) {
        return x[i] * y[j] - x[j] * y[i];
    };
    const BigBall value = minor(a, b, 0, 1) * minor(c, d, 2, 3) - minor(a, b, 0, 2) * minor(c, d, 1, 3) +
                       minor(a, b, 0, 3) * minor(c, d, 1, 2) + minor(a, b, 1, 2) * minor(c, d, 0, 3) -
                       minor(a, b, 1, 3) * minor(c, d, 0, 2) + minor(a, b, 2, 3) * minor(c, d, 0, 1);
    return value.sign() < 0 ? -value : value;
}

// Any direction across a unit vector.
Vector across(const Vector& unit) {
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
        axis = std::fabs(unit[k].middle(0)) < std::fabs(unit[axis].middle(0)) ? k : axis;
    }
    const BigBall zero = unit[0].like(0.0);
    Vector along{zero, zero, zero};
    along[axis] = zero.like(1.0);
    return product(unit, along);
}

// The ridges of a cell of the sphere (cell_ridges.hpp). With S = p + q, E = r - p, F = r - q the vertex N = D x E or
// E x D of the ridge with q and of r has the components
//     2 det[p q r]/|S| towards the middle,  |D| E.F/|S| along it;
// both are as short as S where that is short: det[p q r] = det[p S r], E.F = |S|^2/2 - r.S, and over S any direction
// across p stands for that of S = 0. The product of two such N is D det[D E G] for the other vertex's G = s - p; that
// is the bubble's determinant over all lengths.
std::vector<Ridge<BigBall>> ridges_in_balls(const std::vector<const double*>& sites, std::size_t limbs) {
    const std::size_t size = sites.size() - 1;
    const BallDirection p(sites[size], limbs);
    std::vector<BallDirection> others;
    std::vector<Chord> chords;
    std::vector<Vector> sums;
    std::vector<BigBall> sum_lengths;
    for (std::size_t k = 0; k < size; ++k) {
        others.emplace_back(sites[k], limbs);
        chords.emplace_back(p, others[k]);
        const bool is_opposite = is_zero(chords[k].sum);
        sums.push_back(is_opposite ? across(p.unit) : chords[k].sum);
        sum_lengths.push_back(is_opposite ? length(sums[k]) : chords[k].sum_length);
    }
    // Of the ridge k: the vector of the vertex with the neighbour r on its left (sign 1) or right (-1).
    const auto leg = [&](std::size_t k, std::size_t r, const Vector& back, double sign) {
        const Chord& chord = chords[k];
        const BigBall factor = p.length.like(sign);
        BigBall across_form, volume;
        if (chord.is_far) {
            across_form = (dot(chord.sum, chord.sum).times_power(-1) - dot(others[r].unit, sums[k]));
            volume = dot(p.unit, product(sums[k], others[r].unit));
        } else {
            across_form = dot(chords[r].difference, back);
            volume = dot(p.given, product(others[k].given, others[r].given)) /
                     (p.length * others[k].length * others[r].length);
        }
        return Leg<BigBall>{factor * chord.difference_length * across_form, factor * volume.times_power(1)};
    };
    std::vector<Leg<BigBall>> legs(2 * size);
    for (std::size_t k = 0, last = size - 1; k < size; last = k++) {
        const Vector to_next = Chord(others[last], others[k]).difference, back = to_next[0].like(-1.0) * to_next;
        legs[2 * last] = leg(last, k, to_next, 1.0);
        legs[2 * k + 1] = leg(k, last, back, -1.0);
    }
    std::vector<Ridge<BigBall>> ridges(size);
    for (std::size_t k = 0; k < size; ++k) {
        Leg<BigBall>&left = legs[2 * k], &right = legs[2 * k + 1];
        const BallDirection &before = others[(k + size - 1) % size], &after = others[(k + 1) % size];
        const BigBall to_left = length_of(left.across, left.along), to_right = length_of(right.across, right.along);
        Ridge<BigBall>& ridge = ridges[k];
        for (std::size_t i = 0; i < 3; ++i) {
            ridge.edge[i] = chords[k].difference[i];
        }
        ridge.length = chords[k].difference_length;
        ridge.sine = ridge.length.times_power(-1);
        ridge.cosine = is_zero(chords[k].sum) ? p.length.like(0.0) : chords[k].sum_length.times_power(-1);
        const BigBall lengths = p.length * others[k].length * before.length * after.length;
        const BigBall ridge_sine = size == 2 ? p.length.like(0.0)
                                          : bubble(p, before, others[k], after) * ridge.length * sum_lengths[k] *
                                                sum_lengths[k] / (lengths * to_left * to_right);
        left = {left.across / to_left, left.along / to_left};
        right = {right.across / to_right, right.along / to_right};
        ridge.set(left, right, ridge_sine);
    }
    return ridges;
}

std::vector<const double*> sites_around(const double* points, const Cells& cells, std::size_t site, std::size_t width) {
    std::vector<const double*> sites;
    for (std::size_t entry = cells.begin(site); entry < cells.end(site); ++entry) {
        sites.push_back(points + width * static_cast<std::size_t>(cells.neighbors[entry]));
    }
    sites.push_back(points + width * site);
    return sites;
}

// A difference of two points of the plane.
struct BallDifference {
    BigBall x, y, square;

    BallDifference(const double* from, const double* to, std::size_t limbs)
        : x(BigBall(to[0], limbs) - BigBall(from[0], limbs)), y(BigBall(to[1], limbs) - BigBall(from[1], limbs)) {
        square = x * x + y * y;
    }
};

BigBall product(const BallDifference& a, const BallDifference& b) { return a.x * b.y - a.y * b.x; }

// With d = q - p and c and e for the neighbours before and after q the ridge reaches, in units of |d|, from the middle
// to g' = e.(e - d)/(2 d x e) on the left and g" = c.(c - d)/(2 c x d) on the right:
//     g' + g" = (|e|^2 c x d + |d|^2 e x c + |c|^2 d x e)/(2 (c x d) (d x e)),
// the determinant that says that e is not in the circle of p, c and d. The triangle of p and the ridge has the area
// |d|^2 (g' + g")/4 and the centroid (d + (g' - g") d')/3 from p, d' being d turned by 90 degrees.
MeasuredCell plane_cell(const std::vector<const double*>& sites, std::size_t limbs) {
    const std::size_t size = sites.size() - 1;
    std::vector<BallDifference> edges;
    std::int64_t exponent = std::numeric_limits<std::int64_t>::min();
    for (std::size_t k = 0; k < size; ++k) {
        edges.emplace_back(sites[size], sites[k], limbs);
        for (const BigBall& part : {edges[k].x, edges[k].y}) {
            exponent = part.sign() == 0 ? exponent : std::max(exponent, part.exponent());
        }
    }
    std::vector<BigBall> volumes;  // d x e
    for (std::size_t k = 0; k < size; ++k) {
        volumes.push_back(product(edges[k], edges[(k + 1) % size]));
    }
    BigBall area(0.0, limbs), x = area, y = area;
    double reach = 0.0;
    for (std::size_t k = 0; k < size; ++k) {
        const BallDifference &c = edges[(k + size - 1) % size], &d = edges[k], &e = edges[(k + 1) % size];
        const BigBall &cd = volumes[(k + size - 1) % size], &de = volumes[k];
        const BigBall both = (e.square * cd + d.square * product(e, c) + c.square * de) / (cd * de);
        const BigBall left = (e.x * (e.x - d.x) + e.y * (e.y - d.y)) / de;
        const BigBall right = (c.x * (c.x - d.x) + c.y * (c.y - d.y)) / cd;
        const BigBall weight = d.square * both, turn = (left - right).times_power(-1);
        area = area + weight;
        x = x + weight * (d.x - turn * d.y);
        y = y + weight * (d.y + turn * d.x);
        reach = std::max({reach, std::fabs(d.x.middle(exponent)), std::fabs(d.y.middle(exponent))});
    }
    const BigBall three = area.like(3.0), eighth = area.times_power(-3);
    x = x / (three * area);
    y = y / (three * area);
    const std::int64_t scale = area.exponent();
    const double error = std::max(x.radius(exponent), y.radius(exponent));
    return {eighth.middle(0), {x.middle(0), y.middle(0), 0.0},
            area.radius(scale) <= CELL_ERROR * area.middle(scale) && error <= CELL_ERROR * reach / 2};
}

constexpr std::size_t FEWEST = 8, MOST = 8192;  // limbs; the determinants of cells have some 600 if nothing is cut off

// Of the measure(limbs) that is good first.
template <class Measure>
MeasuredCell with_enough_limbs(Measure&& measure) {
    for (std::size_t limbs = FEWEST; limbs <= MOST; limbs *= 2) {
        const MeasuredCell cell = measure(limbs);
        if (cell.good) {
            return cell;
        }
    }
    throw std::invalid_argument("the cells are not those of a Voronoi diagram");
}

}  // namespace

MeasuredCell sphere_cell_in_balls(const double* points, const Cells& cells, std::size_t site, const UnitVector& unit,
                                  bool with_centroid) {
    const std::vector<const double*> sites = sites_around(points, cells, site, 3);
    return with_enough_limbs([&](std::size_t limbs) {
        const std::vector<Ridge<BigBall>> ridges = ridges_in_balls(sites, limbs);
        return RidgeSum<BigBall>(unit, ridges).measure(with_centroid);
    });
}

MeasuredCell plane_cell_in_balls(const double* points, const Cells& cells, std::size_t site) {
    const std::vector<const double*> sites = sites_around(points, cells, site, 2);
    return with_enough_limbs([&](std::size_t limbs) { return plane_cell(sites, limbs); });
}

}  // namespace stereodel::voronoi
