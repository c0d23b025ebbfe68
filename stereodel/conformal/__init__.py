"""Conformal maps of the sphere: the Möbius group, the fisheye, maps between bubbles, paths between maps."""

from stereodel.conformal.bubbles import bubble_to_bubble
from stereodel.conformal.distortions import Distortion, distortion
from stereodel.conformal.fisheyes import fisheye
from stereodel.conformal.moebius import MoebiusMap
from stereodel.conformal.paths import GroupPath, flight, path_between
from stereodel.conformal.triples import three_points

__all__ = [
    "Distortion",
    "GroupPath",
    "MoebiusMap",
    "bubble_to_bubble",
    "distortion",
    "fisheye",
    "flight",
    "path_between",
    "three_points",
]
