"""Graphs of nearness by their definitions: all pairs, all third points, exact numbers."""

from dataclasses import dataclass, field
from fractions import Fraction
from functools import cmp_to_key
from itertools import combinations
from types import SimpleNamespace

import numpy as np
import pytest

from stereodel.predicates.integers import sign, sign_of_roots
from stereodel.predicates.rays import compare_directions, ray


@dataclass
class Exact:
    """Points of plane or sphere by number, as fractions or integer rays; equal ones but the first are left out."""

    points: np.ndarray
    places: list = field(init=False)
    kept: list = field(init=False)

    def __post_init__(self):
        on_sphere = self.points.shape[1] == 3
        self.places = [ray(p) if on_sphere else tuple(map(Fraction, p)) for p in self.points.tolist()]
        self.kept = [k for k, place in enumerate(self.places) if place not in self.places[:k]]

    @property
    def on_sphere(self):
        return self.points.shape[1] == 3

    def dot(self, a, b):
        return sum(x * y for x, y in zip(self.places[a][:3], self.places[b][:3], strict=True))

    def compare_lengths(self, a, b, c, d):
        if not self.on_sphere:
            return sign(self.square(a, b) - self.square(c, d))
        norms = [self.places[k][3] for k in (a, b, c, d)]
        return sign_of_roots(((self.dot(c, d), norms[0] * norms[1]), (-self.dot(a, b), norms[2] * norms[3])))

    def square(self, a, b):
        return sum((x - y) ** 2 for x, y in zip(self.places[a], self.places[b], strict=True))

    def diametral(self, a, b, p):
        if not self.on_sphere:
            (ax, ay), (bx, by), (px, py) = (self.places[k] for k in (a, b, p))
            return sign((ax - px) * (bx - px) + (ay - py) * (by - py))
        aa, bb, pp = (self.places[k][3] for k in (a, b, p))
        terms = (1, aa * bb * pp), (self.dot(a, b), pp), (-self.dot(p, a), bb), (-self.dot(p, b), aa)
        return sign_of_roots(terms)

    def compare_points(self, a, b):
        if self.on_sphere:
            return compare_directions(self.places[a], self.places[b])
        return (self.places[a] > self.places[b]) - (self.places[a] < self.places[b])

    def compare_edges(self, first, second):
        """Lengths, then ends."""
        ends = [sorted(edge, key=cmp_to_key(self.compare_points)) for edge in (first, second)]
        return (
            self.compare_lengths(*first, *second)
            or self.compare_points(ends[0][0], ends[1][0])
            or self.compare_points(ends[0][1], ends[1][1])
        )


def gabriel(exact):
    return [
        (a, b)
        for a, b in combinations(exact.kept, 2)
        if all(exact.diametral(a, b, p) > 0 for p in exact.kept if p not in (a, b))
    ]


def relative(exact):
    def is_nearer(p, end, other):
        return exact.compare_lengths(end, p, end, other) < 0

    return [
        (a, b)
        for a, b in combinations(exact.kept, 2)
        if not any(is_nearer(p, a, b) and is_nearer(p, b, a) for p in exact.kept if p not in (a, b))
    ]


def urquhart(exact, triangulation):
    longest = set()
    for triangle in triangulation.simplices.tolist():
        for a, b in combinations(sorted(triangle), 2):
            (c,) = set(triangle) - {a, b}
            if exact.compare_lengths(a, b, a, c) > 0 and exact.compare_lengths(a, b, b, c) > 0:
                longest.add((a, b))
    return [edge for edge in map(tuple, triangulation.edges.tolist()) if edge not in longest]


def spanning_tree(exact):
    """Kruskal on the complete graph."""
    tree, component = [], {k: {k} for k in exact.kept}
    for a, b in sorted(combinations(exact.kept, 2), key=cmp_to_key(exact.compare_edges)):
        if b not in component[a]:
            tree.append((a, b))
            joined = component[a] | component[b]
            component.update(dict.fromkeys(joined, joined))
    return sorted(tree)


PLANE_SETS = {
    "none": np.zeros((0, 2)),
    "one": [[1, 2]],
    "all the same": [[1, 2]] * 4,
    "two": [[1, 2], [0, 7]],
    "line": [[k * k, 2 * k * k] for k in (3, 1, 0, 2, 4, 1)],
    "grid": [[i, j] for i in range(4) for j in range(4)],
    "right angles": [[0, 0], [3, 0], [0, 4], [3, 4], [6, 0]],
    "circle and centre": [[3, 4], [4, 3], [5, 0], [-3, 4], [0, -5], [-4, -3], [0, 0], [3, 4]],
    "cluster": [[1 + i * 1e-12, j * 1e-12] for i in range(3) for j in range(3)] + [[0, 0], [9, 9]],
    "large and small": [[1e150, 0], [0, 1e150], [1e-150, 0], [0, 0], [5e-324, 0], [-1, -1]],
    "tenths": [[i * 0.1, j * 0.1] for i in range(4) for j in range(3)],
}
SPHERE_SETS = {
    "none": np.zeros((0, 3)),
    "one": [[0, 0, 2]],
    "opposite": [[0, 0, 1], [0, 0, -3]],
    "two": [[0, 0, 1], [1, 0, 1], [2, 0, 2]],
    "opposite and one more": [[0, 0, 1], [0, 0, -3], [5, 0, 1]],
    "great circle": [[1, 0, 0], [0, 2, 0], [-1, 0, 0], [1, 1, 0], [2, 2, 0], [0, -1, 0]],
    "arc": [[1, 0, 0], [5, 1, 0], [2, 2, 0], [0, 3, 0], [-1, 7, 0]],
    "half circle": [[1, 0, 0], [5, 1, 0], [-3, 0, 0]],
    "wide steps": [[100, 0, 0], [-64, 77, 0], [-77, -64, 0], [-81, -60, 0]],
    "third of a circle": [[1, -1, 0], [0, 1, -1], [-1, 0, 1]],
    "three": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
    "small circle": [[3, 4, 1], [4, 3, 1], [5, 0, 1], [-3, 4, 1], [0, -5, 1]],
    "octahedron": [[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1], [0, 0, 7]],
    "cube": [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)],
    "hemisphere": [[i, j, 2] for i in range(-2, 3) for j in range(-1, 2)],
    "closed hemisphere": [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [1, 1, 3], [1, 2, 0]],
    "cluster": [[i * 1e-12, j * 1e-12, 1] for i in range(3) for j in range(3)] + [[1, 0, 0], [0, 0, -1]],
}


@pytest.fixture(scope="session")
def definitions():
    return SimpleNamespace(
        Exact=Exact, gabriel=gabriel, relative=relative, urquhart=urquhart, spanning_tree=spanning_tree
    )


@pytest.fixture(params=PLANE_SETS)
def plane_set(request):
    return np.array(PLANE_SETS[request.param], dtype=float)


@pytest.fixture(params=SPHERE_SETS)
def sphere_set(request):
    return np.array(SPHERE_SETS[request.param], dtype=float)
