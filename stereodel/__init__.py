"""Exact Delaunay triangulations and Voronoi diagrams of the plane and the sphere, conformal maps of the sphere."""

from stereodel.projections import (
    Conic,
    Gnomonic,
    Orthographic,
    PlaneCircle,
    PlaneLine,
    RectangleLift,
    Stereographic,
)
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

__version__ = "0.1.0"

__all__ = [
    "Conic",
    "Gnomonic",
    "Orthographic",
    "PlaneCircle",
    "PlaneLine",
    "RectangleLift",
    "Rotation",
    "SphereArc",
    "SphereCircle",
    "Stereographic",
    "angular_distance",
    "great_circle_points",
    "lonlat_to_xyz",
    "solid_angle",
    "xyz_to_lonlat",
]
