"""Divide and conquer against the readable engine: the same triangles for any order, pole and number of threads."""

import itertools
import os
import pickle
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import _kernel, lonlat_to_xyz
from stereodel.triangulation import HullInsertion, PlanarDelaunay, SphericalDelaunay, check_delaunay
from stereodel.triangulation.topology import canonical, neighbors_of

POLES = list(itertools.product(range(3), (-1, 1)))
GRID_POINT = st.tuples(st.integers(-4, 4), st.integers(-4, 4))
SMALL = st.tuples(*[st.integers(-3, 3)] * 3).filter(any)
RNG = np.random.default_rng(0)


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=1)[:, None]


def cluster(spread, size=300):
    return unit(RNG.normal(size=3)[None])[0] + spread * RNG.normal(size=(size, 3))


def graticule(step):
    return lonlat_to_xyz([[lon, lat] for lon in range(-180, 181, step) for lat in range(-90, 91, step)])


def cube_grid(n):
    points = np.array(list(itertools.product(range(-n, n + 1), repeat=3)), dtype=float)
    return points[np.abs(points).max(axis=1) == n]


def subdivided_icosahedron():
    corners = SphericalDelaunay.from_lonlat(
        [[0, 90], [0, -90]] + [[72 * k + 36 * (s < 0), s * 26.56505117707799] for s in (1, -1) for k in range(5)]
    )
    points = corners.points
    for _ in range(3):
        middles = points[SphericalDelaunay(points).edges].sum(axis=1)
        points = np.vstack([points, unit(middles)])
    return points


SPHERE = {
    "random": RNG.normal(size=(2000, 3)),
    "any length": RNG.normal(size=(300, 3)) * 10.0 ** RNG.uniform(-300, 300, (300, 1)),
    "any components": RNG.normal(size=(40, 3)) * 10.0 ** RNG.uniform(-300, 300, (40, 3)),
    "graticule": graticule(10),
    "cube grid": cube_grid(3),
    "half of the cube grid": cube_grid(3)[cube_grid(3)[:, 2] >= 0],
    "octahedron subdivided": np.array([p for p in itertools.product(range(-4, 5), repeat=3) if sum(map(abs, p)) == 4]),
    "icosahedron subdivided": subdivided_icosahedron(),
    "parallel": lonlat_to_xyz([[lon, 30] for lon in range(-180, 180, 3)]),
    "equator and pole": lonlat_to_xyz([[lon, 0] for lon in range(-180, 180, 3)] + [[0, 90]]),
    "meridian and a point": lonlat_to_xyz([[20, lat] for lat in range(-90, 91, 3)] + [[50, 10]]),
    "antipodal pairs": np.vstack([p := RNG.normal(size=(200, 3)), -p]),
    "mirrored": np.vstack([RNG.normal(size=(30, 3)) * s for s in itertools.product((1, -1), repeat=3)]),
    "mixed scales": np.vstack([[1, 0, 0] + 10.0**-k * RNG.normal(size=(20, 3)) for k in range(18)]),
    "duplicates": RNG.integers(-1, 2, (2000, 3)) + [5, 0, 0],
} | {f"cluster {s}": cluster(s) for s in (1e-3, 1e-6, 1e-9, 1e-12, 1e-13, 1e-14, 1e-15)}
SPHERE |= {f"unit {name}": unit(points) for name, points in SPHERE.items() if name.startswith("cluster")}
SPHERE |= {f"cluster {s} among others": np.vstack([cluster(s, 150), RNG.normal(size=(100, 3))]) for s in (1e-6, 1e-12)}
SPHERE |= {
    f"{s} around an end of an axis": np.column_stack([np.full(200, sign), s * RNG.normal(size=(200, 2))])
    for s, sign in itertools.product((1e-8, 1e-15, 1e-30), (-1.0, 1.0))
}
PLANE = {
    "random": RNG.random((2000, 2)),
    "grid": np.array(list(itertools.product(range(40), repeat=2)), dtype=float),
    "grid of tenths": np.array(list(itertools.product(range(40), repeat=2))) * 0.1,
    "duplicates": RNG.integers(0, 3, (3000, 2)).astype(float),
    "circle": np.array([[x, y] for x, y in itertools.product(range(-325, 326), repeat=2) if x * x + y * y == 325**2]),
    "line and a point": np.vstack([np.column_stack([np.arange(200.0), np.arange(200.0)]), [[3, 50]]]),
    "mixed scales": np.vstack([RNG.normal(size=(20, 2)) * 10.0**-k for k in range(0, 300, 10)]),
    "tiny": RNG.integers(-5, 6, (60, 2)) * 5e-324,
    "huge": RNG.integers(-5, 6, (60, 2)) * 3e307,
    "far": 1e8 + RNG.random((1000, 2)),
} | {f"cluster {s}": RNG.normal(size=2) + s * RNG.normal(size=(400, 2)) for s in (1e-6, 1e-12, 1e-15)}


def triangulate(points, workers=1, pole=(0, -1)):
    points = np.ascontiguousarray(points, dtype=float)
    if points.shape[1] == 2:
        return _kernel.plane.triangulate(points, workers)
    return _kernel.sphere.triangulate(points, workers, True, *pole)


def rows(simplices):
    return canonical(simplices).tolist()


