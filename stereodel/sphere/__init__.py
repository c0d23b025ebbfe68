"""Geometry on the unit sphere: coordinates, rotations, circles, arcs, areas."""

from stereodel.sphere.arcs import (
    SphereArc,
    angular_distance,
    graticule,
    graticule_patch,
    great_circle_points,
    meridian,
    parallel,
    solid_angle,
)
from stereodel.sphere.circles import SphereCircle
from stereodel.sphere.coordinates import lonlat_to_xyz, xyz_to_lonlat
from stereodel.sphere.rotations import Rotation

__all__ = [
    "Rotation",
    "SphereArc",
    "SphereCircle",
    "angular_distance",
    "graticule",
    "graticule_patch",
    "great_circle_points",
    "lonlat_to_xyz",
    "meridian",
    "parallel",
    "solid_angle",
    "xyz_to_lonlat",
]
