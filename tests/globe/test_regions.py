"""Regions as triangles: areas under lenses and across limb, antimeridian and poles; neighbours stay joined."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import MoebiusMap, angular_distance, fisheye, lonlat_to_xyz
from stereodel.drawing.view import View
from stereodel.globe.polygons import Polygons
from stereodel.globe.regions import Mesh, SphereMesh
from stereodel.render.outlines import boundary_sides, loops
from stereodel.sphere.vectors import turned

NONE = MoebiusMap.identity()

# Rings and their exact areas on the unit sphere.
BOXES = {
    "plain": (
        [(10, 20), (50, 20), (50, 60), (10, 60)],
        np.radians(40) * (np.sin(np.radians(60)) - np.sin(np.radians(20))),
    ),
    "across": ([(170, -10), (-170, -10), (-170, 10), (170, 10)], np.radians(20) * 2 * np.sin(np.radians(10))),
    "beyond": ([(170, -10), (190, -10), (190, 10), (170, 10)], np.radians(20) * 2 * np.sin(np.radians(10))),
    "south as in files": ([(-180, -90), (180, -90), (180, -60), (-180, -60)], 2 * np.pi * (1 - np.sin(np.radians(60)))),
    "north once round": ([(0, 60), (90, 60), (180, 60), (-90, 60)], 2 * np.pi * (1 - np.sin(np.radians(60)))),
    "south once round": ([(0, -60), (-90, -60), (-180, -60), (90, -60)], 2 * np.pi * (1 - np.sin(np.radians(60)))),
    "band": ([(-180, -30), (180, -30), (180, 30), (-180, 30)], 4 * np.pi * 0.5),
    "clockwise": (
        [(10, 60), (50, 60), (50, 20), (10, 20)],
        np.radians(40) * (np.sin(np.radians(60)) - 0.3420201433256687),
    ),
}


def solid_angles(mesh):
    a, b, c = (mesh.points[mesh.faces[:, i]] for i in range(3))
    triple = np.sum(np.cross(a, b) * c, axis=1)
    return 2 * np.arctan2(triple, 1 + np.sum(a * b, axis=1) + np.sum(b * c, axis=1) + np.sum(c * a, axis=1))


@pytest.mark.parametrize("name", BOXES)
def test_areas_of_boxes(name):
    ring, area = BOXES[name]
    mesh = Polygons.of_lonlat([[ring]]).mesh.through(NONE, tolerance=1e-4)
    assert solid_angles(mesh).sum() == pytest.approx(area, rel=1e-3)


@pytest.mark.parametrize("name", BOXES)
def test_what_is_left_of_a_box_has_no_seam(name):
    """The boundary of the whole image is one loop, or the two of the band: ±180° and the poles do not show."""
    mesh = Polygons.of_lonlat([[BOXES[name][0]]]).mesh.through(fisheye((100, 40), magnification=3), tolerance=1e-3)
    assert len(loops(boundary_sides(mesh.faces))) == (2 if name == "band" else 1)


@pytest.mark.parametrize("name", BOXES)
def test_outlines_have_no_seam(name):
    """Outlines are as long as the true border, without the sides along ±180° and to the poles."""
    polygons = Polygons.of_lonlat([[BOXES[name][0]]])
    points, offsets = polygons.outlines.through(NONE, tolerance=1e-5)
    length = sum(np.linalg.norm(np.diff(points[a:b], axis=0), axis=1).sum() for a, b in pairwise(offsets))
    parallel = 2 * np.pi * np.cos(np.radians(60))
    expected = {
        "plain": np.radians(40) * (np.cos(np.radians(20)) + np.cos(np.radians(60)) + 2),
        "clockwise": np.radians(40) * (np.cos(np.radians(20)) + np.cos(np.radians(60)) + 2),
        "across": np.radians(40) * (1 + np.cos(np.radians(10))),
        "beyond": np.radians(40) * (1 + np.cos(np.radians(10))),
        "band": 4 * np.pi * np.cos(np.radians(30)),
    }
    assert length == pytest.approx(expected.get(name, parallel), rel=1e-3)


@given(
    focus=st.tuples(st.floats(-180, 180), st.floats(-90, 90)),
    size=st.floats(-3, 6).map(lambda e: 10.0**e),
    name=st.sampled_from(sorted(BOXES)),
)
def test_a_region_and_the_rest_of_the_sphere_cover_it_under_every_lens(focus, size, name):
    """Areas of the images of a box and of its complement add up to the sphere, wherever the focus is."""
    lens = fisheye(focus, magnification=size)
    ring = np.array(BOXES[name][0], dtype=float)
    if name == "band":
        rest = [[[(-180, -90), (180, -90), (180, -30), (-180, -30)]], [[(-180, 30), (180, 30), (180, 90), (-180, 90)]]]
    elif name in ("south as in files", "south once round"):
        rest = [[[(-180, -60), (180, -60), (180, 90), (-180, 90)]]]
    elif name == "north once round":
        rest = [[[(-180, -90), (180, -90), (180, 60), (-180, 60)]]]
    else:
        ring[:, 0] = np.where(ring[:, 0] < ring[:, 0].max() - 180, ring[:, 0] + 360, ring[:, 0])
        west = ring[:, 0].mean() - 180.0
        outer = [(west, -90), (west + 360, -90), (west + 360, 90), (west, 90)]
        rest = [[outer, ring]]
    both = Polygons.of_lonlat([[BOXES[name][0]], *rest], owners=[0] + [1] * len(rest))
    areas = solid_angles(both.mesh.through(lens, tolerance=2e-3))
    assert areas.sum() == pytest.approx(4 * np.pi, rel=2e-2)


def test_holes_are_left_out():
    box, hole = [(0, 0), (40, 0), (40, 40), (0, 40)], [(10, 10), (10, 20), (20, 20), (20, 10)]
    areas = [
        solid_angles(Polygons.of_lonlat([rings]).mesh.through(NONE, tolerance=1e-4)).sum()
        for rings in ([box], [box, hole], [hole])
    ]
    assert areas[1] == pytest.approx(areas[0] - areas[2], rel=1e-3)


@given(st.floats(-180, 180), st.floats(-90, 90), st.sampled_from(sorted(BOXES)))
def test_both_sides_of_the_limb_make_the_whole(lon, lat, name):
    mesh = Polygons.of_lonlat([[BOXES[name][0]]]).mesh.through(NONE, tolerance=1e-3)
    matrix = View(lon, lat).matrix
    near = replace(mesh, points=turned(mesh.points, matrix))
    far = replace(mesh, points=turned(mesh.points, matrix * np.array([[-1.0], [1.0], [-1.0]])))
    total = 0.0
    for side in (near, far):
        part, rim = side.clipped(0.0, tolerance=1e-3)
        assert (part.points[:, 2] >= 0).all()
        assert (part.points[rim, 2] == 0).all()
        total += solid_angles(part).sum()
    assert total == pytest.approx(solid_angles(mesh).sum(), abs=2e-3)


def test_clipping_leaves_neighbours_joined():
    """The boundary of what is seen is the border and the rim: each cut side has one corner there."""
    mesh = Polygons.of_lonlat([[BOXES["band"][0]]]).mesh.through(NONE, tolerance=1e-3)
    part, rim = replace(mesh, points=turned(mesh.points, View(20, 10).matrix)).clipped(0.0, tolerance=1e-3)
    (loop,) = loops(boundary_sides(part.faces))
    assert rim[loop].sum() > 20
    assert len(np.unique(loop)) == len(loop)


def test_nothing_is_seen_of_what_is_behind():
    corners = lonlat_to_xyz([(0, 30), (40, 30), (20, 60)])
    mesh = SphereMesh(corners, np.array([[0, 1, 2]]), np.array([0])).through(NONE, tolerance=1e-2)
    part, rim = Mesh(-mesh.points, mesh.faces[:, ::-1], mesh.owners).clipped(0.0, tolerance=1e-3)
    assert part.faces.shape == (0, 3)
    assert len(rim) == 0
    everything, _ = mesh.clipped(-0.999, tolerance=1e-3)
    assert len(everything.faces) == len(mesh.faces)


def test_great_circle_triangles_keep_their_area():
    mesh = SphereMesh(np.eye(3), np.array([[0, 1, 2]]), np.array([0])).through(NONE, tolerance=1e-4)
    assert solid_angles(mesh).sum() == pytest.approx(np.pi / 2, rel=1e-12)
    assert np.linalg.norm(mesh.points, axis=1) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("rings", "message"), [([[(0, 0), (1, 1)]], "needs three"), ([[(0, 95), (1, 1), (2, 2)]], "latitude")]
)
def test_bad_rings_are_named(rings, message):
    with pytest.raises(ValueError, match=r"polygons\[1\].*" + message):
        Polygons.of_lonlat([[[(0, 0), (1, 0), (1, 1)]], rings])


def test_tiny_regions_at_huge_magnification_are_smooth():
    """A circle of 1 km of many sides, a million times larger: its image's outline has no long chords."""
    t = np.arange(8) * np.pi / 4
    ring = np.stack([2.0 + 1e-5 * np.cos(t), 48.0 + 1e-5 * np.sin(t)], axis=1)
    lens = fisheye((2.0, 48.0), magnification=1e7)
    mesh = Polygons.of_lonlat([[ring]]).mesh.through(lens, tolerance=1e-3)
    sides = np.concatenate([mesh.faces[:, [0, 1]], mesh.faces[:, [1, 2]], mesh.faces[:, [2, 0]]])
    assert np.linalg.norm(mesh.points[sides[:, 0]] - mesh.points[sides[:, 1]], axis=1).max() < 0.25
    np.testing.assert_allclose(mesh.points[:8], lens(lonlat_to_xyz(ring)), atol=1e-15)


