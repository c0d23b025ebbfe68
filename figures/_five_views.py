"""Figures 10 to 12: five orthographic views of a globe under the fisheye, which differ in four numbers."""

from dataclasses import dataclass

from _arcs import from_rows, to_rows

from stereodel import fisheye
from stereodel.drawing import Page, Scene, Solid, View
from stereodel.sphere import graticule, graticule_patch

FOCUS = (0.0, 40.0)  # degrees
VIEWS = (View(0, 0), View(0, 90), View(0, -90), View(0, 40), View(180, -40))
PITCH, MARGIN = 2.14, 0.03  # globe radii
WEIGHT = 0.65  # of the lines: the globes are small


@dataclass(frozen=True)
class FiveViews:
    """The four numbers: magnification S, and in degrees the graticule, the fine grid and its half-width."""

    magnification: float
    coarse: float
    fine: float
    half_width: float

    def geometry(self) -> dict:
        """The images of both grids under the fisheye: circle arcs again."""
        bend = fisheye(FOCUS, magnification=self.magnification)
        patch = graticule_patch(FOCUS, self.half_width, self.fine)
        return {
            "coarse": to_rows(bend.image_of(arc) for arc in graticule(self.coarse)),
            "fine": to_rows(bend.image_of(arc) for arc in patch),
        }

    def scenes(self, g: dict) -> list:
        """Five globes in a row."""
        return [globe(g).placed(view, at=(PITCH * number, 0.0)) for number, view in enumerate(VIEWS)]

    def draw(self, g: dict) -> Page:
        """What is seen of them."""
        items = tuple(item for placed in self.scenes(g) for item in placed.page_items())
        reach = 1 + MARGIN
        extent = (-reach, PITCH * (len(VIEWS) - 1) + reach, -reach, reach)
        return Page(extent, items, views=tuple(view.matrix for view in VIEWS))

    def solid(self, g: dict) -> Solid:
        """All of them in space."""
        return Solid(self.draw(g), self.scenes(g))


def globe(g: dict) -> Scene:
    """One globe with both grids, coarse gray, fine black."""
    scene = Scene(weight=WEIGHT)
    scene.add_arcs(from_rows(g["coarse"]), name="graticule")
    scene.add_arcs(from_rows(g["fine"]), name="fine")
    return scene