def assert_as_the_readable_engine(points, poles):
    points = np.ascontiguousarray(points, dtype=float)
    readable = HullInsertion(points, spatial=True)
    readable.run()
    for pole in poles:
        simplices, neighbors, duplicates, dimension, _ = triangulate(points, 1, pole)
        assert dimension == readable.dimension
        assert duplicates.tolist() == readable.duplicates.tolist()
        assert rows(simplices) == readable.simplices.tolist()
        assert np.array_equal(neighbors, neighbors_of(simplices))
    check_delaunay(points, simplices)


@pytest.mark.parametrize("name", SPHERE)
def test_the_sphere_from_every_pole(name):
    assert_as_the_readable_engine(SPHERE[name], POLES)


@pytest.mark.parametrize("name", PLANE)
def test_the_plane(name):
    assert_as_the_readable_engine(PLANE[name], [None])


@given(st.lists(SMALL, max_size=14), st.sampled_from(POLES))
def test_small_integers_on_the_sphere(points, pole):
    assert_as_the_readable_engine(np.reshape(points, (-1, 3)), [pole])


@given(st.lists(GRID_POINT, max_size=20))
def test_small_integers_in_the_plane(points):
    assert_as_the_readable_engine(np.reshape(points, (-1, 2)), [None])


@pytest.mark.parametrize("name", ["random", "graticule", "cube grid", "unit cluster 1e-12", "duplicates", "mirrored"])
def test_ten_orders_give_the_same_triangles(name):
    points = np.asarray(SPHERE[name], dtype=float)
    simplices, _, duplicates, _, _ = triangulate(points)
    first = np.arange(len(points))
    first[duplicates[:, 0]] = duplicates[:, 1]
    expected = {frozenset(row) for row in simplices.tolist()}
    for seed in range(10):
        order = np.random.default_rng(seed).permutation(len(points))
        simplices = triangulate(points[order], pole=POLES[seed % 6])[0]
        assert {frozenset(row) for row in first[order[simplices]].tolist()} == expected


LARGER = {
    "plane": RNG.random((60_000, 2)),
    "plane grid": np.array(list(itertools.product(range(250), range(200))), dtype=float),
    "sphere": RNG.normal(size=(60_000, 3)),
    "sphere clusters": np.vstack([cluster(1e-9, 5000) for _ in range(6)]),
    "graticule": graticule(1),
}


@pytest.mark.parametrize("name", LARGER)
def test_threads_change_nothing_not_even_the_rows(name):
    one = triangulate(LARGER[name], 1)
    for workers in (2, 3, 7):
        for array, other in zip(one, triangulate(LARGER[name], workers), strict=True):
            assert np.array_equal(array, other) if isinstance(array, np.ndarray) else array == other
    check_delaunay(LARGER[name], one[0])


@pytest.mark.parametrize("name", LARGER)
def test_rows_follow_a_curve(name):
    """Triangles that follow one another mostly touch: what makes everything after fast."""
    simplices = triangulate(LARGER[name])[0]
    touch = (simplices[1:, :, None] == simplices[:-1, None, :]).any(axis=(1, 2))
    assert touch.mean() > 0.5


def test_many_threads_may_ask_at_the_same_time():
    triangulation = SphericalDelaunay(LARGER["sphere"])
    queries = np.random.default_rng(1).normal(size=(4000, 3))
    alone = triangulation.find_simplex(queries), triangulation.nearest(queries)
    with ThreadPoolExecutor(8) as pool:
        asked = [pool.submit(lambda: (triangulation.find_simplex(queries), triangulation.nearest(queries)))] * 16
        for answer in asked:
            assert all(np.array_equal(a, b) for a, b in zip(answer.result(), alone, strict=True))


@pytest.mark.parametrize("cls", [PlanarDelaunay, SphericalDelaunay])
def test_a_pickle_after_changes_is_the_same_triangulation(cls):
    width = 2 if cls is PlanarDelaunay else 3
    triangulation = cls(np.random.default_rng(2).normal(size=(200, width)))
    triangulation.insert(np.random.default_rng(3).normal(size=(50, width)))
    triangulation.remove([3, 5, 201])
    other = pickle.loads(pickle.dumps(triangulation))
    assert repr(other) == repr(triangulation)
    assert other.inconclusive == triangulation.inconclusive
    for name in ("points", "simplices", "neighbors", "duplicates"):
        assert np.array_equal(getattr(other, name), getattr(triangulation, name))
        assert not getattr(other, name).flags.writeable
    other.remove([0])
    check_delaunay(other)


def test_the_readable_engine_and_the_kernel_count_the_same_ties():
    """Four points of one circle: one tie at least, whoever asks."""
    assert triangulate([[0, 0], [1, 0], [1, 1], [0, 1]])[4]["exact"] >= 1
    assert triangulate(cube_grid(1))[4]["exact"] >= 6


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="limits of memory are Linux's")
@pytest.mark.skipif("libasan" in os.environ.get("LD_PRELOAD", ""), reason="the sanitizer reserves terabytes")
def test_memory_that_cannot_be_had_is_an_error():
    program = """
import resource
import numpy as np
from stereodel import PlanarDelaunay, SphericalDelaunay, check_delaunay
plane, sphere = np.random.default_rng(0).random((2_000_000, 2)), np.random.default_rng(0).normal(size=(2_000_000, 3))
used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + 150_000_000, resource.RLIM_INFINITY))
for cls, points in ((PlanarDelaunay, plane), (SphericalDelaunay, sphere)):
    for workers in (1, 2):
        try:
            cls(points, workers=workers)
        except MemoryError:
            print("no memory")
        check_delaunay(cls(points[:1000]))
"""
    ran = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, timeout=300)
    assert ran.stdout.split("\n")[:-1] == ["no memory"] * 4, ran.stderr
