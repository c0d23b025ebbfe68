"""
Animation: the convex hull grows point by point
===============================================

The paper's pseudo-code at work on 28 points of the sphere, seen from in front and from behind. Each step finds the
facets (orange) that are visible from the new point, removes them, and joins the point to the horizon (black), the
border of the visible region, by a fan of new facets (blue). A hull of n points has 2n − 4 facets.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
from _film import READING, TYPE_SIZE, add_words, timed, whole
from _sites import on_sphere

from stereodel import HullInsertion
from stereodel.drawing import Page, Scene, Sketch, View
from stereodel.drawing.page.style import fainter, fill
from stereodel.film import Film

SITES, SEED = 28, 5
VIEWS = {"in front": View(25, 20), "behind": View(205, -20)}
SIZE = 640  # pixels
WIDTH, HEIGHT, RADIUS = 240.0, 164.0, 57.0  # points
SLOW, QUICK = 1.6, 0.35  # seconds of what each of the first and of the last steps shows
SLOW_STEPS = 3


@dataclass(frozen=True, eq=False)
class Moment:
    """What is drawn at once: facets, which of them are going or new, the horizon, and the point."""

    facets: np.ndarray
    kinds: np.ndarray
    horizon: np.ndarray
    point: int | None
    step: int


def moments() -> Iterator[tuple[Moment, float]]:
    """The finished hull, a good still; then each insertion, what goes and what comes, with times."""
    engine = HullInsertion(on_sphere(SITES, SEED))
    before = engine.facets
    inserted = []
    for number, step in enumerate(engine, start=1):
        kept = before[~among(before, step.visible)] if len(before) else before
        seconds = SLOW if number <= SLOW_STEPS else QUICK
        for rows, kind in ((step.visible, "visible"), (step.new, "new")):
            facets = np.vstack([kept, rows])
            kinds = np.array(["facet"] * len(kept) + [kind] * len(rows))
            inserted.append((Moment(facets, kinds, step.horizon, step.inserted, number), seconds))
        before = engine.facets
    end = Moment(before, np.full(len(before), "facet"), np.zeros((0, 2), dtype=int), None, number)
    yield end, READING
    yield from inserted


def among(facets: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Which facets are among others, whatever vertex they begin with."""
    names = {tuple(np.roll(row, k)) for row in others.tolist() for k in range(3)}
    return np.array([tuple(row) in names for row in facets.tolist()])


def frame(moment: Moment, sites: np.ndarray) -> Page:
    """Both sides of the hull, a legend, and the numbers of the step."""
    sketch = Sketch()
    for column, (name, view) in enumerate(VIEWS.items()):
        at = (WIDTH * (1 + 2 * column) / 4, HEIGHT - RADIUS - 14)
        for scene in (Scene(), *hull(moment, sites, view)):
            sketch.add_items(scene.layout(view, at=at, scale=RADIUS))
        sketch.add_label((at[0], HEIGHT - 9), name, valign="baseline", size=TYPE_SIZE)
    add_legend(sketch, 20.0)
    n = SITES if moment.point is None else 2 + moment.step + (moment.kinds[-1] == "new")
    add_words(sketch, f"step {moment.step}:  $n = {n}$,  $2n - 4 = {len(moment.facets)}$ facets", 6.0, x=WIDTH / 2)
    return whole(sketch, HEIGHT, width=WIDTH)


def hull(moment: Moment, sites: np.ndarray, view: View) -> list[Scene]:
    """The facets that face the viewer, shaded flat; their sides and vertices, and the new point where it is seen."""
    corners = sites[moment.facets]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    facing = view.depth(normals) > 0
    near = moment.facets[facing]
    facets, graph = Scene(style="none"), Scene(style="none")
    for facet, normal, kind in zip(corners[facing], normals[facing], moment.kinds[facing].tolist(), strict=True):
        light = float(view.depth(normal) / np.linalg.norm(normal))
        facets.add_flat_polygon(facet, name=kind, color=fainter(fill(kind), 0.75 * light))
    sides = {tuple(sorted(side)) for a, b, c in near.tolist() for side in ((a, b), (b, c), (c, a))}
    horizon = sides & {tuple(sorted(side)) for side in moment.horizon.tolist()}
    for pairs, name in ((sides - horizon, "delaunay"), (horizon, "outline")):
        ends = sites[np.array(sorted(pairs), dtype=int).reshape(-1, 2)]
        graph.add_segments(ends[:, 0], ends[:, 1], name=name)
    graph.add_space_points(sites[np.unique(near)], name="vertices")
    if moment.point is not None and in_sight(moment, sites, view):
        graph.add_space_points(sites[[moment.point]], name="points")
    return [facets, graph]


def in_sight(moment: Moment, sites: np.ndarray, view: View) -> bool:
    """Whether a new point is seen beside the hull or before it: a facet of its fan faces the viewer."""
    a, b = np.moveaxis(sites[moment.horizon], 1, 0)
    return bool((view.depth(np.cross(b - a, sites[moment.point] - a)) > 0).any())


def add_legend(sketch: Sketch, y: float) -> None:
    """What the colours stand for."""
    for x, kind, text in ((8.0, "visible", "sees the new point: goes"), (126.0, "new", "joins it to the horizon")):
        box = np.array([[0, 0], [8, 0], [8, 6], [0, 6]]) + [x, y]
        sketch.add_polygon(box, name=kind).add_polyline(box, name="delaunay", closed=True)
        sketch.add_label((x + 12, y), text, align="left", valign="baseline", size=TYPE_SIZE)


def film() -> Film:
    """Two shots for each insertion."""
    shots, seconds = timed(moments())
    return Film(partial(frame, sites=on_sphere(SITES, SEED)), shots, seconds=seconds, size=SIZE)


if __name__ == "__main__":
    film().main()
