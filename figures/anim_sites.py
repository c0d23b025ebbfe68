"""
Animation: sites come and go
============================

A site is inserted among 40 on the sphere, and one of them removed; then both changes are undone. The bubbles that
contain a new site are no longer empty: their triangles (orange) form the cavity, which is filled by new triangles at
the site (blue). When a site is removed, the triangles of its star are replaced. The bubbles of all new triangles are
empty, so that the result is the same as if computed from scratch. The Voronoi diagram (pale blue) follows.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
from _film import READING, SIZE, STEP, WIDTH, add_words, faded, moving, timed, whole
from _sites import on_sphere

from stereodel import SphericalDelaunay, lonlat_to_xyz
from stereodel.drawing import CircleArc, DotStyle, LineStyle, Page, Scene, Sketch, View
from stereodel.drawing.page.style import BLACK, BLUE, DOTS, FILLS, SKY, VERMILION, fainter, line, with_opacity
from stereodel.film import Film
from stereodel.sphere import SphereCircle

SITES, SEED = 40, 5
VIEW = View(20, 25)
PLACE = (27.0, 32.0)  # degrees: where a site comes
LEAVING = (40.0, 17.0)  # degrees: the site next to this goes
HEIGHT, RADIUS = 198.0, 86.0  # points
VORONOI = LineStyle(fainter(SKY, 0.45), 0.7)
GOING, COMING = FILLS["visible"], FILLS["new"]
INTRODUCTION = f"Delaunay triangles and Voronoi cells of {SITES} sites"
AGAIN = "All triangles are those of a fresh start."
BRIEF = 0.4  # seconds of a phase that has been explained

Triangle = frozenset[tuple[float, ...]]


@dataclass(frozen=True, eq=False)
class Diagram:
    """A triangulation by its sites: triangles, counterclockwise, and ridges between the centres of their bubbles."""

    sites: np.ndarray
    triangles: dict[Triangle, np.ndarray]
    ridges: dict[frozenset[Triangle], np.ndarray]

    @classmethod
    def of(cls, triangulation: SphericalDelaunay) -> "Diagram":
        """What the library has at the moment."""
        corners = triangulation.points[triangulation.simplices]
        names = [frozenset(map(tuple, rows)) for rows in corners.tolist()]
        centers = triangulation.circumcenters
        pairs = [(i, j) for i, row in enumerate(triangulation.neighbors.tolist()) for j in row if i < j]
        ridges = {frozenset((names[i], names[j])): centers[[i, j]] for i, j in pairs}
        return cls(triangulation.points.copy(), dict(zip(names, corners, strict=True)), ridges)

    @property
    def edges(self) -> dict[Triangle, np.ndarray]:
        """Sides of the triangles, each once."""
        sides = (corners[[i, j]] for corners in self.triangles.values() for i, j in ((0, 1), (1, 2), (2, 0)))
        return {frozenset(map(tuple, side.tolist())): side for side in sides}


@dataclass(frozen=True, eq=False)
class Change:
    """A site that comes or goes, and what the library makes of it."""

    site: np.ndarray
    comes: bool
    before: Diagram
    after: Diagram

    @property
    def gone(self) -> list[np.ndarray]:
        """The triangles that are no longer there: the cavity of a new site, or the star of one that goes."""
        return lost(self.before.triangles, self.after.triangles)

    @property
    def new(self) -> list[np.ndarray]:
        """The triangles that take their place."""
        return lost(self.after.triangles, self.before.triangles)

    def words(self, phase: str) -> str:
        """What happens in a phase."""
        gone, new = len(self.gone), len(self.new)
        if self.comes:
            return {
                "mark": "A site comes.",
                "bubbles": f"{gone} bubbles contain it: they are no longer empty.",
                "open": f"Their {gone} triangles go and leave a cavity.",
                "fill": f"{new} triangles join its border to the site.",
                "check": f"Their {new} bubbles are empty.",
            }[phase]
        return {
            "mark": "A site goes,",
            "open": f"and with it the {gone} triangles of its star.",
            "fill": f"{new} triangles fill the hole.",
            "check": f"Their {new} bubbles are empty.",
        }[phase]


def lost(some: dict, others: dict) -> list[np.ndarray]:
    """What some have and others have not."""
    return [value for name, value in some.items() if name not in others]


def changes() -> list[Change]:
    """A site comes, another one goes, and both are undone; the library inserts and removes."""
    triangulation = SphericalDelaunay(on_sphere(SITES, SEED))
    new, old = lonlat_to_xyz(PLACE), triangulation.points[triangulation.nearest(lonlat_to_xyz(LEAVING))].copy()
    done = []
    for site, comes in ((new, True), (old, False), (old, True), (new, False)):
        before = Diagram.of(triangulation)
        if comes:
            triangulation.insert([site])
        else:
            triangulation.remove([triangulation.nearest(site)])
        done.append(Change(site, comes, before, Diagram.of(triangulation)))
    return done


@dataclass(frozen=True)
class Moment:
    """What is drawn at once: how far a phase of a change is."""

    change: int
    phase: str = "mark"
    share: float = 0.0
    words: str = ""


def moments(all_changes: list[Change]) -> Iterator[tuple[Moment, float]]:
    """What there is; the first two changes explained phase by phase; then the same back, briefly."""
    yield Moment(0, words=INTRODUCTION), READING
    for number, change in enumerate(all_changes):
        told = number < 2
        phases = ["mark", *(["bubbles"] if change.comes else []), "open", "fill", "check", "rest"]
        for phase in phases:
            text = change.words(phase) if told and phase != "rest" else "" if told else AGAIN
            for share in moving(0.6 if told else BRIEF):
                yield Moment(number, phase, share, text), STEP
            if phase != "rest":
                yield Moment(number, phase, 1.0, text), READING - 0.6 if told else BRIEF


def frame(moment: Moment, all_changes: list[Change]) -> Page:
    """The ball with what a phase shows of a change."""
    change, share = all_changes[moment.change], moment.share
    order = ("mark", "bubbles", "open", "fill", "check", "rest")
    at = order.index(moment.phase)
    # How far each phase is: those before are done, those after have not begun.
    mark, bubbles, opened, filled, check, rest = (share if k == at else float(k < at) for k in range(len(order)))
    scene = Scene()
    add_tints(scene, change, mark=mark, opened=opened, filled=filled, strength=1 - rest)
    add_ridges(scene, change, filled)
    add_graph(scene, change, opened, filled)
    if change.comes:
        add_bubbles(scene, change.gone, VERMILION, bubbles * (1 - opened))
    add_bubbles(scene, change.new, BLUE, check * (1 - rest))
    add_sites(scene, change, mark=mark, opened=opened, rest=rest)
    sketch = Sketch().add_items(scene.layout(VIEW, at=(WIDTH / 2, HEIGHT - RADIUS - 4), scale=RADIUS))
    add_words(sketch, moment.words, 8.0)
    return whole(sketch, HEIGHT)


def add_tints(scene: Scene, change: Change, *, mark: float, opened: float, filled: float, strength: float) -> None:
    """What goes in orange, as soon as it begins to go, and what comes in blue."""
    going = opened if change.comes else mark
    for triangles, color, opacity in (
        (change.gone, GOING, going * (1 - filled)),
        (change.new, COMING, filled * strength),
    ):
        if opacity > 0:
            for a, b, c in triangles:
                scene.add_patch((a, b, c), name="triangle", color=with_opacity(color, 0.75 * opacity))


def add_ridges(scene: Scene, change: Change, filled: float) -> None:
    """The Voronoi diagram: what changes of it, changes while the hole is filled."""
    before, after = change.before.ridges, change.after.ridges
    kept = [ridge for name, ridge in before.items() if name in after]
    for ridges, strength in ((kept, 1.0), (lost(before, after), 1 - filled), (lost(after, before), filled)):
        arcs = [CircleArc.great(*ridge) for ridge in ridges]
        if strength > 0:
            scene.add_arcs(arcs, name="voronoi", style=faded(VORONOI, strength))


def add_graph(scene: Scene, change: Change, opened: float, filled: float) -> None:
    """The Delaunay edges: those of the site grow from it or shrink into it, the others of the hole fade."""
    before, after = change.before.edges, change.after.edges
    kept = [edge for name, edge in before.items() if name in after]
    scene.add_arcs([CircleArc.great(*edge) for edge in kept], name="delaunay")
    for edges, strength in ((lost(before, after), 1 - opened), (lost(after, before), filled)):
        if strength > 0:
            of_site = [edge for edge in edges if (edge == change.site).all(axis=1).any()]
            others = [edge for edge in edges if not (edge == change.site).all(axis=1).any()]
            scene.add_arcs([part(change.site, edge, strength) for edge in of_site], name="delaunay")
            style = faded(line("delaunay"), strength)
            scene.add_arcs([CircleArc.great(*edge) for edge in others], name="delaunay", style=style)


def part(site: np.ndarray, edge: np.ndarray, share: float) -> CircleArc:
    """The part of an edge next to one of its ends."""
    end = edge[1] if (edge[0] == site).all() else edge[0]
    arc = CircleArc.great(site, end)
    return CircleArc(arc.center, arc.u, arc.v, arc.start, arc.start + share * (arc.stop - arc.start))


def add_bubbles(scene: Scene, triangles: list[np.ndarray], color: tuple, strength: float) -> None:
    """Bubbles of triangles: faint discs and their circles."""
    if strength > 0:
        circles = [SphereCircle.through(*corners) for corners in triangles]
        for circle in circles:
            scene.add_cap(circle, name="small_bubble", color=with_opacity(color, 0.08 * strength))
        scene.add_circles(circles, style=LineStyle(with_opacity(color, 0.8 * strength), 0.7))


def add_sites(scene: Scene, change: Change, *, mark: float, opened: float, rest: float) -> None:
    """All sites; the one that comes grows and turns black in the end, the one that goes turns red and shrinks."""
    others = change.before.sites if change.comes else change.after.sites
    scene.add_points(others, name="sites")
    usual, special = DOTS["sites"], DOTS["points"]
    if change.comes:
        size, red = mark, 1 - rest
    else:
        size, red = 1 - opened, mark
    if size > 0:
        color = tuple(np.array(BLACK) + red * (np.array(VERMILION) - np.array(BLACK)))
        radius = size * (usual.radius + red * (special.radius - usual.radius))
        scene.add_points([change.site], style=DotStyle(color, radius, rim_width=usual.rim_width), name="points")


def film() -> Film:
    """The film of the changes."""
    all_changes = changes()
    shots, seconds = timed(moments(all_changes))
    return Film(partial(frame, all_changes=all_changes), shots, seconds=seconds, size=SIZE)


if __name__ == "__main__":
    film().main()
