"""Conformal maps of the sphere: the Möbius group, the fisheye, maps between bubbles, paths between maps."""

from stereodel.conformal.maps import bubble_to_bubble, fisheye, three_points
from stereodel.conformal.moebius import MoebiusMap
from stereodel.conformal.paths import GroupPath, flight

__all__ = [
    "GroupPath",
    "MoebiusMap",
    "bubble_to_bubble",
    "fisheye",
    "flight",
    "three_points",
]
