"""Once differentiable interpolation from values and gradients at the points.

In each triangle by the side-vertex method of G. M. Nielson (1979), carried to the sphere by C. L. Lawson (1984) and by
R. J. Renka (1984), with arcs of great circles for segments. For each corner i:

1. The line from i through the query meets the opposite side jk in Q. Along the side the function is the cubic of the
   values and slopes at j and k; its slope across the side is linear between those at j and k.
2. Along the line the function is the cubic of value and slope at i and at Q. Call it S_i. On all sides it has the
   right values, on the side jk the right slopes too.
3. The three are mixed with the weights b_j b_k, b_k b_i, b_i b_j divided by their sum: on the side jk that of S_i is 1.

Neighbouring triangles agree in value and slope along their common side, as both depend on its two ends alone.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel._arrays import AnyIndices, FloatArray, as_values, locked
from stereodel._docs import shared
from stereodel.constants import LEAST_WEIGHT
from stereodel.interpolation.gradients import fit_gradients
from stereodel.interpolation.interpolator import FAMILY, PrecisePoints, TriangleInterpolator, one_value_a_place
from stereodel.interpolation.located import LocatedQueries, crossed, dot, heaviest, inner, lengths
from stereodel.triangulation.delaunay import Triangulation


@shared(**FAMILY)
class SmoothInterpolator(TriangleInterpolator):
    """Smooth: the function and its gradient are continuous, by Renka's method on the sphere, by Nielson's in the plane.

    {points}
    {values}
    gradients : (n, ..., 2) or (n, ..., 3) array_like, optional
        Gradients at the points, per unit of length or per radian; on the sphere their radial components are ignored.
        Finite or NaN, like values. By default those of `estimate_gradients`.
    {extrapolate}

    {attributes}
    gradients : (n, ..., 2) or (n, ..., 3) array
        As used, read-only.

    {raises}

    Notes
    -----
    In each triangle three functions are blended. Each joins one corner to the points of the opposite side by cubics,
    along the side and along the line from the corner, which have the given values and slopes at their ends; the slope
    across a side is linear. Lines are straight in the plane and great circles on the sphere, without tension.

    Values and gradients at the points are reproduced. With exact gradients, so are quadratic polynomials of the plane
    and constants on the sphere; the error for smooth functions is of order h³ for edges of length h, that of the
    gradient of order h², with estimated gradients too. The function may leave the range of the values, and in
    thin triangles, as between two points that nearly meet and a far one, its gradient may be large. NaN values and
    gradients that are not finite propagate only to the triangles at their point. Outside means in no triangle.

    References
    ----------
    G. M. Nielson, "The side-vertex method for interpolation in triangles", J. Approx. Theory 25 (1979). R. J. Renka,
    "Interpolation of data on the surface of a sphere", ACM TOMS 10 (1984), and Algorithm 623 there.

    Examples
    --------
    >>> x, y = np.mgrid[:3, :3].reshape(2, -1).astype(float)
    >>> hill = SmoothInterpolator(np.column_stack([x, y]), x * (2 - x))
    >>> hill([0.5, 1.25]).round(9).item(), (hill.gradient([0.5, 1.25]).round(9) + 0.0).tolist()
    (0.75, [1.0, 0.0])
    """

    def __init__(
        self,
        points: npt.ArrayLike | Triangulation,
        values: npt.ArrayLike,
        *,
        gradients: npt.ArrayLike | None = None,
        extrapolate: str | None = None,
    ) -> None:
        super().__init__(points, values, extrapolate=extrapolate)
        self._fields = np.ascontiguousarray(self._values.T)
        if gradients is None:
            self._slopes = fit_gradients(self.triangulation, self._values, self._sites)
        else:
            self._slopes = self._given(gradients)
        self.gradients = locked(np.ascontiguousarray(self._slopes.T).reshape(*self.values.shape, len(self._slopes)))

    def _given(self, gradients: npt.ArrayLike) -> FloatArray:
        """Checked gradients (d, k, n), tangent, one a place."""
        size, dimension = self.triangulation.points.shape
        array = as_values(gradients, size, "gradients")
        expected = (*self.values.shape, dimension)
        if array.shape != expected:
            raise ValueError(f"gradients must have shape {expected}, a vector for each value, got {array.shape}")
        merged = one_value_a_place(self.triangulation, array.reshape(size, -1))
        vectors = np.ascontiguousarray(merged.reshape(size, self._values.shape[1], dimension).transpose(2, 1, 0))
        if self._sites.curved:
            up = self._sites.rounded
            vectors -= up[:, None] * inner(vectors, up)
        return vectors

    def _within(self, corners: AnyIndices, queries: FloatArray) -> FloatArray:
        located, weights, values, gradients = self._located(corners, queries)
        first = heaviest(weights, values)
        found = np.asarray(first + _mix(located, list(weights[:, None]), values, first, gradients))
        return _met(found, first, weights, values, gradients).T

    def _slope_within(self, corners: AnyIndices, queries: FloatArray) -> FloatArray:
        located, weights, values, gradients = self._located(corners, queries)
        directions = np.array([[-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]])  # by the second and the third coordinate
        b = [Jet(weights[k : k + 1], directions[:, k, None, None]) for k in range(3)]
        mixed = _mix(located, b, values, heaviest(weights, values), gradients)
        assert isinstance(mixed, Jet)
        slope = located.slope([np.zeros_like(mixed.slope[0]), *mixed.slope])
        return np.moveaxis(_met(slope, heaviest(weights, gradients), weights, values, gradients), -1, 0)

    def _located(
        self, corners: AnyIndices, queries: FloatArray
    ) -> tuple[LocatedQueries, FloatArray, FloatArray, FloatArray]:
        """Queries, their weights (3, m), and at their corners values (3, k, m) and tangent gradients (3, d, k, m)."""
        located = LocatedQueries(self._sites, corners, queries)
        values, slopes = (np.moveaxis(of.take(located.numbers, axis=-1), -2, 0) for of in (self._fields, self._slopes))
        return located, np.maximum(located.weights(), LEAST_WEIGHT), values, slopes


class Jet:
    """Values (x, m) with their derivatives by two parameters, `slope` (2, x, m): forward-mode differentiation."""

    __array_ufunc__ = None  # so that `ndarray * Jet` calls __rmul__
    __slots__ = ("slope", "value")

    def __init__(self, value: FloatArray, slope: FloatArray) -> None:
        self.value = value
        self.slope = slope

    def __add__(self, other: Number) -> Jet:
        b = _lift(other)
        return Jet(self.value + b.value, self.slope + b.slope)

    def __sub__(self, other: Number) -> Jet:
        b = _lift(other)
        return Jet(self.value - b.value, self.slope - b.slope)

    def __mul__(self, other: Number) -> Jet:
        if not isinstance(other, Jet):
            return Jet(self.value * other, self.slope * other)
        return Jet(self.value * other.value, self.slope * other.value + self.value * other.slope)

    def __truediv__(self, other: Number) -> Jet:
        if not isinstance(other, Jet):
            return Jet(self.value / other, self.slope / other)
        quotient = self.value / other.value
        return Jet(quotient, (self.slope - quotient * other.slope) / other.value)

    __radd__, __rmul__ = __add__, __mul__

    def __rsub__(self, other: FloatArray | float) -> Jet:
        return Jet(other - self.value, -self.slope)

    def __rtruediv__(self, other: FloatArray | float) -> Jet:
        return _lift(other) / self


Number = Jet | FloatArray | float


def _lift(number: Number) -> Jet:
    return number if isinstance(number, Jet) else Jet(np.asarray(number), np.zeros(1))


def arctan2(y: Number, x: Number) -> Number:
    """Angle of the vector (x, y)."""
    if not isinstance(y, Jet) and not isinstance(x, Jet):
        return np.arctan2(y, x)
    b, a = _lift(y), _lift(x)
    square = a.value * a.value + b.value * b.value
    return Jet(np.arctan2(b.value, a.value), (a.value * b.slope - b.value * a.slope) / square)


def sqrt(number: Number) -> Number:
    """Square root of a positive number."""
    if not isinstance(number, Jet):
        return np.sqrt(number)
    root = np.sqrt(number.value)
    return Jet(root, number.slope / (2.0 * root))


def norm(vector: Number) -> Number:
    """Length along the first axis of (d, m), which is kept."""
    if not isinstance(vector, Jet):
        return lengths(np.asarray(vector))
    length = lengths(vector.value)
    return Jet(length, np.sum(vector.value / length * vector.slope, axis=-2, keepdims=True))


def _met(
    found: FloatArray, at_corner: FloatArray, weights: FloatArray, values: FloatArray, gradients: FloatArray
) -> FloatArray:
    """Results, replaced at corners by the given values: even the smallest weight times a steep slope is not zero."""
    met = np.flatnonzero(weights.max(axis=0) == 1.0)
    known = np.isfinite(values[..., met]).all(axis=0) & np.isfinite(gradients[..., met]).all(axis=(0, 1))
    found[..., met] = np.where(known, at_corner[..., met], found[..., met])
    return found


def _mix(
    located: LocatedQueries,
    b: list[Jet] | list[FloatArray],
    values: FloatArray,
    first: FloatArray,
    gradients: FloatArray,
) -> Number:
    """The difference from the value `first` of one corner."""
    total: Number = 0.0
    divisor: Number = 0.0
    corners = located.corners
    sides = [_Side(corners[i], corners[i - 2] - corners[i], (gradients[i], gradients[i - 2])) for i in range(3)]
    for i in range(3):
        corner = _Corner(sides, i, values, first)
        weight = b[i - 2] * b[i - 1]
        total = total + weight * corner.surface(b[i], b[i - 2], b[i - 1])
        divisor = divisor + weight
    return total / divisor


Pair = tuple[Number, Number]


def hermite(ends: Pair, slopes: Pair, parts: Pair, length: Number) -> Number:
    """The cubic of given values and slopes at the two ends of a length that is cut into the two parts.

    Parts are fractions of the length; both are given, as 1 − t would lose the digits of a small one.
    """
    s, t = parts
    return (
        ends[0] * (t * t * (1.0 + 2.0 * s))
        + ends[1] * (s * s * (1.0 + 2.0 * t))
        + length * s * t * (t * slopes[0] - s * slopes[1])
    )


def hermite_slope(rise: Number, slopes: Pair, parts: Pair, length: Number) -> Number:
    """Its derivative, from the difference of the values."""
    s, t = parts
    return 6.0 * s * t * (rise / length) + t * (t - 2.0 * s) * slopes[0] + s * (s - 2.0 * t) * slopes[1]


class _Side:
    """The edge from a corner to the next one; seen from its other end its sign is turned, which rounds nothing.

    Tangent gradients have the same products with `along`, on the sphere the edge over its sine, as with the unit
    tangent at either end. `drop` is the cosine less one. At both ends slopes are along the side and across.
    """

    def __init__(self, corner: PrecisePoints, edge: FloatArray, gradients: tuple[FloatArray, FloatArray]) -> None:
        self.curved, self.edge = corner.curved, edge
        if self.curved:
            self.normal = crossed(corner.rounded, edge)
            self.sine, self.drop = lengths(self.normal), dot(corner.rounded, edge)
            self.cosine = 1.0 + self.drop
            self.length = np.arctan2(self.sine, self.cosine)
            self.along, self.across = edge / self.sine, self.normal / self.sine
        else:
            self.sine = self.length = lengths(edge)
            self.along = edge / self.length
            self.across = np.stack([-self.along[1], self.along[0]])
        self.slopes = [(inner(at_end, self.along), inner(at_end, self.across)) for at_end in gradients]


class _Corner:
    """S_i of the module's description: corner i, the sides after and before it, and the side jk opposite."""

    def __init__(self, sides: list[_Side], i: int, values: FloatArray, first: FloatArray) -> None:
        self.after, self.before, self.side = sides[i], sides[i - 1], sides[i - 2]
        self.on_sides = [self.after.slopes[0][0] * self.after.sine, self.before.slopes[1][0] * self.before.sine]
        self.value, self.ends = values[i] - first, (values[i - 2] - first, values[i - 1] - first)
        # Not of the ends: two values next to each other have lost their difference when a far one is taken off.
        self.rise = values[i - 1] - values[i - 2]

    def surface(self, b: Number, b_start: Number, b_end: Number) -> Number:
        """Values (k, m) where the barycentric coordinates of the corner and of the side's two ends are given."""
        share = b_start + b_end
        rests = b_end / share, b_start / share  # parts of the chord jk before and behind the line
        # Where the line meets the chord, along j and across it.
        chord = self._on_chord(rests) if self.side.curved else rests
        parts, length, divisor, (along, across) = self._line(b, share, rests, chord)
        value, slope_along, slope_across = self._on_side(rests, chord)
        start = self._from_corner(rests, self.on_sides) / divisor
        end = (slope_along * along + slope_across * across) / divisor
        return hermite((self.value, value), (start, end), parts, length)

    @staticmethod
    def _from_corner(rests: Pair, on_sides: list[FloatArray]) -> Number:
        """What is linear in the vector from the corner to the chord, from what it is along the two sides there."""
        return on_sides[0] * rests[1] - on_sides[1] * rests[0]

    def _line(self, b: Number, share: Number, rests: Pair, chord: Pair) -> tuple[Pair, Number, Number, Pair]:
        """The line from the corner to Q: the fractions of its length before and behind the query, its length, divisor.

        That is of slopes along the vector from the corner to the chord, at the corner, and of the components last
        returned: those of the line's direction at Q, along the side and across.
        """
        after, before, side = self.after, self.before, self.side
        along, across = dot(after.edge, side.along), dot(after.edge, side.across)
        if not side.curved:
            length = norm(self._from_corner(rests, [after.edge, before.edge]))
            return (share, b), length, length, (along + rests[0] * side.length, across)
        sine = norm(self._from_corner(rests, [after.normal, before.normal]))
        cosine = 1.0 + self._from_corner(rests, [after.drop, -before.drop])
        square = sine * sine + cosine * cosine
        ahead = arctan2(share * sine, b + share * cosine)
        behind = arctan2(b * sine, share * square + b * cosine)
        length = ahead + behind
        x, y = chord
        forward = x * (along + after.drop * side.drop / side.sine + y) + y * (after.drop - rests[0] * side.drop)
        return (ahead / length, behind / length), length, sine, (forward, across * sqrt(square))

    def _on_chord(self, rests: Pair) -> Pair:
        """Where the line meets the chord jk, along j and across it; with the rests exchanged along k."""
        return rests[1] + rests[0] * self.side.cosine, rests[0] * self.side.sine

    def _on_side(self, rests: Pair, chord: Pair) -> tuple[Number, Number, Number]:
        """Value, slope along and slope across at Q."""
        parts, length = rests, self.side.length
        if self.side.curved:
            (x, y), (u, v) = chord, self._on_chord(rests[::-1])
            parts = arctan2(y, x) / length, arctan2(v, u) / length
        slopes, across = zip(*self.side.slopes, strict=True)
        along = hermite_slope(self.rise, slopes, parts, length)
        return hermite(self.ends, slopes, parts, length), along, across[0] * parts[1] + across[1] * parts[0]
