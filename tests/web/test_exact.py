"""The kernel of the web against the one of Python: every integer, every coordinate, every sign, bit for bit.

Both sides hash each array; the script is tests/web/exact.ts, in Node and in Chromium.
"""

import base64
import hashlib
import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

import stereodel
from stereodel import PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi, _kernel
from stereodel.conformal import MoebiusMap, fisheye
from stereodel.predicates import in_bubble, incircle, orient2d, orient3d
from stereodel.sphere import Rotation
from tests import sets

ROOT = Path(__file__).resolve().parents[2]
WEB = ROOT / "stereodel" / "web"
ESBUILD = WEB / "script" / "node_modules" / "esbuild" / "bin" / "esbuild"

FIXTURES = sorted((ROOT / "tests" / "fixtures" / "delaunator").glob("*.json"))
BY_DAY = ["plane none", "plane lattice", "plane clusters", "sphere random", "sphere graticule", "sphere clusters"]


def every_set():
    """Points (n, 2) or (n, 3) by name: all sets, those that delaunator stumbled over, clusters of all sizes, many."""
    found = {str(each): each.points for each in sets.ALL.values()}
    for file in FIXTURES:
        found[file.stem] = np.array(json.loads(file.read_text(encoding="utf-8")), dtype=float)
    rng = np.random.default_rng(6161)
    for power in (2, 4, 6, 7, 8, 9, 10, 12, 14, 15, 16):
        close = sets.near(rng, sets.MIDDLE, 10.0**-power, 200)
        found[f"cluster of 1e-{power}"] = np.vstack([close, rng.normal(size=(20, 3))])
    subnormal = 1e-320 * rng.integers(1, 10, size=(60, 3))
    found["1e300 and subnormal"] = np.vstack([1e300 * rng.normal(size=(60, 3)), subnormal])
    return found | {"a hundred thousand": rng.normal(size=(100_000, 3))}


def queries_of(points, count=400):
    """Points and middles of points, rows of a set, and others near them, for questions about the set."""
    rng = np.random.default_rng(len(points))
    if not len(points):
        return points
    chosen, others = points[rng.integers(0, len(points), size=(2, count))]
    rows = np.vstack([chosen, chosen / 2 + others / 2, chosen + 1e-9 * others])
    return rows[rows.any(axis=1) & np.isfinite(rows).all(axis=1)]


def digest(array, kind):
    array = np.ascontiguousarray(array, dtype=kind)
    if array.dtype.kind == "f":
        array = np.where(np.isnan(array), np.nan, array)
    return hashlib.sha256(array.tobytes()).hexdigest()


def described(points):
    """What exact.ts says of a set, by Python."""
    queries = queries_of(points)
    if points.shape[1] == 2:
        triangulation = PlanarDelaunay(points, workers=1)
        diagram = PlanarVoronoi(triangulation)
    else:
        triangulation = SphericalDelaunay(points, workers=1)
        diagram = SphericalVoronoi(triangulation)
    indptr, indices = triangulation.vertex_neighbor_vertices
    tally = triangulation.inconclusive
    stages = [tally.get(stage, 0) for stage in ("filter", "curvature", "double_double", "exact")]
    integers = {"indptr": indptr, "indices": indices, "find_simplex": triangulation.find_simplex(queries)}
    for name in ("simplices", "neighbors", "duplicates", "edges", "convex_hull"):
        integers[name] = getattr(triangulation, name)
    for name in ("region_offsets", "region_indices", "region_neighbors", "point_region", "simplex_vertex"):
        integers[name] = getattr(diagram, name)
    integers |= {"ridge_points": diagram.ridge_points, "ridge_vertices": diagram.ridge_vertices}
    doubles = {"counts": [triangulation.dimension, *stages], "circumcenters": triangulation.circumcenters}
    doubles |= {"vertices": diagram.vertices, "areas": diagram.areas(), "centroids": diagram.centroids()}
    found = {}
    if points.shape[1] == 3:
        doubles |= {"lonlat": stereodel.xyz_to_lonlat(points), "ridge_normals": diagram.ridge_normals()}
        found["closing"] = digest(triangulation.closing, np.bool_)
    if len(points):
        integers["nearest"] = triangulation.nearest(queries)
        integers["nearest_few"] = triangulation.nearest(queries, k=min(5, len(points)))
        triangulation.insert(queries[:1])
        integers["inserted"] = triangulation.simplices
        integers["number"] = triangulation.remove([0])
        integers["removed"] = triangulation.simplices
        integers["left"] = triangulation.duplicates
    found |= {name: digest(array, np.int32) for name, array in integers.items()}
    return found | {name: digest(array, np.float64) for name, array in doubles.items()}


def text(array):
    return base64.b64encode(np.ascontiguousarray(array, dtype=float).tobytes()).decode("ascii")


ENTRY = f"""
import bytes from "{WEB}/built/stereodel.wasm";
import {{ load }} from "{WEB}/script/kernel/instance.ts";
export * from "{ROOT}/tests/web/exact.ts";
export const ready = load(bytes);
export const doubles = (text) => new Float64Array(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
"""


@pytest.fixture(scope="session")
def bundle(tmp_path_factory):
    """exact.ts with the module inside: `web.ready` and its functions, for any engine."""
    made = tmp_path_factory.mktemp("exact") / "exact.js"
    options = ["--bundle", "--format=iife", "--global-name=web", "--loader:.wasm=binary", "--target=es2022"]
    line = [ESBUILD, *options, f"--outfile={made}", "--log-level=error"]
    subprocess.run(line, cwd=WEB, input=ENTRY, encoding="utf-8", check=True)
    return made


