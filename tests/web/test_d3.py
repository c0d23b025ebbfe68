"""`geoDelaunay` and `geoVoronoi` beside d3-geo-voronoi itself: its documented examples by method, and random sets.

Both are asked the same; orders that neither documents are taken out before they are compared.
"""

import numpy as np
import pytest

from tests.tiers import by_day
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


def turned(ring):
    """A ring from its least entry on; the last one of a closed ring stands for the first."""
    rows = [tuple(row) if isinstance(row, list) else row for row in ring]
    rows = rows[:-1] if rows[0] == rows[-1] else rows
    least = rows.index(min(rows))
    return rows[least:] + rows[:least]


def rounded(value, digits=6):
    """Numbers of nested lists without their last digits, -180 for 180 and one longitude at the poles."""
    if isinstance(value, list) and len(value) == 2 and all(isinstance(part, int | float) for part in value):
        lon, lat = round(value[0], digits), round(value[1], digits)
        return (0.0 if abs(lat) == 90 else -180.0 if lon == 180 else lon + 0.0, lat + 0.0)
    return [rounded(part, digits) for part in value] if isinstance(value, list) else value


def places(count, seed):
    rng = np.random.default_rng(seed)
    z = rng.uniform(-1, 1, count)
    return np.column_stack([rng.uniform(-180, 180, count), np.degrees(np.arcsin(z))]).round(4).tolist()


def unordered(rows):
    return sorted(map(sorted, rounded(rows)))


THREE = [[0, 0], [10, 0], [0, 10]]
METHODS = ["polygons", "triangles", "links", "mesh", "cellMesh", "find", "hull", "x", "y"]
LINKS = "d3.geoVoronoi().links(given).features"
URQUHART = f"{LINKS}.filter((f) => f.properties.urquhart).map((f) => f.geometry.coordinates)"
TRIANGLES = "d3.geoVoronoi().triangles(given).features"
OBJECTS = [{"lon": 10, "lat": 0}, {"lon": 3, "lat": 5}, {"lon": -2, "lat": 5}]
SAME = {
    "methods": ("given.map((name) => typeof d3.geoVoronoi()[name])", METHODS, list),
    "light": ("Object.keys(d3.geoDelaunay(given))", FIVE, sorted),
    "hull": ("d3.geoVoronoi().hull(given).coordinates[0]", FIVE, turned),
    "no hull": ("[d3.geoVoronoi(given).hull()]", places(100, 1), list),
    "mesh": ("d3.geoVoronoi().mesh(given).coordinates", FIVE, unordered),
    "cell mesh": ("d3.geoVoronoi().cellMesh(given).coordinates", FIVE, unordered),
    "lengths": (f"{LINKS}.map((f) => f.properties.length)", THREE, lambda found: sorted(round(x, 12) for x in found)),
    "corners": (f"{TRIANGLES}.map((f) => f.geometry.coordinates[0])", THREE, lambda rings: [*map(turned, rings)]),
    "centres": (f"{TRIANGLES}.map((f) => f.properties.circumcenter)", THREE, rounded),
    "accessors": ("d3.geoVoronoi().x((d) => +d.lon).y((d) => +d.lat)(given).points", OBJECTS, list),
    "accessor": ("[d3.geoVoronoi().x((d) => d.lon).x()(given[0])]", OBJECTS, list),
    "urquhart": (URQUHART, THREE, unordered),
    "urquhart of many": (URQUHART, places(200, 9), unordered),
}
"""What is asked of both, about what, and what takes an order out that neither documents."""


@pytest.mark.parametrize("name", SAME)
def test_the_same_as_theirs(both, name):
    expression, given, ordered = SAME[name]
    own, other = both(expression, given)
    assert ordered(own) == ordered(other)
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


@pytest.mark.parametrize("seed", by_day(range(4), 0))
@pytest.mark.parametrize("count", [4, 5, 20, 300])
def test_random_sites(both, count, seed):
    """Indices of everything, sets of everything, on sites that lie nowhere near a tie."""
    own, other = both(
        "(() => { const d = d3.geoDelaunay(given);"
        "const shown = ({edges, triangles, neighbors, polygons, hull, mesh}) => "
        "({edges, triangles, neighbors, polygons, hull, mesh, centers: d.centers}); return { ...shown(d),"
        "urquhart: d.urquhart(d.edges.map((_, k) => k)), found: given.map(([lon, lat]) => d.find(-lon, lat)),"
        "areas: d3.geoVoronoi(given).polygons().features.map(geoArea) }; })()",
        places(count, 100 * count + seed),
    )
    assert {tuple(turned(t)) for t in own["triangles"]} == {tuple(turned(t)) for t in other["triangles"]}
    assert {tuple(sorted(e)) for e in own["edges"]} == {tuple(sorted(e)) for e in other["edges"]}
    assert [sorted(n) for n in own["neighbors"]] == [sorted(n) for n in other["neighbors"]]
    assert own["found"] == other["found"]
    assert np.allclose(own["areas"], other["areas"], rtol=1e-9)
    assert sorted(own["hull"]) == sorted(other["hull"])
    assert len(own["mesh"]) == len(other["mesh"])

    def cells(made):
        return [turned([made["centers"][center] for center in polygon]) for polygon in made["polygons"]]

    for cell, their_cell in zip(cells(own), cells(other), strict=True):
        assert len(cell) == len(their_cell)
        assert np.allclose(sorted(cell), sorted(their_cell), atol=1e-6)


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
