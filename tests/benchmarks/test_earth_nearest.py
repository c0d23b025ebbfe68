"""The comparison with the ellipsoid: its search finds the nearest, and it finds what its page says."""

import json

import numpy as np
import pytest

from benchmarks import earth_nearest, earth_page, pages
from benchmarks.earth_nearest import WGS84, excess, geodesics, lengths, truly_nearest, uniform
from stereodel import earth


def test_the_nearest_is_found():
    generator = np.random.default_rng(1)
    sites, queries = uniform(300, generator), uniform(50, generator)
    every = geodesics(np.repeat(queries, 300, axis=0), np.tile(sites, (50, 1))).reshape(50, 300)
    np.testing.assert_allclose(truly_nearest(sites, queries), every.min(axis=1), rtol=1e-12)


def test_distances_of_ellipsoid_and_sphere_differ_by_no_more_than_the_spread():
    generator = np.random.default_rng(2)
    lonlat = uniform(20_000, generator)
    east, north = lonlat + [1e-3, 0], lonlat + [0, 1e-3]
    steps = [geodesics(lonlat, east) / np.cos(np.radians(lonlat[:, 1])), geodesics(lonlat, north)]
    ratios = np.concatenate(steps) / np.radians(1e-3)
    assert ratios.max() / ratios.min() < earth_nearest.SPREAD
    assert ratios.max() / ratios.min() > 1.009


@pytest.mark.thorough
def test_the_centres_direction_is_best_and_mixing_is_worst(monkeypatch):
    monkeypatch.setattr(earth_nearest, "PAIRS", 2000)
    generator = np.random.default_rng(3)
    sites, queries = uniform(2000, generator), uniform(20_000, generator)
    nearest = truly_nearest(sites, queries)
    found = {k: excess(sites, queries, nearest, k) for k in [("geodetic",) * 2, ("authalic",) * 2, ("spherical",) * 2]}
    shares = [numbers["share"] for numbers in found.values()]
    assert shares == sorted(shares)
    assert (
        found["spherical", "spherical"]["share"]
        < excess(sites, queries, nearest, ("geodetic", "spherical"))["share"] / 5
    )
    errors = lengths(generator, 0.01)
    # At the equator and at the poles: radii of curvature against the mean radius.
    meridian = WGS84.a / 1000 * (1 - earth.FLATTENING) ** 2
    assert errors["spherical"]["largest"] == pytest.approx(earth.MEAN_RADIUS_KM / meridian - 1, rel=0.02)


def test_page_shows_the_numbers():
    results = json.loads(earth_nearest.RESULTS.read_text(encoding="utf-8"))
    page = (pages.DOCS / "earth.md").read_text(encoding="utf-8")
    assert earth_page.nearest_table(results) in page
    assert earth_page.lengths_table(results) in page
