"""Paths in the Möbius group, for animations: between maps, between foci.

Every map is a fisheye followed by a rotation, and the two are unique. The fisheyes are the points of hyperbolic space:
that of magnification S = exp η at f is the point (sinh η · f, cosh η) of the hyperboloid, at the distance η from the
identity, and two of them have the distance d with

    cosh d = cosh η₁ cosh η₂ − sinh η₁ sinh η₂ cos δ,

δ the angle between the foci. The shortest path between them is the geodesic, which has the form of a flight: the
magnification decreases, the focus moves, and the magnification increases again, simultaneously and no more than
necessary. J. J. van Wijk, W. A. A. Nuij, "Smooth and efficient zooming and panning", IEEE InfoVis (2003), found the
geodesics of the hyperbolic half-plane for views of a plane map; on the sphere they arise from the group itself.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_scalar
from stereodel.conformal.maps import fisheye
from stereodel.conformal.moebius import MoebiusMap
from stereodel.sphere import Rotation


@dataclass(frozen=True)
class GroupPath:
    """The path from one conformal map to another, for animations: called with t in [0, 1] it gives the map there.

    Parameters
    ----------
    start, end : MoebiusMap

    Notes
    -----
    Each map is decomposed into a fisheye and a rotation after it. The fisheyes follow the geodesic of hyperbolic space
    (`flight`), the rotations the shortest rotation. Between fisheyes all maps are fisheyes, between rotations all are
    rotations. The coset of a one-parameter group, ``start @ (start.inverse() @ end).power(t)``, also joins the two, but
    rotates the picture between one fisheye and another.

    Examples
    --------
    >>> path = GroupPath(MoebiusMap.identity(), fisheye((10.0, 50.0), magnification=16.0))
    >>> round(path(0.5).magnification, 12)
    4.0
    >>> path = flight((0.0, 0.0), (90.0, 0.0), magnification=8.0)
    >>> print([round(path(t).magnification, 3) for t in (0.0, 0.25, 0.5, 0.75, 1.0)])
    [8.0, 3.585, 2.314, 3.585, 8.0]
    """

    start: MoebiusMap
    end: MoebiusMap

    def __call__(self, t: float) -> MoebiusMap:
        """The map at t in [0, 1]: `start` itself at 0, `end` at 1, in between at constant speed."""
        t = as_scalar(t, "t", low=0.0, high=1.0)
        if t in {0.0, 1.0}:
            return self.end if t else self.start
        focus, magnification = self._fisheye(t)
        axis, angle = self._turn
        lens = fisheye(focus, magnification=magnification)
        turn = _rotation(self.start) @ Rotation.about(axis, t * angle)
        return MoebiusMap(turn @ lens.left, lens.magnification, lens.right)

    @cached_property
    def length(self) -> float:
        """d, the hyperbolic distance between the two fisheyes: |ln S₂/S₁| for magnification in place from S₁ to S₂.

        Flights with durations proportional to their lengths appear equally fast.
        """
        (f, s), (g, r) = self.start.peak, self.end.peak
        a, b = np.log(s), np.log(r)
        # sinh²(d/2) as a sum of positive terms, without cancellation if the two are close.
        chord = float(np.linalg.norm(f - g)) / 2
        square = np.sinh((a - b) / 2) ** 2 + np.sinh(a) * np.sinh(b) * chord**2
        return float(2 * np.arcsinh(np.sqrt(square)))

    def _fisheye(self, t: float) -> tuple[FloatArray, float]:
        """Focus and magnification at t, from the vector part of the point on the geodesic."""
        (f, s), (g, r), d = self.start.peak, self.end.peak, self.length
        before, after = (np.sinh((1 - t) * d) / np.sinh(d), np.sinh(t * d) / np.sinh(d)) if d > 0 else (1 - t, t)
        vector = before * np.sinh(np.log(s)) * f + after * np.sinh(np.log(r)) * g
        size = float(np.linalg.norm(vector))
        return (vector / size, float(np.exp(np.arcsinh(size)))) if size > 0 else (f, 1.0)

    @cached_property
    def _turn(self) -> tuple[FloatArray, float]:
        """Axis and angle in degrees, at most 180, of the rotation from that of `start` to that of `end`."""
        between = _rotation(self.start).inverse() @ _rotation(self.end)
        w, *v = between.quaternion * (-1.0 if between.quaternion[0] < 0 else 1.0)
        size = float(np.linalg.norm(v))
        return np.array(v if size > 0 else [0.0, 0.0, 1.0]), float(np.degrees(2 * np.arctan2(size, w)))


def _rotation(conformal: MoebiusMap) -> Rotation:
    """The rotation that follows the fisheye."""
    return conformal.left @ conformal.right


def flight(
    start: npt.ArrayLike, end: npt.ArrayLike, *, magnification: float, arrival: float | None = None
) -> GroupPath:
    """A path of fisheyes from one focus to another, along which the magnification first decreases, then increases.

    Parameters
    ----------
    start, end : array_like, shape (2,) or (3,)
        The foci, (lon, lat) in degrees or directions.
    magnification : float
        S at the start, and at the end unless `arrival` is given.
    arrival : float, optional
        S at the end.

    Returns
    -------
    GroupPath
        Its maps are all fisheyes. `length` is the length of the flight.

    Raises
    ------
    ValueError
        As for `fisheye`.

    Notes
    -----
    The geodesic of hyperbolic space between the two fisheyes, at constant speed: see `GroupPath`. For foci at a right
    angle S falls at least to exp(arsinh 1) = 1 + √2, however large it is at the ends; between antipodal foci the path
    passes through the undistorted globe.

    Examples
    --------
    >>> path = flight((-74.0, 40.7), (2.35, 48.86), magnification=20.0)
    >>> round(path.length, 3), round(path(0.5).magnification, 3)
    (4.38, 4.194)
    """
    first = fisheye(start, magnification=magnification)
    return GroupPath(first, fisheye(end, magnification=first.magnification if arrival is None else arrival))
