"""Regions of a sphere bounded by arcs, and the outlines of their visible parts, closed along the limb.

All coordinates are in view axes about the ball's centre.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.constants import ON_BALL
from stereodel.curves.clip import followers
from stereodel.curves.ragged import Ragged, cycles
from stereodel.drawing.space_curves import CircleArc
from stereodel.drawing.visibility import LIMB, cut_at_limb

Loop = list[CircleArc]


@dataclass(frozen=True, eq=False)
class SphereRegion:
    """The part of a sphere about the origin on the left of a loop of arcs; ValueError if the loop has a gap.

    boundary: a simple loop on the sphere, each arc starting at the end of the one before it, counterclockwise around
        the region as seen from outside. It may have any size and shape.
    """

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
            loops = self._with_limb(runs[0].arcs, seen=runs[0].seen)
        else:
            loops = _closed_along_limb([run.arcs for run in runs if run.seen], self.radius)
        # A part no wider than rounding errors is dropped: a boundary on the limb with the far side on its left.
        length = sum((arc.stop - arc.start) * np.sqrt(np.sum(arc.u**2)) for loop in loops for arc in loop)
        return loops if sum(map(page_area, loops)) > ON_BALL * self.radius * length else []

    def _with_limb(self, ring: Loop, *, seen: bool) -> list[Loop]:
        """A ring that does not cross the limb, with the limb itself if the region contains it.

        The region is inside a ring on the near side if the ring is counterclockwise on the page, and outside if it is
        clockwise. A ring on the far side appears mirrored: if counterclockwise, the region is outside it and contains
        the whole near side.
        """
        shown = [ring] if seen else []
        return [*shown, [limb(self.radius)]] if (page_area(ring) > 0) != seen else shown


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
    """Area that connected arcs enclose on the page, positive counterclockwise.

    It is half the integral of p × dp; along center + q with q = cos t·u + sin t·v that is center × (q₁ − q₀), and
    u × v (t₁ − t₀), since q × dq = u × v dt.
    """
    area = 0.0
    for arc in loop:
        x, y = arc.sample(arc.stop)[:2] - arc.sample(arc.start)[:2]
        area += (arc.center[0] * y - arc.center[1] * x) / 2
        area += (arc.u[0] * arc.v[1] - arc.u[1] * arc.v[0]) * (arc.stop - arc.start) / 2
    return float(area)


def limb(radius: float) -> CircleArc:
    """The outline of the ball, counterclockwise on the page."""
    return CircleArc(np.zeros(3), np.array([radius, 0.0, 0.0]), np.array([0.0, radius, 0.0]))
