"""Relief by a formula, the points that a triangulated network keeps of it, and how its facets are lit and cut."""

from collections.abc import Callable

import numpy as np

from stereodel import PlanarDelaunay, SphericalDelaunay
from stereodel.drawing import LineStyle, Sketch
from stereodel.drawing.page.style import BLACK, with_opacity
from stereodel.interpolation import LinearInterpolator

Network = PlanarDelaunay | SphericalDelaunay

OCTAVES, WAVES = 5, 6  # of the formula; plane waves of each octave

TINTS = np.array(
    [
        [-1.0, 0.56, 0.70, 0.80],
        [0.0, 0.80, 0.88, 0.92],
        [0.0, 0.72, 0.80, 0.66],
        [0.4, 0.88, 0.87, 0.70],
        [0.85, 0.86, 0.76, 0.60],
        [1.3, 0.78, 0.70, 0.64],
        [1.75, 0.98, 0.98, 0.98],
    ]
)
"""Heights and their colours, linear in between; the sea ends and the land begins at 0."""

EDGE = LineStyle(with_opacity(BLACK, 0.3), 0.25)
CONTOUR = LineStyle((0.42, 0.25, 0.1, 0.9), 0.3)
COAST = LineStyle((0.10, 0.30, 0.45, 1.0), 0.6)


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
    return 0.5 + 0.62 * np.clip((normals * light).sum(axis=1), 0, 1)


def tint(height: float, light: float) -> tuple[float, float, float, float]:
    """The colour of a height in that light."""
    stops = TINTS[:2] if height < 0 else TINTS[2:]
    red, green, blue = (min(1.0, light * float(np.interp(height, stops[:, 0], stops[:, k]))) for k in (1, 2, 3))
    return (red, green, blue, 1.0)


def add_facets(sketch: Sketch, g: dict, places: np.ndarray, light: np.ndarray) -> None:
    """The facets that face the viewer, from back to front, each with its edges."""
    for facet in g["order"]:
        corners = places[g["triangles"][facet]]
        if turned_away(corners):
            continue
        for polygon, height in cut_at_sea(corners, g["heights"][g["triangles"][facet]]):
            sketch.add_polygon(polygon, name="facet", color=tint(height, light[facet]))
        sketch.add_polyline(corners, closed=True, name="delaunay", style=EDGE)
