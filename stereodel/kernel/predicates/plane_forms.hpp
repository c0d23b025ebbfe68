// The polynomials of the planar predicates, for any kind of number.
#pragma once

namespace stereodel::predicates::plane {

template <class Number>
constexpr Number cross_form(const Number& ax, const Number& ay, const Number& bx, const Number& by) {
    return ax * by - ay * bx;
}

template <class Number>
constexpr Number dot_form(const Number& ax, const Number& ay, const Number& bx, const Number& by) {
    return ax * bx + ay * by;
}

template <class Number>
constexpr Number square_form(const Number& x, const Number& y) {
    return x * x + y * y;
}

// The incircle determinant of a, b, c relative to d. With A = |a|^2 and so on, |bx cy| + |by cx| is at most sqrt(BC)
// (Cauchy) and that at most (B + C)/2 (the two means), so the permanent is at most AB + BC + CA.
template <class Number>
constexpr Number incircle_form(const Number& ax, const Number& ay, const Number& bx, const Number& by, const Number& cx,
                               const Number& cy) {
    return square_form(ax, ay) * cross_form(bx, by, cx, cy) + square_form(bx, by) * cross_form(cx, cy, ax, ay) +
           square_form(cx, cy) * cross_form(ax, ay, bx, by);
}

}  // namespace stereodel::predicates::plane
