"""Arcs of circles on the sphere, stored so that they can be drawn and mapped without samples; distances and areas.

Graticules are meridians and parallels as such arcs (Figures 10 to 12 of the paper).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import FloatArray, Keyed, as_count, as_directions, as_lonlat, as_scalar, as_steps, read_only
from stereodel._double_double import DoubleDouble, cross, dot, unit
from stereodel.constants import UNDECIDED
from stereodel.sphere.circles import SphereCircle, on_circle, stored_unit
from stereodel.sphere.coordinates import as_direction, lonlat_to_xyz
from stereodel.sphere.latitudes import Latitude

_FULL_TURN = 2 * np.pi


@dataclass(frozen=True, eq=False)
class SphereArc(Keyed):
    """The arc of a circle from one point to another, counterclockwise as seen from the tip of `circle.normal`.

    Parameters
    ----------
    circle : SphereCircle
    start, end : array_like, shape (2,) or (3,)
        (lon, lat) in degrees or directions, on the circle (they are moved onto it); stored as unit vectors.
    angle_rad : float, optional
        Angle swept about the axis of the circle, in (0, 2π], if it is known more accurately than from the rounded ends.
        By default computed from the ends; equal ends give the whole circle.

    Examples
    --------
    >>> quarter = SphereArc.great((0.0, 0.0), (90.0, 0.0))
    >>> print(quarter.sample(3))
    [[1.         0.         0.        ]
     [0.70710678 0.70710678 0.        ]
     [0.         1.         0.        ]]
    """

    circle: SphereCircle
    start: FloatArray
    end: FloatArray
    angle_rad: float = 0.0

    def __post_init__(self) -> None:
        for name in ("start", "end"):
            object.__setattr__(self, name, read_only(stored_unit(as_direction(getattr(self, name), name))))
        angle = as_scalar(self.angle_rad, "angle_rad", low=0.0, high=_FULL_TURN)
        angle = angle or swept_angle(unit(self.circle.normal), unit(self.start), unit(self.end))
        object.__setattr__(self, "angle_rad", angle)

    @classmethod
    def great(cls, start: npt.ArrayLike, end: npt.ArrayLike) -> SphereArc:
        """The shorter great-circle arc between two points, each (lon, lat) in degrees or a direction.

        Raises
        ------
        ValueError
            For equal or antipodal points, which have no unique great circle.
        """
        a, b = unit(as_direction(start, "start")), unit(as_direction(end, "end"))
        axis = cross(a, b)
        sine = dot(axis, axis).sqrt()
        if float(sine.hi) <= UNDECIDED:
            raise ValueError("start and end are equal or antipodal: no single great circle joins them")
        circle = SphereCircle((axis / sine).round(), 0.0)
        return cls(circle, a.round(), b.round(), float(np.arctan2(sine.hi, dot(a, b).hi)))

    @classmethod
    def whole(cls, circle: SphereCircle) -> SphereArc:
        """The closed circle, beginning due south of its centre."""
        first = circle.sample(1)[0]
        return cls(circle, first, first, _FULL_TURN)

    @property
    def closed(self) -> bool:
        """Whether the arc is the whole circle."""
        return self.angle_rad == _FULL_TURN

    @property
    def length(self) -> float:
        """Length on the unit sphere."""
        return self.circle.radius * self.angle_rad

    def frame(self) -> tuple[FloatArray, FloatArray, FloatArray, float]:
        """Parametrisation of the arc: `center + cos t · u + sin t · v` for t from 0 to `sweep_rad`.

        Returns
        -------
        center, u, v : ndarray, shape (3,)
            Centre of the circle in space and two perpendicular radii of it, `u` towards `start`.
        sweep_rad : float
            The angle swept, in (0, 2π].
        """
        normal, offset, _ = self.circle.exact_parts()
        center = normal * offset
        u = on_circle(self.circle, unit(self.start)) - center
        return center.round() + 0.0, u.round() + 0.0, cross(normal, u).round() + 0.0, self.angle_rad

    def sample(self, n: int) -> FloatArray:
        """Points at n equal steps of angle from start to end, both included, (n, 3); n at least 2."""
        center, u, v, sweep_rad = self.frame()
        t = np.linspace(0.0, sweep_rad, as_count(n, "n", low=2))[:, None]
        points = center + np.cos(t) * u + np.sin(t) * v
        points[0], points[-1] = self.start, self.end
        return points

    @property
    def _key(self) -> tuple[object, ...]:
        return (self.circle, *self.start.tolist(), *self.end.tolist(), self.angle_rad)


def swept_angle(normal: DoubleDouble, start: DoubleDouble, end: DoubleDouble) -> float:
    """Angle about `normal` from one point of a circle to another, counterclockwise, in (0, 2π]; 2π when they agree."""
    a, b = (point - normal * dot(point, normal) for point in (start, end))
    angle = float(np.arctan2(dot(normal, cross(a, b - a)).hi, dot(a, b).hi))
    return angle if angle > 0 else angle + _FULL_TURN


_NORTH = (0.0, 0.0, 1.0)
_SOUTH = (0.0, 0.0, -1.0)


def meridian(lon: float) -> SphereArc:
    """The half great circle at one longitude in degrees, from the south pole to the north pole."""
    return SphereArc(_meridian_circle(lon), np.array(_SOUTH), np.array(_NORTH), np.pi)


def parallel(lat: float, *, latitude: Latitude = "spherical") -> SphereArc:
    """The whole circle of one latitude in degrees, in (−90, 90), eastwards from longitude 0."""
    if latitude == "spherical":
        return SphereArc.whole(_parallel_circle(lat))
    x, _, z = lonlat_to_xyz((0.0, lat), latitude=latitude).tolist()
    return SphereArc.whole(SphereCircle(np.array(_NORTH), z, x))


def graticule(spacing: float = 15.0, *, latitude: Latitude = "spherical") -> list[SphereArc]:
    """Meridians from pole to pole, from longitude −180 eastwards, then parallels from south to north.

    Parameters
    ----------
    spacing : float
        Degrees between neighbouring lines; 180 must be a whole multiple of it.
    latitude : {"spherical", "geodetic", "authalic"}
        The kind of latitude of which the parallels are multiples; see `stereodel.lonlat_to_xyz`.

    Returns
    -------
    list of SphereArc
        360/spacing half great circles and the parallels whose latitudes are multiples of the spacing.

    Examples
    --------
    >>> len(graticule(30.0))
    17
    """
    steps = as_steps(180.0, spacing, "spacing")
    meridians = [meridian(k * 180.0 / steps) for k in range(-steps, steps)]
    half = (steps - 1) // 2
    return meridians + [parallel(k * 180.0 / steps, latitude=latitude) for k in range(-half, half + 1)]


def graticule_patch(center: npt.ArrayLike, half_width: float, spacing: float) -> list[SphereArc]:
    """The grid of a box in longitude and latitude, borders included: pieces of meridians, then of parallels.

    Parameters
    ----------
    center : array_like, shape (2,)
        (lon, lat) in degrees.
    half_width : float
        Degrees from the centre to each border, in both directions; the box must end before the poles.
    spacing : float
        Degrees between lines; the width 2·half_width must be a whole multiple of it.

    Returns
    -------
    list of SphereArc

    Examples
    --------
    >>> len(graticule_patch((0.0, 40.0), 8.0, 2.0))
    18
    """
    lon, lat = (float(value) for value in as_lonlat(center, "center"))
    width = 2 * as_scalar(half_width, "half_width", low=0.0, high=90.0 - abs(lat), open_low=True, open_high=True)
    steps = as_steps(width, spacing, "spacing")
    shifts = np.array([(k / steps - 0.5) * width for k in range(steps + 1)])
    lons, lats = lon + shifts, lat + shifts
    turn, (west, east), (south, north) = float(np.radians(width)), lons[[0, -1]], lats[[0, -1]]
    sides = [(_meridian_circle(x), lonlat_to_xyz([[x, south], [x, north]])) for x in lons]
    sides += [(_parallel_circle(y), lonlat_to_xyz([[west, y], [east, y]])) for y in lats]
    return [SphereArc(circle, ends[0], ends[1], turn) for circle, ends in sides]


def _meridian_circle(lon: float) -> SphereCircle:
    # Counterclockwise about lon − 90 is northwards at lon.
    return SphereCircle(lonlat_to_xyz((lon - 90.0, 0.0)), 0.0)


def _parallel_circle(lat: float) -> SphereCircle:
    return SphereCircle.around(_NORTH, 90.0 - lat)


def angular_distance(a: npt.ArrayLike, b: npt.ArrayLike) -> FloatArray:
    """Angle between directions, accurate near 0° and 180° alike.

    Parameters
    ----------
    a, b : array_like, shape (..., 3)
        Directions, broadcast against each other.

    Returns
    -------
    ndarray, shape (...)
        Degrees in [0, 180].

    Notes
    -----
    Twice atan2(length of a − b, length of a + b), on unit vectors in double-double; W. Kahan, "How futile are mindless
    assessments of roundoff in floating-point computation?", 2006, section 12.

    Examples
    --------
    >>> print(angular_distance([1, 0, 0], [[1, 1, 0], [1, 1e-20, 0]]))
    [4.50000000e+01 5.72957795e-19]
    """
    difference, total = _difference_and_sum(unit(as_directions(a, "a")), unit(as_directions(b, "b")))
    return np.asarray(np.degrees(2 * np.arctan2(difference.hi, total.hi)))


def _difference_and_sum(a: DoubleDouble, b: DoubleDouble) -> tuple[DoubleDouble, DoubleDouble]:
    minus, plus = a - b, a + b
    return dot(minus, minus).sqrt(), dot(plus, plus).sqrt()


def great_circle_points(a: npt.ArrayLike, b: npt.ArrayLike, n: int) -> FloatArray:
    """Points at n equal steps along the shorter great-circle arc, both ends included.

    Parameters
    ----------
    a, b : array_like, shape (..., 3)
        Directions, broadcast against each other; not antipodal.
    n : int
        At least 2.

    Returns
    -------
    ndarray, shape (..., n, 3)
        Unit vectors.

    Raises
    ------
    ValueError
        For antipodal directions, which have no unique shortest arc.

    Examples
    --------
    >>> print(great_circle_points([2, 0, 0], [0, 1, 0], 3)[1])
    [0.70710678 0.70710678 0.        ]
    """
    p, q = unit(as_directions(a, "a")), unit(as_directions(b, "b"))
    difference, total = _difference_and_sum(p, q)
    if (total.hi <= UNDECIDED).any():
        raise ValueError("a and b hold antipodal directions: no single great circle joins them")
    angle = 2 * np.arctan2(difference.hi, total.hi)[..., None, None]
    across = (q - p) - p * dot(p, q - p)[..., None]
    size = dot(across, across).sqrt().hi
    towards = across.hi / np.where(size == 0, 1.0, size)[..., None]
    t = np.linspace(0.0, 1.0, as_count(n, "n", low=2))[:, None] * angle
    return np.cos(t) * p.round()[..., None, :] + np.sin(t) * towards[..., None, :]


def solid_angle(a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike) -> FloatArray:
    """Signed area of spherical triangles on the unit sphere.

    Parameters
    ----------
    a, b, c : array_like, shape (..., 3)
        Directions of the vertices, broadcast against each other.

    Returns
    -------
    ndarray, shape (...)
        Steradians in (−2π, 2π]: positive when a, b, c are counterclockwise seen from outside; 2π when the vertices go
        once around a great circle. With antipodal vertices the triangle is not unique; 0 where they leave it open.

    Notes
    -----
    tan(Ω/2) = a·(b × c) / (1 + a·b + b·c + c·a), with a·(b × c) = a·((b − a) × (c − a)), all in double-double: tiny
    triangles keep their digits. A. Van Oosterom, J. Strackee, "The solid angle of a plane triangle", IEEE Trans.
    Biomed. Eng. 30 (1983).

    Examples
    --------
    >>> round(float(solid_angle([1, 0, 0], [0, 1, 0], [0, 0, 1]) / np.pi), 15)
    0.5
    """
    p, q, r = unit(as_directions(a, "a")), unit(as_directions(b, "b")), unit(as_directions(c, "c"))
    volume = dot(p, cross(q - p, r - p))
    base = 1.0 + dot(p, q) + dot(q, r) + dot(r, p)
    angles = _kernel.vector_angles(*(np.ascontiguousarray(part).ravel() for part in (volume.hi + 0.0, base.hi)))
    return np.asarray(2 * angles.reshape(volume.hi.shape))
