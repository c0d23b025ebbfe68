"""Several foci at once: a map that is not conformal, with its angular distortion.

No conformal map has two foci. The conformal maps of the whole sphere onto itself are the Möbius maps (Liouville's
theorem says the same of space, H. A. Schwarz's of the sphere), and the scale of one is 1/(a − b·x): it has one maximum.
So here each focus has a disc of its own, inside which points move along rays from the focus; outside all discs the map
is the identity. In stereographic terms, with τ = tan(χ/2) over its value at the rim, τ becomes G(τ) with

    d ln G / d ln τ = E(ln τ),

E = 1 at the rim and in a core about the focus, where the map is the conformal fisheye of magnification S, and less than
1 in the ring between, where it is the ratio of radial to tangential scale. ln G decreases by ln S in the ring, so the
smallest E determines how wide the ring must be on the scale of ln τ. 1 − E is a window with cosine tapers (J. W. Tukey,
"An introduction to the calculations of numerical spectrum analysis", 1967), so that G is twice differentiable. Since E
> 0 the map does not fold, and since the discs are disjoint it is injective.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, FloatArray, as_directions, as_floats, as_scalar, read_only
from stereodel._double_double import by_blocks
from stereodel._values import Keyed
from stereodel.constants import LARGEST_MAGNIFICATION
from stereodel.sphere import angular_distance
from stereodel.sphere.coordinates import as_sphere_points
from stereodel.sphere.vectors import units

_TAPER = 0.25
"""Share of the window taken by each of its two tapers; the area under the window is 1 − _TAPER."""


@dataclass(frozen=True, eq=False)
class FocusBlend(Keyed):
    """A map of the sphere that magnifies several places at once. It is injective, but not conformal.

    Parameters
    ----------
    foci : array_like, shape (n, 2) or (n, 3)
        Rows (lon, lat) in degrees, or directions.
    magnification : float or array_like, shape (n,)
        S ≥ 1, for all foci or for each.
    width : float, optional
        Angular radius of the discs in degrees, in (0, 180). By default (0) half the smallest distance between two foci,
        so that discs touch; 90 for a single focus.
    limit : float, optional
        Largest angular distortion in the rings, in degrees in (0, 180). The smaller it is and the larger S, the smaller
        the cores: their radius is proportional to S to the power −1/(¾(1 − E)).

    Raises
    ------
    ValueError
        If discs overlap, or a number is out of range.

    Examples
    --------
    >>> blend = FocusBlend([(-74.0, 40.7), (2.35, 48.86)], magnification=4.0)
    >>> print(round(blend.width, 3), blend.core_radii.round(3), blend.angular_distortion(blend.foci))
    26.248 [1.67 1.67] [0. 0.]
    """

    foci: FloatArray
    magnification: FloatArray = field(kw_only=True)
    width: float = field(default=0.0, kw_only=True)
    limit: float = field(default=60.0, kw_only=True)

    def __post_init__(self) -> None:
        foci = units(as_sphere_points(self.foci, "foci"))
        if len(foci) == 0:
            raise ValueError("foci is empty; give at least one point")
        sizes = as_floats(self.magnification, "magnification")
        if sizes.shape not in {(), (len(foci),)}:
            raise ValueError(f"magnification must be one number or {len(foci)}, one for each focus, got {sizes.shape}")
        for size in sizes.ravel():
            as_scalar(size, "magnification", low=1.0, high=LARGEST_MAGNIFICATION)
        limit = as_scalar(self.limit, "limit", low=0.0, high=180.0, open_low=True, open_high=True)
        object.__setattr__(self, "width", _checked_width(foci, self.width))
        object.__setattr__(self, "limit", limit)
        object.__setattr__(self, "foci", read_only(foci))
        object.__setattr__(self, "magnification", read_only(np.broadcast_to(sizes, len(foci))))

    @property
    def core_radii(self) -> FloatArray:
        """Angular radii in degrees, (n,), of the cores: inside them the map is the conformal fisheye."""
        return np.degrees(2 * np.arctan(np.exp(-self._ring) * self._rim))

    def __call__(self, xyz: npt.ArrayLike) -> FloatArray:
        """Images of directions (..., 3) as unit vectors."""
        return by_blocks(self._images, as_directions(xyz, "xyz"))

    def stretches(self, xyz: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Largest and smallest local scale at directions (..., 3): across the rays and along them."""
        both = by_blocks(self._scales, as_directions(xyz, "xyz"))
        return both.max(axis=-1), both.min(axis=-1)

    def angular_distortion(self, xyz: npt.ArrayLike) -> FloatArray:
        """The largest change of an angle at directions (..., 3), degrees: 2 arcsin((a − b)/(a + b)).

        The scales a ≥ b are those of `stretches` (A. Tissot, "Mémoire sur la représentation des surfaces", 1881).
        """
        largest, smallest = self.stretches(xyz)
        return np.asarray(np.degrees(2 * np.arcsin((largest - smallest) / (largest + smallest))))

    @property
    def _rim(self) -> float:
        return float(np.tan(np.radians(self.width) / 2))

    @property
    def _depth(self) -> float:
        """1 − E at its largest; an angular distortion ω belongs to E = (1 − sin(ω/2))/(1 + sin(ω/2))."""
        sine = float(np.sin(np.radians(self.limit) / 2))
        return 2 * sine / (1 + sine)

    @property
    def _ring(self) -> FloatArray:
        """Widths of the rings in ln τ: the window takes ln S from ln G."""
        return np.log(self.magnification) / (self._depth * (1 - _TAPER))

    def _images(self, rows: FloatArray) -> FloatArray:
        points = units(rows)
        result = points.copy()
        for disc in self._discs(points):
            # Along its ray from the focus a point goes from χ to Ξ: cos Ξ from tan(Ξ/2), and the part across the axis,
            # of length sin χ, times sin Ξ / sin χ; from the difference to the focus, so that near ones keep digits.
            away = points[disc.inside] - disc.focus
            across = away - disc.focus * (away @ disc.focus)[:, None]
            square = (self._rim * disc.tau * disc.growth) ** 2
            along = (1 - square) / (1 + square)
            result[disc.inside] = along[:, None] * disc.focus + disc.tangential[:, None] * across
        return result + 0.0

    def _scales(self, rows: FloatArray) -> FloatArray:
        """Radial and tangential scale, (m, 2)."""
        points = units(rows)
        result = np.ones((len(points), 2))
        for disc in self._discs(points):
            radial = disc.tangential * (1 - self._depth * _window(disc.tau, disc.ring))
            result[disc.inside] = np.stack([radial, disc.tangential], axis=-1)
        return result

    def _discs(self, points: FloatArray) -> Iterator[_Disc]:
        """Each focus with the points in its disc."""
        for focus, size, ring in zip(self.foci, self.magnification, self._ring, strict=True):
            near, far = (np.linalg.norm(points - sign * focus, axis=1) for sign in (1, -1))
            inside = near < self._rim * far
            tau = near[inside] / (self._rim * far[inside])
            growth = size * np.exp(-np.log(size) * _window_area(tau, ring))
            # sin Ξ / sin χ from tan(Ξ/2) / tan(χ/2).
            tangential = growth * (1 + (self._rim * tau) ** 2) / (1 + (self._rim * tau * growth) ** 2)
            yield _Disc(focus, float(ring), inside, tau, growth, tangential)

    @property
    def _key(self) -> tuple[object, ...]:
        return (self.foci.tobytes(), self.magnification.tobytes(), self.width, self.limit)


