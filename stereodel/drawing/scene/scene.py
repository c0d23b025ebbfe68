"""Scenes: a ball and the items on and around it, filled once and laid out as page items for any number of views."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from stereodel._arrays import as_choice, as_directions, as_indices, as_points, as_scalar, as_vectors
from stereodel._notebook import Displayed, drawn
from stereodel.curves.view import View
from stereodel.drawing.page import Item, Label, Page
from stereodel.drawing.page import style as styles
from stereodel.drawing.page.colors import ColorLike, as_color
from stereodel.drawing.page.style import DotStyle, LengthLike, LineStyle, as_length
from stereodel.drawing.scene.scene_items import (
    BallStyle,
    Layer,
    Layout,
    SceneBall,
    SceneDots,
    SceneItem,
    SceneLabel,
    SceneLines,
    SceneRegion,
    SceneSheet,
    laid_out,
)
from stereodel.drawing.scene.solid import PlacedScene, Solid
from stereodel.drawing.scene.space_curves import CircleArc, Curve, Segment
from stereodel.drawing.scene.visibility import SphereRegion
from stereodel.sphere import SphereArc, SphereCircle
from stereodel.sphere.vectors import units

MARGIN = 0.02
"""Default white space around the ball on a page, in radii."""


class Scene(Displayed):
    """A ball with items on it, inside it and around it.

    Coordinates are those of space, in one unit. Points and arcs *of the ball* are given on the unit sphere about the
    origin, as in the rest of the library, and are mapped onto the ball.

    Every method takes the `name` of what is added. It selects the style of that name in `stereodel.drawing.page.style`,
    unless a `style` or `color` is given, and is the id of the group in vector files.

    Parameters
    ----------
    radius : float
        Radius of the ball.
    center : (3,) array-like
        Centre of the ball.
    style : {"solid", "glass", "none"}
        An opaque ball; a transparent one, through which the far side shows fainter; or no ball at all.
    weight : float
        Factor on all line widths and dot radii, for globes that are small on the page.
    limb : LineStyle, optional
        Style of the ball's outline.

    Examples
    --------
    >>> scene = Scene(style="solid")
    >>> scene.add_edges([[1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1], [1, 2]], name="delaunay")
    >>> page = scene.page(View(20, 35), width=200.0)
    >>> [item.name for item in page.items], page.extent
    (['ball', 'delaunay', 'delaunay', 'limb'], (-1.02, 1.02, -1.02, 1.02))
    """

    _mimes = drawn(lambda it: it.page(View(0.0, 20.0), width=340.0))

    def __init__(
        self,
        *,
        radius: float = 1.0,
        center: npt.ArrayLike = (0.0, 0.0, 0.0),
        style: BallStyle = "solid",
        weight: float = 1.0,
        limb: LineStyle | None = None,
    ) -> None:
        self.radius = as_scalar(radius, "radius", low=0.0, open_low=True)
        self.center = as_vectors(center, 3, "center")
        self.style: BallStyle = as_choice(style, ("solid", "glass", "none"), "style")
        self.weight = as_scalar(weight, "weight", low=0.0, open_low=True)
        self._items: list[SceneItem] = []
        if style != "none":
            color = styles.fill("ball" if style == "solid" else "glass")
            self._items.append(SceneBall(color, styles.line("limb", limb).scaled(self.weight)))

    def add_arcs(self, arcs: Iterable[SphereArc | CircleArc], *, name: str, style: LineStyle | None = None) -> None:
        """Draw arcs of circles of the ball, given on the unit sphere."""
        curves = (CircleArc.of(arc).scaled(self.radius, self.center) for arc in arcs)
        self.add_curves(curves, name=name, style=style)

    def add_edges(
        self, points: npt.ArrayLike, pairs: npt.ArrayLike, *, name: str, style: LineStyle | None = None
    ) -> None:
        """Draw the shorter great-circle arcs between pairs (m, 2) of directions (n, 3)."""
        vertices = as_points(points, 3, "points")
        index = as_indices(np.ravel(pairs), len(vertices), "pairs").reshape(-1, 2)
        arcs = [CircleArc.great(vertices[i], vertices[j]) for i, j in index]
        self.add_arcs(arcs, name=name, style=style)

    def add_circles(
        self, circles: Iterable[SphereCircle], *, name: str = "circle", style: LineStyle | None = None
    ) -> None:
        """Draw whole circles of the ball."""
        self.add_arcs([CircleArc.circle(circle) for circle in circles], name=name, style=style)

    def add_segments(
        self,
        starts: npt.ArrayLike,
        ends: npt.ArrayLike,
        *,
        name: str,
        style: LineStyle | None = None,
        layer: Layer | None = None,
    ) -> None:
        """Draw straight segments in space from starts (n, 3) to ends (n, 3); a single row is paired with all others."""
        first, last = np.broadcast_arrays(np.atleast_2d(as_vectors(starts, 3, "starts")), as_vectors(ends, 3, "ends"))
        segments = [Segment.between(a, b) for a, b in zip(first, last, strict=True)]
        self.add_curves(segments, name=name, style=style, layer=layer)

    def add_curves(
        self, curves: Iterable[Curve], *, name: str, style: LineStyle | None = None, layer: Layer | None = None
    ) -> None:
        """Draw curves in space, not necessarily on the ball.

        A `layer` is their position in painter's order, except that of parts behind the ball.
        """
        drawn = styles.line(name, style).scaled(self.weight)
        self._items.append(SceneLines(tuple(curves), drawn, name, layer))

    def add_points(self, points: npt.ArrayLike, *, name: str = "sites", style: DotStyle | None = None) -> None:
        """Draw dots at points of the ball, given as directions (n, 3)."""
        unit = units(as_directions(points, "points", points=True))
        self.add_space_points(self.center + self.radius * unit, name=name, style=style)

    def add_space_points(self, points: npt.ArrayLike, *, name: str = "points", style: DotStyle | None = None) -> None:
        """Draw dots at points (n, 3) in space."""
        drawn = styles.dot(name, style).scaled(self.weight)
        self._items.append(SceneDots(as_points(points, 3), drawn, name))

    def add_region(
        self, boundary: Iterable[SphereArc | CircleArc], *, name: str, color: ColorLike | None = None
    ) -> None:
        """Tint the region to the left of a loop of arcs, as seen from outside, of any size and shape."""
        region = SphereRegion(
            tuple(CircleArc.of(arc).scaled(self.radius, np.zeros(3)) for arc in boundary), self.radius
        )
        self._items.append(SceneRegion(region, styles.fill(name, color), name))

    def add_cap(
        self,
        circle: SphereCircle,
        *,
        name: str,
        side: Literal["inside", "outside"] = "inside",
        color: ColorLike | None = None,
    ) -> None:
        """Tint the bubble of a circle: the side normal·x ≥ offset ("inside") or the other side."""
        whole = CircleArc.circle(circle)
        boundary = whole if side == "inside" else CircleArc(whole.center, whole.u, -whole.v)
        self.add_region([boundary], name=name, color=color)

    def add_patch(self, corners: npt.ArrayLike, *, name: str = "triangle", color: ColorLike | None = None) -> None:
        """Tint a spherical polygon, such as a triangle, of corners (n, 3), counterclockwise seen from outside."""
        starts = as_points(corners, 3, "corners")
        sides = zip(starts, np.roll(starts, -1, axis=0), strict=True)
        self.add_region([CircleArc.great(a, b) for a, b in sides], name=name, color=color)

    def add_flat_polygon(self, corners: npt.ArrayLike, *, name: str = "plane", color: ColorLike | None = None) -> None:
        """Tint a flat polygon in space, corners (n, 3) in order, such as a tangent plane or a chordal triangle.

        It must not cut the ball (`layout` raises a ValueError); its outline is drawn separately, by `add_outline`.
        """
        self._items.append(SceneSheet(as_points(corners, 3, "corners"), styles.fill(name, color), name))

    def add_outline(self, corners: npt.ArrayLike, *, name: str = "plane", style: LineStyle | None = None) -> None:
        """Draw the sides of a polygon in space, corners (n, 3) in order."""
        starts = as_points(corners, 3, "corners")
        self.add_segments(starts, np.roll(starts, -1, axis=0), name=name, style=style)

    def add_label(
        self,
        point: npt.ArrayLike,
        text: str,
        *,
        offset: tuple[float, float] = (0.0, 0.0),
        always: bool = False,
        align: Literal["left", "center", "right"] = "center",
        valign: Literal["bottom", "center", "top", "baseline"] = "center",
        size: float = styles.LABEL_SIZE,
        color: ColorLike = styles.BLACK,
    ) -> None:
        """Write at a point (3,) in space, shifted by `offset` points; omitted if the ball hides it, unless `always`."""
        label = Label(text, (0.0, 0.0), offset, align, valign, size, as_color(color))
        self._items.append(SceneLabel(label, as_vectors(point, 3, "point"), always))

    def page(
        self,
        view: View,
        *,
        extent: tuple[float, float, float, float] | None = None,
        width: LengthLike = Page.width,
        background: ColorLike = styles.WHITE,
    ) -> Page:
        """A page with the scene in a view.

        Parameters
        ----------
        view : View
        extent : (float, float, float, float), optional
            Left, right, bottom and top of the page, in the unit of space, about the origin of space. By default the
            ball with a margin of `MARGIN` radii.
        width : float or str
            Width of the page in points, or with a unit, such as "17cm"; the height follows.
        background : color-like
            Colour of the background.
        """
        if extent is None:
            (x, y), reach = view.project(self.center), (1 + MARGIN) * self.radius
            extent = (float(x) - reach, float(x) + reach, float(y) - reach, float(y) + reach)
        return Page(
            extent, self.layout(view), as_length(width, "width"), as_color(background, "background"), (view.matrix,)
        )

    def layout(self, view: View, *, at: tuple[float, float] = (0.0, 0.0), scale: float = 1.0) -> tuple[Item, ...]:
        """Page items in painter's order, with hidden parts removed, for pages with more than one scene.

        The origin of space is at page coordinates `at`, and a unit of space is `scale` page units.
        """
        placed = self.placed(view, at=at, scale=scale)
        return laid_out(placed.items, placed.layout)

    def placed(self, view: View, *, at: tuple[float, float] = (0.0, 0.0), scale: float = 1.0) -> PlacedScene:
        """The scene at its position on a page, for a `Solid` with several scenes; parameters as in `layout`."""
        size = as_scalar(scale, "scale", low=0.0, open_low=True)
        return PlacedScene(Layout(view.matrix, self.center, self.radius, self.style, at, size), tuple(self._items))

    def solid(self, view: View, **options: Any) -> Solid:
        """The scene in space in a view; options and errors as in `page`.

        Examples
        --------
        >>> import tempfile
        >>> from pathlib import Path
        >>> scene = Scene()
        >>> scene.add_circles([SphereCircle.around((20, 30), 40)])
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     scene.solid(View(0, 20), width=200.0).save(Path(folder, "circle.glb")).stat().st_size > 1000
        True
        """
        return Solid(self.page(view, **options), (self.placed(view),))
