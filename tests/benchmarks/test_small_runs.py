"""Small runs of the measurements: every call is made, both sides compute the same, and the pages tell it."""

from pathlib import Path

import numpy as np
import pytest

from benchmarks import benchmark_page, compilers
from benchmarks.conformal_maps import coastline, conformal_maps
from benchmarks.derived import derived, graphs, others, queries
from benchmarks.map_files import FORMATS, measure, table
from stereodel import PlanarDelaunay, SphericalDelaunay
from tests import sets

UNIT = sets.sphere("unit").drawn(400)


def test_coastline_points_are_as_many_as_asked_and_different():
    points = coastline(200_000)
    assert points.shape == (200_000, 2)
    assert len(np.unique(points, axis=0)) > 190_000


def test_both_sides_compute_the_same_map_and_the_page_tells_it():
    measured = conformal_maps(1000)
    assert measured["places"]["largest gap in degrees"] < 1e-9
    lines = benchmark_page.conformal_maps({"conformal maps": measured}).splitlines()
    assert len(lines) == 2 + 9


@pytest.mark.parametrize(
    "triangulation", [PlanarDelaunay(sets.plane("random").drawn(200)), SphericalDelaunay(UNIT[:200])], ids=str
)
def test_both_sides_compute_the_same(triangulation):
    asked = sets.plane("random").drawn(50, 1) if triangulation.points.shape[1] == 2 else UNIT[200:]
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


@pytest.mark.thorough
@pytest.mark.parametrize("kind", ["parquet", "fgb"])
def test_a_format_is_measured_in_a_process_of_its_own(kind):
    row = measure(kind, 100)
    assert row["seconds"] > 0
    assert row["busy"] > 0
    assert 30e6 < row["peak"] < 4e9  # sanitizers take two
    head, rule, line = table([row]).splitlines()
    assert line.startswith(f"| {FORMATS[kind]} | ")
    assert head.count("|") == rule.count("|") == line.count("|")


# Two kernels, one of each compiler: in turn, by least times, and only if they answer the same.


def said(bits, seconds):
    return {"bits": bits, "triangulation": seconds}


def test_least_times_are_taken_in_turn(monkeypatch):
    asked = []

    def run(folder, points):
        asked.append(folder.name)
        return said("0", 2.0 - 0.1 * len(asked))

    monkeypatch.setattr(compilers, "run", run)
    least = compilers.measure({"own": Path("own"), "zig": Path("zig")}, points=10, rounds=2)
    assert asked == ["own", "zig", "zig", "own"]
    assert least == {"own": {"triangulation": pytest.approx(1.6)}, "zig": {"triangulation": pytest.approx(1.7)}}


def test_other_bits_are_an_error(monkeypatch):
    monkeypatch.setattr(compilers, "run", lambda folder, points: said(folder.name, 1.0))
    with pytest.raises(RuntimeError, match="same to the last bit"):
        compilers.measure({"own": Path("own"), "zig": Path("zig")}, rounds=1)


@pytest.mark.thorough
def test_a_process_imports_the_package_that_it_is_given(tmp_path):
    assert {"triangulation, sphere", "triangulation, plane", "bits"} <= compilers.run(
        compilers.HERE.parent, 1000
    ).keys()
    with pytest.raises(RuntimeError, match="not the one that was imported"):
        compilers.run(tmp_path, 1000)