@pytest.fixture(scope="session", params=["node", pytest.param("chromium", marks=pytest.mark.thorough)])
def web(request, bundle, tmp_path_factory):
    """Run an expression of JavaScript on a value: `web("web.signs(...given)", value)`."""
    if request.param == "node":
        node = request.getfixturevalue("node")
        code = f"import {{ readFileSync }} from 'node:fs'; (0, eval)(readFileSync({json.dumps(str(bundle))}, 'utf8'));"
        yield lambda line, given: node(f"{code} await web.ready; export default await {line};", given)
        return
    page = request.getfixturevalue("browser").new_page()
    empty = tmp_path_factory.mktemp("page") / "page.html"
    empty.write_text("<!doctype html><title>Kernel</title>", encoding="utf-8")
    page.goto(empty.as_uri())
    page.add_script_tag(path=bundle)
    page.evaluate("web.ready")
    yield lambda line, given: page.evaluate(f"async (given) => await {line}", given)
    page.close()


@pytest.mark.parametrize("which", ["some", pytest.param("all", marks=pytest.mark.thorough)])
def test_every_array_of_every_set(web, which):
    asked = every_set() if which == "all" else {name: sets.ALL[tuple(name.split(" ", 1))].points for name in BY_DAY}
    given = [[text(points), points.shape[1], text(queries_of(points))] for points in asked.values()]
    line = "(async () => { const all = []; for (const [points, width, queries] of given) "
    line += "all.push(await web.describe(web.doubles(points), width, web.doubles(queries))); return all; })()"
    made = web(line, given)
    wrong = []
    for (name, points), arrays in zip(asked.items(), made, strict=True):
        expected = described(points)
        assert set(arrays) == set(expected)
        wrong += [f"{name}: {array}" for array in expected if arrays[array] != expected[array]]
    assert wrong == []


PREDICATES = {"orient2d": (orient2d, 2, 3), "incircle": (incircle, 2, 4), "orient3d": (orient3d, 3, 4)}
PREDICATES |= {"in_bubble": (in_bubble, 3, 4), "turn": (_kernel.sphere.turn, 3, 3)}
"""With the width and the number of the points that each is asked about."""


def tied_rows():
    """Rows of four (three) points that lie exactly on a circle, a plane or a line, or a hair beside."""
    rng = np.random.default_rng(60_000)
    for name, (_, width, count) in PREDICATES.items():
        rows = [rng.integers(-3, 4, size=(14_000, width)).astype(float) for _ in range(count)]
        # A third of the rows are moved by one unit in the last place of one coordinate, a third are scaled.
        rows[-1][:4000, 0] = np.nextafter(rows[-1][:4000, 0], rng.choice([-9.0, 9.0], size=4000))
        rows[0][4000:8000] *= 2.0 ** rng.integers(-30, 30, size=(4000, 1))
        stays = np.all([row.any(axis=1) for row in rows], axis=0)
        yield name, [row[stays] for row in rows]


def test_signs_at_ties(web):
    asked = list(tied_rows())
    assert sum(len(rows[0]) for _, rows in asked) > 60_000
    given = [[name, [text(points) for points in rows]] for name, rows in asked]
    line = "Promise.all(given.map(([name, rows]) => web.signs(name, rows.map(web.doubles))))"
    made = dict(zip([name for name, _ in asked], web(line, given), strict=True))
    for name, rows in asked:
        signs = PREDICATES[name][0](*rows)
        assert min(np.count_nonzero(signs == s) for s in (-1, 0, 1)) > 100
        assert made[name] == digest(signs, np.int8), name


def test_latitudes_of_the_ellipsoid(rng, web):
    lonlat = np.column_stack([rng.uniform(-400, 400, 4000), rng.uniform(-90, 90, 4000)])
    lonlat[:7, 1] = [90, -90, 0, -0.0, 45, 5e-324, 89.99999999999999]
    made = web("web.ellipsoid(web.doubles(given))", text(lonlat))
    for kind in ("geodetic", "authalic"):
        assert made[kind] == digest(stereodel.lonlat_to_xyz(lonlat, latitude=kind), np.float64)


def test_maps_of_all_magnifications(rng, web):
    lonlat = np.column_stack([rng.uniform(-180, 180, 3000), rng.uniform(-90, 90, 3000)])
    lonlat[:6] = [[0, 90], [0, -90], [0, 0], [180, 0], [-90, 45], [12.5, 41.9]]
    sizes = [float(10.0**k) for k in range(-9, 10)] + [1.0, 1 / 3, 7.25]
    made = iter(web("web.maps(web.doubles(given.lonlat), given.sizes)", {"lonlat": text(lonlat), "sizes": sizes}))
    xyz = stereodel.lonlat_to_xyz(lonlat)
    for k, size in enumerate(sizes):
        lens = fisheye(lonlat[k], magnification=size)
        turned = MoebiusMap.rotation(Rotation.about(lonlat[k + 1], 10 * k + 0.1))
        both = lens @ turned @ fisheye(xyz[k + 3], magnification=2.5)
        for which, map_ in enumerate([lens, both, both.inverse(), lens @ lens.inverse()]):
            parameters = [*map_.left.quaternion, map_.magnification, *map_.right.quaternion]
            expected = {"parameters": parameters, "focus": map_.focus, "images": map_(xyz)}
            expected |= {"scales": map_.scale_factor(xyz), "lonlat": map_.lonlat(lonlat)}
            arrays = next(made)
            wrong = [name for name, array in expected.items() if arrays[name] != digest(array, np.float64)]
            assert wrong == [], (size, which)
