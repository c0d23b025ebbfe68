"""`stereodel/delaunator` and `stereodel/d3-delaunay` beside the packages whose names they bear.

Both are asked the same, method by method, orders included; but `render` of a diagram draws in an order of its own, and
rings of cells may begin elsewhere.
"""

import re

import numpy as np
import pytest

from tests.web.conftest import LOADED, SCRIPT

PEERS = SCRIPT / "node_modules"
BOTH = f"""{LOADED}
import OurDelaunator from "{SCRIPT}/kernel/delaunator.ts";
import * as ours from "{SCRIPT}/kernel/d3_delaunay.ts";
import TheirDelaunator from "{PEERS}/delaunator/index.js";
import * as theirs from "{PEERS}/d3-delaunay/dist/d3-delaunay.mjs";
const both = (ask) => [[OurDelaunator, ours], [TheirDelaunator, theirs]].map(([Delaunator, d3]) => ask(Delaunator, d3));
"""

DESCRIBED = """(Delaunator, { Delaunay, Voronoi }) => given.map((points) => {
    const flat = points.flat();
    const [made, d] = [new Delaunator(flat), Delaunay.from(points)];
    const v = new Voronoi(d, [10, 10, 90, 90]);
    const sites = points.map((_, k) => k);
    const near = points.map(([x, y], k) => [(k * 37) % 100, (x + 2 * y) % 100]);
    const traced = (draw) => {
        const said = [];
        const note = (name) => (...all) => { said.push([name, ...all]); };
        const names = ["moveTo", "lineTo", "closePath", "arc", "rect"];
        const answer = draw(Object.fromEntries(names.map((name) => [name, note(name)])));
        return [said, answer === undefined];
    };
    const moved = new Delaunay(Float64Array.from(flat));
    const later = moved.voronoi([10, 10, 90, 90]);
    flat.forEach((value, k) => { moved.points[k] = 100 - value; });
    const arrays = [made.triangles, made.halfedges, made.hull, d.points, d.triangles, d.halfedges, d.hull, d.inedges];
    return {
        same: {
            coords: made.coords, count: made.trianglesLen, vectors: [...v.vectors], collinear: d.collinear ?? null,
            types: [...arrays, v.circumcenters, v.vectors].map((a) => a.constructor.name),
            hull: [made.hull, d.hull, d.hullPolygon(), d.renderHull(), traced((c) => d.renderHull(c))].map(String),
            points: [d.renderPoints(), d.renderPoints(3), traced((c) => d.renderPoints(c, "4"))],
            bounds: [v.renderBounds(), v.xmin, v.ymin, v.xmax, v.ymax, traced((c) => v.renderBounds(c))],
            find: near.map(([x, y], k) => [d.find(x, y), d.find(x, y, k)]), nowhere: d.find(NaN, 1),
            contains: near.flatMap(([x, y], k) => [d.find(x, y), k].map((site) => v.contains(site, x, y))),
            triangles: [made, d].flatMap((t) => [[...t.triangles], [...t.halfedges]]), into: [...d.inedges],
            around: sites.map((k) => [...d.neighbors(k)]), within: sites.map((k) => [...v.neighbors(k)]),
            polygons: [...d.trianglePolygons()], later: [...later.delaunay.hull],
            cells: Array.from(v.cellPolygons(), (cell) => cell.index),
            chained: [later.update() === later, moved.update() === moved, v.delaunay === d],
        },
        cells: [...sites.map((k) => v.cellPolygon(k)), ...v.cellPolygons(), ...later.cellPolygons()].filter(Boolean),
        paths: sites.map((k) => v.renderCell(k)), meshes: [d.render(), v.render()],
        triangle: d.renderTriangle(0) === `M${d.trianglePolygon(0).slice(0, 3).join("L")}Z`,
        centers: [...v.circumcenters],
        outside: [[...v.neighbors(-1)], v.contains(-1, 1, 1)],
    };
})"""


def sets():
    """Twenty sets in general position."""
    rng = np.random.default_rng(31)
    return [(100 * rng.random((size, 2))).tolist() for size in [3, 4, 5, 6, 7, 9, 12, 20, 40, 80] for _ in "ab"]


@pytest.fixture
def both(node):
    """Ask both: `both("(Delaunator, d3) => d3.Delaunay.from(given).hull", points)`; ours first."""
    return lambda ask, given: node(f"{BOTH} export default both({ask});", given)


