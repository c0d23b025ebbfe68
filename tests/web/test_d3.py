"""`geoDelaunay` and `geoVoronoi` beside d3-geo-voronoi itself: its documented examples by method, and random sets.

Both are asked the same, and list the same in the same order but for what is said beside `DIFFER`.
"""

import numpy as np
import pytest

from tests.web.conftest import LOADED, SCRIPT

BOTH = f"""{LOADED}
import * as ours from "{SCRIPT}/kernel/d3.ts";
import * as theirs from "{SCRIPT}/node_modules/d3-geo-voronoi/src/index.js";
import {{ geoArea, geoCentroid }} from "{SCRIPT}/node_modules/d3-geo/src/index.js";
"""

FIVE = [[10, 0], [10, 10], [3, 5], [-2, 5], [0, 0]]
"""The sites of its own examples."""


@pytest.fixture
def both(node):
    """Ask both of them: `both("d3.geoVoronoi().hull(given)", sites)`; ours first."""

    def ask(expression, given):
        return node(f"{BOTH} const ask = (d3) => {expression}; export default [ask(ours), ask(theirs)];", given)

    return ask


def places(count, seed):
    rng = np.random.default_rng(seed)
    z = rng.uniform(-1, 1, count)
    return np.column_stack([rng.uniform(-180, 180, count), np.degrees(np.arcsin(z))]).round(4).tolist()


THREE = [[0, 0], [10, 0], [0, 10]]
METHODS = ["polygons", "triangles", "links", "mesh", "cellMesh", "find", "hull", "x", "y"]
OBJECTS = [{"lon": 10, "lat": 0}, {"lon": 3, "lat": 5}, {"lon": -2, "lat": 5}]


@pytest.mark.parametrize(
    ("expression", "given"),
    [
        ("given.map((name) => typeof d3.geoVoronoi()[name])", METHODS),
        ("Object.keys(d3.geoDelaunay(given)).sort()", FIVE),
        ("d3.geoVoronoi().x((d) => +d.lon).y((d) => +d.lat)(given).points", OBJECTS),
        ("[d3.geoVoronoi().x((d) => d.lon).x()(given[0])]", OBJECTS),
    ],
)
def test_the_same_as_theirs(both, expression, given):
    own, other = both(expression, given)
    assert own == other
    assert own


def test_what_its_pages_say_and_it_does_not(both):
    """Radii are in degrees; without data there is nothing."""
    places_and_radii = "[[1, 1], [1, 1, 4], [50, 0, 39], [50, 0, 41]]"
    assert both(f"{places_and_radii}.map((asked) => d3.geoVoronoi(given).find(...asked))", FIVE)[0] == [4, 4, None, 0]
    assert both("given.slice(0, 5).map((name) => d3.geoVoronoi()[name]())", METHODS)[0] == [False] * 5


def test_one_site_has_the_whole_sphere_and_none_has_nothing(both):
    number = "((place) => place.map((value) => value ?? NaN))"  # JSON has no NaN
    line = f"given.map((sites) => d3.geoVoronoi(sites.map({number})).polygons().features)"
    own, other = both(line, [[[None, -1], [5, 10]], [[4, None]], []])
    assert own == other
    assert own[0][0]["geometry"] == {"type": "Sphere"}
    assert own[1:] == [[], []]


def test_features_are_at_their_points(both):
    shapes = [{"type": "Point", "coordinates": [1, 2]}, {"type": "Point", "coordinates": [9, 9, 100]}]
    features = [{"type": "Feature", "properties": {}, "geometry": shape} for shape in shapes]
    own, other = both("d3.geoVoronoi(given).points", {"type": "FeatureCollection", "features": features})
    assert np.allclose(own, other, rtol=0, atol=1e-9)
    assert both("d3.geoVoronoi(given).points", shapes)[0] == own
    line = {"type": "LineString", "coordinates": [[20, 0], [20, 30]]}
    assert both("d3.geoVoronoi(given).points", [line, shapes[0], {"type": "Feature", "geometry": None}])[0] == [[1, 2]]


