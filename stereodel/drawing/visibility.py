"""What a ball hides: curves cut analytically where they pass in front of it, through it, beside it and behind it.

Everything here is in view axes (right, up, toward the viewer) about the ball's centre. With ρ the distance of a point x
from the line of sight through the centre, the ball of radius r covers x when ρ < r and x lies deeper than the near
surface. The places can change only where |x| = r or ρ = r: for a segment two quadratic equations, for a circle one
equation linear in cos t, sin t and one quartic; for a circle *on* the sphere, where |x| = r says nothing, depth = 0.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from itertools import pairwise
from typing import TypeVar

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.constants import LIMB_DEPTH, ON_BALL
from stereodel.drawing.space_curves import CircleArc, Curve

K = TypeVar("K")

TOWARD = np.array([0.0, 0.0, 1.0])
ALL_AXES = np.array([1.0, 1.0, 1.0])
PAGE_AXES = np.array([1.0, 1.0, 0.0])


class Place(Enum):
    """Where a point is, seen by the viewer, with respect to a ball."""

    FRONT = "in front of the ball, or on its near side"
    OUTSIDE = "beside the ball: neither covers the other"
    INSIDE = "inside the ball"
    BEHIND = "covered by the ball, or on its far side"


def lies_on_ball(curve: Curve, radius: float) -> bool:
    """Whether a curve is an arc of a circle on the sphere.

    |x|² is linear in cos t and sin t along a circle, so three of its points decide for all.
    """
    if not isinstance(curve, CircleArc):
        return False
    lengths = np.sqrt(np.sum(curve.sample([0.0, 2.0, 4.0]) ** 2, axis=-1))
    return bool(np.all(np.abs(lengths - radius) <= ON_BALL * radius))


def place_of(point: FloatArray, radius: float) -> Place:
    """Place of one point (3,); on the sphere itself the limb counts as front."""
    distance, beside = float(np.sqrt(np.sum(point**2))), float(np.hypot(point[0], point[1]))
    if abs(distance - radius) <= ON_BALL * radius:
        return Place.FRONT if point[2] >= -LIMB_DEPTH * radius else Place.BEHIND
    if distance < radius:
        return Place.INSIDE
    if beside >= (1 - ON_BALL) * radius:
        return Place.OUTSIDE
    return Place.FRONT if point[2] > 0 else Place.BEHIND


def split_on_ball(curve: Curve, radius: float) -> list[tuple[Curve, Place]]:
    """An arc on the sphere, cut at the limb; an arc along the limb counts as front."""
    limb = -LIMB_DEPTH * radius

    def place(point: FloatArray) -> Place:
        return Place.FRONT if point[2] >= limb else Place.BEHIND

    return cut(curve, curve.level_parameters(TOWARD, limb), place)


def split_by_ball(curve: Curve, radius: float) -> list[tuple[Curve, Place]]:
    """A curve cut into pieces of one `Place` each, in order; a closed curve that needs no cut stays closed.

    Examples
    --------
    >>> from stereodel.drawing.space_curves import Segment
    >>> ray = Segment.between([0, 0, 2], [0, 0, -3])
    >>> [(piece.start, piece.stop, place.name) for piece, place in split_by_ball(ray, 1.0)]
    [(0.0, 0.2, 'FRONT'), (0.2, 0.6, 'INSIDE'), (0.6, 1.0, 'BEHIND')]
    """
    if lies_on_ball(curve, radius):
        return split_on_ball(curve, radius)
    surface = curve.quadric_parameters(ALL_AXES, radius**2)
    outline = curve.quadric_parameters(PAGE_AXES, radius**2)
    pieces = cut(curve, np.union1d(surface, outline), lambda point: place_of(point, radius))
    if any(place is Place.FRONT for _, place in pieces):
        return _joined_at_limb(pieces)
    return pieces


def _joined_at_limb(pieces: list[tuple[Curve, Place]]) -> list[tuple[Curve, Place]]:
    """Pieces beside the ball joined to a neighbour in front of it: no seam shows where a line crosses the limb."""
    joined: list[tuple[Curve, Place]] = []
    for curve, place in pieces:
        if joined and {place, joined[-1][1]} == {Place.FRONT, Place.OUTSIDE}:
            before, _ = joined.pop()
            curve, place = before.part(before.start, curve.stop), Place.FRONT
        joined.append((curve, place))
    return joined


def cut(curve: Curve, parameters: FloatArray, kind: Callable[[FloatArray], K]) -> list[tuple[Curve, K]]:
    """The curve cut at parameters, each piece with the kind of its middle; neighbours of one kind stay together."""
    bounds = np.array([curve.start, *parameters, curve.stop])
    kinds = [kind(point) for point in curve.sample((bounds[:-1] + bounds[1:]) / 2)]
    changes = [i for i in range(1, len(kinds)) if kinds[i] != kinds[i - 1]]
    if not changes:
        return [(curve, kinds[0])]
    edges = [0, *changes, len(kinds)]
    pieces = [(curve.part(float(bounds[i]), float(bounds[j])), kinds[i]) for i, j in pairwise(edges)]
    if curve.closed and kinds[0] == kinds[-1]:
        first, _ = pieces.pop(0)
        last, same = pieces.pop()
        pieces.append((last.part(last.start, first.stop + 2 * np.pi), same))
    return pieces
