"""Edges as arcs and their images: on their circles, ends bit for bit, chords within the tolerance."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from stereodel import MoebiusMap, SphereArc, fisheye, lonlat_to_xyz
from stereodel.curves.ragged import Ragged
from stereodel.curves.trace import Edges, great, largest_scale, sides_of, unwrapped
from tests.curves.oracle import off_lines, units
from tests.strategies import BETWEEN_POLES, SEEDS, decades

AXES = np.eye(3)


def any_lens(rng):
    return fisheye(units(rng.normal(size=3)), magnification=float(10 ** rng.uniform(-2, 3)))


def between(p, q, share):
    """Points of great-circle arcs from p to q, not evenly."""
    return units((1 - share)[:, None] * p + share[:, None] * q)


@given(SEEDS)
def test_images_of_great_arcs_lie_on_their_arcs(seed):
    rng = np.random.default_rng(seed)
    lens, (p, q) = any_lens(rng), units(rng.normal(size=(2, 3)))
    arcs = great(p[None], q[None]).through(lens)
    # The ends are the images of the ends, and pieces share theirs, bit for bit.
    assert (arcs.start[0] == lens(p)).all()
    assert (arcs.end[-1] == lens(q)).all()
    assert (arcs.start[1:] == arcs.end[:-1]).all()
    assert (arcs.stop - arcs.begin <= np.pi + 1e-9).all()
    # Images of points between lie on one of the circles, and no farther from the chords than the tolerance.
    images = lens(between(p, q, np.linspace(0, 1, 300)))
    assert np.abs(images @ arcs.axis.T - arcs.offset).min(axis=1).max() < 1e-9
    tolerance = 10.0 ** rng.uniform(-6, -1)
    samples = arcs.sampled(tolerance)
    assert off_lines(images, [samples.values]).max() < tolerance * (1 + 1e-6) + 1e-9


def test_half_turns_keep_their_angle(rng):
    """Rounding makes of a half turn's sine a tiny negative number, whose arc tangent is −π: no arc at all."""
    start = units(rng.normal(size=(2000, 3)))
    normal = units(np.cross(start, rng.normal(size=(2000, 3))))
    arcs = great(start, -start, normal)
    assert np.abs(arcs.stop - np.pi).max() < 1e-7
    middle = arcs.points(np.arange(2000), arcs.stop / 2)
    assert np.abs(middle - np.cross(normal, start)).max() < 1e-7
    # The apsides of an image are half a turn apart.
    for lens in (fisheye(AXES[0], magnification=5.0), fisheye(AXES[2], magnification=0.2)):
        images = great(np.array([[0.6, 0.8, 0.0]]), np.array([[-0.6, -0.8, 0.0]]), np.array([[0.0, 0.0, 1.0]])).through(
            lens
        )
        assert (images.stop > 0.1).all()
        assert images.sampled(1e-3).sizes.min() > 3


def test_a_lens_that_magnifies_nothing_turns():
    lens = MoebiusMap.rotation((30.0, 20.0), 130.0)
    arcs = great(AXES[:1], AXES[1:2]).through(lens)
    np.testing.assert_allclose(arcs.start, lens(AXES[:1]), atol=1e-15)
    np.testing.assert_allclose(arcs.points(np.array([0]), arcs.stop / 2), lens(units([[1.0, 1.0, 0.0]])), atol=1e-15)


def test_edges_without_length_stay():
    for lens in (MoebiusMap.identity(), fisheye(AXES[0], magnification=3.0)):
        samples = great(AXES[:1], AXES[:1]).through(lens).sampled(1e-4)
        np.testing.assert_allclose(samples.values, lens(AXES[[0, 0]]), atol=1e-15)


@given(SEEDS, st.sampled_from(["spherical", "geodetic", "authalic"]))
def test_edges_straight_in_degrees(seed, latitude):
    rng = np.random.default_rng(seed)
    lens = any_lens(rng)
    a, b = rng.uniform((-180, -90), (180, 90), size=(2, 2))
    if rng.random() < 0.3:
        b[1] = a[1]
    if rng.random() < 0.2:
        b = b.copy()
        b[1] = 90.0
    tolerance = 10.0 ** rng.uniform(-4, -2)
    arcs = Edges.straight(a[None], b[None], latitude).arcs_under(lens, tolerance / 2).through(lens)
    samples = arcs.sampled(tolerance / 2)
    share = np.linspace(0, 1, 400)[:, None]
    images = lens(lonlat_to_xyz((1 - share) * a + share * b, latitude=latitude))
    assert off_lines(images, [samples.values]).max() < tolerance
    ends = lens(lonlat_to_xyz(np.stack([a, b]), latitude=latitude))
    assert (samples.values[[0, -1]] == ends).all()


