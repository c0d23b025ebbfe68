"""Charts: mapping the sphere to a page through a lens and a view."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Indices
from stereodel.conformal import MoebiusMap
from stereodel.constants import CHART_TOLERANCE, REACH_MARGIN, UNIT_ROUNDOFF
from stereodel.curves import clip, trace
from stereodel.curves.borders import Cap, Pieces
from stereodel.curves.ragged import Ragged, thinned
from stereodel.drawing.page import Ball, Beziers
from stereodel.drawing.space_curves import page_path
from stereodel.drawing.style import PRINT_WIDTH
from stereodel.drawing.view import MapView
from stereodel.drawing.visibility import limb
from stereodel.globe.lines import SphereLines
from stereodel.globe.regions import SphereRegions
from stereodel.sphere import SphereCircle
from stereodel.sphere.vectors import turned


@dataclass(frozen=True, eq=False)
class Chart:
    """A conformal map of the sphere, then a view of its image, on a disc of the page.

    Parameters
    ----------
    lens : MoebiusMap
    view : MapView
    at : tuple of float
        Page coordinates of the centre of the disc.
    scale : float
        Radius of the disc in page units.
    tolerance : float
        Largest deviation of the drawing from the exact image, in page units.
    unit : float
        Points (1/72 inch) in a page unit, by which line widths and type sizes are scaled.
    """

    lens: MoebiusMap
    view: MapView
    at: tuple[float, float] = (0.0, 0.0)
    scale: float = 1.0
    tolerance: float = CHART_TOLERANCE
    unit: float = PRINT_WIDTH / 2

    @cached_property
    def outline(self) -> tuple[Beziers, ...]:
        """The edge of the disc, counterclockwise."""
        return (page_path([limb(1.0)], self.at, self.scale),)

    @property
    def ball(self) -> Ball | None:
        """The shading of the disc, if it is a ball."""
        return Ball(self.at, self.scale) if self.view.round else None

    @cached_property
    def source(self) -> SphereCircle:
        """The circle before the lens whose interior is visible."""
        return self.lens.inverse().image_of(SphereCircle.around(self.view.matrix[2], self.view.angular_radius))

    def lines(self, lines: SphereLines) -> Ragged:
        """The visible parts of lines, on the page."""
        near = lines.edges.within(self.source.center, self._reach)
        pieces = self._border.cut(self._images(lines.edges.take(near)))
        seen, _ = clip.lines(clip.among(lines.sides, near), pieces, self._samples(pieces), self._border)
        return thinned(self._placed(seen), self.tolerance)

    def regions(self, regions: SphereRegions) -> tuple[Ragged, Indices]:
        """The visible parts of regions, as closed loops on the page, interior on the left, and the region of each."""
        edges, rings, owner = regions.edges, regions.rings, regions.owner
        near = edges.within(self.source.center, self._reach)
        pieces = self._border.cut(self._images(edges.take(near)))
        rows, samples = clip.among(rings, near), self._samples(pieces)
        loops, region, shown = clip.in_sight(rows, owner, regions.count, pieces, samples, self._border, regions.left)
        # No ring of the others is visible: where they may contain the view, all their rings are traced to find out.
        around = regions.everywhere.copy()
        asked = ~shown & regions.may_hold(self.source.center)
        if asked.any():
            some = asked[owner]
            rings, owner, left = rings.take(some), owner[some], regions.left[some]
            used = np.zeros(len(edges), dtype=bool)
            used[np.where(rings.values < 0, ~rings.values, rings.values)] = True
            hidden = Pieces.uncut(self._images(edges.take(used)), seen=False)
            rows, samples = clip.among(rings, used), hidden.arcs.sampled(self.slack / 2)
            around |= clip.surround(rows, owner, asked, hidden, samples, self._border, left)
        loops, region = clip.bordered(loops, region, around, self._border)
        return self._placed(loops), region

    def points(self, xyz: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Page coordinates (n, 2) of unit vectors, meaningless for hidden points, and a mask of visible points."""
        axes = turned(self.lens(xyz), self.view.matrix)
        return self.scale * self.view.flattened(axes) + np.array(self.at), self._border.holds(axes)

    @property
    def slack(self) -> float:
        """A tolerance on the sphere, in radii, that nowhere exceeds the tolerance on the page."""
        return self.tolerance / (self.scale * self.view.stretch)

    @cached_property
    def _border(self) -> Cap:
        return Cap(self.view, self.tolerance / self.scale)

    @property
    def _reach(self) -> float:
        """The radius of `source` plus a millionth, so that rounding omits nothing that touches the border."""
        return float(np.radians(self.source.angular_radius)) * (1 + REACH_MARGIN) + UNIT_ROUNDOFF * 8

    def _images(self, edges: trace.Edges) -> trace.Arcs:
        """Images of edges in view axes; half the tolerance is for them, the other half for the chords of the images."""
        return edges.arcs_under(self.lens, self.slack / 2).through(self.lens).turned(self.view.matrix)

    def _samples(self, pieces: Pieces) -> Ragged:
        return pieces.arcs.sampled(self.slack / 2, pieces.seen)

    def _placed(self, found: Ragged) -> Ragged:
        return Ragged(self.scale * found.values + np.array(self.at), found.offsets)
