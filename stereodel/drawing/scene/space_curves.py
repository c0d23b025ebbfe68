r"""Curves in space for drawing: straight segments and circular arcs, exact up to their approximation by cubic Béziers.

Both kinds are linear in a small basis: a segment is o + t·d, an arc c + cos t·u + sin t·v with u ⟂ v of one length. An
affine map, such as a view, sends o, d, c, u, v and leaves t alone; so the same classes also stand for ellipses.

Notes
-----
*Error of the Béziers.* The usual cubic for an arc of angle θ, with controls at k = 4/3·tan(θ/4) along the tangents,
meets the unit circle at both ends and in the middle, touching each time. So |B(s)|² − 1, a polynomial of degree 6, is
a multiple of s²(1 − s)²(1 − 2s)². Its leading coefficient is that of |a₃|²s⁶ with a₃ = P₃ − 3P₂ + 3P₁ − P₀, which is
parallel to the chord and of length 8τ³/(1 + τ²), τ = tan(θ/4). Since s(1 − s)|1 − 2s| ≤ 1/(6√3),

    |B| − 1 ≤ (2/27)·sin⁶(θ/4)/cos²(θ/4),

that is 3.8e-7 for θ = 30°, the longest piece used here. An orthographic view never lengthens it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_directions, as_vectors
from stereodel.constants import ONE_HARMONIC, ROOT_ON_CIRCLE, SPARE_PIECE, TOUCHING_SLOPE, UNIT_ROUNDOFF
from stereodel.drawing.page import Beziers
from stereodel.sphere import SphereArc, SphereCircle
from stereodel.sphere.vectors import turned, units

LONGEST_PIECE_RAD = np.pi / 6


@dataclass(frozen=True, eq=False)
class Segment:
    """The straight piece of origin + t·direction with start ≤ t ≤ stop.

    Examples
    --------
    >>> Segment.between([0, 0, 0], [3, 0, 3]).beziers()[0].tolist()
    [[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [2.0, 0.0, 2.0], [3.0, 0.0, 3.0]]
    """

    origin: FloatArray
    direction: FloatArray
    start: float = 0.0
    stop: float = 1.0

    @classmethod
    def between(cls, a: npt.ArrayLike, b: npt.ArrayLike) -> Segment:
        """The segment from a to b."""
        first = as_vectors(a, 3, "a")
        return cls(first, as_vectors(b, 3, "b") - first)

    @property
    def closed(self) -> bool:
        """False: a segment is never closed."""
        return False

    def sample(self, t: npt.ArrayLike) -> FloatArray:
        """Points (..., 3) at parameters (...)."""
        return self.origin + np.asarray(t, dtype=np.float64)[..., None] * self.direction

    def beziers(self) -> FloatArray:
        """One cubic with its controls at thirds, (1, 4, 3)."""
        return self.sample(np.linspace(self.start, self.stop, 4))[None]

    def moved(self, matrix: FloatArray, origin: FloatArray) -> Segment:
        """The image under x → matrix·(x − origin)."""
        place, direction = turned(np.array([self.origin - origin, self.direction]), matrix)
        return replace(self, origin=place, direction=direction)

    def part(self, start: float, stop: float) -> Segment:
        """The piece between two parameters."""
        return replace(self, start=start, stop=stop)

    def level_parameters(self, normal: FloatArray, level: float) -> FloatArray:
        """Where normal·x = level, in the open interval of the parameter."""
        rate = float(np.sum(normal * self.direction))
        if rate == 0:
            return np.zeros(0)
        return _within(self, [(level - float(np.sum(normal * self.origin))) / rate])

    def quadric_parameters(self, weights: FloatArray, level: float) -> FloatArray:
        """Where Σ weightsᵢ·xᵢ² = level, in the open interval of the parameter."""
        a = float(np.sum(weights * self.direction**2))
        half_b = float(np.sum(weights * self.direction * self.origin))
        c = float(np.sum(weights * self.origin**2)) - level
        discriminant = half_b**2 - a * c
        if a == 0 or discriminant < 0:
            return np.zeros(0)
        # The root of larger modulus first, the other from the product of the roots: no cancellation.
        q = -half_b - np.copysign(np.sqrt(discriminant), half_b)
        return _within(self, [q / a, *([c / q] if q else [])])


@dataclass(frozen=True, eq=False)
class CircleArc:
    """The arc center + cos t·u + sin t·v with start ≤ t ≤ stop (radians); u ⟂ v of one length before any view.

    Examples
    --------
    >>> quarter = CircleArc.great([1, 0, 0], [0, 1, 0])
    >>> quarter.sample(quarter.stop).round(12).tolist(), quarter.closed
    ([0.0, 1.0, 0.0], False)
    """

    center: FloatArray
    u: FloatArray
    v: FloatArray
    start: float = 0.0
    stop: float = 2 * np.pi

    @classmethod
    def great(cls, a: npt.ArrayLike, b: npt.ArrayLike) -> CircleArc:
        """The shorter great-circle arc of the unit sphere between two directions (3,), neither equal nor antipodal."""
        start, end = units(as_directions(a, "a")), units(as_directions(b, "b"))
        # a × b from difference and sum, which avoids cancellation for points that are close or nearly antipodal.
        axis = np.cross(start - end, start + end) / 2
        sine = float(np.sqrt(np.sum(axis**2)))
        if sine == 0:
            raise ValueError(f"a and b are equal or antipodal, so that no single arc joins them: {start} and {end}")
        sweep_rad = float(np.arctan2(sine, np.sum(start * end)))
        return cls(np.zeros(3), start, np.cross(axis / sine, start), 0.0, sweep_rad)

    @classmethod
    def of(cls, arc: SphereArc | CircleArc) -> CircleArc:
        """An arc of a circle of the unit sphere, counterclockwise about its normal."""
        if isinstance(arc, CircleArc):
            return arc
        center, u, v, sweep_rad = arc.frame()
        return cls(center, u, v, 0.0, sweep_rad)

    @classmethod
    def circle(cls, circle: SphereCircle) -> CircleArc:
        """A whole circle of the unit sphere, counterclockwise about its normal."""
        return cls.of(SphereArc.whole(circle))

    @property
    def closed(self) -> bool:
        """Whether it is the whole circle."""
        # start + 2π was rounded once and so is the difference, each time by at most UNIT_ROUNDOFF·(|start| + 2π).
        return abs(self.stop - self.start - 2 * np.pi) <= 2 * UNIT_ROUNDOFF * (abs(self.start) + 2 * np.pi)

    def sample(self, t: npt.ArrayLike) -> FloatArray:
        """Points (..., 3) at parameters (...)."""
        angle = np.asarray(t, dtype=np.float64)[..., None]
        return self.center + np.cos(angle) * self.u + np.sin(angle) * self.v

    def beziers(self) -> FloatArray:
        """Cubics of at most 30° each, (k, 4, 3), within 3.8e-7 of the radius (see the module's notes)."""
        pieces = max(1, int(np.ceil((self.stop - self.start) / LONGEST_PIECE_RAD - SPARE_PIECE)))
        t = np.linspace(self.start, self.stop, pieces + 1)
        ends = self.sample(t)
        if self.closed:
            ends[-1] = ends[0]
        reach = 4 / 3 * np.tan((self.stop - self.start) / pieces / 4)
        tangents = reach * (np.cos(t)[:, None] * self.v - np.sin(t)[:, None] * self.u)
        return np.stack([ends[:-1], ends[:-1] + tangents[:-1], ends[1:] - tangents[1:], ends[1:]], axis=1)

    def moved(self, matrix: FloatArray, origin: FloatArray) -> CircleArc:
        """The image under x → matrix·(x − origin)."""
        center, u, v = turned(np.array([self.center - origin, self.u, self.v]), matrix)
        return replace(self, center=center, u=u, v=v)

    def scaled(self, factor: float, center: FloatArray) -> CircleArc:
        """From the unit sphere to the sphere of that radius about that centre."""
        return replace(self, center=center + factor * self.center, u=factor * self.u, v=factor * self.v)

    def part(self, start: float, stop: float) -> CircleArc:
        """The piece between two parameters."""
        return replace(self, start=start, stop=stop)

    def level_parameters(self, normal: FloatArray, level: float) -> FloatArray:
        """Where normal·x = level, in the open interval of the parameter."""
        cosine, sine = float(np.sum(normal * self.u)), float(np.sum(normal * self.v))
        return _within(self, linear_roots(float(np.sum(normal * self.center)) - level, cosine, sine), period=True)

    def quadric_parameters(self, weights: FloatArray, level: float) -> FloatArray:
        """Where Σ weightsᵢ·xᵢ² = level, in the open interval of the parameter."""

        def form(a: FloatArray, b: FloatArray) -> float:
            return float(np.sum(weights * a * b))

        # With ⟨a, b⟩ = Σ weightsᵢ·aᵢ·bᵢ the form ⟨x, x⟩ of x = c + cos t·u + sin t·v is a constant, ⟨c, c⟩ +
        # (⟨u, u⟩ + ⟨v, v⟩)/2, a first harmonic, 2⟨c, u⟩ cos t + 2⟨c, v⟩ sin t, and a second one, from cos² t =
        # (1 + cos 2t)/2 and so on. Each harmonic is twice the real part of a coefficient times eⁱᵗ or e²ⁱᵗ.
        c, u, v = self.center, self.u, self.v
        constant = form(c, c) + (form(u, u) + form(v, v)) / 2 - level
        first = complex(form(c, u), -form(c, v))
        second = complex((form(u, u) - form(v, v)) / 4, -form(u, v) / 2)
        return _within(self, trigonometric_roots(constant, first, second), period=True)


Curve = Segment | CircleArc
"""Its parameter t runs from `start` to `stop`."""


def linear_roots(constant: float, cosine: float, sine: float) -> list[float]:
    """Roots of constant + cosine·cos t + sine·sin t, radians in no particular period; none when it never vanishes."""
    amplitude = float(np.hypot(cosine, sine))
    if amplitude <= abs(constant):
        return []
    middle, half = float(np.arctan2(sine, cosine)), float(np.arccos(-constant / amplitude))
    return [middle - half, middle + half]


def trigonometric_roots(constant: float, first: complex, second: complex) -> list[float]:
    """Roots of constant + 2·Re(first·eⁱᵗ + second·e²ⁱᵗ), radians; a double root may be missed or found twice."""
    scale = max(abs(constant), abs(first), abs(second))
    if abs(second) <= ONE_HARMONIC * scale:
        return linear_roots(constant, 2 * first.real, -2 * first.imag)
    # With z = eⁱᵗ the function times z² is second·z⁴ + first·z³ + constant·z² + conj(first)·z + conj(second), as
    # conj(z) = 1/z on the unit circle. Roots off the circle come in pairs z, 1/conj(z) and are of no use.
    roots = np.roots([second, first, constant, np.conj(first), np.conj(second)])
    t = np.angle(roots[np.abs(np.abs(roots) - 1) < ROOT_ON_CIRCLE])
    # Newton's method on t, for which the function is real, recovers the accuracy lost by the companion matrix.
    for _ in range(3):
        z = np.exp(1j * t)
        value = constant + 2 * (first * z + second * z**2).real
        slope = -2 * (first * z + 2 * second * z**2).imag
        steep = np.abs(slope) > TOUCHING_SLOPE * scale
        t = t - np.divide(value, slope, out=np.zeros_like(t), where=steep)
    return t.tolist()


def _within(curve: Curve, parameters: Iterable[float], *, period: bool = False) -> FloatArray:
    """Parameters strictly inside the curve's interval, ascending; angles are first reduced to its period."""
    t = np.array(list(parameters), dtype=np.float64)
    if period:
        t = curve.start + np.mod(t - curve.start, 2 * np.pi)
    return np.unique(t[(t > curve.start) & (t < curve.stop)])


def page_path(curves: Iterable[Curve], at: tuple[float, float], scale: float) -> Beziers:
    """Consecutive curves in view axes as one connected path on the page."""
    spatial = np.concatenate([curve.beziers() for curve in curves])
    path: Beziers = spatial[..., :2] * scale + np.array(at)
    path[1:, 0] = path[:-1, 3]
    return path
