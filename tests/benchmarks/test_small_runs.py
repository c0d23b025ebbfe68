"""Small runs of the measurements: every call is made, both sides compute the same, and the pages tell it."""

import numpy as np
import pytest

from benchmarks import gmt, pages
from benchmarks.conformal_maps import coastline, conformal_maps
from benchmarks.derived import derived, graphs, others, queries, waves
from benchmarks.distributions import make
from benchmarks.map_files import measure
from stereodel import PlanarDelaunay, SphericalDelaunay, lonlat_to_xyz
from tests import sets

UNIT = sets.sphere("unit").drawn(400)


def test_coastline_points_are_as_many_as_asked_and_different():
    points = coastline(200_000)
    assert points.shape == (200_000, 2)
    assert len(np.unique(points, axis=0)) > 190_000


def test_both_sides_compute_the_same_map_and_the_page_tells_it():
    measured = conformal_maps(1000)
    assert measured["places"]["largest gap in degrees"] < 1e-9
    lines = pages.conformal_maps(measured).splitlines()
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
    lines = pages.derived(derived(300)).splitlines()
    assert len(lines) == 2 + 12
    assert all(line.count("|") == 6 for line in lines)


def test_without_gmt_the_page_says_so(monkeypatch):
    monkeypatch.setattr(gmt.shutil, "which", lambda name: None)
    assert pages.gmt(gmt.gmt(10_000)) == "GMT is not installed."


@pytest.mark.parametrize("command", gmt.COMMANDS)
def test_what_is_compared_with_gmt_is_true(command):
    """Without GMT: the function is interpolated, distances are those of all points, and the page tells it."""
    points = make("sphere", "uniform", 3000)
    found = gmt.ours(command, points)
    if command in gmt.KINDS:
        assert np.abs(found - waves(lonlat_to_xyz(gmt.GRID))).mean() < 0.05
    elif command.startswith("sphdistance"):
        cosines = lonlat_to_xyz(gmt.GRID[::999]) @ points.T
        assert np.allclose(found[::999], np.degrees(np.arccos(cosines.max(axis=-1))), atol=1e-5)
    else:
        assert found.shape == (2 * len(points) - 4, 3)
    row = {"command": command, "n": 400, "ours": 0.5, "theirs": 1.0}
    errors = {"ours rms": 1e-3, "theirs rms": 2e-3, "ours max": 3e-3, "theirs max": 4e-3}
    table = pages.gmt([row | errors])
    assert f"| 400 | `{command}` | 1 | 0.5 | 2 |" in table
    assert f"| 400 | `{command}` | 2.0e-03 | 1.0e-03 | 4.0e-03 | 3.0e-03 |" in table


@pytest.mark.skipif(not gmt.shutil.which("gmt"), reason="GMT is not installed")
@pytest.mark.parametrize(("command", "near"), [("sphinterpolate -Qp", 1e-6), ("sphinterpolate -Ql", 1.0)])
def test_gmt_computes_the_same(command, near):
    assert np.abs(gmt.theirs(command, UNIT) - gmt.ours(command, UNIT)).max() < near


@pytest.mark.thorough
@pytest.mark.parametrize("kind", ["parquet", "fgb"])
def test_a_format_is_measured_in_a_process_of_its_own(kind):
    row = measure(kind, 100)
    assert row["seconds"] > 0
    assert row["busy"] > 0
    assert 30e6 < row["peak"] < 4e9  # sanitizers take two
    head, rule, line = pages.map_files([row])["cells"].splitlines()
    assert line.startswith({"parquet": "| GeoParquet | ", "fgb": "| FlatGeobuf | "}[kind])
    assert head.count("|") == rule.count("|") == line.count("|")
