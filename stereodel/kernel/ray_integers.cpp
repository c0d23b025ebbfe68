#include "ray_integers.hpp"

#include <algorithm>
#include <array>

#include "roots.hpp"

namespace stereodel::rays {

namespace {

BigInteger minor(const IntegerRay& u, const IntegerRay& v, int i, int j) {
    return u.v[i] * v.v[j] - u.v[j] * v.v[i];
}

BigInteger determinant(const IntegerRay& a, const IntegerRay& b, const IntegerRay& c) {
    return a.v[0] * minor(b, c, 1, 2) + a.v[1] * minor(b, c, 2, 0) + a.v[2] * minor(b, c, 0, 1);
}

BigInteger dot(const IntegerRay& a, const IntegerRay& b) {
    return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2];
}

}  // namespace

IntegerRay::IntegerRay(const double* vector) {
    const int exponent =
        std::min({lowest_exponent(vector[0]), lowest_exponent(vector[1]), lowest_exponent(vector[2])});
    for (int k = 0; k < 3; ++k) {
        v[k] = BigInteger::from_double(vector[k], exponent);
    }
}

BigInteger IntegerRay::squared() const {
    return dot(*this, *this);
}

int bubble_exact(const double* a, const double* b, const double* c, const double* p) {
    const IntegerRay ra(a), rb(b), rc(c), rp(p);
    const std::array<RootTerm, 4> terms = {
        RootTerm{determinant(rb, rc, rp), ra.squared()}, RootTerm{-determinant(ra, rc, rp), rb.squared()},
        RootTerm{determinant(ra, rb, rp), rc.squared()}, RootTerm{-determinant(ra, rb, rc), rp.squared()}};
    return sign_of_roots(terms.data(), 4);
}

int turn_exact(const double* a, const double* b, const double* c) {
    return determinant(IntegerRay(a), IntegerRay(b), IntegerRay(c)).sign();
}

int compare_component_exact(const double* a, const double* b, int k) {
    const IntegerRay ra(a), rb(b);
    const std::array<RootTerm, 2> terms = {RootTerm{ra.v[k], rb.squared()}, RootTerm{-rb.v[k], ra.squared()}};
    return sign_of_roots(terms.data(), 2);
}

int compare_angles_exact(const double* q, const double* a, const double* b) {
    const IntegerRay rq(q), ra(a), rb(b);
    const std::array<RootTerm, 2> terms = {RootTerm{dot(rq, rb), ra.squared()}, RootTerm{-dot(rq, ra), rb.squared()}};
    return sign_of_roots(terms.data(), 2);
}

int shadow_exact(const double* a, const double* b, const double* c, int axis) {
    const int i = axis == 0 ? 1 : 0, j = axis == 2 ? 1 : 2;
    const IntegerRay ra(a), rb(b), rc(c);
    const std::array<RootTerm, 3> terms = {RootTerm{minor(rb, rc, i, j), ra.squared()},
                                           RootTerm{-minor(ra, rc, i, j), rb.squared()},
                                           RootTerm{minor(ra, rb, i, j), rc.squared()}};
    return sign_of_roots(terms.data(), 3);
}

}  // namespace stereodel::rays