def numbers(path):
    return sorted(np.round(np.array(re.findall(r"-?[\d.]+(?:e-?\d+)?", path or ""), float), 6).tolist())


def segments(path):
    """Unordered lines of a path, with corners rounded."""
    lines = re.findall(r"M([^MLZ]+)L([^MLZ]+)(?=M|$)", path or "")
    return sorted(sorted(tuple(round(float(x), 4) + 0.0 for x in end.split(",")) for end in line) for line in lines)


def same_cell(own, other):
    own, other = np.array(own[:-1]), np.array(other[:-1])
    return len(own) == len(other) and any(np.allclose(np.roll(own, k, 0), other, atol=1e-6) for k in range(len(own)))


def test_every_method_on_twenty_sets(both):
    for own, other in zip(*both(DESCRIBED, sets()), strict=True):
        for name in own["same"]:
            assert own["same"][name] == other["same"][name], name
        assert all(map(same_cell, own["cells"], other["cells"]))
        assert len(own["cells"]) == len(other["cells"])
        assert [*map(numbers, own["paths"])] == [*map(numbers, other["paths"])]
        assert [*map(segments, own["meshes"])] == [*map(segments, other["meshes"])]
        assert np.allclose(own["centers"], other["centers"], rtol=1e-6)
        assert own["triangle"]
        assert own["outside"] == [[], False]  # as its pages say, and it does not


CELLS = """(Delaunator, { Delaunay }) => {
    const v = Delaunay.from(given).voronoi([-3, -3, 9, 9]);
    const cells = [...v.cellPolygons()];
    const within = given.map((_, k) => [...v.neighbors(k)].sort((i, j) => i - j));
    const found = given.map(([x, y]) => v.delaunay.find(x, y));
    return { cells, index: cells.map((cell) => cell.index), within, found };
}"""


@pytest.mark.parametrize(
    "sites",
    [
        [[1, 1]],
        [[1, 1], [4, 1]],
        [[1, 1], [3, 3], [2, 2], [5, 5]],
        [[2, 5], [2, 1], [2, 3]],
        [[0, 0], [4, 0], [0, 4], [4, 0], [0, 0]],
        [[i, j] for i in range(5) for j in range(5)],
        [[i % 4, i // 4] for i in range(16)] + [[50, 60], [-70, 1]],
    ],
    ids=["one", "two", "line", "upright", "equal", "grid", "grid and far ones"],
)
def test_cells_of_sites_on_lines_and_circles(both, sites):
    own, other = both(CELLS, sites)
    assert own["index"] == other["index"]
    assert own["within"] == other["within"]
    assert own["found"] == other["found"]
    for cell, their_cell in zip(own["cells"], other["cells"], strict=True):  # they move sites of a line by 1e-7
        ring, their_ring = [np.unique(np.round(corners, 4) + 0.0, axis=0) for corners in (cell, their_cell)]
        assert np.allclose(ring, their_ring, atol=1e-3)


def test_a_border_is_where_it_is_however_far_its_ends(both):
    """Of sites all but on one line the centres of circles are 1e15 away; the border of two is midway."""
    ask = "(_, d3) => d3.Delaunay.from(given).voronoi([0, 0, 100, 100]).cellPolygon(0)"
    own, other = both(ask, [[0, 50], [51, 50 + 1e-11], [100, 50], [50, -900]])
    corners = np.array(own)
    assert np.abs(corners[:, 0].max() - 25.5) < 1e-9
    assert np.abs(np.array(other)[:, 0].max() - 25.5) < 10


def test_what_is_refused(both):
    ask = """(Delaunator, { Delaunay }) => given.map((code) => {
        const made = new Function("Delaunator", "Delaunay", code);
        try { return String(made(Delaunator, Delaunay)); } catch (error) { return error.message; }
    })"""
    wrong = [
        "new Delaunator([[0, 0], [1, 1]])",
        "new Delaunator({ length: -1 })",
        "new Delaunay([0, 0]).voronoi([1, 0, 0, 1])",
    ]
    own, other = both(ask, wrong)
    assert [words[:14] for words in own] == [words[:14] for words in other]
    own, _ = both(ask, ["new Delaunay([0, 0, 1, NaN])"])
    assert own == ["points[1, 1] is NaN; every value must be a finite number"]
