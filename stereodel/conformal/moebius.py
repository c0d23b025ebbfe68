"""The orientation-preserving conformal maps of the sphere: Möbius transformations (claims P15 to P19 of the paper).

The fisheye along z acts on u = 1 + z and w = 1 − z (Figure 13): tan²(χ/2) = w/u, and tan(Ξ/2) = S tan(χ/2) says that u
becomes u/S, w becomes S w, and the part across the axis stays, all up to a common factor. This is the boost of
Minkowski space of rapidity −ln S along z, on light-cone coordinates; on a circle n·x = d the same factors act on
d + n_z and d − n_z.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from typing import overload

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import FloatArray, as_complex_matrix, as_directions, as_lonlat, as_scalar, as_shaped, as_vectors
from stereodel._double_double import DoubleDouble, dot, stack, unit
from stereodel._tasks.threads import thread_count
from stereodel.conformal.forms import from_lorentz, from_moebius, lorentz_matrix, stereographic_pipeline
from stereodel.conformal.group import Z_AXIS, Biquaternion, Kind, fixed_points_of, kind_of, multiplier_of, parts, power
from stereodel.constants import LARGEST_EXPONENT, LARGEST_MAGNIFICATION, STORED_ERROR
from stereodel.sphere import Rotation, SphereArc, SphereCircle
from stereodel.sphere.arcs import swept_angle
from stereodel.sphere.circles import light_cone, on_circle, one_plus_minus

_FLIP = Rotation(np.array([0.0, 1.0, 0.0, 0.0]))
"""Half a turn about x: it turns the fisheye of magnification 1/S along z into that of S, exactly."""

Circle = tuple[DoubleDouble, DoubleDouble, DoubleDouble]
"""Normal (3,), cos α and sin α, up to one positive factor."""


Answer = Callable[..., tuple[FloatArray, bool]]
Check = Callable[[FloatArray], FloatArray]

_directions: Check = partial(as_directions, name="xyz")


def boost_points(points: DoubleDouble, magnification: DoubleDouble) -> DoubleDouble:
    """Images of unit vectors (..., 3) under the fisheye of magnification S at +z."""
    x, y = points[..., 0], points[..., 1]
    u, w = one_plus_minus(points[..., 2], x * x + y * y)
    lower, upper = u / magnification, w * magnification
    total = lower + upper
    return stack([points[..., 0] * 2.0 / total, points[..., 1] * 2.0 / total, (lower - upper) / total])


@dataclass(frozen=True)
class MoebiusMap:
    """A conformal map of the sphere: rotation `right`, then the fisheye along +z, then rotation `left`.

    The parameters define the map exactly. Create maps with `identity`, `rotation`, `from_matrix`, `fisheye` or
    `bubble_to_bubble`, and combine them with `@` and `inverse`.

    Parameters
    ----------
    left : Rotation
    magnification : float
        S > 0, the scale at the focus: tan(Ξ/2) = S tan(χ/2) takes the angular distance χ from the focus to Ξ.
    right : Rotation

    Notes
    -----
    The computed image is within 4·2⁻⁵² of the exact image of a point within 4·2⁻⁵² rad of the given one, even near the
    focus and its antipode. This allows for parameters that were rounded once, as by `fisheye` and `@`: for the stored
    parameters an image is off by less than 13·2⁻⁵³ + scale·2⁻⁷³ and by less than (1 + scale)·6·2⁻⁵³ (derived in
    ``stereodel/kernel/conformal/moebius.cpp``). Circles and arcs are mapped in double-double and rounded once.

    Examples
    --------
    >>> from stereodel.conformal import fisheye
    >>> lens = fisheye((0.0, 40.0), magnification=4.0)
    >>> both = lens @ MoebiusMap.rotation((0.0, 90.0), 30.0)
    >>> (both @ both.inverse()).is_close(MoebiusMap.identity())
    True
    >>> round(float(lens.scale_factor(lens.focus)), 12)
    4.0
    """

    left: Rotation
    magnification: float
    right: Rotation

    def __post_init__(self) -> None:
        size = as_scalar(self.magnification, "magnification", low=0.0, open_low=True)
        if not 1 / LARGEST_MAGNIFICATION <= size <= LARGEST_MAGNIFICATION:
            limits = f"{1 / LARGEST_MAGNIFICATION:g} to {LARGEST_MAGNIFICATION:g}"
            raise ValueError(f"magnification is {size:g}, outside the range {limits} that can be evaluated")
        object.__setattr__(self, "magnification", size)

    @classmethod
    def identity(cls) -> MoebiusMap:
        """The identity map."""
        return cls(Rotation.identity(), 1.0, Rotation.identity())

    @classmethod
    def rotation(cls, axis: npt.ArrayLike | Rotation, angle: float = 0.0) -> MoebiusMap:
        """A `Rotation`, or the one by `angle` degrees counterclockwise about an axis: (lon, lat) or a direction."""
        turn = axis if isinstance(axis, Rotation) else Rotation.about(axis, angle)
        return cls(Rotation.identity(), 1.0, turn)

    @classmethod
    def from_matrix(cls, matrix: npt.ArrayLike) -> MoebiusMap:
        """The map of a 2×2 complex or a 4×4 real matrix, of magnification at most 1e6.

        Parameters
        ----------
        matrix : array_like, shape (2, 2) or (4, 4)
            [[a, b], [c, d]] with ad − bc ≠ 0: ζ ↦ (aζ + b)/(cζ + d) on ζ = (x + iy)/(1 − z), the stereographic
            projection from the north pole to the equatorial plane. Or a proper orthochronous Lorentz matrix M, rows and
            columns (x, y, z, t): (x', 1) is M (x, 1) up to a factor.

        Raises
        ------
        ValueError
            If the matrix has another shape, is singular, is outside the group by more than `MATRIX_ERROR`, is a
            reflection, or has a magnification above `MATRIX_MAGNIFICATION`.

        Examples
        --------
        >>> quarter = MoebiusMap.from_matrix([[1j, 0], [0, 1]])
        >>> print(quarter([1.0, 0.0, 0.0]).round(12))
        [0. 1. 0.]
        """
        if np.shape(matrix) == (2, 2):
            return cls(*from_moebius(as_complex_matrix(matrix, "matrix")))
        return cls(*from_lorentz(as_shaped(matrix, (4, 4), "matrix")))

    @property
    def focus(self) -> FloatArray:
        """The point of scale S, a unit vector (3,); the scale is largest there if S > 1."""
        return self.right.inverse()(Z_AXIS.hi)

    @property
    def peak(self) -> tuple[FloatArray, float]:
        """The point of largest scale, a unit vector, and that scale: the focus and S, or its antipode and 1/S."""
        focus, size = self.focus, self.magnification
        return (focus, size) if size >= 1 else (-focus + 0.0, 1 / size)

    @property
    def matrix(self) -> FloatArray:
        """The 4×4 Lorentz matrix, rounded once; for large S its doubles no longer determine the map."""
        return lorentz_matrix(self.left, self.magnification, self.right)

    def __call__(self, xyz: npt.ArrayLike, *, workers: int | None = None) -> FloatArray:
        """Images of directions as unit vectors.

        Parameters
        ----------
        xyz : array_like, shape (..., 3)
            Non-zero vectors of any length.
        workers : int, optional
            Number of threads, -1 for all processors; by default all for 20 000 points or more. Does not affect the
            result.

        Returns
        -------
        ndarray, shape (..., 3)
        """
        array = as_vectors(xyz, 3, "xyz", gaps=True, instead="for longitude and latitude call its method lonlat")
        return self._asked(_kernel.moebius_images, array, _directions, workers).reshape(array.shape)

    def lonlat(self, lonlat: npt.ArrayLike, *, workers: int | None = None) -> FloatArray:
        """Images of points given by longitude and latitude, in one step.

        Parameters
        ----------
        lonlat : array_like, shape (..., 2)
            (lon, lat) in degrees on the sphere.
        workers : int, optional
            As in a call.

        Returns
        -------
        ndarray, shape (..., 2)
            Longitude in [−180, 180), latitude in [−90, 90]. Off by less than (1 + scale)·18·2⁻⁵³ rad: a few ulps more
            than the call between `lonlat_to_xyz` and `xyz_to_lonlat`, in a tenth of the time.

        Examples
        --------
        >>> from stereodel.conformal import fisheye
        >>> print(fisheye((0.0, 40.0), magnification=4.0).lonlat([(0.0, 40.0), (0.0, 50.0)]).round(6))
        [[ 0.       40.      ]
         [ 0.       78.575463]]
        """
        array = as_vectors(lonlat, 2, "lonlat", gaps=True)
        return self._asked(_kernel.moebius_lonlat, array, as_lonlat, workers).reshape(array.shape)

    @property
    def _size(self) -> DoubleDouble:
        return DoubleDouble(self.magnification)

    def scale_factor(self, xyz: npt.ArrayLike, *, workers: int | None = None) -> FloatArray:
        """Local scale at directions (..., 3), the same in all directions: S / (cos²(χ/2) + S² sin²(χ/2)).

        Off by less than 2⁻⁴⁸ of itself for a point within 2⁻⁷³ rad of the given one. `workers` as in a call.
        """
        array = as_vectors(xyz, 3, "xyz", gaps=True)
        return self._asked(_kernel.moebius_scales, array, _directions, workers).reshape(array.shape[:-1])

    def _asked(self, function: Answer, array: FloatArray, check: Check, workers: int | None) -> FloatArray:
        """What the kernel says of rows; it finds invalid ones without a separate pass, and `check` raises."""
        left, right = self._six_rows
        rows = array.reshape(-1, array.shape[-1])
        found, sound = function(rows, left, self.magnification, right, thread_count(workers, len(rows)))
        if not sound:
            check(array)
        return found

    @cached_property
    def _six_rows(self) -> tuple[FloatArray, FloatArray]:
        """The matrices of `left` and `right`, each as doubles followed by their rounding errors."""
        left, right = (np.concatenate([part.exact_matrix.hi, part.exact_matrix.lo]) for part in (self.left, self.right))
        return left, right

    @overload
    def image_of(self, curve: SphereCircle) -> SphereCircle: ...
    @overload
    def image_of(self, curve: SphereArc) -> SphereArc: ...
    def image_of(self, curve: SphereCircle | SphereArc) -> SphereCircle | SphereArc:
        """The exact image of a circle, interior to interior, or of an arc, start to start; nothing is sampled."""
        if isinstance(curve, SphereCircle):
            return SphereCircle.rounded(*self._circle_image(curve))
        normal, offset, radius = self._circle_image(curve.circle)
        circle = SphereCircle.rounded(normal, offset, radius)
        # The endpoints are moved onto the circle first, as their distance from it would be magnified, too.
        ends = (self.right.apply(on_circle(curve.circle, unit(point))) for point in (curve.start, curve.end))
        start, end = (self.left.apply(boost_points(point, self._size)) for point in ends)
        angle = curve.angle_rad if curve.closed else swept_angle(normal / dot(normal, normal).sqrt(), start, end)
        return SphereArc(circle, start.round() + 0.0, end.round() + 0.0, angle)

    def _circle_image(self, circle: SphereCircle) -> Circle:
        normal, cosine, sine = circle.exact_parts()
        normal = self.right.apply(normal)
        plus, minus = light_cone(normal, cosine, sine)
        plus, minus = plus / self._size, minus * self._size
        normal = stack([normal[0], normal[1], (plus + minus) * 0.5])
        return self.left.apply(normal), (plus - minus) * 0.5, sine  # sin α is invariant before normalisation

    def __matmul__(self, other: MoebiusMap) -> MoebiusMap:
        """The map `other`, then this one: the exact composition with its parameters rounded once.

        Magnifications may have any size; ValueError if that of the composition is out of range.
        """
        if not isinstance(other, MoebiusMap):
            return NotImplemented
        return MoebiusMap(*parts(_kernel.moebius_product(self._numbers, other._numbers)))

    def inverse(self) -> MoebiusMap:
        """The exact inverse; its focus is the image of this map's point of smallest scale."""
        return MoebiusMap(self.right.inverse() @ _FLIP, self.magnification, _FLIP @ self.left.inverse())

    @property
    def biquaternion(self) -> Biquaternion:
        """The map as an element of SL(2, C) in double-double."""
        return Biquaternion.of(self._numbers)

    @property
    def _numbers(self) -> FloatArray:
        """All that the kernel composes: left quaternion, magnification, right quaternion."""
        return np.concatenate([self.left.quaternion, [self.magnification], self.right.quaternion])

    def power(self, exponent: float) -> MoebiusMap:
        """The map applied t times, for any real t: a one-parameter group through the map.

        Parameters
        ----------
        exponent : float
            t, with absolute value at most `LARGEST_EXPONENT`; −1 gives the inverse, ½ the map whose square is this one.

        Returns
        -------
        MoebiusMap
            Fixed points stay fixed. At the first of them the map magnifies |k|ᵗ times and rotates by t arg k, where k
            is the `multiplier` and arg k is in (−180°, 180°]. Powers are unique except for maps that rotate by 180°,
            which go counterclockwise about the end of the axis whose last non-zero coordinate is positive. They are
            discontinuous where arg k passes 180°.

        Raises
        ------
        ValueError
            If the exponent is out of range, or the magnification of the power cannot be evaluated.

        Examples
        --------
        >>> from stereodel.conformal import fisheye
        >>> lens = fisheye((0.0, 40.0), magnification=9.0)
        >>> lens.power(0.5).is_close(fisheye((0.0, 40.0), magnification=3.0))
        True
        """
        t = as_scalar(exponent, "exponent", low=-LARGEST_EXPONENT, high=LARGEST_EXPONENT)
        return MoebiusMap(*power(self.biquaternion, t).decomposed())

    @property
    def kind(self) -> Kind:
        """One of "identity", "rotation", "boost", "parabolic" and "loxodromic", up to `KIND_TOLERANCE`.

        A rotation (elliptic) turns about two fixed points, which need not be antipodal; a boost (hyperbolic) moves
        everything from one to the other; a loxodromic map does both; a parabolic one has a single fixed point. The
        fisheye is a boost.
        """
        return kind_of(self.biquaternion)

    @property
    def fixed_points(self) -> FloatArray:
        """The fixed points, unit vectors (2, 3), or (1, 3) for a parabolic map; ValueError for the identity.

        The map magnifies at the first and shrinks at the second; a rotation is counterclockwise at the first, by at
        most 180°, as seen from outside.
        """
        return fixed_points_of(self.biquaternion)

    @property
    def multiplier(self) -> complex:
        """k: at the first fixed point the map magnifies |k| ≥ 1 times and rotates by arg k counterclockwise.

        At the second it does the inverse. k is 1 for the identity and for parabolic maps.
        """
        return multiplier_of(self.biquaternion)

    def is_close(self, other: MoebiusMap, *, tolerance: float = 4 * STORED_ERROR) -> bool:
        """Whether two maps agree up to `tolerance`: in rad for points and images, relative for S."""
        a, b = self.biquaternion, other.biquaternion
        gaps = [
            Biquaternion(a.real - b.real, a.imag - b.imag).norm(),
            Biquaternion(a.real + b.real, a.imag + b.imag).norm(),
        ]
        return min(float(gap.hi) for gap in gaps) <= tolerance**2 * float(a.norm().hi)

    def to_proj(self) -> str:
        """The map as a PROJ pipeline, for GDAL, QGIS and pyproj: (lon, lat) in degrees in and out, on a sphere.

        `stere` with k_0 = S at the focus, then inverse `stere` at the image of the focus (claim P18); between the two a
        rotation of the plane, `affine`, if the map does not take north at the focus to north at its image. PROJ gives
        no result for the antipode of the focus itself.

        Examples
        --------
        >>> from stereodel.conformal import fisheye
        >>> "+proj=stere +lat_0=40 +lon_0=0 +k_0=4 +R=1" in fisheye((0.0, 40.0), magnification=4.0).to_proj()
        True
        """
        return stereographic_pipeline(self.left, self.magnification, self.right)
