"""
Animation: the fisheye grows from 1 to 20
=========================================

A globe with two grids about 40° N while the magnification S of the fisheye runs from 1 to 20, in equal ratios, with
pauses at 1 (Figure 10), 4 (Figure 11) and 20 (Figure 12), where the grids are those of the figures. Meanwhile the
graticule (gray) is refined from 10° to 5° and, up to 8° from the focus, to 1°, and the fine grid (black) from 2° to 1°
and 1/2°. The focus does not move; every line remains a circle.
"""

from collections.abc import Iterator
from functools import partial

import numpy as np
from _film import READING, WIDTH, add_gauge, add_words, faded, moving, nearest, timed, whole
from _five_views import FOCUS, FiveViews
from fig10_earth import PANELS as FIGURE_10
from fig11_fisheye4 import PANELS as FIGURE_11
from fig12_fisheye20 import PANELS as FIGURE_12

from stereodel import fisheye
from stereodel.drawing import Graticule, LineStyle, Page, Scene, Sketch, View
from stereodel.drawing.page.style import line
from stereodel.drawing.scene.graticule import WIDTHS_APART
from stereodel.film import Film
from stereodel.film.shots import eased
from stereodel.sphere import SphereArc, graticule_patch

STAGES = (FIGURE_10, FIGURE_11, FIGURE_12)
NUMBERS = (10, 11, 12)
SIZES = np.array([stage.magnification for stage in STAGES])
LOGS = np.log(SIZES)
GRATICULES = [f"{FIGURE_10.coarse:g}°", f"{FIGURE_11.coarse:g}°", f"{FIGURE_12.coarse:g}° and {FIGURE_11.fine:g}°"]
FINE = {0.5: "½"}  # degrees that are not written with digits
TICKS = (1, 2, 4, 10, 20)
VIEW = View(0, 22)
RADIUS, HEIGHT = 86.0, 214.0  # points
SIZE, STEP = 440, 0.1  # pixels and seconds: all lines move, which makes large files
NEAR = 0.35  # words are seen within this ratio of magnifications, as a logarithm

Grids = dict[str, Graticule | list[SphereArc]]
Shot = tuple[float, tuple[float, float]]
"""A magnification, and those of the pauses before and after, which have words."""


def grids() -> Grids:
    """The graticules of two stages, and the fine lines of each that those before it do not have."""
    fine = [patch(stage) for stage in STAGES]
    return {
        "graticule": Graticule.regular(STAGES[0].coarse),
        "finer graticule": Graticule.regular(STAGES[1].coarse),
        "fine": fine[0],
        "finer": added(fine[1], fine[0]),
        "finest": fine[2],
    }


def patch(stage: FiveViews) -> list[SphereArc]:
    """The fine grid of a figure."""
    return graticule_patch(FOCUS, stage.half_width, stage.fine)


def added(arcs: list[SphereArc], others: list[SphereArc]) -> list[SphereArc]:
    """Those of some arcs that are not among others."""
    there = np.array([arc.sample(3)[1] for arc in others])
    return [arc for arc in arcs if np.linalg.norm(there - arc.sample(3)[1], axis=1).min() > 1e-9]


def styles(magnification: float) -> dict[str, LineStyle]:
    """How each grid looks: finer ones come in, and the first fine ones become a part of the graticule."""
    steps = np.clip((np.log(magnification) - LOGS[:-1]) / np.diff(LOGS), 0.0, 1.0)
    first, second = (eased(float(step)) for step in steps)
    gray, black = line("graticule"), line("fine")
    turning = between(black, gray, second)
    return {
        "graticule": gray,
        "finer graticule": faded(gray, first),
        "fine": turning,
        "finer": faded(turning, first),
        "finest": faded(black, second),
    }


def between(one: LineStyle, other: LineStyle, share: float) -> LineStyle:
    """A line on its way from one style to another."""
    start, end = (np.array([*style.color, style.width]) for style in (one, other))
    *color, width = (start + share * (end - start)).tolist()
    return LineStyle(tuple(color), width)


def frame(shot: Shot, lines: Grids) -> Page:
    """The globe with its grids at one magnification, and a scale that tells it."""
    magnification, ends = shot
    bend = fisheye(FOCUS, magnification=magnification)
    scene = Scene()
    looks = styles(magnification)
    for name, arcs in lines.items():
        if looks[name].color[3] > 0:
            least = WIDTHS_APART * looks[name].width / RADIUS
            drawn = (
                arcs.drawn(bend, VIEW, least) if isinstance(arcs, Graticule) else [bend.image_of(arc) for arc in arcs]
            )
            scene.add_arcs(drawn, name=name, style=looks[name])
    sketch = Sketch().add_items(scene.layout(VIEW, at=(WIDTH / 2, HEIGHT - RADIUS - 4), scale=RADIUS))
    end, strength = nearest(np.log(ends), np.log(magnification), NEAR)
    stage = SIZES.tolist().index(ends[end])
    fine = FINE.get(STAGES[stage].fine, f"{STAGES[stage].fine:g}")
    words = f"Figure {NUMBERS[stage]}: graticule {GRATICULES[stage]}, fine grid {fine}°"
    add_words(sketch, words, 28.0, strength=strength)
    ticks = {log(size): [f"{size}"] for size in TICKS}
    add_gauge(sketch, log(magnification), ticks, 15.0, left=26.0, title=["$S$"])
    return whole(sketch, HEIGHT)


def log(magnification: float) -> float:
    """Where a magnification lies between the least, 0, and the largest, 1."""
    return float(np.log(magnification / SIZES[0]) / np.log(SIZES[-1] / SIZES[0]))


def moments() -> Iterator[tuple[Shot, float]]:
    """What is shown, and its times: 4, which is a good still, then the largest, the least, and back."""
    for start, end, seconds in ((4.0, 20.0, 1.7), (20.0, 1.0, 2.6), (1.0, 4.0, 1.7)):
        yield (start, (start, end)), READING
        for share in moving(seconds, STEP):
            yield (start * (end / start) ** share, (start, end)), STEP


def film() -> Film:
    """One shot for each magnification."""
    shots, seconds = timed(moments())
    return Film(partial(frame, lines=grids()), shots, seconds=seconds, size=SIZE)


if __name__ == "__main__":
    film().main()
