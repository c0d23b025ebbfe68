"""Stars of points read block by block while bubbles reach into others: the answers of all points at once."""

from itertools import pairwise

import numpy as np
import pytest

from stereodel import (
    PlanarDelaunay,
    PlanarVoronoi,
    SphericalDelaunay,
    SphericalVoronoi,
    _kernel,
    lonlat_to_xyz,
)
from stereodel._spaces import space_of
from stereodel.interpolation import LinearInterpolator, NaturalNeighborInterpolator


@pytest.fixture
def rng():
    return np.random.default_rng(20261122)


def directions(rng, n):
    v = rng.normal(size=(n, 3))
    return v / np.linalg.norm(v, axis=1)[:, None]


def near(rng, center, radius, n):
    v = center + radius * rng.normal(size=(n, 3))
    return v / np.linalg.norm(v, axis=1)[:, None]


def uniform(rng):
    return directions(rng, 3000)


def hemisphere(rng):
    v = directions(rng, 2000)
    v[:, 0] = np.abs(v[:, 0])
    return v


def clusters(rng):
    return np.concatenate([near(rng, c, 10.0 ** rng.uniform(-7, -2), 100) for c in directions(rng, 20)])


def dense_and_far(rng):
    return np.concatenate([directions(rng, 8), near(rng, directions(rng, 1)[0], 4e-8, 2000)])


def with_duplicates(rng):
    v = directions(rng, 2000)
    v[rng.permutation(2000)[:600]] = v[rng.integers(0, 2000, 600)]
    return v


def integer_directions(rng):
    cube = np.stack(np.meshgrid(*[np.arange(-5, 6)] * 3), -1).reshape(-1, 3)
    return rng.permutation(cube[np.abs(cube).max(axis=1) > 0]).astype(float)


def lengths(rng):
    v = np.ldexp(directions(rng, 400), rng.integers(-1000, 1000, (400, 1)))
    return np.concatenate([v, np.ldexp(v[:80], 1), 3 * np.ldexp(v[80:160], -5)])


def graticule(rng):
    lon, lat = np.meshgrid(np.arange(-180, 180, 6.0), np.arange(-90, 90.1, 6.0))
    return rng.permutation(lonlat_to_xyz(np.column_stack([lon.ravel(), lat.ravel()])))


def circle_and_pole(_):
    s = np.linspace(0, 6, 300)
    return np.concatenate([np.column_stack([np.cos(s), np.sin(s), 0 * s]), [[0.0, 0.0, 1.0]]])


def lattice(rng):
    x, y = np.meshgrid(np.arange(45.0), np.arange(45.0))
    return rng.permutation(np.column_stack([x.ravel(), y.ravel()]))


def square(rng):
    w = rng.uniform(size=(3000, 2))
    w[:500] = w[rng.integers(500, 3000, 500)]
    return w


def many_sizes(rng):
    return rng.normal(size=(1500, 2)) * 10.0 ** rng.uniform(-60, 60, (1500, 1))


def tiny(rng):
    return rng.normal(size=(1000, 2)) * 1e-120


def ring(rng):
    """Of which the hull's edges alone tell what lies outside: two points far beyond a dense disc."""
    s = rng.uniform(0, 2 * np.pi, 1500)
    return np.concatenate(
        [np.column_stack([np.cos(s), np.sin(s)]) * rng.uniform(0, 1, (1500, 1)), [[40, 1], [-3, 50.0]]]
    )


SPHERES = (
    uniform, hemisphere, clusters, dense_and_far, with_duplicates, integer_directions, lengths, graticule,
    circle_and_pole,
)  # fmt: skip
PLANES = lattice, square, many_sizes, tiny, ring


def in_memory(points):
    """Triangles by number, closing ones told; kept, degree, area and nearest of each point."""
    sphere = points.shape[1] == 3
    mesh = SphericalDelaunay(points) if sphere else PlanarDelaunay(points)
    diagram = SphericalVoronoi(mesh) if sphere else PlanarVoronoi(mesh)
    kept = np.arange(len(points))
    kept[mesh.duplicates[:, 0]] = mesh.duplicates[:, 1]
    found = mesh.nearest(points, k=2)
    nearest = np.where(found[:, 0] == np.arange(len(points)), found[:, 1], found[:, 0])
    return mesh.simplices, (kept, np.diff(diagram.region_offsets), diagram.areas(), nearest)