class _Disc(NamedTuple):
    focus: FloatArray
    ring: float
    inside: BoolArray  # of all points; what follows is of those inside
    tau: FloatArray
    growth: FloatArray  # G(τ)/τ
    tangential: FloatArray


def _checked_width(foci: FloatArray, width: float) -> float:
    """The angular radius of discs that do not overlap, in degrees."""
    first, second = np.triu_indices(len(foci), 1)
    distances = np.asarray(angular_distance(foci[first], foci[second]))
    closest = int(np.argmin(distances)) if len(distances) else 0
    widest = float(distances[closest]) / 2 if len(distances) else 90.0
    if widest == 0:
        raise ValueError(f"foci[{first[closest]}] and foci[{second[closest]}] are the same point")
    if width == 0:
        return widest
    width = as_scalar(width, "width", low=0.0, high=180.0, open_low=True, open_high=True)
    if len(distances) and width > widest:
        pair = f"foci[{first[closest]}] and foci[{second[closest]}]"
        raise ValueError(f"width is {width:g}, but the discs of {pair} overlap beyond {widest:g}")
    return width


def _position(tau: FloatArray, ring: float) -> FloatArray:
    """Position of ln τ in the ring: 0 at the core and inside it, 1 at the rim."""
    if ring == 0:
        return np.ones_like(tau)
    with np.errstate(divide="ignore"):
        return np.clip(1 + np.log(tau) / ring, 0.0, 1.0)


def _window(tau: FloatArray, ring: float) -> FloatArray:
    """The tapered window, 0 at core and rim, 1 between."""
    x = _position(tau, ring)
    return 0.5 - 0.5 * np.cos(np.pi * np.clip(np.minimum(x, 1 - x) / _TAPER, 0.0, 1.0))


def _window_area(tau: FloatArray, ring: float) -> FloatArray:
    """The area under the window from the core on, over the whole area."""
    x = _position(tau, ring)
    near = np.minimum(x, 1 - x)
    taper = np.minimum(near, _TAPER)
    area = 0.5 * (taper - _TAPER / np.pi * np.sin(np.pi * taper / _TAPER)) + np.maximum(near - _TAPER, 0.0)
    area = area / (1 - _TAPER)
    return np.where(x <= 0.5, area, 1 - area)
