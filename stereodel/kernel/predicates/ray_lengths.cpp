#include "predicates/ray_lengths.hpp"

#include "arithmetic/error_counts.hpp"

namespace stereodel::predicates::rays {

using arithmetic::sqrt;

namespace {

DoubleDouble length(const Direction& d) {
    return sqrt(dot(d, d));
}

}  // namespace

double squared_chord(const Direction& p, const Direction& a) {
    const Difference gap(p, a);
    return dot_form(gap.v, gap.v);
}

// (q.b)|p||a| - (p.a)|q||b| in double-double. A dot product of vectors of length one is off by less than 7u^2 +
// 2 * 3.1u^2 < 14u^2, a length by (7 + 6.2)/2 u^2 + 5u^2 < 12u^2, the product of two by 12 + 12 + 7 = 31u^2, that of
// all three by 14 + 31 + 7 = 52u^2; twice that, and 3.1u^2 of a difference of at most 2 for the last operation: below
// 112u^2. Underflow is nothing beside it.
Sign compare_lengths_double_double(const Direction& p, const Direction& a, const Direction& q, const Direction& b) {
    const DoubleDouble value = dot(q, b) * (length(p) * length(a)) - dot(p, a) * (length(q) * length(b));
    return decide(value.hi, 112 * UNIT_ROUNDOFF * UNIT_ROUNDOFF);
}

namespace {

// With a = (1 + s) a' and so on, |s|, |t|, |r| <= 2^-49, and a-p = (a'-p') + s(a'-p') + (s-r)p', b-p alike with t, the
// value (a-p).(b-p) differs from that of the unit vectors by
//     (s + t + st) (a'-p').(b'-p') + ((t-r)(1+s) p'.(a'-p') + (s-r)(1+t) p'.(b'-p')) + (s-r)(t-r),
// where p'.(a'-p') = -|a'-p'|^2/2. With A = |a'-p'|^2, B = |b'-p'|^2 and |(a'-p').(b'-p')| <= (A + B)/2 that is at most
// 2^-49 (A + B) + 2^-49 (A + B) + 2^-96 and a little. Roundings: two for each difference (of directions, which are off
// by 2^-106 besides), three of the product and the sums: 7, below 8u (A + B)/2. Together below 2^-47 (A + B) + 2^-95.
Sign diametral_of_gaps(const double* ap, const double* bp) {
    return decide(dot_form(ap, bp), 0x1p-47 * (dot_form(ap, ap) + dot_form(bp, bp)) + 0x1p-94);
}

}  // namespace

Sign diametral_filter(const double* a, const double* b, const double* p) {
    const double ap[3] = {a[0] - p[0], a[1] - p[1], a[2] - p[2]}, bp[3] = {b[0] - p[0], b[1] - p[1], b[2] - p[2]};
    return diametral_of_gaps(ap, bp);
}

Sign diametral_filter(const Direction& a, const Direction& b, const Direction& p) {
    return diametral_of_gaps(Difference(p, a).v, Difference(p, b).v);
}

// |a||b||p| + (a.b)|p| - (p.a)|b| - (p.b)|a| in double-double, from left to right. By the errors above the products are
// off by 31 + 12 + 7 = 50u^2 and 14 + 12 + 7 = 33u^2 each, three sums of at most 4 by 3.1u^2 of them: below 200u^2.
Sign diametral_double_double(const Direction& a, const Direction& b, const Direction& p) {
    const DoubleDouble la = length(a), lb = length(b), lp = length(p);
    const DoubleDouble value = la * lb * lp + dot(a, b) * lp - dot(p, a) * lb - dot(p, b) * la;
    return decide(value.hi, 200 * UNIT_ROUNDOFF * UNIT_ROUNDOFF);
}

}  // namespace stereodel::predicates::rays
