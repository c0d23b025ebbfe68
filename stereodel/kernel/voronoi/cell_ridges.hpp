// Ridges of a cell of the sphere as seen from its site, in numbers that know their error (Bounded or BigBall), and what
// they add up to: area and centroid.
//
// The plane of a ridge is normal to D = q - p. Angles along it are counted from the middle m of p and q, positive to
// the left of p -> q: a vertex at the angle l is cos l m + sin l t with t the direction of p x q. The ridge goes from
// l'' to l', its length is L = l' - l'' in (0, pi], its middle c is at M = (l' + l'')/2. With h from p to m the
// triangle of p and the ridge has the area w,
//     tan(w/2) = sin h sin(L/2) / (cos(L/2) + cos h cos M)
// (half of it is the right angle of p, c and a vertex: sin h sin(L/2) = det[p c v], cos h cos M = p.c). All these
// triangles are positive, so that a cell is as accurate as they are.
//
// The integral of x over the cell is minus half the sum of L D/|D| (theorem of Stokes). In a cell of size s that
// cancels up to s^2 of itself; but then the cell is flat, and its centroid that of flat triangles p, v, v', up to s^2
// of s: each has its mean at p + 2/3 (c - p), and c - p is D/2 + sin M t up to s^2 of s.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "arithmetic/arc_tangent.hpp"
#include "arithmetic/double_double.hpp"
#include "voronoi/cell_integrals.hpp"
#include "voronoi/unit_vectors.hpp"

namespace stereodel::voronoi {

using arithmetic::arc_tangent_series;
using arithmetic::vector_angle;

// The angle of a vector of any length.
template <class Number>
struct Leg {
    Number across{}, along{};
};

template <class Number>
Number length_of(const Number& a, const Number& b) {
    return sqrt(a * a + b * b);
}

template <class Number>
struct Ridge {
    Number edge[3], length;             // D over any power of two, and the length of that
    Number sine, cosine;                // of h
    Number half_sine, half_cosine;      // of L/2
    Number middle_sine, middle_cosine;  // of M
    std::int64_t exponent = 0;          // D is edge * 2^exponent

    // left, right: l' and l'', of length 1; ridge_sine: sin L.
    void set(const Leg<Number>& left, const Leg<Number>& right, const Number& ridge_sine) {
        const Number one = ridge_sine.like(1.0), ridge_cosine = left.along * right.along + left.across * right.across;
        // Of the larger half angle's function from its square, of the other one from the sine.
        const bool wide = ridge_cosine.sign() < 0;
        const Number large = sqrt((wide ? one - ridge_cosine : one + ridge_cosine).times_power(-1));
        const Number twice = large.times_power(1), small = ridge_sine / twice;
        half_sine = wide ? large : small;
        half_cosine = wide ? small : large;
        middle_cosine = (wide ? left.across - right.across : left.along + right.along) / twice;
        middle_sine = (wide ? right.along - left.along : left.across + right.across) / twice;
    }
};

// What a cell came out as. The bounds are SHARE_ERROR for areas, beside 2^-1040 for what underflows, and CELL_ERROR.
struct MeasuredCell {
    double area = 0.0, centroid[3] = {};
    bool good = false;
};

// Of the ridges of a cell of the site p.
template <class Number>
class RidgeSum {
  public:
    RidgeSum(const UnitVector& p, const std::vector<Ridge<Number>>& ridges) : p_(p), ridges_(ridges) {}

    MeasuredCell measure(bool with_centroid) {
        MeasuredCell cell;
        std::vector<Number> tangents;
        DoubleDouble area;
        double error = 0.0;
        bool flat = true;
        const std::int64_t lift = -ridges_[0].sine.exponent();  // areas may leave the range of doubles, these not
        for (const Ridge<Number>& ridge : ridges_) {
            const Number n = ridge.sine * ridge.half_sine, m = ridge.half_cosine + ridge.cosine * ridge.middle_cosine;
            error += add_triangle(n, m, area);
            flat = flat && is_flat(ridge);
            if (with_centroid && flat) {
                tangents.push_back(ridge.sine.times_power(lift) * ridge.half_sine.times_power(lift) / m);
            }
        }
        cell.area = area.hi;
        cell.good = error <= SHARE_ERROR * cell.area + 0x1p-1040;
        if (with_centroid && cell.good) {
            cell.good = flat ? flat_centroid(tangents, cell.centroid) : centroid(cell.centroid);
        }
        return cell;
    }

  private:
    static constexpr double FLAT = 0x1p-26;

