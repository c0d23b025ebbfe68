r"""
Claims P12 and P13: how far apart the points of a rectangle stay on its hemisphere
==================================================================================

Two points of a rectangle of diagonal D, at distance d, are lifted to the hemisphere of radius R = D/4. Each dot is one
of 1500 random pairs of the rectangle of Figure 7, its angle given as a multiple c of (d/D) 180°. The paper says that c
is at least 1/2 (dashed); that is true, but no pair comes close. The best constants are 2/π, which close pairs at a
corner approach, and 4/π, which close pairs at the centre approach. The scale on the right is the same for lengths: a
geodesic on the sphere is between 1/2 and 1 times as long as the corresponding segment.

The blue curves are the bounds for every distance, whatever the sides of the rectangle: the angle is at most 4
arctan(d/D), with equality for points opposite each other about the centre, and at least 2 arcsin(d/D), with equality
for two corners. Vermilion: pairs of a corner and a point on a side, which attain the bound at the next corner.

Chosen by us: the sides 3 : 2, the number of pairs and their seed.
"""

import numpy as np
from _chart import Chart, fraction, steps
from _rectangle import HEIGHT, WIDTH, lift

from stereodel import RectangleLift
from stereodel.drawing import LineStyle, Page, Sketch
from stereodel.drawing.page.style import BLACK, BLUE, DARK_GRAY, PRINT_WIDTH, VERMILION, DotStyle, with_opacity
from stereodel.render import Figure
from stereodel.sphere import angular_distance

PAIRS, DOTS, SEED = 100_000, 1500, 13
BINS = 72
KNOTS = np.sin(np.radians(np.linspace(0.5, 90, 180)))  # values of d/D, dense where the curves are steep
LOW, HIGH = 0.45, 1.33
MAIN = Chart((1.45, 1.25), (10.7, 7.6), (0.0, 1.0), (LOW, HIGH))
SIDE = Chart((12.5, 1.25), (2.7, 7.6), (0.0, 1.0), (LOW, HIGH))
EXTENT = (0.0, 17.0, 0.0, 9.1)
CURVE, CORNER = LineStyle(BLUE, 1.3), LineStyle(VERMILION, 0.9)


