"""What bounds polygons of a page, and whether a path in a vector file is that."""

import numpy as np

from stereodel.constants import FINEST_POINTS
from tests.images.marks import PLACE, area, distances


class LoopsBoundary:
    """Closed loops (k, 2) each, in points, their first point again at the end."""

    def __init__(self, loops):
        self.points = np.concatenate(loops)
        self.loop = np.repeat(np.arange(len(loops)), [len(loop) for loop in loops])
        self.sides = np.concatenate([np.stack([loop[:-1], loop[1:]], axis=1) for loop in loops])
        self.lengths = np.array([np.linalg.norm(np.diff(loop, axis=0), axis=1).sum() for loop in loops])
        self.areas = np.array([_area(loop) for loop in loops])

    def wrong(self, mark):
        """What is wrong with a path that is filled in place of the loops."""
        chords = mark.path.chords()[0]
        away = distances(chords[:, 0], self.sides, FINEST_POINTS)
        if away.max(initial=0.0) > AWAY:
            return f"the outline lies {away.max():.4g} points off"
        lost = distances(self.points, chords, FINEST_POINTS) > AWAY
        wide = np.unique(self.loop[lost])
        wide = wide[np.abs(self.areas[wide]) > THIN * self.lengths[wide]]
        longest = self.lengths[wide].max(initial=0.0)
        if longest > LOST:
            return f"a loop {longest:.4g} points long is missing"
        length = float(np.linalg.norm(chords[:, 1] - chords[:, 0], axis=1).sum())
        off = abs(float(area(mark.path).sum()) - self.areas.sum())
        return f"the area is {off:.4g} square points off" if off > FINEST_POINTS * (length + 1) else ""


AWAY = 1.05 * FINEST_POINTS + PLACE
"""How far corners may be from what is drawn: one stands for all in a piece of a length, and may then be left out."""

LOST = 4 * FINEST_POINTS + PLACE
"""Loops that are no longer than this may fall out: one of three corners in as many pieces of the length."""

THIN = FINEST_POINTS / 20
"""Area for its length, points, of loops that may fall out however long they are: they are straightened to lines."""


def union_boundary(loops):
    """What bounds regions that share their sides: those that one loop alone has, end to end."""
    places = [loop @ (1.0, 1.0j) for loop in loops]
    sides = np.concatenate([np.stack([place[:-1], place[1:]], axis=1) for place in places])
    ends, numbers = np.unique(sides, return_inverse=True)
    begin, end = numbers.reshape(-1, 2).T
    there, back = begin * len(ends) + end, end * len(ends) + begin
    alone = (begin != end) & ~np.isin(back, there)
    left = dict(zip(begin[alone].tolist(), end[alone].tolist(), strict=True))
    runs = []
    while left:
        run = [next(iter(left))]
        while run[-1] in left:
            run.append(left.pop(run[-1]))
        runs.append(np.stack([ends[run].real, ends[run].imag], axis=1))
    return LoopsBoundary(runs)


def _area(loop):
    x, y = (loop[:-1] - loop[0]).T
    return float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2)
