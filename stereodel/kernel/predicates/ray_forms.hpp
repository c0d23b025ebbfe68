// The polynomials of the predicates on directions, for any kind of number; vectors are arrays of three.
#pragma once

namespace stereodel::predicates::rays {

template <class Scalar, class Number>
constexpr Number dot_form(const Scalar* u, const Number* v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

// det[a u v]. Its permanent is at most sqrt(2) times the product of the lengths of the rows (Cauchy).
template <class Scalar, class Number>
constexpr Number determinant_form(const Scalar* a, const Number* u, const Number* v) {
    return a[0] * (u[1] * v[2] - u[2] * v[1]) + a[1] * (u[2] * v[0] - u[0] * v[2]) + a[2] * (u[0] * v[1] - u[1] * v[0]);
}

// |b|^2 det[a c p] + |c|^2 det[a p b] + |p|^2 det[a b c], from the squares and the determinants.
template <class Number>
constexpr Number weighted_form(const Number& bb, const Number& at_b, const Number& cc, const Number& at_c,
                               const Number& pp, const Number& at_p) {
    return bb * at_b + cc * at_c + pp * at_p;
}

// |d|^2 + 2 a.d = |a + d|^2 - |a|^2, from |d|^2 and a.d.
template <class Number>
constexpr Number growth_form(const Number& square, const Number& dot) {
    return square + (dot + dot);
}

}  // namespace stereodel::predicates::rays