def constant(rectangle: RectangleLift, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Distances of pairs as shares of the diagonal, and their angles as multiples c of (d/D) 180°, (n, 2)."""
    share = np.linalg.norm(a - b, axis=-1) / rectangle.diagonal
    return np.column_stack([share, angular_distance(rectangle.forward(a), rectangle.forward(b)) / (180 * share)])


def geometry() -> dict:
    """Random pairs, the pairs that are farthest apart and nearest, and the pairs along the sides from a corner."""
    rectangle, corner = lift(), np.array([WIDTH, HEIGHT]) / 2
    a, b = np.random.default_rng(SEED).uniform(-corner, corner, size=(2, PAIRS, 2))
    random = constant(rectangle, a, b)
    bounds = np.array(rectangle.separation_bounds(rectangle.diagonal)) / 180
    counts, edges = np.histogram(random[:, 1], BINS, bounds)
    across = KNOTS[:, None] * corner
    narrow = [RectangleLift(t, np.sqrt((1 - t) * (1 + t))) for t in KNOTS]
    ends = [np.array([[-r.width, r.height], [r.width, r.height]]) / 2 for r in narrow]
    along = np.linspace(0, 1, 121)[1:, None]
    return {
        "pairs": random[:DOTS],
        "edges": edges,
        "shares": counts / counts.max(),
        "largest": np.vstack([[0.0, bounds[1]], constant(rectangle, across, -across)]),
        "smallest": np.vstack(
            [[0.0, bounds[0]], *(constant(r, *end[:, None]) for r, end in zip(narrow, ends, strict=True))]
        ),
        "short_side": constant(rectangle, corner, corner - along * [0.0, HEIGHT]),
        "long_side": constant(rectangle, corner, corner - along * [WIDTH, 0.0]),
        "bounds": bounds,
    }


def draw(g: dict) -> Page:
    """The chart, its histogram on the right, and the scale of lengths."""
    sketch = Sketch()
    outline = np.concatenate([g["largest"], g["smallest"][::-1]])
    sketch.add_polygon(MAIN.place(outline), name="possible", color=with_opacity(BLUE, 0.07))
    add_levels(sketch, g)
    dot = DotStyle(with_opacity(DARK_GRAY, 0.45), 0.75)
    sketch.add_points(MAIN.place(g["pairs"]), name="pairs", style=dot)
    for name in ("short_side", "long_side"):
        sketch.add_polyline(MAIN.place(g[name]), name=name, style=CORNER)
    for name in ("largest", "smallest"):
        sketch.add_polyline(MAIN.place(g[name]), name=name, style=CURVE)
    add_histogram(sketch, g)
    add_words(sketch, g)
    return sketch.page(EXTENT, width=PRINT_WIDTH)


def add_levels(sketch: Sketch, g: dict) -> None:
    """The three constants, through both parts."""
    for value, name in zip((*g["bounds"], 0.5), ("frame", "frame", "construction"), strict=True):
        left, right = MAIN.place((0.0, value)), SIDE.place((1.0, value))
        sketch.add_segment(left, right, name=name)


def add_histogram(sketch: Sketch, g: dict) -> None:
    """How often each constant occurs."""
    outline = SIDE.place(steps(g["edges"], 0.92 * g["shares"])[:, ::-1])
    sketch.add_polygon(outline, name="histogram", color=with_opacity(DARK_GRAY, 0.3))
    sketch.add_polyline(outline, name="frame")


def add_words(sketch: Sketch, g: dict) -> None:
    """Scales and names."""
    MAIN.add_frame(sketch)
    low, high = g["bounds"]
    MAIN.add_x_ticks(sketch, {value: fraction(value) for value in (0, 0.25, 0.5, 0.75, 1)}, "distance  $d/D$")
    ticks = {value: fraction(value) for value in (0.5, 0.75, 1.0)} | {low: r"$2/\pi$", high: r"$4/\pi$"}
    MAIN.add_y_ticks(sketch, dict(sorted(ticks.items())), r"$c$ = angle / $(d/D)\,180°$", gap=27.0)
    sketch.add_segment(*SIDE.place([(1.0, low), (1.0, high)]), name="axis")
    lengths = {value * high: fraction(value) for value in (0.5, 0.75, 1.0)}
    SIDE.add_y_ticks(sketch, lengths, "geodesic of the sphere / segment", right=True)
    for at, text, offset, align, color in (
        ((0.03, 0.5), "the paper's lower constant", (0, -7), "left", DARK_GRAY),
        ((0.03, high), "close pairs at the centre", (0, 7), "left", BLACK),
        ((0.03, low), "close pairs at a corner", (0, -7), "left", BLACK),
        (on_curve(g["largest"], 0.72), r"$4\,\arctan(d/D)$", (3, 8), "left", BLUE),
        (on_curve(g["smallest"], 0.8), r"$2\,\arcsin(d/D)$", (4, -9), "left", BLUE),
        (on_curve(g["short_side"], 0.33), "along a short side", (0, 7), "center", VERMILION),
        (on_curve(g["long_side"], 0.53), "along a long side", (0, -8), "center", VERMILION),
    ):
        sketch.add_label(MAIN.place(at), text, offset, align=align, color=color)
    sketch.add_label(SIDE.place((0.5, HIGH)), f"{PAIRS:,} pairs".replace(",", " "), (0, -5))


def on_curve(curve: np.ndarray, share: float) -> tuple[float, float]:
    """The point of a curve at a share of the diagonal."""
    return share, float(np.interp(share, *curve.T))


FIGURE = Figure("claim_separation", geometry, draw, renderer="agg")

if __name__ == "__main__":
    FIGURE.main()
