"""Scenes: a ball and what is drawn on and about it, laid out as page items for a view.

A `Scene` knows nothing of pixels or paper. It is filled once and may be laid out many times, for several views, several
globes on a page, or the frames of an animation.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Literal

import numpy as np
import numpy.typing as npt

from stereodel._arrays import as_directions, as_indices, as_points, as_scalar, as_vectors
from stereodel.drawing import style as styles
from stereodel.drawing.page import Color, Item, Label
from stereodel.drawing.regions import SphereRegion
from stereodel.drawing.space_curves import CircleArc, Curve, Segment
from stereodel.drawing.style import DotStyle, LineStyle
from stereodel.drawing.things import (
    BallThing,
    DotsThing,
    LabelThing,
    Layer,
    Layout,
    LineThing,
    Look,
    RegionThing,
    SheetThing,
    Thing,
)
from stereodel.drawing.view import View
from stereodel.sphere import SphereArc, SphereCircle


class Scene:
    """A ball with things on it, in it and about it.

    Coordinates are those of space, in one unit. Methods that take points or arcs *of the ball* take them on the unit
    sphere about the origin, as the rest of the library gives them, and put them on the ball.

    Parameters
    ----------
    radius : float
        Of the ball.
    center : (3,) array-like
        Of the ball.
    look : {"solid", "glass", "none"}
        An opaque ball; a transparent one, through which the far side shows fainter; or no ball at all.
    weight : float
        Factor on the widths of all lines and the radii of all dots, for globes that are small on the page.
    limb : LineStyle, optional
        Another look of the ball's outline.

    Examples
    --------
    >>> scene = Scene(look="solid")
    >>> scene.add_edges([[1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1], [1, 2]], role="delaunay")
    >>> [type(item).__name__ for item in scene.layout(View(20, 35))]
    ['Surface', 'Stroke', 'Stroke', 'Stroke']
    """

    def __init__(
        self,
        *,
        radius: float = 1.0,
        center: npt.ArrayLike = (0.0, 0.0, 0.0),
        look: Look = "solid",
        weight: float = 1.0,
        limb: LineStyle | None = None,
    ) -> None:
        self.radius = as_scalar(radius, "radius", low=0.0, open_low=True)
        self.center = as_vectors(center, 3, "center")
        if look not in ("solid", "glass", "none"):
            raise ValueError(f'look must be "solid", "glass" or "none", got {look!r}')
        self.look: Look = look
        self.weight = as_scalar(weight, "weight", low=0.0, open_low=True)
        self._things: list[Thing] = []
        if look != "none":
            tint = styles.fill("ball" if look == "solid" else "glass")
            outline = styles.line("limb") if limb is None else limb
            self._things.append(BallThing(tint, outline.scaled(self.weight)))

    def add_arcs(
        self,
        arcs: Iterable[SphereArc | CircleArc],
        *,
        role: str,
        style: LineStyle | None = None,
        layer: Layer | None = None,
    ) -> None:
        """Draw arcs of circles of the ball.

        Parameters
        ----------
        arcs : iterable of SphereArc or CircleArc
            On the unit sphere.
        role : str
            What they are; names the style and the group in vector files.
        style : LineStyle, optional
            Another look than the role's.
        layer : Layer, optional
            Another place in painter's order for all parts but those behind the ball.
        """
        curves = (arc if isinstance(arc, CircleArc) else CircleArc.of(arc) for arc in arcs)
        self.add_curves(
            (curve.scaled(self.radius, self.center) for curve in curves), role=role, style=style, layer=layer
        )

    def add_edges(
        self,
        points: npt.ArrayLike,
        pairs: npt.ArrayLike,
        *,
        role: str,
        style: LineStyle | None = None,
        layer: Layer | None = None,
    ) -> None:
        """Draw the shorter great-circle arcs between pairs (m, 2) of directions (n, 3)."""
        vertices = as_points(points, 3, "points")
        index = as_indices(np.ravel(pairs), len(vertices), "pairs").reshape(-1, 2)
        arcs = [CircleArc.great(vertices[i], vertices[j]) for i, j in index]
        self.add_arcs(arcs, role=role, style=style, layer=layer)

    def add_circles(
        self,
        circles: Iterable[SphereCircle],
        *,
        role: str = "circle",
        style: LineStyle | None = None,
        layer: Layer | None = None,
    ) -> None:
        """Draw whole circles of the ball."""
        self.add_arcs([CircleArc.circle(circle) for circle in circles], role=role, style=style, layer=layer)

    def add_segments(
        self,
        starts: npt.ArrayLike,
        ends: npt.ArrayLike,
        *,
        role: str,
        style: LineStyle | None = None,
        layer: Layer | None = None,
    ) -> None:
        """Draw straight segments of space from starts (n, 3) to ends (n, 3); one row is paired with all others."""
        first, last = np.broadcast_arrays(np.atleast_2d(as_vectors(starts, 3, "starts")), as_vectors(ends, 3, "ends"))
        segments = [Segment.between(a, b) for a, b in zip(first, last, strict=True)]
        self.add_curves(segments, role=role, style=style, layer=layer)

    def add_curves(
        self, curves: Iterable[Curve], *, role: str, style: LineStyle | None = None, layer: Layer | None = None
    ) -> None:
        """Draw curves of space, not necessarily on the ball."""
        look = (styles.line(role) if style is None else style).scaled(self.weight)
        self._things += [LineThing(curve, look, role, layer) for curve in curves]

    def add_points(self, points: npt.ArrayLike, *, role: str = "sites", style: DotStyle | None = None) -> None:
        """Draw dots at points of the ball, given as directions (n, 3)."""
        directions = as_directions(points, "points", points=True)
        unit = directions / np.sqrt(np.sum(directions**2, axis=1, keepdims=True))
        self.add_space_points(self.center + self.radius * unit, role=role, style=style)

    def add_space_points(self, points: npt.ArrayLike, *, role: str = "points", style: DotStyle | None = None) -> None:
        """Draw dots at points (n, 3) of space."""
        look = (styles.dot(role) if style is None else style).scaled(self.weight)
        self._things.append(DotsThing(as_points(points, 3), look, role))

    def add_region(self, boundary: Iterable[SphereArc | CircleArc], *, role: str, tint: Color | None = None) -> None:
        """Tint the region to the left of each arc of a connected loop, counterclockwise as seen from outside."""
        arcs = (arc if isinstance(arc, CircleArc) else CircleArc.of(arc) for arc in boundary)
        region = SphereRegion(tuple(arc.scaled(self.radius, np.zeros(3)) for arc in arcs), self.radius)
        self._things.append(RegionThing(region, styles.fill(role) if tint is None else tint, role))

    def add_cap(
        self,
        circle: SphereCircle,
        *,
        role: str,
        side: Literal["inside", "outside"] = "inside",
        tint: Color | None = None,
    ) -> None:
        """Tint the bubble of a circle: the side normal·x ≥ offset ("inside") or the other one."""
        whole = CircleArc.circle(circle)
        boundary = whole if side == "inside" else CircleArc(whole.center, whole.u, -whole.v)
        self.add_region([boundary], role=role, tint=tint)

    def add_triangle_patch(
        self, a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike, *, role: str = "triangle", tint: Color | None = None
    ) -> None:
        """Tint the spherical triangle of three points, counterclockwise seen from outside."""
        self.add_region([CircleArc.great(*pair) for pair in ((a, b), (b, c), (c, a))], role=role, tint=tint)

    def add_flat_polygon(self, corners: npt.ArrayLike, *, role: str = "plane", tint: Color | None = None) -> None:
        """Tint a flat polygon of space, corners (n, 3) in order: a plane that touches the ball, a chordal triangle.

        It must not cut the ball (`layout` raises a ValueError); its outline is drawn apart, by `add_outline`.
        """
        self._things.append(
            SheetThing(as_points(corners, 3, "corners"), styles.fill(role) if tint is None else tint, role)
        )

    def add_outline(self, corners: npt.ArrayLike, *, role: str = "plane", style: LineStyle | None = None) -> None:
        """Draw the sides of a polygon of space, corners (n, 3) in order."""
        starts = as_points(corners, 3, "corners")
        self.add_segments(starts, np.roll(starts, -1, axis=0), role=role, style=style)

    def add_label(
        self,
        text: str,
        point: npt.ArrayLike,
        *,
        offset: tuple[float, float] = (0.0, 0.0),
        always: bool = False,
        align: Literal["left", "center", "right"] = "center",
        valign: Literal["bottom", "center", "top", "baseline"] = "center",
        size: float = styles.LABEL_SIZE,
        color: Color = styles.BLACK,
    ) -> None:
        """Write at a point (3,) of space, moved by `offset` points; not where the ball hides it unless `always`."""
        label = Label(text, (0.0, 0.0), offset, align, valign, size, color)
        self._things.append(LabelThing(label, as_vectors(point, 3, "point"), always))

    def layout(self, view: View, *, at: tuple[float, float] = (0.0, 0.0), scale: float = 1.0) -> tuple[Item, ...]:
        """Page items in painter's order, without what is hidden.

        Parameters
        ----------
        view : View
        at : tuple of float
            Page position of the origin of space.
        scale : float
            Page units for one unit of space.
        """
        size = as_scalar(scale, "scale", low=0.0, open_low=True)
        layout = Layout(view.matrix, self.center, self.radius, self.look, at, size)
        planes = [thing.plane(layout) for thing in self._things if isinstance(thing, SheetThing)]
        sheets = tuple(plane for plane in planes if plane[2] is not Layer.INSIDE_SHEET)
        layout = replace(layout, sheets=sheets)
        laid = [item for thing in self._things for item in thing.lay(layout)]
        return tuple(item for _, item in sorted(laid, key=lambda pair: pair[0]))