def test_parallels_are_followed_exactly():
    a, b = np.array([[-100.0, 60.0], [100.0, 60.0]]), np.array([[200.0, 60.0], [-200.0, 60.0]])
    arcs = Edges.straight(a, b).arcs_under(MoebiusMap.identity(), 1e-2)
    assert len(arcs) == 2
    np.testing.assert_allclose(arcs.stop, np.radians(300))
    points = arcs.sampled(1e-6).values
    np.testing.assert_allclose(points[:, 2], np.sin(np.radians(60)), atol=1e-15)


def test_sides_of_lines_and_longitudes_that_go_on():
    lines = Ragged.of(
        [np.array([[170.0, 0], [-170, 5], [-160, 0]]), np.array([[0.0, 1]]), np.array([[5.0, 5], [6, 6]])]
    )
    going_on = unwrapped(lines)
    assert going_on.values[:, 0].tolist() == [170, 190, 200, 0, 5, 6]
    first, sides = sides_of(going_on)
    assert first.tolist() == [0, 1, 4]
    assert [row.tolist() for row in sides] == [[0, 1], [], [2]]
    # Along a pole map files run from one side of the map to the other, and 360° are a whole turn.
    seam = Ragged.of([np.array([[180.0, -60], [180, -90], [-180, -90], [-180, -60], [180, -60]])])
    assert unwrapped(seam) is seam


def test_some_edges_have_the_arcs_that_they_have_among_all(rng):
    a = np.stack([rng.uniform(-180, 180, 40), rng.uniform(-90, 90, 40)], axis=1)
    b = a + rng.uniform(-60, 60, (40, 2))
    b[:, 1] = np.where(np.arange(40) % 4, np.clip(b[:, 1], -90, 90), a[:, 1])
    edges, some = Edges.straight(a, b), np.arange(40) % 3 == 0
    for size in (0.1, 1.0, 50.0):
        lens = fisheye((10.0, 20.0), magnification=size)
        arcs, part = edges.arcs_under(lens, 1e-3), edges.take(some).arcs_under(lens, 1e-3)
        kept = np.isin(arcs.edge, np.flatnonzero(some))
        for name in ("start", "end", "axis", "offset", "u", "begin", "stop"):
            np.testing.assert_array_equal(getattr(arcs, name)[kept], getattr(part, name))
        assert np.bincount(part.edge).tolist() == np.bincount(arcs.edge)[some].tolist()


def test_edges_stay_within_their_length(rng):
    """No point of an edge is farther from its start; so no edge that comes near a place is left out."""
    a = np.stack([rng.uniform(-180, 180, 200), rng.uniform(-90, 90, 200)], axis=1)
    b = a + rng.uniform(-150, 150, (200, 2))
    b[:, 1] = np.clip(b[:, 1], -90, 90)
    edges = Edges.straight(a, b)
    share = np.linspace(0, 1, 101)[:, None, None]
    along = lonlat_to_xyz(a + share * (b - a))
    away = 2 * np.arcsin(np.minimum(np.linalg.norm(along - along[0], axis=-1) / 2, 1))
    assert (away.max(axis=0) <= edges.length + 1e-12).all()
    place = np.array([0.6, 0.0, 0.8])
    reach = 0.3
    comes = (2 * np.arcsin(np.linalg.norm(along - place, axis=-1) / 2) <= reach).any(axis=0)
    near = edges.within(place, reach)
    assert (near | ~comes).all()
    assert near.sum() < 200


@given(focus=BETWEEN_POLES, size=decades(-6, 6), at=BETWEEN_POLES, radius=st.floats(0, 3), seed=st.integers(0, 100))
def test_no_scale_nearby_is_larger_than_the_bound(focus, size, at, radius, seed):
    lens = fisheye(focus, magnification=size)
    rng = np.random.default_rng(seed)
    center = SphereArc.great(at, (at[0] + 1.0, at[1] * 0.5)).start
    other = rng.normal(size=(200, 3))
    side = other - np.outer(other @ center, center)
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    angle = (radius * rng.random(200))[:, None]
    points = np.cos(angle) * center + np.sin(angle) * side
    bound = largest_scale(lens, center[None], np.array([radius]))[0]
    assert lens.scale_factor(points).max() <= bound * (1 + 1e-6)
    assert bound <= max(size, 1 / size) * (1 + 1e-12)
