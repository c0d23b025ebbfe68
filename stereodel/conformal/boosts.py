"""The fisheye along the z axis, on double-double points and circles (section on fisheye maps; Figure 13).

With u = 1 + z and w = 1 − z, tan²(χ/2) = w/u, and tan(Ξ/2) = S tan(χ/2) says: u becomes u/S, w becomes S w, the part
t across the axis stays, all up to a common factor. This is the boost of Minkowski space of rapidity −ln S along z, on
light-cone coordinates; on a circle n·x = d the same factors act on d + n_z and d − n_z.
"""

from __future__ import annotations

from stereodel._double_double import DoubleDouble, stack
from stereodel.sphere.circles import light_cone, one_plus_minus

Circle = tuple[DoubleDouble, DoubleDouble, DoubleDouble]
"""Normal (3,), cos α and sin α, up to one positive factor."""


def boost_points(points: DoubleDouble, magnification: DoubleDouble) -> DoubleDouble:
    """Images of unit vectors (..., 3) under the fisheye of magnification S at +z."""
    x, y = points[..., 0], points[..., 1]
    u, w = one_plus_minus(points[..., 2], x * x + y * y)
    lower, upper = u / magnification, w * magnification
    total = lower + upper
    return stack([points[..., 0] * 2.0 / total, points[..., 1] * 2.0 / total, (lower - upper) / total])


def boost_circle(circle: Circle, magnification: DoubleDouble) -> Circle:
    """Image of the circle n·x = cos α, n a unit vector, with its interior; sin α is invariant before normalisation."""
    normal, cosine, sine = circle
    plus, minus = light_cone(normal, cosine, sine)
    plus, minus = plus / magnification, minus * magnification
    return stack([normal[0], normal[1], (plus + minus) * 0.5]), (plus - minus) * 0.5, sine
