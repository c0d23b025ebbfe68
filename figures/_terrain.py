"""Relief by a formula, the points that a triangulated network keeps of it, and how its facets are lit and cut."""

from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np
from _chart import Chart

from stereodel import PlanarDelaunay, SphericalDelaunay
from stereodel.drawing import LineStyle, Sketch
from stereodel.drawing.page.style import BLACK, with_opacity
from stereodel.interpolation import LinearInterpolator

Network = PlanarDelaunay | SphericalDelaunay

KEY, KEY_STEPS = (5.0, 0.22), 60  # width and height of a key of heights, cm, and its steps
OCTAVES, WAVES = 5, 6  # of the formula; plane waves of each octave

TINTS = np.array(
    [
        [-1.0, 0.50, 0.70, 0.85],
        [0.0, 0.78, 0.90, 0.96],
        [0.0, 0.62, 0.79, 0.58],
        [0.3, 0.83, 0.88, 0.66],
        [0.7, 0.97, 0.91, 0.68],
        [1.2, 0.94, 0.80, 0.64],
        [1.75, 1.0, 0.99, 0.97],
    ]
)
"""Heights and their colours, linear in between; the sea ends and the land begins at 0."""

SHADOW = np.array([1.2, 1.05, 0.6])  # how fast red, green and blue darken: shadows are cool
EDGE = LineStyle(with_opacity(BLACK, 0.28), 0.2)
CONTOUR = LineStyle((0.30, 0.16, 0.05, 1.0), 0.3)
COAST, DEPTH = LineStyle((0.05, 0.26, 0.45, 1.0), 0.7), LineStyle((0.05, 0.26, 0.45, 1.0), 0.3)


def relief(points: np.ndarray, wavelength: float, seed: int) -> np.ndarray:
    """Heights (n,) at points of space (n, 3); the sea is at 0.

    Broad swells are a sum of plane waves. On them stand octaves of the same kind, each half as wide and half as high as
    the one before: folded at their zeros, which makes ridges, and highest where the swells and the ridges before are.
    """
    rng = np.random.default_rng(seed)

    def waves(length: float) -> np.ndarray:
        directions = rng.normal(size=(WAVES, 3))
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        phases = rng.uniform(0, 2 * np.pi, WAVES)
        return np.cos(2 * np.pi / length * points @ directions.T + phases).mean(axis=1)

    swell = 1.5 * waves(2 * wavelength)
    height, weight = 0.5 * swell, np.clip(swell + 0.3, 0, 1)
    for octave in range(OCTAVES):
        ridge = (1 - np.minimum(np.abs(1.6 * waves(wavelength / 2**octave)), 1)) ** 2
        height += 0.5**octave * weight * ridge
        weight *= np.minimum(0.3 + ridge, 1)
    return height


def keep_points(
    triangulate: Callable[[np.ndarray], Network],
    candidates: np.ndarray,
    heights: np.ndarray,
    kept: np.ndarray,
    count: int,
) -> np.ndarray:
    """Indices of `count` of the candidates, which begin with `kept`: in rounds, where the network errs most.

    Each round takes of every triangle the candidate that is farthest above or below it, the worst third of them.
    """
    while len(kept) < count:
        network = triangulate(candidates[kept])
        error = np.nan_to_num(np.abs(LinearInterpolator(network, heights[kept])(candidates) - heights))
        order = np.argsort(-error, kind="stable")
        _, first = np.unique(np.asarray(network.find_simplex(candidates))[order], return_index=True)
        worst = order[np.sort(first)]
        worst = worst[error[worst] > 0]
        kept = np.concatenate([kept, worst[: min(len(worst) // 3 + 1, count - len(kept))]])
    return kept


def cut_at_sea(corners: np.ndarray, heights: np.ndarray) -> list[tuple[np.ndarray, float]]:
    """A facet as one or two polygons to be painted in this order, each with the height that it is tinted by.

    `corners` (3, d) are where the facet is drawn, on a map or in space. If it reaches above the level 0 and below it,
    the second polygon is the part below, painted over the whole, so that no seam is left between them.
    """
    found: list[tuple[np.ndarray, float]] = []
    for side in (heights >= 0, heights < 0):
        polygon, level = [], []
        for k, following in ((0, 1), (1, 2), (2, 0)):
            if side[k]:
                polygon.append(corners[k])
                level.append(heights[k])
            if side[k] != side[following]:
                part = heights[k] / (heights[k] - heights[following])
                polygon.append(corners[k] + part * (corners[following] - corners[k]))
                level.append(0.0)
        if polygon:
            found.append((np.array(polygon) if found else corners, float(np.mean(level))))
    return found


def turned_away(corners: np.ndarray) -> bool:
    """Whether a facet, by its corners on the page (3, 2), shows its lower side: then others hide it."""
    (x, y), (u, v) = corners[1:] - corners[0]
    return bool(x * v <= y * u)


def brightness(corners: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Brightness (m,) of facets with corners in space (m, 3, 3), counterclockwise seen from above.

    `light` (3,) or (m, 3) points to where light comes from.
    """
    a, b, c = np.moveaxis(corners, 1, 0)
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return 0.70 + 0.42 * np.clip((normals * light).sum(axis=1), 0, 1)


def tint(height: float, light: float) -> tuple[float, float, float, float]:
    """The colour of a height in that light, which the sea takes little of: it has a colour of its own."""
    stops = TINTS[:2] if height < 0 else TINTS[2:]
    color = np.array([np.interp(height, stops[:, 0], stops[:, k]) for k in (1, 2, 3)])
    red, green, blue = np.minimum(color * light ** (SHADOW / 2 if height < 0 else SHADOW), 1.0).tolist()
    return (red, green, blue, 1.0)


def contour_style(level: float) -> LineStyle:
    """The line of a height, of the sea's shore, of a depth."""
    return COAST if level == 0 else CONTOUR if level > 0 else DEPTH


def add_key(
    sketch: Sketch, corner: tuple[float, float], ends: tuple[float, float], at: Sequence[float], unit: float, name: str
) -> None:
    """The tints of heights from one end to another, numbers below at some of them, and the name of their unit."""
    chart, heights = Chart(corner, KEY, ends, (0.0, 1.0)), np.linspace(*ends, KEY_STEPS + 1)
    for low, high in pairwise(heights):  # each step is covered by the next, so that there are no seams
        box = [(low, 0), (ends[1], 0), (ends[1], 1), (low, 1)]
        sketch.add_polygon(chart.place(box), name="key", color=tint((low + high) / 2, 1.0))
    outline = [(ends[0], 0), (ends[1], 0), (ends[1], 1), (ends[0], 1)]
    sketch.add_polyline(chart.place(outline), closed=True, name="frame")
    chart.add_x_ticks(sketch, {height: f"{unit * height:g}".replace("-", "\N{MINUS SIGN}") for height in at}, "")
    sketch.add_label(chart.place((ends[1], 0.5)), name, (5, 0), align="left")


def add_facets(sketch: Sketch, g: dict, places: np.ndarray, light: np.ndarray) -> None:
    """The facets that face the viewer, from back to front, each with its edges."""
    for facet in g["order"]:
        corners = places[g["triangles"][facet]]
        if turned_away(corners):
            continue
        for polygon, height in cut_at_sea(corners, g["heights"][g["triangles"][facet]]):
            sketch.add_polygon(polygon, name="facet", color=tint(height, light[facet]))
        sketch.add_polyline(corners, closed=True, name="delaunay", style=EDGE)
