"""Lines of maps: straight in longitude and latitude, clipped at the edge of the view, thinned."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import MoebiusMap, fisheye, lonlat_to_xyz, xyz_to_lonlat
from stereodel.curves.chart import Chart
from stereodel.curves.ragged import Ragged, thinned
from stereodel.curves.view import StereographicView, View
from stereodel.globe.lines import SphereLines
from stereodel.sphere import SphereArc
from stereodel.sphere.vectors import turned
from tests.globe.sights import distance, places, sizes, views

NONE = MoebiusMap.identity()


def test_jumps_across_the_antimeridian_go_the_short_way():
    """From one side of it to the other there is no way at all."""
    lines = SphereLines.straight_in_lonlat([[(170, 10), (-170, 12), (-160, 12)], [(-179, 0), (179, 0)]])
    points, offsets = lines.through(NONE, tolerance=1e-3)
    assert np.abs(xyz_to_lonlat(points)[:, 0]).min() > 159.9
    assert len(offsets) == 3
    points, _ = SphereLines.straight_in_lonlat([[(180, 10), (-180, 10), (-170, 10)]]).through(NONE, tolerance=1e-3)
    assert np.linalg.norm(np.diff(points, axis=0), axis=1).sum() < np.radians(10)


@given(start=places, end=places, focus=places, size=sizes(-2, 6), view=views)
def test_what_is_seen_of_an_arc_is_on_its_exact_image(start, end, focus, size, view):
    """All of the image in the disc is near what is drawn, and what is drawn is near the image."""
    a, b = lonlat_to_xyz([start, end])
    if not 1e-3 < np.linalg.norm(a - b) < 1.999:
        return
    lens = fisheye(focus, magnification=size)
    chart = Chart(lens, view, tolerance=1e-3)
    seen = SphereLines.great(a[None], b[None]).on(chart)
    axes = turned(lens.image_of(SphereArc.great(a, b)).sample(4000), view.matrix)
    truth = view.flattened(axes[axes[:, 2] > view.edge])
    if not len(seen):
        # Out of sight, but for a point on the rim.
        assert len(truth) == 0 or np.ptp(truth, axis=0).max() < 1e-2
        return
    assert (np.hypot(*seen.values.T) <= 1 + 1e-9).all()
    gaps = np.min([distance(truth, line) for line in seen], axis=0) if len(truth) else np.zeros(1)
    assert gaps.max() <= 2.2e-3
    # Ends are ends of the image, or on the rim.
    ends = np.concatenate([seen.values[seen.offsets[:-1]], seen.values[seen.offsets[1:] - 1]])
    own = view.flattened(turned(lens(np.stack([a, b])), view.matrix))
    away = np.minimum(np.abs(np.hypot(*ends.T) - 1), np.linalg.norm(ends[:, None] - own, axis=-1).min(axis=1))
    assert away.max() < 1e-9


def test_lines_out_of_sight_leave_nothing():
    lines = SphereLines.straight_in_lonlat([[(170, -10), (175, -20), (180, -30)]])
    for view in (View(0, 0), StereographicView(0, 0, angular_radius=100)):
        seen = lines.on(Chart(NONE, view))
        assert seen.values.shape == (0, 2)
        assert len(seen) == 0
    assert len(SphereLines.straight_in_lonlat([]).on(Chart(NONE, View(0, 0)))) == 0


@given(st.integers(0, 1000), st.floats(0.01, 1.0))
def test_thinning_moves_no_line_by_more_than_the_spacing(seed, spacing):
    rng = np.random.default_rng(seed)
    lines = Ragged(np.cumsum(rng.normal(scale=0.1, size=(60, 2)), axis=0), np.array([0, 20, 22, 60]))
    for line, thin in zip(lines, thinned(lines, spacing), strict=True):
        assert (thin[0] == line[0]).all()
        assert (thin[-1] == line[-1]).all()
        assert np.linalg.norm(line[:, None] - thin, axis=-1).min(axis=1).max() <= spacing


@pytest.mark.parametrize("size", [1e4, 1e8, 1e12])
@pytest.mark.parametrize("latitude", ["spherical", "authalic"])
def test_long_edges_through_a_strong_lens_are_exact_and_few_pieces(size, latitude):
    """Through the focus, beside it and far from it; equal pieces would be ten million."""
    ends = np.array([[(-8.0, 45.0), (12.0, 52.0)], [(-8.0, 45.1), (12.0, 52.0)], [(100.0, 0.0), (120.0, 30.0)]])
    focus, tolerance = ends[0].mean(axis=0), 1e-4
    lens = fisheye(lonlat_to_xyz(focus, latitude=latitude), magnification=size)
    edges = SphereLines.straight_in_lonlat(ends, latitude).edges
    arcs = edges.arcs_under(lens, tolerance)
    assert len(arcs) < 3000
    assert (np.diff(arcs.edge) >= 0).all()
    for edge, (start, end) in enumerate(ends):
        own = arcs.take(arcs.edge == edge)
        assert np.array_equal(own.start[0], lonlat_to_xyz(start, latitude=latitude))
        assert np.array_equal(own.end[-1], lonlat_to_xyz(end, latitude=latitude))
        assert np.array_equal(own.start[1:], own.end[:-1])
        # Closer and closer to the focus, as the lens shows it.
        near = 0.5 + np.array([-1, 1])[:, None] * np.geomspace(0.5, 1e-3 / size, 40)
        truth = lens(lonlat_to_xyz(start + np.sort(near.ravel())[:, None] * (end - start), latitude=latitude))
        drawn = own.through(lens).sampled(tolerance / 2).values
        assert distance(truth, drawn).max() <= tolerance + 4e-16 * size  # the rounding of the places
