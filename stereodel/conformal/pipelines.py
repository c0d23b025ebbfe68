"""Conformal maps as pipelines of the PROJ library."""

from __future__ import annotations

import numpy as np

from stereodel.constants import STORED_ERROR
from stereodel.sphere import Rotation, xyz_to_lonlat
from stereodel.sphere.frames import tangent_frame

_Z = np.array([0.0, 0.0, 1.0])


def stereographic_pipeline(left: Rotation, magnification: float, right: Rotation) -> str:
    """`stere` with k_0 at the focus, then inverse `stere` at its image; ValueError where the map is not that."""
    start, end = xyz_to_lonlat(right.inverse()(_Z)), xyz_to_lonlat(left(_Z))
    turn = left.exact_matrix.hi @ right.exact_matrix.hi
    carried = turn @ tangent_frame(start).hi.T
    # Two rounded rotations and two rounded centres, each within 2⁻⁵², stand between equal frames.
    if np.abs(carried - tangent_frame(end).hi.T).max() > 4 * STORED_ERROR:
        raise ValueError(
            "this map is no stereographic pipeline: it does not carry east and north at its focus to east and north "
            "at the image of the focus; compose a fisheye with the rotation outside PROJ"
        )
    return " ".join(
        [
            "+proj=pipeline +step +proj=unitconvert +xy_in=deg +xy_out=rad",
            f"+step +proj=stere {_place(start)} +k_0={_number(magnification)} +R=1",
            f"+step +inv +proj=stere {_place(end)} +k_0=1 +R=1",
            "+step +proj=unitconvert +xy_in=rad +xy_out=deg",
        ]
    )


def _place(lonlat: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> str:
    return f"+lat_0={_number(lonlat[1])} +lon_0={_number(lonlat[0])}"


def _number(value: float) -> str:
    """Shortest decimal that reads back as the same double."""
    return repr(float(value)).removesuffix(".0")
