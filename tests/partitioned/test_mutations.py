"""Tests of the tests: each fault that is put into the certificate on purpose is noticed by a set of points."""

import numpy as np
import pytest

from stereodel import PlanarDelaunay, _kernel
from stereodel.partitioned import rounds
from tests.partitioned.answers import differences, in_memory, serially, surface_of, write_points
from tests.sets import ALL

pytestmark = pytest.mark.thorough

SPACES = {"sphere": _kernel.sphere, "plane": _kernel.plane}


def noticed(folder, name, size=1500, partition=100):
    """Whether the answer, or that there is none, is another one than in memory."""
    found = ALL[name]
    columns, rows = found.columns, found.rows(size)
    write_points(folder / "points", columns, rows)
    try:
        run = serially(
            folder / "points", folder / "out", columns=columns, surface=surface_of(columns), partition=partition
        )
    except RuntimeError as error:  # the check at the end
        return "Euler" in str(error) or "areas" in str(error)
    return bool(differences(run, in_memory(columns, rows)))


@pytest.fixture
def damage(monkeypatch):
    """Replace a function of the kernel by what another one makes of its result."""

    def replaced(name, change):
        for space in SPACES.values():
            function = getattr(space, name)

            def changed(*args, function=function):
                return change(function(*args), *args)

            monkeypatch.setattr(space, name, changed)

    return replaced


def all_final(found, *_):
    return tuple(np.zeros_like(part) for part in found)


@pytest.mark.parametrize("name", ["random", "half", "airports", "whole numbers", "copied"])
def test_every_triangle_final_and_no_halo(tmp_path, monkeypatch, damage, name):
    damage("open_bubbles", all_final)
    monkeypatch.setattr(rounds, "REACH", -1.0)
    assert noticed(tmp_path, ("sphere", name))


@pytest.mark.parametrize("name", ["half", "airports", "whole numbers"])
def test_every_triangle_final(tmp_path, damage, name):
    damage("open_bubbles", all_final)
    assert noticed(tmp_path, ("sphere", name))


def test_hull_edges_not_asked(tmp_path, damage):
    damage("open_bubbles", lambda found, _, faces, *rest: (found[0] & (faces[:, 2] >= 0), found[1]))
    assert noticed(tmp_path, ("plane", "thin strip"))


def test_closing_facets_not_asked(tmp_path, damage):
    def change(found, points, faces, *_):
        return found[0] & ~_kernel.sphere.closing(points, faces), found[1]

    damage("open_bubbles", change)
    assert noticed(tmp_path, ("sphere", "half"))


@pytest.mark.parametrize("name", [("sphere", "random"), ("plane", "lattice")])
def test_boxes_that_are_too_small(tmp_path, damage, monkeypatch, name):
    def change(found, *_):
        order, starts, lows, highs = found
        middle = (lows + highs) / 2
        return order, starts, middle + (lows - middle) * 0.5, middle + (highs - middle) * 0.5

    damage("blocks", change)
    monkeypatch.setattr(rounds, "REACH", -1.0)
    assert noticed(tmp_path, name)


def test_another_tie_rule(tmp_path, monkeypatch):
    """Partitions that break ties by opposite rules do not fit, nor does one rule other than the library's."""
    calls = []

    class Turned(PlanarDelaunay):
        """Of every other partition the triangulation of points that are turned by 90°, where ties go otherwise."""

        def __new__(cls, points, **options):
            calls.append(len(points))
            if len(calls) % 2:
                return PlanarDelaunay(points, **options)
            mesh = PlanarDelaunay(np.column_stack([-points[:, 1], points[:, 0]]), **options)
            return PlanarDelaunay._from_simplices(points, mesh.simplices, mesh.duplicates)

    monkeypatch.setattr(rounds, "PlanarDelaunay", Turned)
    monkeypatch.setattr(rounds, "isinstance", lambda mesh, _: mesh.points.shape[1] == 2, raising=False)
    assert noticed(tmp_path, ("plane", "lattice"))
    assert len(calls) > 10
