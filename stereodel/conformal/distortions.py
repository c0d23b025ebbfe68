"""Change of scale of a conformal map over a region: closed formulas for bubbles, sums for points.

The scale at the distance χ from the focus is 1/(a − b cos χ) with a = (S + 1/S)/2 and b = (S − 1/S)/2. It falls from
the focus to its antipode, so that on a bubble it is largest nearest to the focus and smallest farthest from it, and its
mean is an elementary integral: around the centre of the bubble, at the distance D from the focus, a circle of height u
has the mean 1/√q(u), q(u) = (bu − a cos D)² + sin² D, and ∫ du/√q is an inverse hyperbolic sine.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray
from stereodel.conformal.moebius import MoebiusMap
from stereodel.constants import STORED_ERROR
from stereodel.sphere import SphereCircle, xyz_to_lonlat
from stereodel.sphere.coordinates import as_sphere_points
from stereodel.sphere.vectors import turned


def largest_scale(lens: MoebiusMap, points: FloatArray, radius: FloatArray) -> FloatArray:
    """The largest local scale within angular distances `radius` (n,) of unit vectors (n, 3), radians."""
    there = turned(points, lens.right.matrix)
    size = lens.magnification
    height = there[:, 2] if size >= 1 else -there[:, 2]
    across = np.sqrt(there[:, 0] ** 2 + there[:, 1] ** 2)
    # At the place nearest to the point of largest scale: the focus, or its antipode if the map shrinks.
    half = np.maximum(np.arctan2(across, height) - radius, 0.0) / 2
    larger = max(size, 1 / size)
    scale: FloatArray = larger / (np.cos(half) ** 2 + (larger * np.sin(half)) ** 2)
    return scale


LonLat = tuple[float, float]


@dataclass(frozen=True)
class Distortion:
    """The local scale of a conformal map over a region.

    Parameters
    ----------
    smallest, largest : float
        The extremes of the local scale.
    mean : float
        Mean of the local scale, over the area of a bubble or over points.
    area_ratio : float
        Area of the image over that of the region; for points the mean of the squared scale.
    smallest_at, largest_at : tuple of float
        (lon, lat) in degrees where the extremes are.
    """

    smallest: float
    largest: float
    mean: float
    area_ratio: float
    smallest_at: LonLat
    largest_at: LonLat


def distortion(conformal: MoebiusMap, region: SphereCircle | npt.ArrayLike) -> Distortion:
    """Smallest, largest and mean magnification of a region by a conformal map, its change in area, and where.

    Parameters
    ----------
    conformal : MoebiusMap
    region : SphereCircle or array_like, shape (n, 2) or (n, 3)
        A bubble, the side n·x ≥ offset, or points: rows (lon, lat) in degrees or directions.

    Returns
    -------
    Distortion
        Computed by closed formulas for a bubble, from the scale at each point for points.

    Raises
    ------
    ValueError
        If there are no points.

    Examples
    --------
    >>> from stereodel.conformal import fisheye
    >>> lens = fisheye((0.0, 40.0), magnification=4.0)
    >>> summary = distortion(lens, SphereCircle.around((0.0, 40.0), 28.0))
    >>> round(summary.largest, 6), round(summary.smallest, 3), round(summary.area_ratio, 3)
    (4.0, 2.13, 8.52)
    """
    if isinstance(region, SphereCircle):
        return _over_bubble(conformal, region)
    points = as_sphere_points(region, "region")
    if len(points) == 0:
        raise ValueError("region is empty; give a circle, or at least one point")
    scale = conformal.scale_factor(points)
    low, high = int(np.argmin(scale)), int(np.argmax(scale))
    places = _place(points[low]), _place(points[high])
    return Distortion(float(scale[low]), float(scale[high]), float(scale.mean()), float((scale**2).mean()), *places)


def _over_bubble(conformal: MoebiusMap, bubble: SphereCircle) -> Distortion:
    pole, size = conformal.peak
    nearest, farthest = _extremes(bubble, pole)
    largest, smallest = conformal.scale_factor(np.stack([nearest, farthest]))
    ratio = _sagitta(conformal.image_of(bubble)) / _sagitta(bubble)
    half_angle = [float(np.linalg.norm(bubble.center + sign * pole)) / 2 for sign in (-1, 1)]
    mean = _mean_scale(size, half_angle[0], half_angle[1], _sagitta(bubble))
    return Distortion(float(smallest), float(largest), mean, ratio, _place(farthest), _place(nearest))


def _extremes(bubble: SphereCircle, pole: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The points of a bubble nearest to and farthest from `pole`: `pole` itself, its antipode, or on the circle."""
    across = _reject(pole, bubble.center)
    if np.linalg.norm(across) <= STORED_ERROR:
        across = np.eye(3)[np.argmin(np.abs(bubble.center))]  # concentric: all directions are equivalent
    across = _reject(across / np.linalg.norm(across), bubble.center)  # again: a short vector was mostly rounding error
    across /= np.linalg.norm(across)
    ends = [bubble.offset * bubble.center + side * bubble.radius * across for side in (1, -1)]
    nearest = pole if bubble.contains(pole) else ends[0]
    return nearest, -pole if bubble.contains(-pole) else ends[1]


def _reject(vector: FloatArray, axis: FloatArray) -> FloatArray:
    return vector - axis * (vector @ axis)


def _sagitta(circle: SphereCircle) -> float:
    """1 − cos α, the area over 2π, without cancellation for small circles."""
    return circle.radius**2 / (1 + circle.offset) if circle.offset > 0 else 1 - circle.offset


def _mean_scale(magnification: float, sine: float, cosine: float, sagitta: float) -> float:
    """The integral of 1/√q(u) from cos α to 1, over 1 − cos α, the sagitta; of D/2 sine and cosine are given."""
    # With P = b − a cos D, Q = b cos α − a cos D and R = √(P² + sin² D), T likewise of Q, the integral is
    # ln((P + R)/(Q + T))/b. Written as log1p of b (1 − cos α) over positive terms it cancels nowhere.
    a, b = (magnification + 1 / magnification) / 2, (magnification - 1 / magnification) / 2
    if b == 0:
        return 1.0
    square = (2 * sine * cosine) ** 2  # sin² D
    p = 2 * a * sine**2 - 1 / magnification
    q = p - b * sagitta
    r, t = np.hypot(p, np.sqrt(square)), np.hypot(q, np.sqrt(square))
    if p + q < 0:
        p, q, r, t = -q, -p, t, r  # the mirrored integral
    lower = q + t if q > 0 else square / (t - q)
    step = b * sagitta * (1 + (p + q) / (r + t)) / lower
    return float(np.log1p(step) / (b * sagitta))


def _place(point: FloatArray) -> LonLat:
    lon, lat = xyz_to_lonlat(point)
    return float(lon), float(lat)
