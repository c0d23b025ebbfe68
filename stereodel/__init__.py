"""Exact Delaunay triangulations and Voronoi diagrams of the plane and the sphere, conformal maps of the sphere.

What is named here needs NumPy and nothing else; the other modules, such as ``stereodel.io``, are loaded when they are
used.
"""

from importlib import import_module
from pkgutil import iter_modules
from typing import Any

from stereodel.conformal import MoebiusMap, bubble_to_bubble, fisheye
from stereodel.predicates import in_bubble, incircle, orient2d, orient3d
from stereodel.projections import Conic, Gnomonic, Orthographic, PlaneCircle, PlaneLine, RectangleLift, Stereographic
from stereodel.sphere import (
    Rotation,
    SphereArc,
    SphereCircle,
    angular_distance,
    great_circle_points,
    lonlat_to_xyz,
    solid_angle,
    xyz_to_lonlat,
)
from stereodel.triangulation import (
    HullInsertion,
    PlanarDelaunay,
    PlanarVoronoi,
    SphericalDelaunay,
    SphericalVoronoi,
    check_delaunay,
)

__version__ = "0.1.0"

__all__ = [
    "Conic",
    "Gnomonic",
    "HullInsertion",
    "MoebiusMap",
    "Orthographic",
    "PlanarDelaunay",
    "PlanarVoronoi",
    "PlaneCircle",
    "PlaneLine",
    "RectangleLift",
    "Rotation",
    "SphereArc",
    "SphereCircle",
    "SphericalDelaunay",
    "SphericalVoronoi",
    "Stereographic",
    "angular_distance",
    "bubble_to_bubble",
    "check_delaunay",
    "fisheye",
    "great_circle_points",
    "in_bubble",
    "incircle",
    "lonlat_to_xyz",
    "orient2d",
    "orient3d",
    "solid_angle",
    "xyz_to_lonlat",
]

_MODULES = frozenset(module.name for module in iter_modules(__path__) if not module.name.startswith("_"))


def __getattr__(name: str) -> Any:
    """A module of the package that was not imported yet."""
    if name in _MODULES:
        return import_module(f"{__name__}.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*__all__, *_MODULES, "__version__", "__doc__", "__file__", "__path__"})