@given(
    focus=st.tuples(st.floats(-180, 180), st.floats(-90, 90)),
    size=st.floats(-2, 4).map(lambda e: 10.0**e),
    at=st.tuples(st.floats(-180, 180), st.floats(-90, 90)),
    edge=st.floats(-0.9, 0.9),
    name=st.sampled_from(sorted(BOXES)),
)
def test_what_is_left_out_beyond_a_cap_is_out_of_sight(focus, size, at, edge, name):
    lens = fisheye(focus, magnification=size)
    matrix = View(*at).matrix
    mesh = Polygons.of_lonlat([[BOXES[name][0]]]).mesh
    seen = []
    for cap in (None, (matrix[2], edge)):
        image = mesh.through(lens, tolerance=2e-3, cap=cap)
        part, _ = replace(image, points=turned(image.points, matrix)).clipped(edge, tolerance=2e-3)
        seen.append(np.sort(part.points[part.faces].reshape(-1, 9), axis=0))
    np.testing.assert_array_equal(*seen)


def test_a_side_across_the_cap_whose_ends_are_on_its_rim_stays_straight():
    points = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.3, 0.3, 0.9], [1.0, 1.0, 0.2]])
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    mesh = Mesh(points, np.array([[0, 1, 2], [0, 3, 1]]), np.zeros(2, dtype=int))
    part, rim = mesh.clipped(0.0, tolerance=1e-3)
    assert len(part.points) == 4
    assert rim.sum() == 2


@given(
    corners=st.lists(st.tuples(st.floats(-170, 170), st.floats(-90, 90)), min_size=3, max_size=3),
    seed=st.integers(0, 100),
)
def test_triangles_are_no_larger_than_their_size(corners, seed):
    """What is out of sight is left out by it: it bounds distances from the first corner."""
    mesh = SphereMesh(np.array(corners), np.array([[0, 1, 2]]), np.array([0]))
    (size,) = mesh._sizes(lonlat_to_xyz(mesh.corners))
    shares = np.random.default_rng(seed).dirichlet(np.ones(3), 50)
    inside = np.clip(shares @ mesh.corners, [-180, -90], [180, 90])
    distances = angular_distance(lonlat_to_xyz(inside), lonlat_to_xyz(corners[0]))
    assert np.radians(distances).max() <= size + 1e-9
