"""
Figures 10 to 12 on one plate
=============================

The globe itself and its images at magnifications 4 and 20, row by row, seen from the same five directions. The red dot
is the focus at 40° N, a fixed point of the map, so that in each column it has the same position relative to the viewer.
The prime meridian is the vertical line in the middle of all 15 views; the south pole and the antipode do not see the
finer grid. The grids are those of the three figures, and every line is a circle.

Chosen by us: where neighbouring lines of a grid would be less than three line widths apart on the page, some of them
end.
"""

from _five_views import FOCUS, PITCH, VIEWS, plate
from fig10_earth import PANELS as EARTH
from fig11_fisheye4 import PANELS as FOUR
from fig12_fisheye20 import PANELS as TWENTY

from stereodel import lonlat_to_xyz
from stereodel.drawing import Dots, Page
from stereodel.drawing.page.style import DOTS
from stereodel.render import Figure

ROWS = (EARTH, FOUR, TWENTY)
ROW_PITCH = 2.12  # globe radii
DOT = DOTS["points"].scaled(0.6)


def geometry() -> dict:
    """The grids of the three figures, and the focus."""
    rows = {f"{number}_{key}": value for number, row in enumerate(ROWS) for key, value in row.geometry().items()}
    return rows | {"focus": lonlat_to_xyz(FOCUS)}


def draw(g: dict) -> Page:
    """Three rows of five globes, with the focus where it is seen."""
    rows = []
    for number, row in enumerate(ROWS):
        height = ROW_PITCH * (len(ROWS) - 1 - number)
        own = {key.removeprefix(f"{number}_"): value for key, value in g.items() if key.startswith(f"{number}_")}
        rows.append(row.items(own, height))
        for column, view in enumerate(VIEWS):
            if view.depth(g["focus"]) > 0:
                place = view.project(g["focus"]) + (PITCH * column, height)
                rows[-1].append(Dots(place[None], DOT.radius, DOT.color, DOT.rim, DOT.rim_width, "focus"))
    return plate(rows, ROW_PITCH)


FIGURE = Figure("fig10_12_plate", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
