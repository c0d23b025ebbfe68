"""Conformal maps of the sphere: the Möbius group, the fisheye, bubbles to bubbles."""

from stereodel.conformal.bubbles import bubble_to_bubble
from stereodel.conformal.fisheyes import fisheye
from stereodel.conformal.moebius import MoebiusMap

__all__ = ["MoebiusMap", "bubble_to_bubble", "fisheye"]
