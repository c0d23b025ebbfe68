"""Cells and polylines in bulk: they cover the near side once, join without gaps, and end on the limb."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import SphericalDelaunay, SphericalVoronoi, check_delaunay, lonlat_to_xyz, solid_angle
from stereodel.render import Page, Scene, View
from stereodel.render.mosaics import STEP_RAD, cell_triangles, near_part, near_runs, refined, stepped, units
from stereodel.render.page import Mosaic, Stroke
from stereodel.render.raster import render
from stereodel.render.style import LineStyle
from stereodel.render.vector import save_vector


def diagram(count, seed):
    points = np.random.default_rng(seed).normal(size=(count, 3))
    triangulation = SphericalDelaunay(points)
    check_delaunay(triangulation)
    return SphericalVoronoi(triangulation)


def arrays(voronoi):
    return voronoi.points, voronoi.vertices, voronoi.region_indices, voronoi.region_offsets


@pytest.mark.parametrize("count", [4, 5, 12, 3000])
def test_triangles_of_a_cell_have_its_area(count):
    voronoi = diagram(count, count)
    triangles, cell = cell_triangles(*arrays(voronoi))
    areas = np.bincount(cell, solid_angle(*triangles.transpose(1, 0, 2)), minlength=count)
    np.testing.assert_allclose(areas, voronoi.areas(), rtol=1e-9)
    assert angles(triangles).max() <= STEP_RAD * (1 + 1e-12)


def angles(triangles):
    return 2 * np.arcsin(np.linalg.norm(triangles - np.roll(triangles, -1, axis=1), axis=-1) / 2)


def test_cells_join_without_gaps():
    """Every side of a triangle is a side of just one other, turned round."""
    triangles, _ = cell_triangles(*arrays(diagram(40, 7)))
    starts, ends = triangles.reshape(-1, 3), np.roll(triangles, -1, axis=1).reshape(-1, 3)
    forward = {(a.tobytes(), b.tobytes()) for a, b in zip(starts, ends, strict=True)}
    assert len(forward) == len(starts)
    assert forward == {(b, a) for a, b in forward}


def test_duplicates_have_no_triangles():
    voronoi = SphericalVoronoi([[1, 0, 0], [0, 1, 0], [2, 0, 0], [0, 0, 1], [-1, -1, -1]])
    _, cell = cell_triangles(*arrays(voronoi))
    assert set(cell.tolist()) == {0, 1, 3, 4}


def test_fine_triangles_stay_as_they_are():
    triangle = units(np.array([[[1, 0, 0], [1, 1e-3, 0], [1, 0, 1e-3]]]))
    kept, owner = refined(triangle, np.array([5]))
    assert np.array_equal(kept, triangle)
    assert owner.tolist() == [5]


def page_area(corners):
    a, b, c = corners[..., :2].transpose(1, 0, 2)
    return np.sum((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])) / 2


@pytest.mark.parametrize("view", [View(0, 0), View(20, 35), View(-100, -90)])
def test_the_near_part_is_the_disc(view):
    triangles, _ = cell_triangles(*arrays(diagram(50, 3)))
    corners, _ = near_part(view.axes(triangles))
    assert corners[..., 2].min() >= 0
    np.testing.assert_allclose(np.linalg.norm(corners, axis=-1), 1, atol=1e-12)
    # Chords cut segments of STEP_RAD off the disc: at most a share of STEP_RAD²/6.
    assert np.pi * (1 - STEP_RAD**2 / 6) < page_area(corners) < np.pi


@given(st.integers(2, 40), st.integers(0, 2**32 - 1))
def test_runs_of_a_line_are_on_the_near_side_and_end_on_the_limb(count, seed):
    line = stepped(units(np.random.default_rng(seed).normal(size=(count, 3))))
    runs = near_runs(line)
    assert sum(map(len, runs)) >= np.count_nonzero(line[:, 2] >= 0)
    for run in runs:
        assert run[:, 2].min() >= 0
        assert np.linalg.norm(np.diff(run, axis=0), axis=1).max() <= STEP_RAD
    crossings = np.count_nonzero(np.diff(line[:, 2] >= 0))
    assert sum(end[2] == 0 for run in runs for end in (run[0], run[-1])) == crossings


def cells_scene(colors):
    voronoi = diagram(6, 1)
    scene = Scene()
    scene.add_cells(*arrays(voronoi), colors=np.broadcast_to(colors, (6, 3)))
    return scene


def test_colours_are_those_of_the_cells():
    voronoi = diagram(200, 5)
    colors = np.random.default_rng(1).random((200, 3))
    scene = Scene()
    scene.add_cells(*arrays(voronoi), colors=colors)
    view = View(10, 20)
    (mosaic,) = (item for item in scene.layout(view) if isinstance(item, Mosaic))
    middles = units(mosaic.normals.mean(axis=1)) @ view.matrix
    sites = voronoi.points / np.linalg.norm(voronoi.points, axis=1, keepdims=True)
    assert np.array_equal(mosaic.colors, colors[(middles @ sites.T).argmax(axis=1)])


def test_pixels_and_vector_files(tmp_path):
    items = cells_scene((0.2, 0.5, 0.8)).layout(View(0, 0))
    page = Page((-1.1, 1.1, -1.1, 1.1), items)
    picture = render(page, size=200)
    assert np.abs(picture[100, 100] / 255 - [0.2, 0.5, 0.8]).max() < 0.02
    assert (picture[2, 2] == 255).all()
    for kind in ("svg", "pdf"):
        path = save_vector(page, tmp_path / f"cells.{kind}", mosaics=[picture])
        assert b"image" in path.read_bytes().lower()
    with pytest.raises(ValueError, match="mosaics has 0 pictures, but there are 1 mosaics on the page; give each one"):
        save_vector(page, tmp_path / "none.svg")
    assert not (tmp_path / "none.svg").exists()


def test_lines_on_the_near_side():
    scene = Scene(weight=2.0)
    equator = lonlat_to_xyz([[lon, 0.0] for lon in range(-180, 181, 10)])
    small = lonlat_to_xyz([[0, 0], [1, 0], [1, 1], [0, 0]])
    scene.add_polylines([equator, small], role="coast", style=LineStyle((0.0, 0.0, 0.0, 1.0), 1.0))
    long, closed = (item for item in scene.layout(View(0, 0)) if isinstance(item, Stroke) and item.role == "coast")
    np.testing.assert_allclose(long.path[[0, -1], [0, 3]], [[-1, 0], [1, 0]], atol=1e-15)
    assert (long.width, long.closed, closed.closed) == (2.0, False, True)
    far = [item for item in scene.layout(View(180, 0)) if isinstance(item, Stroke) and item.role == "coast"]
    assert [item.closed for item in far] == [False, False]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"colors": np.zeros((5, 3))}, "colors has 5 rows, but there are 6 cells"),
        ({"indices": np.full(24, 99)}, "indices"),
        ({"colors": np.zeros((6, 4))}, r"colors must have shape \(n, 3\)"),
    ],
)
def test_refused_cells(change, message):
    names = ("points", "vertices", "indices", "offsets")
    given = dict(zip(names, arrays(diagram(6, 1)), strict=True)) | {"colors": np.zeros((6, 3))} | change
    with pytest.raises(ValueError, match=message):
        Scene().add_cells(**given)


def test_cells_with_two_vertices_are_refused():
    with pytest.raises(ValueError, match="a cell has two vertices"):
        Scene().add_cells(*arrays(SphericalVoronoi(np.eye(3))), colors=np.zeros((3, 3)))
