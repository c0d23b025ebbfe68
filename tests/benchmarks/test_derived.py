"""The measurement of what is made of a triangulation: every call is made, and the peers compute the same."""

import numpy as np
import pytest

from benchmarks import benchmark_page
from benchmarks.derived import derived, graphs, others, queries
from stereodel import PlanarDelaunay, SphericalDelaunay

RNG = np.random.default_rng(0)
UNIT = RNG.normal(size=(400, 3))
UNIT /= np.linalg.norm(UNIT, axis=1, keepdims=True)


@pytest.mark.parametrize(
    "triangulation", [PlanarDelaunay(RNG.random((200, 2))), SphericalDelaunay(UNIT[:200])], ids=str
)
def test_both_sides_compute_the_same(triangulation):
    asked = RNG.random((50, 2)) if triangulation.points.shape[1] == 2 else UNIT[200:]
    calls = queries(triangulation, asked) | graphs(triangulation) | others(triangulation)
    for workers in (1, 2):
        for words in ("nearest", "k nearest"):
            assert np.array_equal(calls[f"{words} {workers}"](), calls[f"tree {words} {workers}"]()[1])
    tree, theirs = calls["spanning 1"](), calls["scipy spanning 1"]().tocoo()
    assert set(map(tuple, tree.tolist())) == set(zip(*map(np.ndarray.tolist, theirs.coords), strict=True))
    if "matplotlib contours 1" in calls:
        ours = sum(len(contour.points) - 1 for contour in calls["contours 1"]())
        pieces = sum(len(path.vertices) for path in calls["matplotlib contours 1"]().get_paths())
        assert 0.9 < ours / pieces < 1.1


def test_the_page_tells_it():
    lines = benchmark_page.derived({"derived": derived(300)}).splitlines()
    assert len(lines) == 2 + 12
    assert all(line.count("|") == 6 for line in lines)
