"""Charts: the sphere through a lens and a view, on a disc of a page.

What depends on lens and view alone, as the circle that bounds what is seen, is computed once, for all that is drawn.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Indices
from stereodel.conformal import MoebiusMap
from stereodel.constants import CHART_TOLERANCE, REACH_MARGIN, RIM_FINENESS, UNIT_ROUNDOFF
from stereodel.curves import clip
from stereodel.curves.borders import Cap, Pieces
from stereodel.curves.ragged import Ragged
from stereodel.curves.trace import Arcs, Edges
from stereodel.curves.view import MapView
from stereodel.sphere.vectors import turned

Place = tuple[float, float]


@dataclass(frozen=True, eq=False)
class Rim:
    """A circle of the sphere by its unit normal, and cosine and sine of its angular radius, in plain doubles.

    It chooses what may be seen and where lines are sampled; no point of a picture is computed from it.
    """

    normal: FloatArray
    cosine: float
    sine: float

    @property
    def radius(self) -> float:
        """Angular radius in radians."""
        return float(np.arctan2(self.sine, self.cosine))

    @property
    def reach(self) -> float:
        """The radius plus a millionth, so that rounding omits nothing that touches the circle."""
        return self.radius * (1 + REACH_MARGIN) + UNIT_ROUNDOFF * 8


@dataclass(frozen=True, eq=False)
class Chart:
    """A conformal map of the sphere, then a view of its image, on a disc of the page.

    lens, view: the map and the view.
    at, scale: page coordinates of the centre of the disc, and its radius in page units.
    tolerance: largest deviation of the drawing from the exact image, in page units.
    unit: points (1/72 inch) in a page unit, by which line widths and type sizes are scaled.
    share: the part of the tolerance that arcs in place of edges have, and as much chords in place of arcs; 1 where all
        edges are arcs of circles.
    fineness: as for `Cap`.
    """

    lens: MoebiusMap
    view: MapView
    at: Place = (0.0, 0.0)
    scale: float = 1.0
    tolerance: float = CHART_TOLERANCE
    unit: float = 1.0
    share: float = 0.5
    fineness: float = RIM_FINENESS

    @cached_property
    def matrix(self) -> FloatArray:
        """That of the view."""
        return self.view.matrix

    @cached_property
    def turns(self) -> tuple[FloatArray, FloatArray]:
        """Matrices of the rotations before and after the fisheye; the last row of the first is the focus."""
        return self.lens.right.matrix, self.lens.left.matrix

    @cached_property
    def source(self) -> Rim:
        """The circle before the lens whose interior is seen."""
        return self.before(float(np.radians(self.view.angular_radius)))

    @cached_property
    def limb(self) -> Rim:
        """The circle before the lens where the near side of a ball ends."""
        return self.source if self.view.angular_radius == 90.0 else self.before(np.pi / 2)

    def before(self, radius: float) -> Rim:
        """The circle before the lens whose image has this angular radius, in radians, about the centre of the view."""
        # (normal, cosine) is a vector of Minkowski space, which a fisheye boosts: the sum and the difference of its
        # components along the boost, each without cancellation, are multiplied and divided by the magnification. The
        # sine is the length of the vector, which no lens changes.
        size, cosine, sine = self.lens.magnification, float(np.cos(radius)), float(np.sin(radius))
        right, left = self.turns
        normal = turned(self.matrix[2], left.T)
        (n_plus, n_minus), (c_plus, c_minus) = _halves(normal[2], np.hypot(*normal[:2])), _halves(cosine, sine)
        plus = n_plus - c_minus if n_plus + c_minus < 2 else c_plus - n_minus
        minus = c_minus - n_minus if c_minus + n_minus < 2 else n_plus - c_plus
        plus, minus = plus * size, minus / size
        axis, offset = np.array([normal[0], normal[1], (plus + minus) / 2]), (plus - minus) / 2
        length = float(np.sqrt(np.sum(axis**2)))
        return Rim(turned(axis / length, right.T), offset / length, sine / length)

    @property
    def slack(self) -> float:
        """A tolerance on the sphere, in radii, that nowhere exceeds the tolerance on the page."""
        return self.tolerance / (self.scale * self.view.stretch)

    @cached_property
    def border(self) -> Cap:
        """The edge of the disc."""
        return Cap(self.view, self.tolerance / self.scale, fineness=self.fineness)

    def points(self, xyz: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Page coordinates (n, 2) of unit vectors, meaningless for hidden points, and a mask of visible points."""
        axes = turned(self.lens(xyz), self.matrix)
        return self.scale * self.view.flattened(axes) + np.array(self.at), self.border.holds(axes)

    def lines(self, edges: Edges, sides: Ragged) -> tuple[Ragged, Indices]:
        """The visible parts of lines, rows of edges (~e for edge e in reverse), on the page; the line of each part."""
        near = self._near(edges)
        pieces, samples = self._traced(edges.take(near))
        seen, line = clip.lines(clip.among(sides, near), pieces, samples, self.border)
        return self._placed(seen), line

    def regions(
        self,
        edges: Edges,
        rings: Ragged,
        owner: Indices,
        left: FloatArray,
        count: int,
        around: Callable[[BoolArray], BoolArray],
    ) -> tuple[Ragged, Indices]:
        """The visible parts of regions, as closed loops on the page, interior on the left, and the region of each.

        edges, rings: rows of edges (~e for edge e in reverse), with the region on their left.
        owner: the region of each ring, (r,).
        left: what `Edges.left` says of the rings, (r, 3).
        count: number of regions.
        around: which regions (count,) fill the disc; it is given those with a ring that is seen, which do not.
        """
        near = self._near(edges)
        pieces, samples = self._traced(edges.take(near))
        rows = clip.among(rings, near)
        loops, region, shown = clip.in_sight(rows, owner, count, pieces, samples, self.border, left)
        loops, region = clip.bordered(loops, region, around(shown), self.border)
        return self._placed(loops), region

    def surrounded(self, edges: Edges, rings: Ragged, owner: Indices, left: FloatArray, asked: BoolArray) -> BoolArray:
        """Which of the regions that are asked for (count,), of which no ring is seen, fill the disc.

        All their rings are traced to find out.
        """
        if not asked.any():
            return asked
        some = asked[owner]
        rings, owner, left = rings.take(some), owner[some], left[some]
        used = np.zeros(len(edges), dtype=bool)
        used[np.where(rings.values < 0, ~rings.values, rings.values)] = True
        arcs = self._images(edges.take(used))
        hidden = Pieces(arcs, *np.zeros((4, len(arcs)), dtype=bool))
        rows, samples = clip.among(rings, used), arcs.sampled(self.slack * self.share)
        return clip.surround(rows, owner, asked, hidden, samples, self.border, left)

    def _near(self, edges: Edges) -> BoolArray:
        return edges.within(self.source.normal, self.source.reach)

    def _traced(self, edges: Edges) -> tuple[Pieces, Ragged]:
        """Images of edges, cut at the border, and their points."""
        pieces = self.border.cut(self._images(edges))
        return pieces, pieces.arcs.sampled(self.slack * self.share, pieces.seen)

    def _images(self, edges: Edges) -> Arcs:
        """Images of edges in view axes."""
        return edges.arcs_under(self.lens, self.slack * self.share).through(self.lens).turned(self.matrix)

    def _placed(self, found: Ragged) -> Ragged:
        return Ragged(self.scale * found.values + np.array(self.at), found.offsets)


def _halves(height: float, across: float) -> tuple[float, float]:
    """1 + c and 1 − c of the height c of a unit vector, from its distance from the axis as well."""
    large = 1 + abs(height)
    small = across**2 / large
    return (large, small) if height >= 0 else (small, large)