class Parts:
    """Points in parts of a k-d tree, their blocks in one tree of boxes. Rows in memory stand for files."""

    def __init__(self, points, count, size):
        self.points, self.space = points, space_of(points)
        x = points if points.shape[1] == 2 else points / np.abs(points).max(axis=1)[:, None]
        axis, value = np.zeros(count - 1, np.int32), np.zeros(count - 1)
        rows = {0: np.arange(len(points))}
        for node in range(count - 1):
            inside = x[rows[node]]
            axis[node] = np.argmax(np.ptp(inside, axis=0)) if len(inside) else 0
            value[node] = np.median(inside[:, axis[node]]) if len(inside) else 0.0
            right = inside[:, axis[node]] > value[node]
            rows[2 * node + 1], rows[2 * node + 2] = rows[node][~right], rows[node][right]
        part = self.space.part_of(points, axis, value)
        self.ids, self.part, self.first, lows, highs = [], [], [0], [], []
        for k in range(count):
            own = np.flatnonzero(part == k)
            order, starts, low, high = self.space.blocks(points[own], size)
            self.ids += [own[order[a:b]] for a, b in pairwise(starts)]
            self.part += [k] * (len(starts) - 1)
            lows.append(low)
            highs.append(high)
        self.part = np.array(self.part)
        self.tree = self.space.box_tree(np.concatenate(lows), np.concatenate(highs))

    def solve(self, part, open_bubbles=None):
        """Triangles and cells of a part, and how many points were read for them."""
        open_bubbles = open_bubbles or self.space.open_bubbles
        lows, highs, first = self.tree
        own = self.part == part
        wanted = np.concatenate([np.zeros(0, int), *(self.ids[k] for k in np.flatnonzero(own))])
        read = own | self.space.near_blocks(own, 0.15, lows, highs, first, _kernel.unread_counts(~own, first))
        while True:
            ids = np.concatenate([self.ids[k] for k in np.flatnonzero(read)])
            points = np.ascontiguousarray(self.points[ids])
            simplices, neighbors, duplicates, dimension, _ = self.space.triangulate(points)
            if dimension < 2:
                assert not read.all()
                read[:] = True
                continue
            kept = np.arange(len(ids))
            kept[duplicates[:, 0]] = duplicates[:, 1]
            mine = np.isin(ids, wanted)
            site = np.zeros(len(ids), bool)
            site[kept[mine]] = True
            faces = simplices
            if points.shape[1] == 2:
                t, k = np.nonzero(neighbors < 0)
                edges = np.column_stack([simplices[t, (k + 1) % 3], simplices[t, (k + 2) % 3], np.full(len(t), -1)])
                faces = np.concatenate([simplices, edges.astype(np.int32)])
            unread = _kernel.unread_counts(~read, first)
            is_open, depth = open_bubbles(points, faces, lows, highs, first, unread, site)
            assert is_open.any() == (depth > 0).any()
            assert not depth[read].any()
            if not is_open.any():
                break
            read |= depth > 0
        rows = np.flatnonzero(mine).astype(np.int32)
        cells = self.space.final_cells(points, simplices, neighbors, duplicates, ids, rows)
        triangles, _ = self.space.final_triangles(points, simplices, duplicates, ids, mine)
        return ids[rows], cells, triangles, len(ids)


def check(points, count, size=32, open_bubbles=None):
    simplices, values = in_memory(points)
    parts = Parts(points, count, size)
    solved = [parts.solve(k, open_bubbles) for k in np.unique(parts.part)]
    triangles = np.concatenate([triangles for _, _, triangles, _ in solved])
    assert np.array_equal(triangles[np.lexsort(triangles.T[::-1])], simplices[np.lexsort(simplices.T[::-1])])
    ids = np.concatenate([ids for ids, *_ in solved])
    assert np.array_equal(np.sort(ids), np.arange(len(points)))
    for place, right in enumerate(values):
        found = np.concatenate([cells[place] for _, cells, *_ in solved])
        assert np.array_equal(found, right[ids])
    return sum(read for *_, read in solved)


@pytest.mark.parametrize("count", [1, 5, 16])
@pytest.mark.parametrize("make", SPHERES + PLANES)
def test_parts_agree_with_all_points(make, count, rng):
    check(make(rng), count)


@pytest.mark.parametrize("make", [uniform, square])
def test_little_more_than_the_own_points_is_read(make, rng):
    assert check(make(rng), 4, 16) < 1.9 * 3000


def rounds(parts, open_of):
    """Ids of the points that were read when nothing is open any more; open_of(points, *tree) tells what is."""
    lows, highs, first = parts.tree
    read = np.arange(len(parts.part)) % 4 == 0
    for _ in range(len(read)):
        ids = np.sort(np.concatenate([parts.ids[k] for k in np.flatnonzero(read)]))
        is_open, depth = open_of(parts.points[ids], lows, highs, first, _kernel.unread_counts(~read, first))
        assert is_open.any() == (depth > 0).any()
        if not is_open.any():
            return ids
        read |= depth > 0
    raise AssertionError("something stays open, with all points read")


