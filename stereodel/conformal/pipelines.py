"""Conformal maps as pipelines of the PROJ library."""

from __future__ import annotations

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.constants import STORED_ERROR
from stereodel.sphere import Rotation, xyz_to_lonlat
from stereodel.sphere.frames import tangent_frame

_Z = np.array([0.0, 0.0, 1.0])


def stereographic_pipeline(left: Rotation, magnification: float, right: Rotation) -> str:
    """`stere` with k_0 = S at the focus, a turn of the plane, inverse `stere` at the image of the focus."""
    start, end = xyz_to_lonlat(right.inverse()(_Z)), xyz_to_lonlat(left(_Z))
    turn = left.exact_matrix.hi @ right.exact_matrix.hi
    # Images of east and north at the focus, in terms of east and north at its image.
    plane = tangent_frame(end).hi[:2] @ turn @ tangent_frame(start).hi[:2].T
    steps = [
        "+proj=pipeline",
        "+step +proj=unitconvert +xy_in=deg +xy_out=rad",
        f"+step +proj=stere {_place(start)} +k_0={_number(magnification)} +R=1",
        *_turned(plane),
        f"+step +inv +proj=stere {_place(end)} +k_0=1 +R=1",
        "+step +proj=unitconvert +xy_in=rad +xy_out=deg",
    ]
    return " ".join(steps)


def _turned(plane: FloatArray) -> list[str]:
    """The step of a rotation matrix (2, 2); none for the identity."""
    # Equal frames may differ by two rounded rotations and two rounded centres, each within 2⁻⁵².
    if np.abs(plane - np.eye(2)).max() <= 4 * STORED_ERROR:
        return []
    entries = " ".join(f"+s{i + 1}{j + 1}={_number(plane[i, j])}" for i in (0, 1) for j in (0, 1))
    return [f"+step +proj=affine {entries}"]


def _place(lonlat: FloatArray) -> str:
    return f"+lat_0={_number(lonlat[1])} +lon_0={_number(lonlat[0])}"


def _number(value: float) -> str:
    """Shortest decimal that reads back as the same double."""
    return repr(float(value)).removesuffix(".0")
