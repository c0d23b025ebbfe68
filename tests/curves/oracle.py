"""What the tests of curves compare with: distances from lines, stars told in a gnomonic plane, whole circles."""

import numpy as np

from stereodel import SphereArc
from stereodel.curves import clip
from stereodel.curves.borders import Cap
from stereodel.curves.ragged import Ragged, offsets_of
from stereodel.curves.trace import exact, great
from tests.globe.sights import distance, winding
from tests.sets import unit as units


def off_lines(points, lines):
    """How far points (n, d) are from the nearest chord of lines."""
    return np.min([np.full(len(points), np.inf), *(distance(points, line) for line in lines)], axis=0)


def ring(points):
    """One ring of great-circle edges through directions, and its row of edges."""
    points = units(points)
    return great(points, np.roll(points, -1, axis=0)), rows(len(points))


def rings(parts):
    """Several of them."""
    parts = [units(part) for part in parts]
    start, end = np.concatenate(parts), np.concatenate([np.roll(part, -1, axis=0) for part in parts])
    return great(start, end), rows(*map(len, parts))


def rows(*sizes):
    """Edges in rows of given sizes, counted through."""
    return Ragged(np.arange(sum(sizes)), offsets_of(sizes))


def whole_circles(circles):
    """Circles as two arcs each, and a row for each circle."""
    halves = []
    for circle in circles:
        center, u, _, _ = SphereArc.whole(circle).frame()
        a, b = center + u, center - u
        halves += [SphereArc(circle, a, b), SphereArc(circle, b, a)]
    return exact(halves), rows(*[2] * len(circles))


def in_sight(arcs, sides, view, tolerance=1e-4, owner=None, count=1):
    """Loops on a page of regions whose rings are rows of edges, their arcs in the axes of the Earth."""
    cap = Cap(view, tolerance)
    pieces = cap.cut(arcs.turned(view.matrix))
    samples = pieces.arcs.sampled(tolerance / view.stretch)
    owner = np.zeros(len(sides), dtype=np.intp) if owner is None else owner
    return clip.regions(sides, owner, count, pieces, samples, cap)


class Star:
    """A star about a centre, all of it nearer than 80°, with great-circle sides: in a gnomonic plane straight ones."""

    def __init__(self, rng, center, low, high, count):
        angle = np.sort(rng.uniform(0, 2 * np.pi, count))
        angle = angle[np.append(True, np.diff(angle) > 1e-3)]
        reach = np.tan(np.radians(rng.uniform(low, high, len(angle))))
        across = units(np.cross(center, rng.normal(size=3)))
        self.axes = np.stack([across, np.cross(center, across), center])
        self.plane = np.stack([reach * np.cos(angle), reach * np.sin(angle)], axis=1)
        # A gap of more than half a turn has the centre outside.
        self.round = np.diff(np.append(angle, angle[0] + 2 * np.pi)).max() < 2.9

    @property
    def points(self):
        """Vertices counterclockwise as unit vectors."""
        return units(np.column_stack([self.plane, np.ones(len(self.plane))]) @ self.axes)

    def holds(self, xyz):
        """Which unit vectors (n, 3) lie inside."""
        local = xyz @ self.axes.T
        ahead = local[:, 2] > 0
        flat = np.where(ahead[:, None], local[:, :2] / np.where(ahead, local[:, 2], 1.0)[:, None], 1e9)
        return winding([np.concatenate([self.plane, self.plane[:1]])], flat).astype(bool)

    def surrounds(self, other):
        """Whether another star about the same centre lies inside, sides and all."""
        steps = np.linspace(0, 1, 50)[:, None, None]
        after = np.roll(other.points, -1, axis=0)
        return self.holds(((1 - steps) * other.points + steps * after).reshape(-1, 3)).all()