def queries_near(points, rng):
    """Near some points, at them and between them."""
    few = points[rng.integers(0, len(points), 12)]
    if points.shape[1] == 3:
        few = few / np.abs(few).max(axis=1)[:, None]
    spread = np.ptp(few, axis=0).max() * 10.0 ** rng.uniform(-3, -1, (12, 1))
    return np.concatenate(
        [few[:4] + spread[:4] * rng.normal(size=(4, few.shape[1])), few[4:8], (few[:4] + few[8:]) / 2]
    )


def triangulation(points):
    return SphericalDelaunay(points) if points.shape[1] == 3 else PlanarDelaunay(points)


@pytest.mark.parametrize("k", [1, 7])
@pytest.mark.parametrize("make", [uniform, hemisphere, with_duplicates, integer_directions, lattice, square, ring])
def test_nearest_points_of_targets(make, k, rng):
    points = make(rng)
    queries = queries_near(points, rng)

    def open_of(read, *tree):
        found = triangulation(read).nearest(queries, k=k)
        return space_of(points).open_discs(queries, read[found[:, -1]], *tree)

    ids = rounds(Parts(points, 16, 16), open_of)
    assert len(points) / 4 < len(ids) < len(points)
    found = ids[triangulation(points[ids]).nearest(queries, k=k)]
    assert np.array_equal(found, triangulation(points).nearest(queries, k=k))


@pytest.mark.parametrize("natural", [False, True])
@pytest.mark.parametrize("make", [uniform, hemisphere, with_duplicates, integer_directions, lattice, square, ring])
def test_interpolation_at_targets(make, natural, rng):
    points = make(rng)
    values, queries = rng.normal(size=len(points)), queries_near(points, rng)
    kind = NaturalNeighborInterpolator if natural else LinearInterpolator

    def open_of(read, *tree):
        mesh = triangulation(read)
        closing = mesh.closing if points.shape[1] == 3 else None
        if mesh.dimension < 2 or (closing is not None and closing.all()):
            return np.ones(1, bool), (tree[-1][: tree[-2][1]] > 0).astype(float)
        arrays = mesh.points, mesh.simplices, mesh.neighbors
        return space_of(points).open_targets(*arrays, queries, *tree, closing, natural)

    ids = rounds(Parts(points, 16, 16), open_of)
    assert len(points) / 3 < len(ids) < len(points)
    found = kind(triangulation(points[ids]), values[ids])(queries)
    assert np.array_equal(found, kind(triangulation(points), values)(queries), equal_nan=True)


@pytest.mark.parametrize("natural", [False, True])
@pytest.mark.parametrize("width", [2, 3])
def test_a_hidden_point_changes_open_targets_alone(width, natural, rng):
    points, queries = rng.normal(size=(30, width)), rng.normal(size=(40, width))
    mesh, values = triangulation(points), rng.normal(size=31)
    kind = NaturalNeighborInterpolator if natural else LinearInterpolator
    before, changed, told = kind(mesh, values[:30])(queries), 0, 0
    for hidden in rng.normal(size=(100, 1, width)):
        after = kind(triangulation(np.concatenate([points, hidden])), values)(queries)
        differs = ~np.isclose(before, after, rtol=1e-9, atol=0, equal_nan=True)
        tree = space_of(points).box_tree(*space_of(points).blocks(hidden, 1)[2:])
        arrays = mesh.points, mesh.simplices, mesh.neighbors, queries
        closing = mesh.closing if width == 3 else None
        is_open, _ = space_of(points).open_targets(*arrays, *tree, np.ones(1, np.int32), closing, natural)
        assert not (differs & ~is_open).any()
        changed, told = changed + differs.sum(), told + is_open.sum()
    assert 0.01 * 4000 < changed <= told < 0.6 * 4000


def all_final(points, faces, lows, highs, first, unread, wanted):
    return np.zeros(len(faces), bool), np.zeros(first[1])


def without(which):
    """The kernel's answer, but that some faces are never open."""

    def open_bubbles(points, faces, lows, highs, first, unread, wanted):
        rest = faces[~which(points, faces)]
        found, depth = space_of(points).open_bubbles(points, rest, lows, highs, first, unread, wanted)
        is_open = np.zeros(len(faces), bool)
        is_open[~which(points, faces)] = found
        return is_open, depth

    return open_bubbles


def is_hull_edge(_, faces):
    return faces[:, 2] < 0


def is_closing(points, faces):
    return _kernel.sphere.closing(points, faces)


@pytest.mark.parametrize(
    ("make", "mutant"),
    [
        (hemisphere, all_final),
        (ring, all_final),
        (with_duplicates, all_final),
        (hemisphere, without(is_closing)),
        (ring, without(is_hull_edge)),
    ],
)
def test_it_takes_each_question(make, mutant, rng):
    """Parts that are told too little to be open disagree: so the sets above can tell."""
    with pytest.raises(AssertionError):
        check(make(rng), 16, open_bubbles=mutant)
