"""
Animation: the convex hull grows point by point
===============================================

The paper's pseudo-code at work on 28 points of the sphere. Each step finds the facets (orange) that see the new point,
takes them away, and joins the point to the horizon edges by a fan of new facets (blue).
"""

from collections.abc import Iterator
from functools import partial

import numpy as np
from _sites import on_sphere

from stereodel import HullInsertion
from stereodel.drawing import Page, Scene, View
from stereodel.drawing.style import fainter, fill
from stereodel.film import Film

SITES, SEED = 28, 5
VIEW = View(25, 20)
REST = 6  # frames at the end


def facets_over_time() -> Iterator[tuple[np.ndarray, np.ndarray, int]]:
    """Facets, how many of the last of them are marked, and the point: before and after each insertion."""
    engine = HullInsertion(on_sphere(SITES, SEED))
    before = np.zeros((0, 3), dtype=np.int32)
    for step in engine:
        if len(before):
            kept = before[~seen(before, step.visible)]
            yield np.vstack([kept, step.visible]), -len(step.visible), step.inserted
            yield np.vstack([kept, step.new]), len(step.new), step.inserted
        before = engine.facets
    for _ in range(REST):
        yield before, 0, -1


def seen(facets: np.ndarray, visible: np.ndarray) -> np.ndarray:
    """Which of the facets are among the visible ones, whatever vertex they begin with."""
    names = {frozenset(row) for row in visible.tolist()}
    return np.array([frozenset(row) in names for row in facets.tolist()])


def frame(state: tuple[np.ndarray, int, int], sites: np.ndarray) -> Page:
    """The near side of the hull, shaded flat, with the marked facets tinted and the new point large."""
    facets, marked, inserted = state
    corners = sites[facets]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    facing = VIEW.depth(normals) > 0
    tints = np.full(len(facets), "facet", dtype=object)
    if marked:
        tints[slice(marked, None) if marked < 0 else slice(-marked, None)] = "visible" if marked < 0 else "new"
    scene = Scene(style="glass")
    for facet, normal, tint in zip(corners[facing], normals[facing], tints[facing], strict=True):
        scene.add_flat_polygon(facet, name=str(tint), color=shaded(str(tint), normal))
    for facet in corners[facing]:
        scene.add_outline(facet, name="delaunay")
    scene.add_points(sites[np.unique(facets)], name="vertices")
    if inserted >= 0:
        scene.add_points(sites[[inserted]], name="points")
    return scene.page(VIEW, extent=(-1.04, 1.04, -1.04, 1.04), width=150.0)


def shaded(tint: str, normal: np.ndarray) -> tuple:
    """The tint of a facet, the paler the more it faces the viewer."""
    light = VIEW.depth(normal) / np.linalg.norm(normal)
    return fainter(fill(tint), 0.75 * float(light))


def film() -> Film:
    """Two shots for each insertion, the finished hull at the end."""
    return Film(partial(frame, sites=on_sphere(SITES, SEED)), list(facets_over_time()), seconds=0.35, size=480)


if __name__ == "__main__":
    film().main()
