"""The fisheye globe (section on fisheye maps; Figures 10 to 13 of the paper)."""

from __future__ import annotations

import numpy.typing as npt

from stereodel._docs import by_name
from stereodel.conformal.moebius import MoebiusMap
from stereodel.sphere import Rotation, as_direction


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
