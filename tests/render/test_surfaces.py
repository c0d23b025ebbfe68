"""Surfaces in space: closed, facing outward, as near to the true shape as they say."""

from itertools import pairwise

import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

from stereodel.drawing.scene.space_curves import CircleArc, Segment
from stereodel.drawing.scene.visibility import SphereRegion
from stereodel.render.space.surfaces import BALL_LEVELS, CURVE_ERROR, ball, dashed, patch, polygon, tube
from stereodel.sphere import SphereCircle, lonlat_to_xyz, solid_angle


def mesh(surface):
    return trimesh.Trimesh(surface.points, surface.faces, process=False)


def is_closed(surface):
    return mesh(surface).is_watertight and mesh(surface).is_winding_consistent


def faces_out(surface):
    """Triangles and normals of their corners look the same way."""
    return (np.sum(mesh(surface).face_normals[:, None] * surface.normals[surface.faces], axis=2) > 0).all()


ARC = CircleArc.great([1.0, 0.2, 0.1], [-0.3, 1.0, 0.4])
RING = CircleArc(np.array([0.1, 0.2, 0.3]), np.array([0.0, 0.6, 0.0]), np.array([0.0, 0.0, 0.6]))
LINES = {"arc": ARC, "part": ARC.part(0.3, 0.9), "ring": RING, "bar": Segment.between([0, 0, 1], [0.5, 0, -1])}


@pytest.mark.parametrize("name", LINES)
@pytest.mark.parametrize("radius", [0.001, 0.02])
def test_a_tube_is_what_lies_within_its_radius(name, radius):
    line = LINES[name]
    made = tube(line, radius, CURVE_ERROR)
    assert is_closed(made)
    assert faces_out(made)
    near = cKDTree(line.sample(np.linspace(line.start, line.stop, 200_001)))
    assert np.abs(near.query(made.points)[0] - radius).max() < 1e-6
    # The middles of its triangles' sides lie below by what chords are below arcs, along and around.
    a, b = (made.points[made.faces[:, k]] for k in (0, 1))
    assert radius - near.query((a + b) / 2)[0].min() < max(2.1 * CURVE_ERROR, 0.3 * radius)
    step = line.direction if isinstance(line, Segment) else line.u
    length = (line.stop - line.start) * np.sqrt(np.sum(step**2)) + (0 if line.closed else 4 / 3 * radius)
    assert 0.8 < mesh(made).volume / (np.pi * radius**2 * length) < 1.0


def test_dashes_and_gaps_have_their_lengths():
    pieces = dashed(RING, 0.1, 0.05)
    assert len(pieces) == int(np.ceil(2 * np.pi * 0.6 / 0.15))
    lengths = [0.6 * (piece.stop - piece.start) for piece in pieces]
    assert np.allclose(lengths[:-1], 0.1)
    assert 0 < lengths[-1] <= 0.1 + 1e-12
    gaps = [0.6 * (b.start - a.stop) for a, b in pairwise(pieces)]
    assert np.allclose(gaps, 0.05)


@pytest.mark.parametrize("level", [2, *BALL_LEVELS[:2]])
def test_a_ball_is_closed_and_round(level):
    made = ball(level)
    assert is_closed(made)
    assert faces_out(made)
    assert np.allclose(np.sqrt(np.sum(made.points**2, axis=1)), 1, rtol=1e-15)
    lowest = made.points[made.faces].mean(axis=1)
    assert made.depth == pytest.approx(1 - np.sqrt(np.sum(lowest**2, axis=1)).min(), rel=0.05)


def region(*corners, radius=2.0):
    xyz = lonlat_to_xyz(np.array(corners))
    sides = [
        CircleArc.great(a, b).scaled(radius, np.zeros(3)) for a, b in zip(xyz, np.roll(xyz, -1, axis=0), strict=True)
    ]
    return SphereRegion(tuple(sides), radius), xyz


@pytest.mark.parametrize("angle", [0.5, 20, 90, 140, 179])
def test_a_patch_of_a_circle_is_its_cap(angle):
    circle = CircleArc.circle(SphereCircle.around((30, 32), angle)).scaled(0.5, np.zeros(3))
    made = patch(SphereRegion((circle,), 0.5), 4)
    around = 2 * np.pi * np.sin(np.radians(angle)) * CURVE_ERROR
    assert mesh(made).area == pytest.approx(2 * np.pi * (1 - np.cos(np.radians(angle))), rel=0.003, abs=around)
    middle = lonlat_to_xyz((30.0, 32.0))
    assert (made.points @ middle).min() == pytest.approx(np.cos(np.radians(angle)), abs=1e-12)
    assert np.array_equal(made.points, made.normals)
    assert faces_out(made)


def test_a_patch_of_a_thin_triangle_has_its_area():
    thin, corners = region((0, 0), (60, 0.6), (60, 0.9))
    assert mesh(patch(thin, 4)).area == pytest.approx(solid_angle(*corners), rel=0.01)


def test_a_boundary_the_other_way_round_is_the_rest_of_the_sphere():
    corners = [(0, 0), (40, 0), (20, 50)]
    inner, outer = (mesh(patch(region(*c)[0], 5)).area for c in (corners, corners[::-1]))
    assert inner + outer == pytest.approx(4 * np.pi, rel=1e-3)
    assert inner < outer


def test_a_boundary_that_crosses_itself_is_refused():
    with pytest.raises(ValueError, match="crosses itself"):
        patch(region((0, 0), (40, 30), (40, 0), (0, 30))[0], 4)


@pytest.mark.parametrize("order", [1, -1])
def test_a_polygon_need_not_be_convex(order):
    star = np.array([[0, 0], [2, 0], [2, 2], [1, 0.5], [0, 2]], dtype=float)[::order]
    normal = np.array([1.0, 2.0, -2.0]) / 3
    across = np.array([2.0, -1.0, 0.0]) / np.sqrt(5)
    corners = star @ np.array([across, np.cross(normal, across)]) + 0.7 * normal
    made = polygon(corners, normal)
    assert len(made.faces) == 3
    assert mesh(made).area_faces @ (mesh(made).face_normals @ normal) == pytest.approx(2.5)
    assert mesh(made).area == pytest.approx(2.5)
