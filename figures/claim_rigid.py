r"""
Claims P15 and P25: conformal maps form a group, and are rigid
==============================================================

Left, a patch of the Earth through a lens and then through another: the composition of conformal maps is conformal. Maps
of the sphere that preserve angles and agree on a patch, however small, agree everywhere. So there is one that continues
the patch, in the middle; three points of the patch (dots) and their images determine it. Right, the mirror image of the
Earth in the plane of the equator, through the same map. That preserves the size of angles, too, but turns them round.
It agrees with the other map along the equator (blue), where all coasts and rivers meet it at the same places, and
nowhere else.

Chosen by us: the lenses, the patch, the mirror and the view.
"""

import numpy as np

from stereodel import MoebiusMap, SphereCircle, fisheye
from stereodel.conformal import three_points
from stereodel.data import borders, coastlines, land, rivers
from stereodel.drawing import LineStyle, Page, View
from stereodel.drawing.page.style import BLUE, FILLS, MAP_FILLS, MAP_LINES, VERMILION
from stereodel.globe import Globe, Panel, panels
from stereodel.render import Figure

LENSES = (((30.0, 12.0), 1.4), ((5.0, -6.0), 1.5))  # foci in degrees, and magnifications
PATCH = SphereCircle.around((9.0, 4.0), 10.0)
EQUATOR = SphereCircle((0.0, 0.0, 1.0), 0.0)
RIM, LINE = LineStyle(VERMILION, 1.1), LineStyle(BLUE, 1.0)
VIEW = View(14.0, 10.0)
TITLES = ("a patch", "the one map that continues it", "its mirror image")


def composed() -> MoebiusMap:
    """The second lens after the first."""
    (first, size), (second, other) = LENSES
    return fisheye(second, magnification=other) @ fisheye(first, magnification=size)


def geometry() -> dict:
    """Three points of the rim of the patch and their images under the composition."""
    points = PATCH.sample(3)
    return {"points": points, "images": composed()(points)}


def earth(*, mirrored: bool) -> Globe:
    """Land and sea, or their mirror image in the plane of the equator."""
    globe, side = Globe(), np.array([1.0, -1.0 if mirrored else 1.0])
    globe.add_polygons(
        [[side * ring for ring in rings] for rings in land("110m").polygons()],
        color=MAP_FILLS["land"],
        outline=None,
        name="land",
    )
    globe.add_graticule(15)
    for name, lines in (("rivers", rivers("50m")), ("borders", borders("110m")), ("coast", coastlines("110m"))):
        globe.add_lines([side * line for line in lines.lines()], style=MAP_LINES[name], name=name)
    return globe


def draw(g: dict) -> Page:
    """Three globes through the same map."""
    lens = three_points(g["points"], g["images"])
    globes = [earth(mirrored=number == 2) for number in range(3)]
    for globe in globes[1:]:
        globe.add_circles([EQUATOR], color=None, style=LINE, name="equator")
    for globe, hidden in zip(globes, (FILLS["ball"], None), strict=False):
        globe.add_circles([PATCH.complement], color=hidden, style=RIM, name="patch")
        globe.add_points(g["points"])
    return panels([Panel(globe, lens, VIEW, title) for globe, title in zip(globes, TITLES, strict=True)])


FIGURE = Figure("claim_rigid", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
