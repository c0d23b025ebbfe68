r"""
Claim P14: one point more, step by step
=======================================

How the paper's pseudo-code adds a point to the convex hull of others on the sphere, in six stills. The new point (red)
lies outside the hull. (a) Some facets are visible from it: it is outside of their planes (orange). They go, and the
edges between them and all others are the horizon (black). (b) The point is joined to each edge of the horizon by a new
facet (blue). (c) Each new facet has a plane Ax + By + Cz + D = 0 and a normal (A, B, C), which points away from the
hull. After the last point the facets are the Delaunay triangles of all.

Chosen by us: the points, those of the animation, which of them is shown, and the view.
"""

import numpy as np
from _sites import on_sphere
from anim_hull import SEED, SITES, Moment, among, hull

from stereodel import HullInsertion
from stereodel.drawing import Page, Scene, Sketch, View
from stereodel.drawing.page.style import BLACK, LINES, PRINT_WIDTH, with_opacity
from stereodel.render import Figure

SHOWN = 13  # the number of the insertion
VIEW = View(165, 2)
COLUMNS, PITCH, DROP, RADIUS = 3, 5.75, 6.0, 2.45  # cm
LENGTH = 0.5  # of normals
EXTENT = (-2.75, 14.25, -9.2, 2.55)
SHADE = with_opacity(BLACK, 0.15)  # in the hull
NORMALS = "(c) normals of the new planes"
TITLES = ("hull and new point", "(a) facets that it sees", "the horizon", "(b) joined to it", NORMALS, "all points")


def geometry() -> dict:
    """The points, the facets before and after, those that go and come, the horizon and the finished hull."""
    engine = HullInsertion(on_sphere(SITES, SEED))
    steps = iter(engine)
    for _ in range(SHOWN - 1):
        next(steps)
    before, step = engine.facets, next(steps)
    found = {"before": before, "visible": step.visible, "new": step.new, "horizon": step.horizon}
    engine.run()
    return found | {"points": on_sphere(SITES, SEED), "inserted": np.array(step.inserted), "last": engine.facets}


def moments(g: dict) -> list[list[Moment]]:
    """What is drawn of each still, one over the other."""
    kept = g["before"][~among(g["before"], g["visible"])]
    none, point = np.zeros((0, 2), dtype=int), int(g["inserted"])

    def moment(facets: np.ndarray, kind: str, horizon: np.ndarray = none) -> Moment:
        kinds = np.array(["facet"] * len(kept) + [kind] * len(facets))
        return Moment(np.vstack([kept, facets]), kinds, horizon, point, SHOWN)

    inside = Moment(kept[:, ::-1], np.full(len(kept), "facet"), none, None, SHOWN)
    return [
        [moment(g["visible"], "facet")],
        [moment(g["visible"], "visible", g["horizon"])],
        [inside, moment(none.reshape(0, 3), "facet", g["horizon"])],
        [moment(g["new"], "new", g["horizon"])],
        [moment(g["new"], "new")],
        [Moment(g["last"], np.full(len(g["last"]), "facet"), none, None, 0)],
    ]


def draw(g: dict) -> Page:
    """Two rows of three."""
    sketch = Sketch()
    for number, (title, shown) in enumerate(zip(TITLES, moments(g), strict=True)):
        row, column = divmod(number, COLUMNS)
        at = np.array([PITCH * column, -DROP * row])
        sketch.add_scene(Scene(), VIEW, at=tuple(at), scale=RADIUS)
        for layer, moment in enumerate(shown, start=1):
            for scene in hull(moment, g["points"], VIEW):
                sketch.add_scene(scene, VIEW, at=tuple(at), scale=RADIUS)
            if layer < len(shown):
                sketch.add_polygon(at + RADIUS * border(g), name="shade", color=SHADE)
        if number == TITLES.index(NORMALS):
            add_normals(sketch, at, g["points"][g["new"]])
        if number < len(TITLES) - 1:
            sketch.add_points(at + RADIUS * VIEW.project(g["points"][g["inserted"]]), name="points")
        sketch.add_label(at - [0, RADIUS], title, (0, -6), valign="top", size=10.0)
    return sketch.page(EXTENT, width=PRINT_WIDTH)


def border(g: dict) -> np.ndarray:
    """Where the corners of the horizon are on the page, in order about the new point, which sees all of it."""
    rim, middle = VIEW.project(g["points"][g["horizon"][:, 0]]), VIEW.project(g["points"][g["inserted"]])
    return rim[np.argsort(np.arctan2(*(rim - middle).T))]


def add_normals(sketch: Sketch, at: np.ndarray, corners: np.ndarray) -> None:
    """An arrow away from each facet, given by its corners (n, 3, 3)."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals *= LENGTH / np.linalg.norm(normals, axis=1, keepdims=True)
    feet = corners.mean(axis=1)
    for foot, tip in zip(VIEW.project(feet), VIEW.project(feet + normals), strict=True):
        sketch.add_arrow(at + RADIUS * foot, at + RADIUS * tip, name="normal", style=LINES["axis"])


FIGURE = Figure("claim_steps", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
