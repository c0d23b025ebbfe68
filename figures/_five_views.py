"""Figures 10 to 12: five orthographic views of a globe under the fisheye, which differ in four numbers."""

from collections.abc import Sequence
from dataclasses import dataclass

from _arcs import from_rows, to_rows

from stereodel import fisheye, lonlat_to_xyz
from stereodel.drawing import CircleArc, Graticule, Label, LineStyle, Page, Scene, Solid, View
from stereodel.drawing.page import Item
from stereodel.drawing.page.style import DARK_GRAY, GRID_GRAY, LINES, fainter
from stereodel.drawing.scene.graticule import WIDTHS_APART
from stereodel.sphere import SphereArc, graticule, graticule_patch

Arcs = Sequence[SphereArc | CircleArc]

FOCUS = (0.0, 40.0)  # degrees
VIEWS = (View(0, 0), View(0, 90), View(0, -90), View(0, 40), View(180, -40))
NAMES = ("equator", "north pole", "south pole", f"{FOCUS[1]:g}° N", "antipode")
PITCH, MARGIN = 2.14, 0.03  # globe radii
SIDE, FOOT = 0.33, 0.29  # of the strips for S on the left and the names below, globe radii
WEIGHT = 0.625  # of the lines: the globes are small
LIMB = LineStyle(DARK_GRAY, 0.96)
FAINT, ROOM = LineStyle(fainter(GRID_GRAY, 0.24), 0.3), 4.0  # lines between others, and how much more room they need
TYPE = 8.5  # points
EXTENT = (-1 - MARGIN - SIDE, PITCH * (len(VIEWS) - 1) + 1 + MARGIN)  # left and right of a row
POINTS = Page.width / (EXTENT[1] - EXTENT[0])  # for a globe's radius


@dataclass(frozen=True)
class FiveViews:
    """The four numbers: magnification S, and in degrees the graticule, the fine grid and its half-width.

    Between the lines of the graticule others may be drawn, faint, where the focus is seen.
    """

    magnification: float
    coarse: float
    fine: float
    half_width: float
    between: float | None = None

    def geometry(self) -> dict:
        """What each view shows of the images of both grids under the fisheye: circle arcs again."""
        bend = fisheye(FOCUS, magnification=self.magnification)
        coarse, fine = Graticule.regular(self.coarse), Graticule.patch(FOCUS, self.half_width, self.fine)
        rows, grids = {}, [(coarse, "coarse", LINES["graticule"]), (fine, "fine", LINES["fine"])]
        if self.between:
            grids.append((Graticule.regular(self.between), "between", FAINT.scaled(ROOM)))
        for grid, name, style in grids:
            least = WIDTHS_APART * WEIGHT * style.width / POINTS
            for number, view in enumerate(VIEWS):
                seen = name != "between" or view.depth(lonlat_to_xyz(FOCUS)) > 0
                rows[f"{name}_{number}"] = to_rows(grid.drawn(bend, view, least) if seen else [])
        return rows

    def items(self, g: dict, height: float = 0.0) -> list[Item]:
        """Five globes in a row, their middles at a height of the page, and S beside them."""
        items: list[Item] = [
            Label(f"$S = {self.magnification:g}$", (EXTENT[0], height), (5.0, 0.0), size=TYPE, rotation=90.0)
        ]
        for number, view in enumerate(VIEWS):
            names = ("coarse", "fine", "between")[: 3 if self.between else 2]
            grids = (from_rows(g[f"{name}_{number}"]) for name in names)
            items += globe(*grids).layout(view, at=(PITCH * number, height))
        return items

    def draw(self, g: dict) -> Page:
        """One row, with the names of the views."""
        return plate([self.items(g)])

    def solid(self, g: dict) -> Solid:
        """All of them in space, with every line: bodies may be looked at from anywhere and as near as one likes."""
        bend = fisheye(FOCUS, magnification=self.magnification)
        coarse, fine = graticule(self.coarse), graticule_patch(FOCUS, self.half_width, self.fine)
        whole = globe(*([bend.image_of(arc) for arc in arcs] for arcs in (coarse, fine)))
        return Solid(self.draw(g), [whole.placed(view, at=(PITCH * k, 0.0)) for k, view in enumerate(VIEWS)])


def plate(rows: Sequence[list[Item]], pitch: float = PITCH) -> Page:
    """Rows of globes, a pitch apart, the last about height 0, and the names of the views below."""
    names = [
        Label(name, (PITCH * number, -1 - MARGIN - FOOT), (0.0, 3.0), valign="baseline", size=TYPE)
        for number, name in enumerate(NAMES)
    ]
    extent = (*EXTENT, -1 - MARGIN - FOOT, pitch * (len(rows) - 1) + 1 + MARGIN)
    items = (*(item for row in rows for item in row), *names)
    return Page(extent, items, views=tuple(view.matrix for view in VIEWS) * len(rows))


def globe(coarse: Arcs, fine: Arcs, between: Arcs = ()) -> Scene:
    """One globe with its grids, coarse gray, fine black, and what is between the lines of the coarse one."""
    scene = Scene(weight=WEIGHT, limb=LIMB)
    scene.add_arcs(between, name="graticule", style=FAINT)
    scene.add_arcs(coarse, name="graticule")
    scene.add_arcs(fine, name="fine")
    return scene
