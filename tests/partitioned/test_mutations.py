"""Tests of the tests: each fault that is put into the certificate on purpose is noticed by a set of points."""

import numpy as np
import pytest

from stereodel import PlanarDelaunay, _kernel
from stereodel.partitioned import rounds
from tests.partitioned.answers import differences, in_memory, serially, write_points
from tests.sets import ALL

pytestmark = pytest.mark.thorough

SPACES = (_kernel.sphere, _kernel.plane)


def noticed(folder, space, name, size=1500, partition=100):
    """Whether the answer, or that there is none, is another one than in memory."""
    found = ALL[space, name]
    rows = found.rows(size)
    write_points(folder / "points", found.columns, rows)
    asked = {"columns": found.columns, "surface": space, "partition": partition}
    try:
        run = serially(folder / "points", folder / "out", **asked)
    except RuntimeError as error:  # the check at the end
        return "Euler" in str(error) or "areas" in str(error)
    return bool(differences(run, in_memory(found.columns, rows)))


def all_final(found, *_):
    return tuple(np.zeros_like(part) for part in found)


def no_hull_edges(found, _, faces, *rest):
    return found[0] & (faces[:, 2] >= 0), found[1]


def no_closing_facets(found, points, faces, *_):
    return found[0] & ~_kernel.sphere.closing(points, faces), found[1]


def small_boxes(found, *_):
    order, starts, lows, highs = found
    middle = (lows + highs) / 2
    return order, starts, middle + (lows - middle) * 0.5, middle + (highs - middle) * 0.5


DAMAGE = [
    *(("open_bubbles", all_final, False, "sphere", name) for name in ("random", "half", "airports", "whole numbers")),
    *(("open_bubbles", all_final, True, "sphere", name) for name in ("half", "airports", "whole numbers")),
    ("open_bubbles", no_hull_edges, True, "plane", "thin strip"),
    ("open_bubbles", no_closing_facets, True, "sphere", "half"),
    ("blocks", small_boxes, False, "sphere", "random"),
    ("blocks", small_boxes, False, "plane", "lattice"),
]


@pytest.mark.parametrize(("name", "change", "halo", "space", "points"), DAMAGE)
def test_damage_is_noticed(tmp_path, monkeypatch, name, change, halo, space, points):
    """A function of the kernel is replaced by what another one makes of its result; the halo is a guess that helps."""
    for each in SPACES:
        function = getattr(each, name)
        monkeypatch.setattr(each, name, lambda *args, function=function: change(function(*args), *args))
    monkeypatch.setattr(rounds, "REACH", rounds.REACH if halo else -1.0)
    assert noticed(tmp_path, space, points)


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
    assert noticed(tmp_path, "plane", "lattice")
    assert len(calls) > 10
