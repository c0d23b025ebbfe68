"""Outlines of patches: the loops round triangles, and arcs along the rim."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.transforms import Affine2D
from scipy.spatial import Delaunay

from stereodel.drawing.page import Patch
from stereodel.render.outlines import boundary_sides, loops, patch_outline

BLACK = (0.0, 0.0, 0.0, 1.0)


def signed_area(points):
    x, y = points.T
    return np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2


def area_of_faces(points, faces):
    a, b, c = (points[faces[:, i]] for i in range(3))
    return np.sum((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2


@given(st.integers(0, 1000), st.integers(4, 60), st.floats(0.0, 1.0))
def test_loops_bound_what_the_triangles_cover(seed, n, share):
    """Counterclockwise loops count, clockwise ones are holes: the areas add up to that of the triangles."""
    rng = np.random.default_rng(seed)
    points = rng.random((n, 2))
    faces = Delaunay(points).simplices
    orient = np.array([signed_area(points[face]) for face in faces])
    faces = np.where((orient > 0)[:, None], faces, faces[:, ::-1])[rng.random(len(faces)) < share]
    found = loops(boundary_sides(faces))
    np.testing.assert_allclose(
        sum(signed_area(points[loop]) for loop in found), area_of_faces(points, faces), atol=1e-12
    )


def test_a_ring_of_triangles_has_an_outside_and_a_hole():
    angles = np.arange(8) * np.pi / 4
    inner = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    points = np.concatenate([inner, 2 * inner])
    here = np.arange(8)
    there = (here + 1) % 8
    faces = np.concatenate([np.stack([here, here + 8, there + 8], 1), np.stack([here, there + 8, there], 1)])
    areas = sorted(signed_area(points[loop]) for loop in loops(boundary_sides(faces)))
    np.testing.assert_allclose(areas, [-2 * np.sqrt(2), 8 * np.sqrt(2)])


def test_seams_between_pieces_fall_out():
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    assert sorted(map(tuple, boundary_sides(faces).tolist())) == [(0, 1), (1, 2), (2, 3), (3, 0)]
    assert boundary_sides(np.zeros((0, 3), dtype=np.int32)).shape == (0, 2)


def test_sides_along_the_rim_are_arcs():
    """A cap of the disc, cut by a chord: its outline's area is that of the circular segment."""
    angles = np.linspace(0.0, np.pi / 2, 9)
    points = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    points = np.concatenate([points, points[[0, 8]].mean(axis=0, keepdims=True)])
    faces = np.array([[9, k, k + 1] for k in range(8)], dtype=np.int32)
    outline = patch_outline(Patch(points, faces, BLACK, np.arange(10) < 9))
    (polygon,) = outline.transformed(Affine2D().scale(1000)).to_polygons(closed_only=True)
    assert abs(signed_area(polygon) / 1e6 - (np.pi / 4 - 0.5)) < 1e-4


def test_a_region_that_is_all_there_is_becomes_the_whole_circle():
    angles = np.arange(12) * np.pi / 6
    points = np.concatenate([[[3.0, 4.0]], [3.0, 4.0] + 2 * np.stack([np.cos(angles), np.sin(angles)], axis=1)])
    faces = np.array([[0, 1 + k, 1 + (k + 1) % 12] for k in range(12)], dtype=np.int32)
    outline = patch_outline(Patch(points, faces, BLACK, np.arange(13) > 0, (3.0, 4.0)))
    box = outline.get_extents()
    np.testing.assert_allclose([box.x0, box.x1, box.y0, box.y1], [1.0, 5.0, 2.0, 6.0], atol=1e-5)


def test_corners_nearer_than_a_spacing_become_one():
    """A disc and a speck of many corners: of the first no point is farther than that from what is left; no speck is."""
    angles = np.arange(1000) * 2 * np.pi / 1000
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    points = np.concatenate([[[0.0, 0.0]], ring, [[3.0, 0.0]], [3.0, 0.0] + 1e-3 * ring])
    fan = np.stack([np.zeros(1000, dtype=np.int32), 1 + np.arange(1000), 1 + (np.arange(1000) + 1) % 1000], axis=1)
    patch = Patch(points, np.concatenate([fan, fan + 1001]), BLACK, np.zeros(len(points), dtype=bool))
    whole, thin = patch_outline(patch), patch_outline(patch, spacing=0.05)
    assert len(whole.vertices) == 2 * 1002
    assert len(thin.vertices) < 135
    left = thin.vertices
    assert np.abs(left[:, 0]).max() < 1.5
    assert np.hypot(*(ring[:, None] - left[None]).transpose(2, 0, 1)).min(axis=1).max() < 0.05
    (polygon,) = thin.transformed(Affine2D().scale(1000)).to_polygons(closed_only=True)
    assert abs(signed_area(polygon) / 1e6 - np.pi) < 0.01


def test_no_triangles_have_no_outline():
    nothing = Patch(np.zeros((0, 2)), np.zeros((0, 3), dtype=np.int32), BLACK, np.zeros(0, dtype=bool))
    assert len(patch_outline(nothing).vertices) == 0
