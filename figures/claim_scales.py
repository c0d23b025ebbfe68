r"""
Claims P12 and P17: how paths shrink, and how the scale varies between two bubbles
==================================================================================

Left: polygonal paths in the rectangle of Figure 7 and their images on its hemisphere. The ratio of the lengths is the
mean of the scale along the path. The scale is 1 at the centre and 1/2 at the corners, so the ratio lies between 1/2 and
1 for every path: 40 000 very short ones (gray), 40 000 segments between random points (blue) and 10 000 paths through
12 random points (vermilion). The more a path wanders, the nearer it comes to the mean over the rectangle.

Right: a bubble of angular radius χ is mapped conformally onto one of angular radius Ξ, centre to centre. Each curve is
labelled with the ratio of the largest to the smallest scale, cos² (χ/2) / cos² (Ξ/2) or its inverse. If neither bubble
is larger than a hemisphere, the ratio is at most 2. The dots show where it would be reached: a hemisphere and a bubble
of radius 0.

Chosen by us: the numbers of paths, their seed, and the levels of the curves.
"""

import numpy as np
from _chart import Chart, fraction, steps
from _rectangle import HEIGHT, WIDTH, lift

from stereodel import RectangleLift, SphereCircle, bubble_to_bubble
from stereodel.drawing import LineStyle, Page, Sketch
from stereodel.drawing.page.style import BLUE, DARK_GRAY, PRINT_WIDTH, VERMILION, DotStyle, with_opacity
from stereodel.interpolation import contours
from stereodel.render import Figure

SEGMENTS, WANDERINGS, STOPS, SEED = 40_000, 10_000, 12, 12
SHORT = 1e-3  # length of the very short paths over that of the others
BINS = np.linspace(0.5, 1.0, 51)
RADII = np.array([0.01, *range(2, 91, 2)])  # degrees
CENTER = (0.0, -90.0)
LEVELS = (1.0, 1.2, 1.4, 1.6, 1.8)
LEFT = Chart((0.5, 1.3), (7.3, 6.6), (0.48, 1.02), (0.0, 16.6))
RIGHT = Chart((9.9, 1.3), (6.6, 6.6), (0.0, 90.0), (0.0, 90.0))
EXTENT = (0.0, 17.0, 0.0, 8.5)
KINDS = {"short": DARK_GRAY, "segments": BLUE, "wanderings": VERMILION}


def ratios(rectangle: RectangleLift, corners: np.ndarray) -> np.ndarray:
    """Lengths of the images over lengths of polygonal paths (m, k, 2): means of the scale along them, (m,)."""
    nodes, weights = np.polynomial.legendre.leggauss(5)
    a, b = corners[:, :-1], corners[:, 1:]
    places = (a + b)[:, :, None] / 2 + nodes[:, None] * (b - a)[:, :, None] / 2
    lengths = np.linalg.norm(b - a, axis=-1)
    images = lengths * (rectangle.scale_factor(places) @ weights) / 2
    return images.sum(axis=1) / lengths.sum(axis=1)


def geometry() -> dict:
    """Densities of the ratios for three kinds of paths; the contours of the ratio of the scales."""
    rng, corner = np.random.default_rng(SEED), np.array([WIDTH, HEIGHT]) / 2
    ends = rng.uniform(-corner, corner, size=(SEGMENTS, 2, 2))
    paths = {
        "short": ends[:, :1] + SHORT * np.stack([np.zeros_like(ends[:, 0]), ends[:, 1] - ends[:, 0]], axis=1),
        "segments": ends,
        "wanderings": rng.uniform(-corner, corner, size=(WANDERINGS, STOPS, 2)),
    }
    rectangle = lift()
    found = {kind: np.histogram(ratios(rectangle, path), BINS, density=True)[0] for kind, path in paths.items()}
    grid = np.stack(np.meshgrid(RADII, RADII, indexing="ij"), axis=-1).reshape(-1, 2)
    to_hemisphere = np.array([scale_ratio(radius, 90.0) for radius in RADII])
    scales = np.ravel(to_hemisphere[:, None] / to_hemisphere)  # by way of a hemisphere: the chain rule
    lines = contours(grid, scales, [*LEVELS, *(1 / level for level in LEVELS[1:])])
    return {
        **found,
        "curves": np.concatenate([line.points for line in lines]),
        "sizes": np.array([len(line.points) for line in lines]),
        "levels": np.array([line.level for line in lines]),
    }


