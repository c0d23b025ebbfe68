"""SciPy's public tests run against `stereodel.spatial`; what cannot apply is listed, test by test, with the reason."""

import fnmatch
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.tiers import by_day

HERE = Path(__file__).resolve().parent
FILES = ("test_qhull", "test_spherical_voronoi", "test__plotutils")

DIFFERENT = "AssertionError"  # a comparison fails, for the reason beside it
ANSWERED = "DID NOT RAISE"
# Pattern of test names → the error that they meet, and why that is right.
NOT_APPLICABLE = {
    # The order in which Qhull happens to list rows.
    "test_qhull.py::TestUtilities::test_find_simplex": (DIFFERENT, "order of the rows of simplices"),
    "test_qhull.py::TestUtilities::test_convex_hull": (DIFFERENT, "order of the rows of convex_hull"),
    "test_qhull.py::TestDelaunay::test_2d_square": (DIFFERENT, "order of the rows of simplices"),
    "test_qhull.py::TestVoronoi::test_simple": (DIFFERENT, "where a region begins, and its direction"),
    "test_spherical_voronoi.py::*::test_sort_vertices_of_regions_flattened": (DIFFERENT, "numbers of the vertices"),
    "test__plotutils.py::TestPlotting::test_gh_19653*": (DIFFERENT, "order of the ridges that are drawn"),
    # What SciPy refuses has an answer.
    "test_spherical_voronoi.py::*::test_duplicate_point_handling": (ANSWERED, "equal points: an empty region"),
    "test_spherical_voronoi.py::*::test_rank_deficient[[]*-3-*]": (ANSWERED, "a great circle: two vertices"),
    # Exactness: Qhull lists 22 of the 31 slivers; it merges a ridge of length 1e-16, and two vertices as far apart.
    "test_qhull.py::TestUtilities::test_degenerate_barycentric_transforms": (DIFFERENT, "31 slivers"),
    "test_qhull.py::TestVoronoi::test_ridges[[]pathological-2]": (DIFFERENT, "the tree finds points equally near"),
    "test_qhull.py::TestVoronoi::test_incremental[[]pathological-2-*]": (DIFFERENT, "the same for the comparison"),
    "test_qhull.py::TestDelaunay::test_joggle": (DIFFERENT, "QJ moves no points: equal ones stay one vertex"),
    # Errors.
    "test_qhull.py::test_gh_21286": ("xi must have shape (..., 2)", "ValueError with the shape instead of IndexError"),
}


def ran(folder, *files):
    """What became of each of SciPy's tests in some files that make objects of ours: "" or the error."""
    (folder / "pytest.ini").write_text("[pytest]\n", encoding="utf-8")
    report = folder / "report.json"
    paths = os.pathsep.join([str(HERE), str(HERE.parent.parent), os.environ.get("PYTHONPATH", "")])
    environment = {"PYTHONPATH": paths, "STEREODEL_SCIPY_SUITE": str(report), "MPLBACKEND": "Agg", "PYTEST_ADDOPTS": ""}
    options = ["-p", "scipy_suite", "-p", "no:cacheprovider", "-c", "pytest.ini", "--noconftest", "--tb=no", "-q"]
    command = [sys.executable, "-m", "pytest", *options, "--pyargs", *(f"scipy.spatial.tests.{name}" for name in files)]
    done = subprocess.run(command, cwd=folder, env=os.environ | environment, capture_output=True, text=True)
    assert report.is_file(), done.stdout + done.stderr
    return json.loads(report.read_text(encoding="utf-8"))


def matching(name):
    return [pattern for pattern in NOT_APPLICABLE if fnmatch.fnmatchcase(name, pattern)]


@pytest.mark.parametrize(("files", "passing"), by_day([(FILES[2:], 1), (FILES, 200)], (FILES[2:], 1)))
def test_scipys_tests_pass_but_for_those_listed(tmp_path, files, passing):
    """Each failure is listed once, and meets the error that is listed; what is listed fails."""
    errors = ran(tmp_path, *files)
    failed = {name: error for name, error in errors.items() if error}
    assert len(errors) - len(failed) >= passing
    assert {name: error for name, error in failed.items() if len(matching(name)) != 1} == {}
    assert {name: error for name, error in failed.items() if NOT_APPLICABLE[matching(name)[0]][0] not in error} == {}
    for pattern in NOT_APPLICABLE:
        names = fnmatch.filter(errors, pattern)
        assert names or files != FILES, f"{pattern} names no test"
        assert [name for name in names if not errors[name]] == []
