"""Graphs of nearness by their definitions: all pairs, all third points, exact numbers."""

from dataclasses import dataclass, field
from fractions import Fraction
from functools import cmp_to_key
from itertools import combinations

import numpy as np

from tests.reference import compare_directions, ray, sign, sign_of_roots
from tests.spaces import dot


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
        return dot(self.places[a], self.places[b])

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
