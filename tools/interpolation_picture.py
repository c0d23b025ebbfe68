"""Draw docs/images/interpolation.png: contours of one field at few points, linear and smooth.

python tools/interpolation_picture.py
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from stereodel import SphericalDelaunay
from stereodel._arrays import FloatArray
from stereodel.drawing import LineStyle, Page, Scene, View
from stereodel.drawing.page.style import BLUE, LIGHT_GRAY, VERMILION
from stereodel.interpolation import Contour, SmoothInterpolator, contours

SITES, FINE, SEED = 500, 40_000, 6
LEVELS = np.linspace(-0.9, 0.9, 10)  # without zero
VIEW = View(20, 25)
WIDTH = 1100  # pixels
ROOT = Path(__file__).resolve().parent.parent


def field(x: FloatArray) -> FloatArray:
    """Two sines of an oblique direction and height."""
    return np.sin(4 * x[:, 0] - x[:, 2]) * np.cos(3 * x[:, 1] + 1.5 * x[:, 2])


def directions(count: int, rng: np.random.Generator) -> FloatArray:
    """Uniform unit vectors."""
    vectors = rng.standard_normal((count, 3))
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def geometry() -> dict[str, object]:
    """Sites, and both sets of contours."""
    rng = np.random.default_rng(SEED)
    sites = directions(SITES, rng)
    function = SmoothInterpolator(sites, field(sites))
    fine = directions(FINE, rng)
    return {
        "sites": sites,
        "edges": SphericalDelaunay(sites).edges,
        "linear": contours(sites, field(sites), LEVELS),
        "smooth": contours(fine, function(fine), LEVELS),
    }


def globe(g: dict[str, object], lines: list[Contour], *, triangles: bool) -> Scene:
    """Contours, red above zero and blue below, over the sites."""
    scene = Scene(weight=0.7)
    if triangles:
        scene.add_edges(g["sites"], g["edges"], name="delaunay", style=LineStyle(LIGHT_GRAY, 0.6))
    for line in lines:
        steps = np.arange(len(line.points) - 1)
        color = VERMILION if line.level > 0 else BLUE
        scene.add_edges(line.points, np.stack([steps, steps + 1], axis=1), name="contour", style=LineStyle(color, 1.3))
    scene.add_points(g["sites"], name="sites")
    return scene


def draw(g: dict[str, object]) -> Page:
    """The linear function with its triangles on the left, the smooth one on the right."""
    left = globe(g, g["linear"], triangles=True).layout(VIEW, at=(-1.06, 0.0))
    right = globe(g, g["smooth"], triangles=False).layout(VIEW, at=(1.06, 0.0))
    return Page((-2.1, 2.1, -1.03, 1.03), [*left, *right], width=480.0, views=(VIEW.matrix, VIEW.matrix))


def main() -> None:
    """Draw it."""
    path = draw(geometry()).save(ROOT / "docs" / "images" / "interpolation.png", size=WIDTH)
    print(path.relative_to(ROOT))


if __name__ == "__main__":
    main()