def scale_ratio(chi: float, xi: float) -> float:
    """Scale at the centre over scale at the rim, of the map of a bubble of radius χ onto one of radius Ξ."""
    source = SphereCircle.around(CENTER, chi)
    conformal = bubble_to_bubble(source, SphereCircle.around(CENTER, xi))
    centre, rim = conformal.scale_factor(np.array([source.center, source.sample(1)[0]]))
    return float(centre / rim)


def draw(g: dict) -> Page:
    """The densities on the left, the contours on the right."""
    sketch = Sketch()
    add_densities(sketch, g)
    add_contours(sketch, g)
    return sketch.page(EXTENT, width=PRINT_WIDTH)


def add_densities(sketch: Sketch, g: dict) -> None:
    """How often each ratio occurs, over the ratio."""
    for value in (0.5, 1.0):
        LEFT.add_level(sketch, value, name="construction", upright=True)
    for kind, color in KINDS.items():
        outline = LEFT.place(steps(BINS, g[kind]))
        sketch.add_polygon(outline, name=kind, color=with_opacity(color, 0.12))
        sketch.add_polyline(outline, name=kind, style=LineStyle(color, 0.9))
    sketch.add_segment(*LEFT.place([(LEFT.x[0], 0.0), (LEFT.x[1], 0.0)]), name="axis")
    ends = {end: fraction(end) for end in (0.5, 1.0)}
    ticks = {value: ends.get(value, f"{value:g}") for value in (0.5, 0.6, 0.7, 0.8, 0.9, 1.0)}
    LEFT.add_x_ticks(sketch, ticks, "length of the image / length of the path")
    for at, text, color in (
        ((0.62, 3.2), "very short", DARK_GRAY),
        ((0.89, 5.6), "segments", BLUE),
        ((0.79, 12.0), f"through {STOPS} points", VERMILION),
    ):
        sketch.add_label(LEFT.place(at), text, align="left" if at[0] > 0.85 else "right", color=color)


def add_contours(sketch: Sketch, g: dict) -> None:
    """Curves of equal ratio over the two radii, each with its number."""
    for points, level in zip(np.split(g["curves"], np.cumsum(g["sizes"])[:-1]), g["levels"], strict=True):
        color = DARK_GRAY if level == 1 else BLUE if level < 1 else VERMILION
        placed = RIGHT.place(points)
        sketch.add_polyline(placed, name="ratio", style=LineStyle(color, 0.9))
        text = f"{max(level, 1 / level):.2g}"
        sketch.add_label(placed[len(placed) // 2], text, size=8.0, color=color, halo=3.0)
    RIGHT.add_frame(sketch)
    RIGHT.add_level(sketch, 90.0, name="frame")
    RIGHT.add_level(sketch, 90.0, name="frame", upright=True)
    limit = fraction(scale_ratio(RADII[0], 90.0))
    for place, offset, side, words, color in (
        ((90, 0), (9, 0), (46, 10), "larger at the rim", BLUE),
        ((0, 90), (0, 9), (4, 40), "larger at the centre", VERMILION),
    ):
        sketch.add_points(RIGHT.place(place), name="ends", style=DotStyle(color, 2.4, rim_width=0.5))
        sketch.add_label(RIGHT.place(place), limit, offset, color=color)
        sketch.add_label(RIGHT.place(side), words, align="left" if place[0] == 0 else "right", color=color, halo=3.0)
    ticks = {value: f"${value}°$" for value in (0, 30, 60, 90)}
    RIGHT.add_x_ticks(sketch, ticks, r"radius $\chi$ of the bubble")
    RIGHT.add_y_ticks(sketch, ticks, r"radius $\Xi$ of its image")


FIGURE = Figure("claim_scales", geometry, draw, renderer="agg")

if __name__ == "__main__":
    FIGURE.main()