def near(lon, lat, width, count, seed):
    rng = np.random.default_rng(seed)
    return (np.array([lon, lat]) + width * rng.uniform(-1, 1, (count, 2))).tolist()


def directions(rows):
    xyz = np.array(rows, dtype=float)
    return np.degrees(
        np.column_stack([np.arctan2(xyz[:, 1], xyz[:, 0]), np.arctan2(xyz[:, 2], np.hypot(xyz[:, 0], xyz[:, 1]))])
    ).tolist()


SIGNS = [(a, b) for a in (-1, 1) for b in (-1, 1)]
GOLDEN = (1 + 5**0.5) / 2
SETS = {
    "four": places(4, 41),
    "five": FIVE,
    "three": THREE,
    "two": [[-20, -20], [20, 20]],
    "ten": places(10, 10),
    "hundred": places(100, 100),
    "three hundred": places(300, 300),
    "hemisphere": near(40, 10, 60, 150, 2),
    "country": near(10, 50, 5, 200, 3),
    "city": near(11.5, 48.1, 0.1, 100, 4),
    "clusters": near(0, 0, 3, 60, 5) + near(120, -40, 2, 60, 6) + near(-90, 60, 1, 60, 7),
    "cluster and world": near(139, 35, 0.5, 100, 8) + places(100, 8),
    "poles": [*places(50, 11), [0, 90], [0, -90]],
    "dateline": near(180, 0, 30, 120, 12),
    "jittered grid": [
        [10 * i + x, 10 * j + y]
        for i in range(-17, 18, 2)
        for j in range(-7, 8, 2)
        for x, y in near(0, 0, 2, 1, 40 * i + j + 900)
    ],
    "spiral": [
        [(137.50776405 * k) % 360 - 180, float(np.degrees(np.arcsin(1 - (2 * k + 1) / 150)))] for k in range(150)
    ],
    "icosahedron": directions(
        [p for a, b in SIGNS for p in ((0, a, b * GOLDEN), (a, b * GOLDEN, 0), (b * GOLDEN, 0, a))]
    ),
    "octahedron": directions(np.vstack([np.eye(3), -np.eye(3)])),
    "grid": [[5.0 * i, 4.0 * j] for i in range(6) for j in range(-3, 4)],
    "great circle": [[40.0 * k, 0] for k in range(9)],
    "twins": [*places(20, 13), *places(20, 13)[:3]],
}
"""Places nowhere near a tie, ties (polyhedra, a grid, a great circle), equal places."""

ASKED = """({
  ...Object.fromEntries(["edges", "triangles", "centers", "neighbors", "polygons", "mesh", "hull"].map((name) =>
    [name, geo[name]])),
  "delaunay.triangles": [...geo.delaunay.triangles],
  urquhart: geo.urquhart(geo.edges.map(([i, j]) => Math.hypot(given[i][0] - given[j][0], given[i][1] - given[j][1])))
    .map((is, k) => is && geo.edges[k]),
  find: given.map(([lon, lat]) => geo.find(lon + 1.3, lat * 0.97)),
  ...Object.fromEntries(["polygons", "triangles", "links", "mesh", "cellMesh", "hull"].map((name) =>
    [`geoVoronoi.${name}`, d3.geoVoronoi(given)[name]()])),
  contours: d3.geoContour()(valued),
  contour: d3.geoContour().contour(valued, 1.5),
  isobands: [...d3.geoContour().isobands(valued)],
  thresholds: d3.geoContour().thresholds(4)(valued).map((made) => made.value),
})"""
"""Every method of `geo`, the triangulation, and of generators made for the sites or for values at them."""

OF_TRIANGLES = {"edges", "triangles", "centers", "neighbors", "polygons", "mesh", "delaunay.triangles", "urquhart"}
OF_TRIANGLES |= {f"geoVoronoi.{name}" for name in ("polygons", "links", "mesh", "cellMesh")}
OF_TRIANGLES |= {"contours", "contour", "isobands"}
DIFFER = {
    # Exactly equal heights: both choose diagonals of their own, and all orders follow from the triangles.
    "grid": {*OF_TRIANGLES, "hull", "geoVoronoi.triangles", "geoVoronoi.hull"},
    # It makes triangles of rounding errors; here there are none.
    "great circle": OF_TRIANGLES,
    # It leaves out features of equal places at the end, and has holes instead of no neighbours.
    "twins": {"neighbors", "polygons", "geoVoronoi.polygons"},
    # Edges of equal length: which one is the longest of a triangle, rounding decides.
    "icosahedron": {"geoVoronoi.links"},
    "octahedron": {"geoVoronoi.links"},
}
"""What differs, and why; besides, of all sets, what `kept` takes out."""


