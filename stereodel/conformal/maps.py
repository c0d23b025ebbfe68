"""Conformal maps by what they are to do: magnify a focus, take a bubble to a bubble, or three points to three.

The fisheye is that of Figures 10 to 13 of the paper, the map between bubbles its claim P16.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel._arrays import as_scalar
from stereodel._docs import by_name
from stereodel._double_double import DoubleDouble, dot, stack, unit
from stereodel.conformal.group import Z_AXIS, Biquaternion, Complex, Spinors, boost, from_spinors, rotation
from stereodel.conformal.moebius import MoebiusMap, boost_points
from stereodel.constants import STORED_ERROR, UNDECIDED
from stereodel.sphere import Rotation, SphereCircle
from stereodel.sphere.coordinates import as_direction, as_sphere_points
from stereodel.sphere.degrees import sin_cos_degrees
from stereodel.sphere.rotations import between, multiply, rotation_matrix, transform


@by_name("magnification= is a keyword")
def fisheye(focus: npt.ArrayLike, *, magnification: float) -> MoebiusMap:
    """The conformal map that magnifies the surroundings of a focus S times and shrinks the rest.

    Parameters
    ----------
    focus : array_like, shape (2,) or (3,)
        (lon, lat) in degrees or a direction.
    magnification : float
        S > 0; below 1 the surroundings shrink. The accuracy of `MoebiusMap` is tested from 1e-9 to 1e9.

    Returns
    -------
    MoebiusMap
        Every point keeps its bearing from the focus; its angular distance χ becomes Ξ = 2 arctan(S tan(χ/2)). The scale
        is S at the focus and 1/S at its antipode.

    Raises
    ------
    ValueError
        If the magnification is not positive and finite, a vector is zero, or a latitude is outside [−90, 90].

    Notes
    -----
    Claim P18: Γ⁻¹∘Φ∘Γ with the stereographic projection Γ from the antipode of the focus and the similarity Φ of
    ratio S.

    Examples
    --------
    >>> lens = fisheye((0.0, 90.0), magnification=3.0)
    >>> print(lens([0.6, 0.0, 0.8]).round(12))
    [1. 0. 0.]
    """
    right = Rotation.between(as_direction(focus, "focus"), (0.0, 0.0, 1.0))
    return MoebiusMap(right.inverse(), magnification, right)


def bubble_to_bubble(
    source: SphereCircle,
    target: SphereCircle,
    source_point: npt.ArrayLike | None = None,
    target_point: npt.ArrayLike | None = None,
    *,
    turn: float = 0.0,
) -> MoebiusMap:
    """The conformal map that takes one bubble to another, and a point inside the first to a point inside the second.

    Parameters
    ----------
    source, target : SphereCircle
        The bubbles are the interiors n·x > offset; use `small_bubble` or `large_bubble` to choose the side.
    source_point, target_point : array_like, shape (2,) or (3,), optional
        Points strictly inside the bubbles, (lon, lat) in degrees or directions; by default the centres.
    turn : float
        Degrees by which the image is rotated counterclockwise about `target_point`, seen from outside the sphere. At 0,
        a bubble that is mapped onto itself with its point fixed is unchanged, and centres are carried along the great
        circle between them (`Rotation.between`).

    Returns
    -------
    MoebiusMap
        The unique map with these properties.

    Raises
    ------
    ValueError
        If a point does not lie strictly inside its bubble, by more than the rounding error of stored points and circles
        (2 · `STORED_ERROR`), or a bubble or its complement is so small that no point does.

    Notes
    -----
    Both bubbles are mapped onto the northern hemisphere with their points at the pole: by the fisheye at the centre of
    magnification cot(α/2), α the angular radius, and by a fisheye at a point of the equator, which keeps the equator.

    Examples
    --------
    >>> cap, half = SphereCircle.around((20.0, 50.0), 10.0), SphereCircle.around((0.0, -90.0), 90.0)
    >>> down = bubble_to_bubble(cap, half)
    >>> down.image_of(cap).angular_radius, round(down.magnification, 6)
    (90.0, 11.430052)
    """
    start = unit(source.normal if source_point is None else as_direction(source_point, "source_point"))
    end = unit(target.normal if target_point is None else as_direction(target_point, "target_point"))
    center = unit(target.normal)
    to_north = between(center, Z_AXIS)
    first = _to_hemisphere(source, start, multiply(to_north, between(unit(source.normal), center)), "source")
    last = _to_hemisphere(target, end, to_north, "target")
    sine, cosine = sin_cos_degrees(np.asarray(as_scalar(turn, "turn") / 2))
    zero = DoubleDouble(0.0)
    turned = rotation(stack([cosine, zero, zero, sine]))
    return MoebiusMap(*(last.inverse() @ turned @ first).decomposed())


def _to_hemisphere(circle: SphereCircle, point: DoubleDouble, to_north: DoubleDouble, name: str) -> Biquaternion:
    """The map of a bubble onto the northern hemisphere with a point of it at the pole."""
    _, cosine, sine = circle.exact_parts()
    # A stored point and a stored circle are each off by up to STORED_ERROR, which the map, of scale 1/sin α on the rim,
    # magnifies to 2 STORED_ERROR/sin α in the height above the equator: whether a lower point lies inside is a matter
    # of rounding; if the circle is too small, of the centre as well. Double-doubles are off by 2⁻⁵⁰ of that.
    noise = 2 * STORED_ERROR / float(sine.hi)
    if noise >= 1:
        raise ValueError(
            f"{name} has the radius sin α = {float(sine.hi):g}: a circle of less than {2 * STORED_ERROR:g} cannot be "
            "told from a point"
        )
    # cot(α/2), without cancellation whichever side is the larger.
    size = (1.0 + cosine) / sine if circle.offset >= 0 else sine / (1.0 - cosine)
    image = boost_points(transform(rotation_matrix(to_north), point), size)
    if not float(image.hi[2]) > noise:
        raise ValueError(
            f"{name}_point must lie strictly inside the bubble {name}, n·x > {circle.offset:g}, "
            f"by more than {2 * STORED_ERROR:g} rad"
        )
    onto = boost(Z_AXIS, size) @ rotation(to_north)
    across = dot(image[:2], image[:2]).sqrt()
    if float(across.hi) == 0:
        return onto
    # At distance ψ from the horizontal axis h through the point, ψ must become 90°: S tan(ψ/2) = 1, tan ψ = z/|t|.
    horizon = stack([image[0] / across, image[1] / across, DoubleDouble(0.0)])
    return boost(horizon, (1.0 + across) / image[2]) @ onto


Spinor = tuple[Complex, Complex]


def three_points(sources: npt.ArrayLike, targets: npt.ArrayLike) -> MoebiusMap:
    """The conformal map that takes three points to three points, in their order.

    Parameters
    ----------
    sources, targets : array_like, shape (3, 2) or (3, 3)
        Rows (lon, lat) in degrees, or directions; the three of each must be distinct.

    Returns
    -------
    MoebiusMap
        The unique map; it also takes the circle through the sources to the circle through the targets.

    Raises
    ------
    ValueError
        If an argument has another shape, or two of its points coincide.

    Notes
    -----
    With spinors p of the points and ⟨p, q⟩ = p₁q₂ − p₂q₁ the map ξ ↦ (⟨p, ξ⟩⟨r, q⟩, ⟨q, ξ⟩⟨r, p⟩) takes p, q, r to
    0, ∞, 1. The result is that of the sources, followed by the inverse of that of the targets.

    Examples
    --------
    >>> turn = three_points([(0, 0), (90, 0), (0, 90)], [(90, 0), (180, 0), (0, 90)])
    >>> turn.kind, turn.is_close(MoebiusMap.rotation((0.0, 90.0), 90.0))
    ('rotation', True)
    """
    (a, b), (c, d) = _to_standard(_three(sources, "sources"))
    (p, q), (r, s) = _to_standard(_three(targets, "targets"))
    matrix = ((s * a - q * c, s * b - q * d), (p * c - r * a, p * d - r * b))
    return MoebiusMap(*from_spinors(matrix).normalized().decomposed())


def _three(points: npt.ArrayLike, name: str) -> list[Spinor]:
    rows = as_sphere_points(points, name)
    if len(rows) != 3:
        raise ValueError(f"{name} must be three points, got {len(rows)}")
    vectors = unit(rows)
    spinors = [_spinor(vectors[k]) for k in range(3)]
    for i, j in ((0, 1), (0, 2), (1, 2)):
        # |⟨p, q⟩|² is the squared chord up to a factor between 1 and 4.
        if float(_bracket(spinors[i], spinors[j]).square_size().hi) <= UNDECIDED**2:
            raise ValueError(f"{name}[{i}] and {name}[{j}] are the same point; give three distinct ones")
    return spinors


def _spinor(point: DoubleDouble) -> Spinor:
    """The spinor of a unit vector (3,): (1 + z, x + iy) or (x − iy, 1 − z), whichever is longer."""
    x, y, z = (point[k] for k in range(3))
    zero = DoubleDouble(np.zeros(()))
    if float(z.hi) >= 0:
        return Complex(1.0 + z, zero), Complex(x, y)
    return Complex(x, -y), Complex(1.0 - z, zero)


def _bracket(p: Spinor, q: Spinor) -> Complex:
    return p[0] * q[1] - p[1] * q[0]


def _to_standard(points: list[Spinor]) -> Spinors:
    """The matrix that takes three points to 0, ∞ and 1."""
    p, q, r = points
    first, second = _bracket(r, q), _bracket(r, p)
    return (-p[1] * first, p[0] * first), (-q[1] * second, q[0] * second)
