"""Geometry on the unit sphere: coordinates, rotations, circles, arcs, areas."""

from stereodel.sphere.arcs import SphereArc, graticule, graticule_patch, meridian, parallel
from stereodel.sphere.circles import SphereCircle
from stereodel.sphere.coordinates import as_direction, lonlat_to_xyz, xyz_to_lonlat
from stereodel.sphere.measures import angular_distance, great_circle_points, solid_angle
from stereodel.sphere.rotations import Rotation

__all__ = [
    "Rotation",
    "SphereArc",
    "SphereCircle",
    "angular_distance",
    "as_direction",
    "graticule",
    "graticule_patch",
    "great_circle_points",
    "lonlat_to_xyz",
    "meridian",
    "parallel",
    "solid_angle",
    "xyz_to_lonlat",
]
