"""Circles, lines and conics of the plane: the images of circles of the sphere under a projection."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, Keyed, as_count, as_floats, read_only


@dataclass(frozen=True, eq=False)
class PlaneCircle(Keyed):
    """A circle of the plane with one of its two sides.

    Parameters
    ----------
    center : array, shape (2,)
    radius : float
    outside : bool
        Whether the interior of the bubble lies outside the circle, as for a bubble that contains the projection pole.

    Examples
    --------
    >>> from stereodel import SphereCircle, Stereographic
    >>> tropic = SphereCircle.around((0.0, 90.0), 66.5)
    >>> circle = Stereographic((0.0, -90.0)).image_of(tropic)
    >>> round(circle.radius, 12), circle.outside
    (3.050506958038, True)
    """

    center: FloatArray
    radius: float
    outside: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "center", read_only(self.center))

    def sample(self, n: int) -> FloatArray:
        """Points on the circle, (n, 2), counterclockwise from the direction +x."""
        t = np.linspace(0.0, 2 * np.pi, as_count(n, "n"), endpoint=False)
        return self.center + self.radius * np.stack([np.cos(t), np.sin(t)], axis=-1)

    @property
    def _key(self) -> tuple[float, ...]:
        return (*self.center.tolist(), self.radius, self.outside)


@dataclass(frozen=True, eq=False)
class PlaneLine(Keyed):
    """The line normal·(x, y) = offset; the interior of its bubble is the side where normal·(x, y) is larger.

    Parameters
    ----------
    normal : array, shape (2,)
        Unit vector.
    offset : float

    Examples
    --------
    >>> from stereodel import SphereCircle, Stereographic
    >>> meridian = SphereCircle((90.0, 0.0), 0.0)
    >>> line = Stereographic((0.0, -90.0)).image_of(meridian)
    >>> abs(line.offset), np.abs(line.direction).round(12).tolist()
    (0.0, [0.0, 1.0])
    """

    normal: FloatArray
    offset: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "normal", read_only(self.normal))

    @property
    def point(self) -> FloatArray:
        """The point of the line nearest to the origin."""
        return self.normal * self.offset

    @property
    def direction(self) -> FloatArray:
        """Unit vector along the line, the interior on its left."""
        return np.array([self.normal[1], -self.normal[0]])

    @property
    def _key(self) -> tuple[float, ...]:
        return (*self.normal.tolist(), self.offset)


ConicKind = Literal["ellipse", "segment", "parabola", "hyperbola", "line", "empty"]


@dataclass(frozen=True, eq=False)
class Conic(Keyed):
    """The image of a circle under a gnomonic or orthographic projection.

    Parameters
    ----------
    kind : str
        "ellipse" (circles too), "segment" (a circle seen edge-on), "hyperbola" (the branch at +axes[0]), "parabola",
        "line", or "empty" when the whole circle lies outside the domain.
    center : array, shape (2,)
        Centre; the vertex of a parabola; a point of a line; NaN when empty.
    axes : array, shape (2, 2)
        Rows: the vectors that `sample` combines. NaN when empty.
    matrix : array, shape (3, 3)
        Symmetric Q with (x, y, 1) Q (x, y, 1)ᵀ = 0 on the curve; of a hyperbola this includes the other branch, of a
        line and a segment it is the line twice.

    Examples
    --------
    >>> from stereodel import Orthographic, SphereCircle
    >>> tropic = SphereCircle.around((0.0, 90.0), 66.5)
    >>> ellipse = Orthographic((0.0, 30.0)).image_of(tropic)
    >>> ellipse.kind, np.linalg.norm(ellipse.axes, axis=1).round(6).tolist()
    ('ellipse', [0.45853, 0.91706])
    """

    kind: ConicKind
    center: FloatArray
    axes: FloatArray
    matrix: FloatArray

    def __post_init__(self) -> None:
        for name in ("center", "axes", "matrix"):
            object.__setattr__(self, name, read_only(getattr(self, name)))

    def sample(self, t: npt.ArrayLike) -> FloatArray:
        """Points of the curve, (..., 2), at parameters t.

        center + f(t)·axes[0] + g(t)·axes[1] with (f, g) = (cos t, sin t) for an ellipse or a segment, (cosh t, sinh t)
        for a hyperbola, (t², t) for a parabola, (0, t) for a line.
        """
        values = as_floats(t, "t")
        f, g = _PARAMETRIC[self.kind](values)
        return self.center + f[..., None] * self.axes[0] + g[..., None] * self.axes[1]

    @property
    def _key(self) -> tuple[object, ...]:
        return (self.kind, self.center.tobytes(), self.axes.tobytes(), self.matrix.tobytes())


_PARAMETRIC = {
    "ellipse": lambda t: (np.cos(t), np.sin(t)),
    "segment": lambda t: (np.cos(t), np.sin(t)),
    "hyperbola": lambda t: (np.cosh(t), np.sinh(t)),
    "parabola": lambda t: (t * t, t),
    "line": lambda t: (np.zeros_like(t), t),
    "empty": lambda t: (t, t),
}
