"""What bounds the triangles of a patch, and whether a path in a vector file is that."""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from stereodel.constants import FINEST_POINTS
from tests.images.marks import PLACE, area, distances


class PatchBoundary:
    """The boundary of a patch: sides of its triangles that no triangle has the other way round."""

    def __init__(self, points, patch, middle):
        self.points, self.middle = points, middle
        corners = points[patch.faces]
        (x, y), (u, v) = ((corners[:, k] - corners[:, 0]).T for k in (1, 2))
        self.area = float((x * v - y * u).sum() / 2)
        faces = patch.faces.astype(np.intp)
        sides = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
        sides = sides[sides[:, 0] != sides[:, 1]]
        codes, counts = np.unique(sides[:, 0] * len(points) + sides[:, 1], return_counts=True)
        begin, end = np.divmod(codes, len(points))
        back = np.searchsorted(codes, end * len(points) + begin).clip(max=len(codes) - 1)
        counts_back = np.where(codes[back] == end * len(points) + begin, counts[back], 0)
        bounds = counts > counts_back
        self.sides = np.stack([begin, end], axis=1)[bounds]
        self.times = (counts - counts_back)[bounds]
        self.on_rim = patch.rim[self.sides].all(axis=1)

    def wrong(self, mark):
        """What is wrong with a path that is filled in place of the triangles."""
        chords = mark.path.chords()[0]
        sides, more = self.drawn()
        away = distances(chords[:, 0], sides, FINEST_POINTS)
        if away.max(initial=0.0) > FINEST_POINTS + PLACE:
            return f"the outline lies {away.max():.4g} points off"
        there = np.unique(self.sides)
        missing = there[distances(self.points[there], chords, FINEST_POINTS) > FINEST_POINTS + PLACE]
        if len(missing):
            longest = self.longest_loop(missing)
            if longest > 2 * FINEST_POINTS + PLACE:
                return f"a loop {longest:.4g} points long is missing"
        length = float(np.linalg.norm(chords[:, 1] - chords[:, 0], axis=1).sum())
        off = abs(float(area(mark.path).sum()) - self.area - more)
        return f"the area is {off:.4g} square points off" if off > FINEST_POINTS * (length + 1) else ""

    def drawn(self):
        """The sides as segments, those on the rim as chords of the circle, and by how much these add to the area."""
        straight = self.points[self.sides[~self.on_rim]]
        start, end = (self.points[self.sides[self.on_rim][:, k]] - self.middle for k in (0, 1))
        sweep = np.arctan2(start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0], (start * end).sum(axis=1))
        radius = np.linalg.norm(start, axis=1)
        s = np.linspace(0.0, 1.0, 65)[None, :] * sweep[:, None]
        arc = (
            start[:, None] * np.cos(s)[..., None]
            + np.stack([-start[:, 1], start[:, 0]], axis=1)[:, None] * np.sin(s)[..., None]
        )
        arcs = np.stack([arc[:, :-1], arc[:, 1:]], axis=2).reshape(-1, 2, 2) + self.middle
        more = float((self.times[self.on_rim] * radius**2 * (sweep - np.sin(sweep)) / 2).sum())
        return np.concatenate([straight, arcs]), more

    def longest_loop(self, among):
        """Length of the longest loop that has corners `among` its own."""
        n = len(self.points)
        joined = coo_array((np.ones(len(self.sides)), (self.sides[:, 0], self.sides[:, 1])), shape=(n, n))
        loop = connected_components(joined, directed=False)[1]
        length = np.linalg.norm(self.points[self.sides[:, 0]] - self.points[self.sides[:, 1]], axis=1)
        lengths = np.bincount(loop[self.sides[:, 0]], weights=length, minlength=n)
        return float(lengths[loop[among]].max())