def kept(made):
    """Without what it has by mistake: triangles and rings of one site, hull edges that it drops from the Urquhart graph
    as if triangles lay beyond them."""
    flat = made["delaunay.triangles"]
    rows = [flat[k : k + 3] for k in range(0, len(flat), 3)]
    made["delaunay.triangles"] = [row for row in rows if len({*row}) == 3]
    hull = made["hull"]
    border = {frozenset(pair) for pair in zip(hull, hull[1:] + hull[:1], strict=True)}
    made["urquhart"] = [edge for edge in made["urquhart"] if edge and frozenset(edge) not in border]
    for feature in made["geoVoronoi.links"]["features"] if hull else []:
        del feature["properties"]["urquhart"]
    for region in [*made["contours"], made["contour"], *made["isobands"]]:
        region["coordinates"] = [[ring for ring in rings if len(ring) > 2] for rings in region["coordinates"]]
    return made


def same(own, other, within):
    """Whether values are equal but for rounding: places within so many degrees, by way of -180, numbers likewise."""
    if isinstance(own, dict):
        return own.keys() == other.keys() and all(same(own[name], other[name], within) for name in own)
    if isinstance(own, list) and isinstance(other, list):
        return len(own) == len(other) and all(map(same, own, other, [within] * len(own)))
    if type(own) in (int, float) and type(other) in (int, float):
        return abs(own - other) <= within or abs(abs(own - other) - 360) <= within
    return own == other


def test_orders_and_all(node):
    """Every method on sets of all kinds: in its order; contours are near, since its first site moves."""
    results = node(
        f"""{BOTH}
        const ask = (d3, given) => {{
          const [geo, valued] = [d3.geoDelaunay(given), given.map(([lon, lat], k) => [lon, lat, 10 * Math.sin(k)])];
          return {ASKED};
        }};
        const none = (ask) => {{ try {{ return ask(); }} catch {{ return null; }} }};
        export default Object.entries(given).map(([name, sites]) =>
          [name, ask(ours, sites), none(() => ask(theirs, sites))]);
        """,
        SETS,
    )
    wrong = []
    for name, own, other in results:
        left = {method for method in own if other is not None}
        own, other = kept(own), other and kept(other)
        for method in left:
            within = 1e-3 if method in ("contours", "contour", "isobands") else 2e-5
            if same(own[method], other[method], within) == (method in DIFFER.get(name, ())):
                wrong.append((name, method))
    assert wrong == []


@pytest.mark.parametrize(
    "sites",
    [
        [[0, 0], [10, 0]],
        [[0, 0], [180, 0]],
        [[0, 90], [0, -90]],
        [[0, 0], [90, 0], [180, 0], [-90, 0]],
        [[0, 0], [10, 0], [20, 0]],
        [[0, 0], [10, 0], [0, 10]],
        [[0, 0], [10, 0], [0, 10], [10, 0]],
        [[0, 0], [1e-9, 0], [0, 1e-9], [1e-9, 1e-9], [90, 0]],
    ],
    ids=str,
)
def test_cells_of_sites_that_others_stumble_over(both, sites):
    """They are wound as d3-geo wants them: areas by its own measure add up to the sphere; duplicates have none."""
    line = "d3.geoVoronoi(given).polygons().features.map((f) => f.geometry && geoArea(f))"
    areas, _ = both(f"d3 === ours ? {line} : null", sites)
    cells = [area for area in areas if area is not None]
    assert len(cells) == len({tuple(site) for site in sites})
    assert np.isclose(sum(cells), 4 * np.pi, rtol=1e-6)
    assert min(cells) > 0
