"""Lines of maps: straight in longitude and latitude, clipped at the edge of the view, thinned."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import MoebiusMap, fisheye, lonlat_to_xyz, xyz_to_lonlat
from stereodel.globe.lines import SphereLines, clipped_lines, thinned

NONE = MoebiusMap.identity()


def distance_to_polyline(truth, points):
    a, way = points[:-1], np.diff(points, axis=0)
    share = np.sum((truth[:, None] - a) * way, axis=-1) / np.maximum(np.sum(way**2, axis=-1), 1e-300)
    near = a + np.clip(share, 0.0, 1.0)[..., None] * way
    return np.linalg.norm(truth[:, None] - near, axis=-1).min(axis=1)


@given(
    start=st.tuples(st.floats(-180, 180), st.floats(-90, 90)),
    step=st.tuples(st.floats(-179, 179), st.floats(-90, 90)),
    size=st.floats(-2, 2).map(lambda e: 10.0**e),
    focus=st.tuples(st.floats(-180, 180), st.floats(-90, 90)),
)
def test_edges_are_straight_in_longitude_and_latitude(start, step, size, focus):
    end = (start[0] + step[0], np.clip(start[1] + step[1], -90, 90))
    lens = fisheye(focus, magnification=size)
    lines = SphereLines.straight_in_lonlat([[start, end]])
    points, offsets = lines.through(lens, tolerance=1e-3)
    share = np.linspace(0, 1, 500)[:, None]
    truth = lens(lonlat_to_xyz(np.array(start) + share * (np.array(end) - start)))
    assert offsets.tolist() == [0, len(points)]
    assert distance_to_polyline(truth, points).max() <= 1.2e-3


def test_jumps_across_the_antimeridian_go_the_short_way():
    lines = SphereLines.straight_in_lonlat([[(170, 10), (-170, 12), (-160, 12)], [(-179, 0), (179, 0)]])
    points, offsets = lines.through(NONE, tolerance=1e-3)
    lon = np.abs(xyz_to_lonlat(points)[:, 0])
    assert lon.min() > 159.9
    assert len(offsets) == 3


@pytest.mark.parametrize("edge", [0.0, -0.5, 0.3])
def test_clipping_keeps_what_is_inside_and_ends_on_the_rim(edge):
    rng = np.random.default_rng(2)
    walks = [np.cumsum(rng.normal(scale=0.3, size=(50, 3)), axis=0) for _ in range(20)]
    points = np.concatenate(walks)
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    offsets = np.arange(0, 1001, 50)
    seen, runs = clipped_lines(points, offsets, edge)
    assert (seen[:, 2] >= edge).all()
    np.testing.assert_allclose(np.linalg.norm(seen, axis=1), 1.0, atol=1e-12)
    assert {tuple(p) for p in points[points[:, 2] >= edge]} == {tuple(p) for p in seen[seen[:, 2] > edge]}
    on_rim = seen[:, 2] == edge
    crossings = sum(
        int(np.sum((points[a : b - 1, 2] >= edge) != (points[a + 1 : b, 2] >= edge))) for a, b in pairwise(offsets)
    )
    assert on_rim.sum() == crossings
    inner = np.ones(len(seen), dtype=bool)
    inner[runs[:-1]] = inner[runs[1:] - 1] = False
    assert not on_rim[inner].any()
    assert (np.diff(runs) > 1).all()


def test_lines_out_of_sight_leave_nothing():
    points = lonlat_to_xyz([(0, -10), (10, -20), (20, -30)])
    seen, runs = clipped_lines(points, np.array([0, 3]), 0.0)
    assert seen.shape == (0, 3)
    assert runs.tolist() == [0]
    assert clipped_lines(np.zeros((0, 3)), np.zeros(1, dtype=int), 0.0)[1].tolist() == [0]


@given(st.integers(0, 1000), st.floats(0.01, 1.0))
def test_thinning_moves_no_line_by_more_than_the_spacing(seed, spacing):
    rng = np.random.default_rng(seed)
    points = np.cumsum(rng.normal(scale=0.1, size=(60, 2)), axis=0)
    offsets = np.array([0, 20, 22, 60])
    kept, ends = thinned(points, offsets, spacing)
    for k in range(3):
        line, thin = points[offsets[k] : offsets[k + 1]], kept[ends[k] : ends[k + 1]]
        assert (thin[0] == line[0]).all()
        assert (thin[-1] == line[-1]).all()
        assert np.linalg.norm(line[:, None] - thin, axis=-1).min(axis=1).max() <= spacing
