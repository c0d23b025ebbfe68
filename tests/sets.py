"""Every set of points that tests ask about: once, by name, with its traits and the answers that are known.

    @pytest.mark.parametrize("points", sets.of("sphere", "ties"))   # those with all traits, a pytest id each
    sets.sphere("cluster").points                                  # one set, made when it is asked for
    sets.plane("lattice").drawn(5000)                              # about as many of its kind, for sets that grow

Traits, each checked by tests/test_sets.py:

    plane, sphere  points (n, 2), or directions (n, 3) of any length
    few            at most thirty, so that brute force is quick
    grows          drawn at random or by a rule, in any number
    ties           more than three points lie on an empty circle, exactly
    flat           no triangles: all on a line, all on a great circle, or fewer than three places
    hemisphere     of the sphere: all in a closed hemisphere
    duplicates     a place occurs twice, of the sphere a direction
    cluster        the shortest side of a triangle is less than a millionth of the longest
    needle         a triangle has an angle below a hundred-thousandth of a radian
    sizes          coordinates or lengths differ by more than a hundred powers of ten, or are that far from one
    random         drawn at random, without ties and duplicates
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, partial
from itertools import product

import numpy as np
import pytest

XY, XYZ, LONLAT = ("x", "y"), ("x", "y", "z"), ("lon", "lat")


@dataclass(frozen=True)
class PointSet:
    name: str
    traits: frozenset
    make: Callable
    """Rows by a generator and about how many are wanted."""
    columns: tuple
    size: int = 300
    triangles: int | None = None
    """How many triangles the set has, where that is known without the library."""
    hull: int | None = None
    """How many points lie on the border of a set of the plane, where that is known."""

    def rows(self, count=None, seed=20261122):
        """Rows of numbers as a file would have them: ``columns`` says what they are."""
        count = self.size if count is None else count
        return np.array(_rows(self, count, seed))

    def drawn(self, count=None, seed=20261122):
        """Points (n, 2) or directions (n, 3)."""
        rows = self.rows(count, seed)
        if self.columns != LONLAT:
            return rows
        from stereodel import lonlat_to_xyz

        return lonlat_to_xyz(rows)

    @property
    def points(self):
        """The caller's own."""
        return self.drawn()

    @property
    def space(self):
        return "plane" if self.columns == XY else "sphere"

    def __str__(self):
        return f"{self.space} {self.name}"


@cache
def _rows(one, count, seed):
    return np.asarray(one.make(np.random.default_rng(seed), count), dtype=float).reshape(-1, len(one.columns))


def of(*traits, without=()):
    """The sets with all of some traits and none of others, as parameters of a test."""
    found = [s for s in ALL.values() if s.traits.issuperset(traits) and s.traits.isdisjoint(without)]
    assert found, f"no set has all of {traits} and none of {without}"
    return [pytest.param(s, id=str(s)) for s in found]


def named(space, *names):
    """Some sets of a space, as parameters of a test."""
    return [pytest.param(ALL[space, name], id=str(ALL[space, name])) for name in names]


def plane(name):
    return ALL["plane", name]


def sphere(name):
    return ALL["sphere", name]


def directions(rng, n):
    """Unit vectors in random directions."""
    return unit(rng.normal(size=(n, 3)))


def opposite(rng, n):
    """Unit vectors of which no hemisphere holds all."""
    half = directions(rng, n)
    return np.concatenate([half, -half])


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def near(rng, center, radius, n):
    """Unit vectors around a direction."""
    return unit(center + radius * rng.normal(size=(n, 3)))


def grid(columns, rows):
    """Whole numbers, column by column."""
    return np.array(list(product(range(columns), range(rows))), dtype=float)


def cube_grid(n):
    """The whole numbers on the faces of a cube."""
    points = np.array(list(product(range(-n, n + 1), repeat=3)), dtype=float)
    return points[np.abs(points).max(axis=1) == n]


def on_circle(rng, n):
    """Of the unit circle, rounded."""
    angle = np.sort(rng.uniform(0, 2 * np.pi, n))
    return np.column_stack([np.cos(angle), np.sin(angle)])


def great_circle(rng, n):
    return np.insert(on_circle(rng, n), 2, 0.0, axis=1)


def line(rng, n):
    return np.outer(rng.permutation(n), [1.0, 3.0])


def lattice(rng, n):
    side = round(n**0.5)
    return rng.permutation(grid(side, side))