    // Adds twice the angle of (m, n); returns its error. Where n and m are off by e and f, the angle is by
    // (|m| e + |n| f)/(m^2 + n^2) and less than 2^-8 of that more while both are below 2^-12 of the vector. Both are
    // rounded to doubles, by u of themselves, and the angle by 3.1u: less than 2^-50 of it. The sum, in double-double,
    // adds nothing to that, however many ridges there are.
    static double add_triangle(const Number& n, const Number& m, DoubleDouble& area) {
        const std::int64_t exponent = std::max(n.exponent(), m.exponent());
        const double y = n.middle(exponent), x = m.middle(exponent), e = n.radius(exponent), f = m.radius(exponent);
        const double square = x * x + y * y;
        if (!(std::max(e, f) < 0x1p-12 * std::sqrt(square))) {
            return HUGE_VAL;
        }
        const double angle = 2 * vector_angle(y, x);
        area = area + DoubleDouble{angle};
        return 2.02 * (std::fabs(x) * e + std::fabs(y) * f) / square + 0x1p-49 * angle;
    }

    // NaN if one of them is, which no bound lets pass: std::max drops it.
    static double larger(double a, double b) { return a >= b || std::isnan(a) ? a : b; }

    static bool is_flat(const Ridge<Number>& ridge) {
        return ridge.sine.middle(0) < FLAT && ridge.half_sine.middle(0) < FLAT && ridge.half_cosine.sign() > 0 &&
               std::fabs(ridge.middle_sine.middle(0)) < FLAT && ridge.middle_cosine.sign() > 0;
    }

    // The mean of 2/3 (c - p) with the areas as weights, both over powers of two. All c - p are within the cell, and so
    // are D/2 and sin M t, which are known to some 2^-50 of themselves and the errors of D and sin M.
    bool flat_centroid(const std::vector<Number>& tangents, double* centroid) const {
        std::int64_t heaviest = tangents[0].exponent(), largest = ridges_[0].sine.exponent();
        for (std::size_t k = 1; k < ridges_.size(); ++k) {
            heaviest = std::max(heaviest, tangents[k].exponent());
            largest = std::max(largest, ridges_[k].sine.exponent());
        }
        DoubleDouble total, rest[3];
        double weight_error = 0.0, error = 0.0, size = 0.0;
        for (std::size_t k = 0; k < ridges_.size(); ++k) {
            const Ridge<Number>& ridge = ridges_[k];
            const double weight = tangents[k].middle(heaviest), height = ridge.sine.middle(largest);
            const double sine = ridge.middle_sine.middle(largest);
            const std::int64_t exponent = ridge.length.exponent();
            double towards[3];
            for (int i = 0; i < 3; ++i) {
                towards[i] = ridge.edge[i].middle(exponent) / ridge.length.middle(exponent);
                error = larger(error, height * (ridge.edge[i].radius(exponent) / ridge.length.middle(exponent)));
            }
            for (int i = 0; i < 3; ++i) {
                const int j = (i + 1) % 3, l = (i + 2) % 3;
                const double along = p_.hi[j] * towards[l] - p_.hi[l] * towards[j];
                rest[i] = rest[i] + DoubleDouble{weight * (towards[i] * height + along * sine)};
            }
            total = total + DoubleDouble{weight};
            weight_error += tangents[k].radius(heaviest);
            error = larger(error, ridge.middle_sine.radius(largest));
            size = std::max({size, height, std::fabs(sine)});
        }
        const int scale = static_cast<int>(std::max<std::int64_t>(largest, -3000));
        Pair vector[3];
        for (int i = 0; i < 3; ++i) {
            const DoubleDouble sum = two_sum(p_.hi[i], std::ldexp(2.0 / 3.0 * (rest[i].hi / total.hi), scale));
            vector[i] = {sum.hi, sum.lo + p_.lo[i]};
        }
        round_unit(vector, centroid);
        return error <= CELL_ERROR * size && weight_error <= CELL_ERROR * total.hi;
    }

    // By the theorem of Stokes. The cell reaches as far as all its h; its integral must be known to that part of it.
    bool centroid(double* centroid) const {
        Number total[3];
        double size = 0.0;
        for (std::size_t k = 0; k < ridges_.size(); ++k) {
            const Ridge<Number>& ridge = ridges_[k];
            const Number one = ridge.sine.like(1.0);
            const Number turn = arc_tangent_series(ridge.half_sine / (one + ridge.half_cosine)) / ridge.length;
            for (int i = 0; i < 3; ++i) {
                total[i] = k == 0 ? -(turn * ridge.edge[i]) : total[i] - turn * ridge.edge[i];
            }
            size = std::max(size, ridge.sine.middle(0));
        }
        const Number length = sqrt(total[0] * total[0] + total[1] * total[1] + total[2] * total[2]);
        double error = 0.0;
        for (int i = 0; i < 3; ++i) {
            const Number component = total[i] / length;
            centroid[i] = component.middle(0) + 0.0;  // no negative zero
            error = larger(error, component.radius(0));
        }
        return error <= CELL_ERROR * size;
    }

    const UnitVector& p_;
    const std::vector<Ridge<Number>>& ridges_;
};

}  // namespace stereodel::voronoi
