"""Visibility: curves and regions cut analytically into parts in front of a ball, inside it, beside it, behind it.

All coordinates are in view axes (right, up, toward the viewer) about the ball's centre. The ball of radius r covers x
if its distance ρ from the line of sight through the centre is below r and x is behind the near surface, so a place can
change only where |x| = r or ρ = r. Arcs on the sphere are cut at the limb together by `stereodel.curves`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import pairwise
from typing import Final, NamedTuple, TypeGuard, TypeVar

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.constants import LIMB_DEPTH, ON_BALL
from stereodel.curves.borders import Cap
from stereodel.curves.clip import chains_of, followers
from stereodel.curves.ragged import Ragged, cycles
from stereodel.curves.trace import Arcs
from stereodel.curves.view import View
from stereodel.drawing.scene.space_curves import CircleArc, Curve

K = TypeVar("K")

TOWARD = np.array([0.0, 0.0, 1.0])
ALL_AXES = np.array([1.0, 1.0, 1.0])
PAGE_AXES = np.array([1.0, 1.0, 0.0])

LIMB: Final = Cap(View(0.0, 0.0), ON_BALL)
"""The edge of the near side of the unit sphere, for `stereodel.curves`; in view axes it is the same for every view."""


class Place(Enum):
    """Position of a point relative to a ball, as seen by the viewer."""

    FRONT = "in front of the ball, or on its near side"
    OUTSIDE = "beside the ball: neither covers the other"
    INSIDE = "inside the ball"
    BEHIND = "covered by the ball, or on its far side"


def lies_on_ball(curve: Curve, radius: float) -> TypeGuard[CircleArc]:
    """Whether a curve is an arc of a circle on the sphere."""
    if not isinstance(curve, CircleArc):
        return False
    # |x|² is linear in cos t and sin t along a circle: three of its points decide for all.
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


class _Run(NamedTuple):
    """Consecutive arcs of a line on a sphere, all visible or all hidden."""

    arcs: list[CircleArc]
    seen: bool
    whole: bool  # closed and not cut
    row: int  # number of the line


def cut_at_limb(curves: Sequence[CircleArc], lines: Ragged, radius: float) -> list[_Run]:
    """Lines on a sphere about the origin, each by the numbers of its curves, cut at the limb, which is visible."""
    if not curves:
        return []
    pieces = LIMB.cut(_joined(_as_arcs(curves, radius), lines))
    edge, begin, stop = (values.tolist() for values in (pieces.arcs.edge, pieces.arcs.begin, pieces.arcs.stop))
    chains = chains_of(lines, pieces)
    runs = []
    for numbers, row, seen, whole in zip(chains.pieces, chains.row, chains.seen, chains.whole, strict=True):
        arcs: list[CircleArc] = []
        before = -1
        for number in numbers.tolist():
            if edge[number] == before:
                # On a circle that was cut, the pieces before and after its first point are one arc.
                arcs[-1] = arcs[-1].part(arcs[-1].start, stop[number] + 2 * np.pi)
            elif stop[number] > begin[number]:
                arcs.append(curves[edge[number]].part(begin[number], stop[number]))
                before = edge[number]
        if arcs:
            runs.append(_Run(arcs, bool(seen), bool(whole), int(row)))
    return runs


def _as_arcs(curves: Sequence[CircleArc], radius: float) -> Arcs:
    """Arcs in the form of `stereodel.curves`, on the unit sphere."""
    center, u, v = (
        np.array([getattr(curve, name) for curve in curves]).reshape(-1, 3) / radius for name in ("center", "u", "v")
    )
    begin, stop = (np.array([getattr(curve, name) for curve in curves], dtype=np.float64) for name in ("start", "stop"))
    axis = np.cross(u, v)
    # A circle of radius zero has no axis of its own.
    axis = np.where(axis.any(axis=1, keepdims=True), axis, center)
    axis /= np.sqrt(np.sum(axis**2, axis=1, keepdims=True))
    start, end = (center + np.cos(t)[:, None] * u + np.sin(t)[:, None] * v for t in (begin, stop))
    return Arcs(start, end, axis, np.sum(center * axis, axis=1), u, begin, stop, np.arange(len(begin)))


def _joined(arcs: Arcs, lines: Ragged) -> Arcs:
    """The arcs with each end set to the next start if they differ only by rounding: a corner has a single side."""
    after = lines.values[lines.following]
    meets = np.sqrt(np.sum((arcs.end[lines.values] - arcs.start[after]) ** 2, axis=1)) <= ON_BALL
    arcs.end[lines.values[meets]] = arcs.start[after[meets]]
    return arcs


def split_by_ball(curves: Sequence[Curve], radius: float) -> list[list[tuple[Curve, Place]]]:
    """Curves cut into pieces of one `Place` each, in order; a closed curve that needs no cut stays closed.

    >>> from stereodel.drawing.scene.space_curves import Segment
    >>> [pieces] = split_by_ball([Segment.between([0, 0, 2], [0, 0, -3])], 1.0)
    >>> [(piece.start, piece.stop, place.name) for piece, place in pieces]
    [(0.0, 0.2, 'FRONT'), (0.2, 0.6, 'INSIDE'), (0.6, 1.0, 'BEHIND')]
    """
    on_ball = {number: curve for number, curve in enumerate(curves) if lies_on_ball(curve, radius)}
    split: list[list[tuple[Curve, Place]]] = [
        [] if number in on_ball else _split_in_space(curve, radius) for number, curve in enumerate(curves)
    ]
    each, numbers = np.arange(len(on_ball) + 1), list(on_ball)
    for run in cut_at_limb(list(on_ball.values()), Ragged(each[:-1], each), radius):
        split[numbers[run.row]] += [(arc, Place.FRONT if run.seen else Place.BEHIND) for arc in run.arcs]
    return split


def _split_in_space(curve: Curve, radius: float) -> list[tuple[Curve, Place]]:
    """A curve in pieces; those beside the ball are joined to one in front of it: no seam where it crosses the limb."""
    # A place changes where the curve goes through the surface, x² + y² + z² = r², and where it passes through the
    # cylinder of all that the limb covers or is covered by, x² + y² = r². The midpoint of each piece determines its
    # place.
    surface = curve.quadric_parameters(ALL_AXES, radius**2)
    outline = curve.quadric_parameters(PAGE_AXES, radius**2)
    joined: list[tuple[Curve, Place]] = []
    for piece, place in cut(curve, np.union1d(surface, outline), lambda point: place_of(point, radius)):
        if joined and {place, joined[-1][1]} == {Place.FRONT, Place.OUTSIDE}:
            before, _ = joined.pop()
            piece, place = before.part(before.start, piece.stop), Place.FRONT
        joined.append((piece, place))
    return joined


def cut(curve: Curve, parameters: FloatArray, kind: Callable[[FloatArray], K]) -> list[tuple[Curve, K]]:
    """The curve cut at parameters, each piece with the kind of its midpoint; adjacent pieces of one kind are joined."""
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


Loop = list[CircleArc]


@dataclass(frozen=True, eq=False)
class SphereRegion:
    """The part of a sphere about the origin on the left of a simple loop of arcs, each starting where the last ends."""

    boundary: tuple[CircleArc, ...]
    radius: float

    def __post_init__(self) -> None:
        for number, arc in enumerate(self.boundary):
            after = (number + 1) % len(self.boundary)
            gap = self.boundary[after].sample(self.boundary[after].start) - arc.sample(arc.stop)
            if np.sqrt(np.sum(gap**2)) > ON_BALL * self.radius:
                raise ValueError(
                    f"boundary[{number}] does not end where boundary[{after}] begins; give the arcs of a closed loop"
                )

    def turned(self, matrix: FloatArray) -> SphereRegion:
        """The region in other axes."""
        return SphereRegion(tuple(arc.moved(matrix, np.zeros(3)) for arc in self.boundary), self.radius)

    def far_side(self) -> SphereRegion:
        """The mirror image in the page plane, whose near side shows the far side of this region."""
        mirror = np.array([1.0, 1.0, -1.0])
        arcs = (
            CircleArc(mirror * arc.center, mirror * arc.u, -mirror * arc.v, -arc.stop, -arc.start)
            for arc in reversed(self.boundary)
        )
        return SphereRegion(tuple(arcs), self.radius)

    def visible_outline(self) -> list[Loop]:
        """Closed loops of arcs around the part on the near side, which is on their left; none if it is hidden."""
        ring = np.arange(len(self.boundary))
        runs = cut_at_limb(self.boundary, Ragged(ring, np.array([0, len(ring)])), self.radius)
        if runs[0].whole:
            # A ring on the near side has its region inside if it is counterclockwise on the page; one on the far side
            # appears mirrored: if counterclockwise, the region contains the whole near side, and so the limb.
            seen = runs[0].seen
            around = (page_area(runs[0].arcs) > 0) != seen
            loops = [runs[0].arcs] * seen + [[limb(self.radius)]] * around
        else:
            loops = _closed_along_limb([run.arcs for run in runs if run.seen], self.radius)
        # A part no wider than rounding errors is dropped: a boundary on the limb with the far side on its left.
        length = sum((arc.stop - arc.start) * np.sqrt(np.sum(arc.u**2)) for loop in loops for arc in loop)
        return loops if sum(map(page_area, loops)) > ON_BALL * self.radius * length else []


def _closed_along_limb(runs: list[Loop], radius: float) -> list[Loop]:
    """Runs from limb to limb, joined by parts of the limb, which has the near side on its left."""
    starts = LIMB.place(np.array([run[0].sample(run[0].start)[:2] for run in runs]))
    ends = LIMB.place(np.array([run[-1].sample(run[-1].stop)[:2] for run in runs]))
    follower, stop = followers(starts, ends, LIMB.length, np.zeros(len(runs), dtype=np.intp))
    along = [limb(radius).part(float(a), float(b)) for a, b in zip(ends, stop, strict=True)]
    return [
        [arc for number in loop for arc in (*runs[number], along[number]) if arc.stop > arc.start]
        for loop in cycles(follower)
    ]


def page_area(loop: Sequence[CircleArc]) -> float:
    """Area that connected arcs enclose on the page, positive counterclockwise."""
    # Half the integral of p × dp: along center + q, q = cos t·u + sin t·v, center × (q₁ − q₀) and u × v (t₁ − t₀).
    area = 0.0
    for arc in loop:
        x, y = arc.sample(arc.stop)[:2] - arc.sample(arc.start)[:2]
        area += (arc.center[0] * y - arc.center[1] * x) / 2
        area += (arc.u[0] * arc.v[1] - arc.u[1] * arc.v[0]) * (arc.stop - arc.start) / 2
    return float(area)


def limb(radius: float) -> CircleArc:
    """The outline of the ball, counterclockwise on the page."""
    return CircleArc(np.zeros(3), np.array([radius, 0.0, 0.0]), np.array([0.0, radius, 0.0]))
