"""What a sphere costs where the Earth is an ellipsoid: distances and nearest places, measured against geodesics.

    python -m benchmarks.earth_nearest

Distances of random pairs, and the nearest of 28 298 airports and of as many random places for random points of the
ellipsoid, on the sphere by each kind of latitude and on WGS84 by pyproj's geodesics. Writes
benchmarks/earth_nearest.json, the tables of docs/earth.md and its plot.
"""

from __future__ import annotations

import json
import time
from typing import Any

import numpy as np
from pyproj import Geod
from scipy.spatial import cKDTree

from benchmarks import earth_page
from benchmarks.earth_page import RESULTS
from stereodel import SphericalDelaunay, data, earth, lonlat_to_xyz, xyz_to_lonlat
from stereodel._arrays import FloatArray
from stereodel._files import replacing
from stereodel.sphere.latitudes import KINDS

WGS84 = Geod(ellps="WGS84")
PAIRS, QUERIES, SEED = 400_000, 400_000, 19

# The ellipsoid's lengths over those of the sphere with latitudes as they stand are between its least and its greatest
# radius of curvature, a(1 − e²) and a/√(1 − e²); so whatever is nearest on the ellipsoid is on the sphere at most
# (1 − e²)^(−3/2) times as far as what is nearest there. 1e-12 for rounding.
SPREAD = (1 - earth.FLATTENING) ** -3 * (1 + 1e-12)


def uniform(count: int, generator: np.random.Generator) -> FloatArray:
    """Longitude and geodetic latitude of points spread evenly over the ellipsoid."""
    xyz = generator.standard_normal((count, 3))
    return xyz_to_lonlat(xyz, latitude="authalic")


def geodesics(a: FloatArray, b: FloatArray) -> FloatArray:
    """Lengths of geodesics on WGS84, metres."""
    _, _, metres = WGS84.inv(a[:, 0], a[:, 1], b[:, 0], b[:, 1])
    return np.asarray(metres)


def truly_nearest(sites: FloatArray, queries: FloatArray) -> FloatArray:
    """Distance from each query to its nearest site on the ellipsoid, metres."""
    tree = cKDTree(lonlat_to_xyz(sites))
    xyz = lonlat_to_xyz(queries)
    chord, _ = tree.query(xyz)
    # Chord 2 sin(δ/2) is concave in δ: the chord of SPREAD·δ is at most SPREAD times that of δ.
    candidates = tree.query_ball_point(xyz, SPREAD * chord)
    counts = np.array([len(row) for row in candidates])
    metres = geodesics(np.repeat(queries, counts, axis=0), sites[np.concatenate(candidates).astype(int)])
    return np.minimum.reduceat(metres, np.concatenate([[0], np.cumsum(counts)[:-1]]))


def excess(sites: FloatArray, queries: FloatArray, nearest: FloatArray, kinds: tuple[str, str]) -> dict[str, Any]:
    """How often the nearest site on the sphere is not the nearest one, and how much farther it is.

    `kinds`: latitude of the sites and of the queries; two different ones are the mistake that the page warns of.
    """
    triangulation = SphericalDelaunay.from_lonlat(sites, latitude=kinds[0])
    found = triangulation.nearest(lonlat_to_xyz(queries, latitude=kinds[1]))
    farther = geodesics(queries, sites[found]) - nearest
    wrong = farther[farther > 1e-6]  # pyproj's lengths are good to some nanometres
    return {
        "share": len(wrong) / len(queries),
        "median": float(np.median(wrong)) if len(wrong) else 0.0,
        "largest": float(wrong.max(initial=0.0)),
        "relative": float((farther / np.maximum(nearest, 1.0)).max()),
    }


def lengths(generator: np.random.Generator, reach: float) -> dict[str, dict[str, float]]:
    """Relative error of the sphere's distances with the mean radius, for pairs at most `reach` radians apart."""
    start = generator.standard_normal((PAIRS, 3))
    start /= np.linalg.norm(start, axis=1, keepdims=True)
    step = generator.standard_normal((PAIRS, 3))
    step -= np.sum(step * start, axis=1, keepdims=True) * start
    step /= np.linalg.norm(step, axis=1, keepdims=True)
    angle = reach * generator.random((PAIRS, 1))
    a, b = (xyz_to_lonlat(v, latitude="authalic") for v in (start, np.cos(angle) * start + np.sin(angle) * step))
    true = geodesics(a, b)
    kept = true > 1000
    errors = {}
    for kind in KINDS:
        u, v = (lonlat_to_xyz(lonlat[kept], latitude=kind) for lonlat in (a, b))
        chord, sum_ = (np.linalg.norm(w, axis=1) for w in (u - v, u + v))
        error = 2 * np.arctan2(chord, sum_) * earth.MEAN_RADIUS_KM * 1000 / true[kept] - 1
        errors[kind] = {"rms": float(np.sqrt(np.mean(error**2))), "largest": float(np.abs(error).max())}
    return errors


def measure() -> dict[str, Any]:
    """Everything on the page."""
    generator = np.random.default_rng(SEED)
    airports = data.airports().lonlat
    results: dict[str, Any] = {"pairs": PAIRS, "queries": QUERIES, "lengths": {}, "nearest": {}}
    for name, reach in (("anywhere", np.pi), ("within 1000 km", 1 / 6.371), ("within 10 km", 0.01 / 6.371)):
        results["lengths"][name] = lengths(generator, reach)
    queries = uniform(QUERIES, generator)
    for name, sites in (("airports", airports), ("random", uniform(len(airports), generator))):
        nearest = truly_nearest(sites, queries)
        pairs = [(kind, kind) for kind in KINDS] + [("geodetic", "spherical")]
        results["nearest"][name] = {
            f"{kinds[0]}, {kinds[1]}": excess(sites, queries, nearest, kinds) for kinds in pairs
        }
        results["nearest"][name]["mean distance"] = float(nearest.mean())
    return results


def main() -> None:
    """Measure, then write the numbers, the plot and the page's tables."""
    begin = time.perf_counter()
    results = measure()
    with replacing(RESULTS) as temporary:
        temporary.write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")
    earth_page.write(results)
    print(f"{time.perf_counter() - begin:.0f} s")


if __name__ == "__main__":
    main()
