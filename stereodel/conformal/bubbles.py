"""Maps between bubbles: any disc of the sphere onto any other (claim P16 of the paper)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel._arrays import as_scalar
from stereodel._double_double import DoubleDouble, dot, stack, unit
from stereodel.conformal.biquaternions import Z_AXIS, Biquaternion, boost, rotation
from stereodel.conformal.moebius import MoebiusMap, boost_points
from stereodel.constants import STORED_ERROR
from stereodel.sphere import SphereCircle, as_direction
from stereodel.sphere.degrees import sin_cos_degrees
from stereodel.sphere.rotations import between, multiply, rotation_matrix, transform


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
    """The map of a bubble onto the northern hemisphere with a point of it at the pole.

    A stored point and a stored circle are each off by up to STORED_ERROR, and the map, whose scale on the rim is 1/sin
    α, magnifies that to an error of 2 STORED_ERROR/sin α in the height above the equator. Whether a lower point lies
    inside is a matter of rounding; if the circle is too small, that includes the centre, whose height is 1. The error
    of the double-doubles, about 2⁻¹⁰⁰/sin α here, is 2⁻⁵⁰ of that.
    """
    _, cosine, sine = circle.exact_parts()
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
