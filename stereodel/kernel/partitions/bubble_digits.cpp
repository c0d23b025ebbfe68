#include "partitions/bubble_digits.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "arithmetic/big_ball.hpp"
#include "arithmetic/bounded.hpp"
#include "partitions/bubble_form.hpp"

namespace stereodel::partitions {

using arithmetic::BigBall;
using arithmetic::Bounded;

namespace {

// The bound was computed in doubles: see bounded.hpp and big_ball.hpp.
template <class Number>
Sign certain_sign(const Number& x) {
    const std::int64_t exponent = x.exponent();
    return decide(x.middle(exponent), x.radius(exponent) * (1 + 0x1p-30));
}

// The lesser of two numbers, which is y + min(x - y, 0).
template <class Number>
Number lesser(const Number& x, const Number& y) {
    const Number difference = x - y;
    const Sign sign = certain_sign(difference);
    return sign == 1 ? y : sign == -1 ? x : y + difference.error_alone();
}

template <std::size_t Width, class Number>
class Quadratic {
  public:
    // `one`: of the precision that is wanted.
    Quadratic(const Bubble& bubble, const Number& one) : one_(one) {
        place(bubble.a, pivot_);
        Number b[Width], c[Width];
        edge(bubble.b, b);
        if (bubble.is_disc) {
            square_ = one;
            constant_ = -square_of(b);
            std::fill_n(linear_, Width, one.like(0.0));
            return;
        }
        constant_ = one.like(0.0);
        if (bubble.c == nullptr) {
            square_ = one.like(0.0);
            linear_[0] = -b[1];
            linear_[1] = b[0];
            return;
        }
        edge(bubble.c, c);
        if constexpr (Width == 2) {
            quadratic_form(b, c, square_, linear_);
        } else {
            quadratic_form(pivot_, b, c, square_, linear_);
        }
    }

    // Of a number that is no more than the least value in a box, and is that but for its error.
    Sign sign_of_lowest(const double* low, const double* high) const {
        Number sum = constant_;
        for (std::size_t k = 0; k < Width; ++k) {
            sum = sum + lowest_of_axis(one_.like(low[k]) - pivot_[k], one_.like(high[k]) - pivot_[k], linear_[k]);
        }
        return certain_sign(sum);
    }

  private:
    // In one direction the function falls, then rises, or it is least at an end. Between the ends no value is below
    // -G^2/(4D), wherever that is taken. If D may be negative, no less than the least one it may be, f is no less than
    // with that, which is least at an end.
    Number lowest_of_axis(const Number& l, const Number& h, const Number& linear) const {
        if (certain_sign(square_) != 1) {
            return lesser(axis_form(l, square_, linear), axis_form(h, square_, linear));
        }
        if (certain_sign(square_.times_power(1) * l + linear) == 1) {
            return axis_form(l, square_, linear);
        }
        if (certain_sign(square_.times_power(1) * h + linear) == -1) {
            return axis_form(h, square_, linear);
        }
        return -(linear * linear / square_.times_power(2));
    }

    void place(const double* point, Number* v) const {
        for (std::size_t k = 0; k < Width; ++k) {
            v[k] = one_.like(point[k]);
        }
        if constexpr (Width == 3) {
            int exponent = 0;
            std::frexp(std::max({std::fabs(point[0]), std::fabs(point[1]), std::fabs(point[2])}), &exponent);
            for (std::size_t k = 0; k < Width; ++k) {
                v[k] = v[k].times_power(-exponent);
            }
            const Number length = sqrt(rays::dot_form(v, v));
            for (std::size_t k = 0; k < Width; ++k) {
                v[k] = v[k] / length;
            }
        }
    }

    void edge(const double* point, Number* v) const {
        place(point, v);
        for (std::size_t k = 0; k < Width; ++k) {
            v[k] = v[k] - pivot_[k];
        }
    }

    static Number square_of(const Number* v) {
        if constexpr (Width == 2) {
            return plane::square_form(v[0], v[1]);
        } else {
            return rays::dot_form(v, v);
        }
    }

    Number one_, pivot_[Width], square_, linear_[Width], constant_;
};

}  // namespace

template <std::size_t Width>
bool touches(const Bubble& bubble, const double* low, const double* high) {
    for (std::size_t k = 0; k < Width; ++k) {
        if (!std::isfinite(low[k]) || !std::isfinite(high[k])) {
            return true;
        }
    }
    const Quadratic<Width, Bounded> pairs(bubble, Bounded({1.0, 0.0}));
    Sign sign = pairs.sign_of_lowest(low, high);
    for (const std::size_t limbs : {std::size_t{8}, std::size_t{32}}) {
        if (sign == OPEN) {
            sign = Quadratic<Width, BigBall>(bubble, BigBall(1.0, limbs)).sign_of_lowest(low, high);
        }
    }
    return sign != 1;
}

template bool touches<2>(const Bubble&, const double*, const double*);
template bool touches<3>(const Bubble&, const double*, const double*);

}  // namespace stereodel::partitions
