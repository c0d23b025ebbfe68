"""Values between scattered points of the plane and the sphere: interpolation, gradients, contours."""

from stereodel.interpolation.contours import Contour, contours
from stereodel.interpolation.gradients import estimate_gradients
from stereodel.interpolation.methods import (
    CloughTocher2DInterpolator,
    LinearNDInterpolator,
    NearestNDInterpolator,
    griddata,
)
from stereodel.interpolation.smooth import SmoothInterpolator
from stereodel.interpolation.weighted import LinearInterpolator, NaturalNeighborInterpolator, NearestInterpolator
from stereodel.interpolation.weights import Weights

__all__ = [
    "CloughTocher2DInterpolator",
    "Contour",
    "LinearInterpolator",
    "LinearNDInterpolator",
    "NaturalNeighborInterpolator",
    "NearestInterpolator",
    "NearestNDInterpolator",
    "SmoothInterpolator",
    "Weights",
    "contours",
    "estimate_gradients",
    "griddata",
]