def plane_clusters(rng, n):
    return (rng.random((20, 1, 2)) + 1e-9 * rng.normal(size=(20, n // 20, 2))).reshape(-1, 2)


def sphere_clusters(rng, n):
    """Down to 1e-7 rad, a disc of the sky, and directions everywhere."""
    disc = directions(rng, n // 2) * [1, 1, 0.1]
    clusters = [near(rng, center, 10.0 ** rng.uniform(-7, -2), n // 50) for center in directions(rng, 20)]
    return np.concatenate([unit(disc), *clusters, near(rng, disc[0], 1e-7, n // 50), directions(rng, n // 10)])


def copied(points, rng):
    """With three tenths of the rows replaced by others."""
    n = len(points)
    points[rng.permutation(n)[: 3 * n // 10]] = points[rng.integers(0, n, 3 * n // 10)]
    return points


def graticule(rng, n):
    step = 180 / max(2, round(np.sqrt(n / 2)))
    lon, lat = np.meshgrid(np.arange(-180, 180, step), np.append(np.arange(-90, 89.9, step), 90))
    return rng.permutation(np.column_stack([lon.ravel(), lat.ravel()]))


def integer_directions(rng, n):
    size = max(2, round(n ** (1 / 3) / 2))
    cube = np.array(list(product(range(-size, size + 1), repeat=3)), dtype=float)
    return rng.permutation(cube[cube.any(axis=1)])


def spread(rng, n, width, decades, per):
    """Rows, or components, of sizes between ten to the power of some decades and one over it."""
    return rng.normal(size=(n, width)) * 10.0 ** rng.uniform(-decades, decades, (n, per))


def falling(rng, n, width, decades):
    return rng.normal(size=(n, width)) * 10.0 ** -(np.arange(n) % decades)[:, None]


def lengths(rng, n):
    big = np.ldexp(directions(rng, 4 * n // 5), rng.integers(-1000, 1000, (4 * n // 5, 1)))
    return np.concatenate([big, np.ldexp(big[: n // 5], 1)])


def hemisphere(rng, n):
    half = directions(rng, n)
    half[:, 0] = np.abs(half[:, 0])
    return half


def pairs_on_meridians(_, n):
    return [[lon, s * lat] for lon in np.linspace(0, 345, n // 6) for lat in (1, 5, 89) for s in (1, -1)]


def airports(_, n):
    from stereodel.data import airports

    lonlat = np.asarray(airports().lonlat, float)
    return lonlat[:: max(1, len(lonlat) // n)]


ALL = {}
CIRCLE = [[3, 4], [4, 3], [5, 0], [-3, 4], [0, -5], [-4, -3]]
AXES = np.concatenate([np.eye(3), -np.eye(3)])
CUBE = np.array(list(product((-1.0, 1.0), repeat=3)))
RIM = np.array([[3, 4, 0], [5, 0, 0], [-4, 3, 0], [0, -5, 0], [-3, -4, 0]], dtype=float)
MIDDLE = np.array([0.6, 0.0, 0.8])
TILT = np.array([[1, 2, 2], [2, 1, -2], [2, -2, 1]])
"""Three times a turn, of whole numbers."""


def _add(columns, name, traits, make, **more):
    if callable(make):
        one = PointSet(name, frozenset(traits.split()) | {"grows"}, make, columns, **more)
    else:
        few = {"few"} if len(make) <= 30 else set()
        one = PointSet(name, frozenset(traits.split()) | few, lambda *_: make, columns, **more)
    ALL[one.space, name] = replace(one, traits=one.traits | {one.space})


_plane, _sphere = partial(_add, XY), partial(_add, XYZ)

_plane("none", "flat", [], triangles=0)
_plane("one", "flat", [[1, 2]], triangles=0)
_plane("all the same", "flat duplicates", [[1, 2]] * 4, triangles=0)
_plane("two", "flat", [[1, 2], [0, 7]], triangles=0)
_plane("short line", "flat duplicates", [[k * k, 2 * k * k] for k in (3, 1, 0, 2, 4, 1)], triangles=0)
_plane("three", "random", [[0, 0], [2, 0], [0, 3]], triangles=1, hull=3)
_plane("square", "ties duplicates", [[0, 0], [2, 0], [2, 2], [0, 2], [2, 2]], triangles=2, hull=4)
_plane("line and a point", "", [[k, 0] for k in range(9)] + [[3, 1]], triangles=8, hull=10)
_plane("small grid", "ties", grid(4, 4), triangles=18, hull=12)
_plane("tenths", "ties", 0.1 * grid(4, 3), triangles=12, hull=10)
_plane("right angles", "ties", [[0, 0], [3, 0], [0, 4], [3, 4], [6, 0]], triangles=3, hull=5)
_plane("circle and center", "duplicates", [*CIRCLE, [0, 0], [3, 4]], triangles=6, hull=6)
_plane("cluster", "ties cluster needle", np.concatenate([[1, 0] + 1e-12 * grid(3, 3), [[0, 0], [9, 9]]]))
_plane("large and small", "cluster needle sizes", [[1e150, 0], [0, 1e150], [1e-150, 0], [0, 0], [5e-324, 0], [-1, -1]])
_plane("random", "random", lambda rng, n: rng.random((n, 2)))
_plane("lattice", "ties", lattice)
_plane("turned tenths", "ties needle", lambda rng, n: lattice(rng, n) @ [[0.03, 0.04], [-0.04, 0.03]])
_plane("line", "flat", line, triangles=0)
_plane("line and one", "cluster needle", lambda rng, n: np.concatenate([line(rng, n), [[5e8, 7.0]]]))
_plane("rounded circle", "", on_circle)
_plane("copied", "duplicates", lambda rng, n: copied(rng.random((n, 2)), rng))
_plane("clusters", "cluster needle random", plane_clusters)
_plane("all sizes", "cluster needle sizes", lambda rng, n: spread(rng, n, 2, 60, 1))
_plane("tiny", "random sizes", lambda rng, n: 1e-120 * rng.normal(size=(n, 2)))
_plane("huge", "random sizes", lambda rng, n: 1e150 * rng.normal(size=(n, 2)))
_plane("thin strip", "needle random", lambda rng, n: rng.random((n, 2)) * [1, 1e-4])
_plane("needles", "needle random", lambda rng, n: np.column_stack([np.arange(float(n)), 1e-13 * rng.normal(size=n)]))
_plane("parabola", "ties", lambda _, n: np.column_stack([np.arange(n) - n // 2, (np.arange(n) - n // 2) ** 2]))
_plane("mixed scales", "cluster needle sizes", lambda rng, n: falling(rng, n, 2, 300))
_plane("subnormal", "ties duplicates sizes", lambda rng, n: rng.integers(-5, 6, (n, 2)) * 5e-324, size=60)
_plane("largest", "ties duplicates sizes", lambda rng, n: rng.integers(-5, 6, (n, 2)) * 3e307, size=60)
# Of which the hull's edges alone tell what lies outside.
_plane("disc and two far", "random", lambda rng, n: [*(on_circle(rng, n) * rng.random((n, 1))), [40, 1], [-3, 50]])

_sphere("none", "flat hemisphere", [], triangles=0)
_sphere("one", "flat hemisphere", [[0, 0, 2]], triangles=0)
_sphere("one direction", "flat hemisphere duplicates", [[1, 2, 3], [2, 4, 6], [0.5, 1, 1.5]], triangles=0)
_sphere("opposite", "flat hemisphere", [[0, 0, 1], [0, 0, -3]], triangles=0)
_sphere("two", "flat hemisphere duplicates", [[0, 0, 1], [1, 0, 1], [2, 0, 2]], triangles=0)
_sphere("opposite and one more", "flat hemisphere", [[0, 0, 1], [0, 0, -3], [5, 0, 1]], triangles=0)
_sphere("short circle", "flat hemisphere", [[1, 0, 0], [0, 2, 0], [-1, 0, 0], [1, 1, 0], [0, -1, 0]], triangles=0)
_sphere("arc", "flat hemisphere", [[1, 0, 0], [5, 1, 0], [2, 2, 0], [0, 3, 0], [-1, 7, 0]], triangles=0)
_sphere("half circle", "flat hemisphere", [[1, 0, 0], [5, 1, 0], [-3, 0, 0]], triangles=0)
_sphere("wide steps", "flat hemisphere", [[100, 0, 0], [-64, 77, 0], [-77, -64, 0], [-81, -60, 0]], triangles=0)
_sphere("thirds of a circle", "flat hemisphere", [[1, -1, 0], [0, 1, -1], [-1, 0, 1]], triangles=0)
_sphere("tilted circle", "flat hemisphere", RIM @ TILT, triangles=0)
_sphere("three", "hemisphere random", np.eye(3), triangles=2)
_sphere("three close", "hemisphere random", [[1, 1e-13, 0], [1, -1e-13, 0], [1, 0, 2e-13]], triangles=2)
_sphere("small circle", "ties hemisphere", [[x, y, 1] for x, y in CIRCLE[:5]], triangles=6)
_sphere("two circles", "ties", [[x, y, z] for x, y, _ in RIM for z in (2, -3)], triangles=16)
_sphere("octahedron", "duplicates", [*AXES, [0, 0, 7]], triangles=8)
_sphere("cube", "ties", CUBE, triangles=12)
_sphere("cube and axes", "", [*CUBE, *AXES], triangles=24)
_sphere("rim and pole", "ties hemisphere", [*RIM, AXES[2]], triangles=8)
_sphere("rim and poles", "", [*RIM, AXES[2], AXES[5]], triangles=10)
_sphere("tilted rim and pole", "ties hemisphere", np.array([*RIM, AXES[2]]) @ TILT, triangles=8)
_sphere("small bowl", "ties hemisphere", [[i, j, 2] for i in range(-2, 3) for j in range(-1, 2)], triangles=26)
_sphere("closed hemisphere", "ties hemisphere", [*AXES[[0, 1, 3, 4]], [1, 1, 3], [1, 2, 0]], triangles=8)
_sphere("cluster", "ties cluster needle hemisphere", [*np.insert(1e-12 * grid(3, 3), 2, 1, axis=1), *AXES[[0, 5]]])
_sphere(
    "beside an axis",
    "ties cluster needle sizes hemisphere",
    [*([1, *p] for p in ([0, 0], [1e-300, 0], [0, 1e-300], [1e-300, 1e-300], [5e-324, 0])), [-1, 0, 0], [0, 1, 0]],
)
_sphere("random", "random", lambda rng, n: rng.normal(size=(n, 3)))
_sphere("unit", "random", directions)
_sphere("half", "random hemisphere", hemisphere)
_sphere("cap", "random hemisphere", lambda rng, n: near(rng, MIDDLE, 0.005, n))
_sphere("bowl", "ties hemisphere", lambda rng, n: np.insert(lattice(rng, n) - n**0.5 // 2, 2, 12.0, axis=1))
_sphere("clusters", "cluster needle random", sphere_clusters)
_sphere("opposites", "random", lambda rng, n: opposite(rng, n // 2))
_sphere("mirrored", "ties", lambda rng, n: np.concatenate([CUBE * v for v in directions(rng, n // 8)]))
_sphere("mixed scales", "cluster", lambda rng, n: AXES[0] + falling(rng, n, 3, 18))
_sphere(
    "ends of an axis",
    "cluster needle",
    lambda rng, n: [[s, *(1e-30 * rng.normal(size=2))] for s in (1, -1) for _ in range(n // 2)],
)
_sphere("a metre and 8 far", "cluster needle random", lambda rng, n: [*opposite(rng, 4), *near(rng, MIDDLE, 4e-8, n)])
_sphere("a rounding and 8 far", "cluster needle", lambda rng, n: [*opposite(rng, 4), *near(rng, MIDDLE, 1e-15, n)])
_sphere("copied", "duplicates", lambda rng, n: copied(directions(rng, n), rng))
_sphere("whole numbers", "duplicates", integer_directions)
_sphere("faces of a cube", "", lambda _, n: cube_grid(max(1, round((n / 24) ** 0.5))))
_sphere("lengths", "duplicates sizes", lengths)
_sphere("components", "cluster needle sizes", lambda rng, n: spread(rng, n, 3, 300, 3), size=40)
_add(LONLAT, "graticule", "duplicates", graticule)
_add(LONLAT, "pairs on meridians", "ties", pairs_on_meridians)
_add(LONLAT, "airports", "", airports)
_sphere("great circle", "flat hemisphere", great_circle, triangles=0)
_sphere("circle and a pole", "ties hemisphere", lambda rng, n: [*great_circle(rng, n), AXES[2]])
_sphere("circle and poles", "", lambda rng, n: [*great_circle(rng, n), AXES[2], AXES[5]])
_sphere("near a circle", "", lambda rng, n: rng.normal(size=(n, 3)) * [1, 1, 1e-9])
_sphere(
    "needles",
    "needle hemisphere",
    lambda rng, n: np.column_stack([np.ones(n), np.linspace(0, 1e-6, n), 1e-20 * rng.normal(size=n)]),
)
_sphere(
    "1e-200 apart",
    "cluster needle sizes hemisphere",
    lambda rng, n: np.insert(10.0 ** rng.uniform(-200, -2, (n, 2)), 0, 1.0, axis=1),
    size=100,
)
