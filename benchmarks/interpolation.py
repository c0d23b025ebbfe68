"""Errors of interpolation on known functions, beside SciPy in the plane and stripy on the sphere.

    benchmarks/install_peers.sh        once, for stripy
    python -m benchmarks.interpolation

Random points and random queries, one thread. Writes benchmarks/interpolation.json and the tables in
docs/interpolation.md.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import CloughTocher2DInterpolator, LinearNDInterpolator

from benchmarks import interpolation_page
from stereodel import PlanarDelaunay, SphericalDelaunay
from stereodel._arrays import FloatArray
from stereodel._files import replacing
from stereodel.interpolation import (
    LinearInterpolator,
    NaturalNeighborInterpolator,
    NearestInterpolator,
    SmoothInterpolator,
)

HERE = Path(__file__).resolve().parent
RESULTS = HERE / "interpolation.json"
SIZES = (1000, 10_000, 100_000)
QUERIES = 20_000
MARGIN = 0.1  # queries of the square keep away from its sides, where Delaunay triangles are thin
METHODS = {
    "nearest": NearestInterpolator,
    "linear": LinearInterpolator,
    "natural neighbour": NaturalNeighborInterpolator,
    "smooth": SmoothInterpolator,
}
Row = dict[str, Any]


def franke(points: FloatArray) -> FloatArray:
    """R. Franke's function of the unit square (1979)."""
    x, y = 9 * points.T
    return (
        0.75 * np.exp(-((x - 2) ** 2 + (y - 2) ** 2) / 4)
        + 0.75 * np.exp(-((x + 1) ** 2) / 49 - (y + 1) / 10)
        + 0.5 * np.exp(-((x - 7) ** 2 + (y - 3) ** 2) / 4)
        - 0.2 * np.exp(-((x - 4) ** 2) - (y - 7) ** 2)
    )


def sphere_function(points: FloatArray) -> FloatArray:
    """(1 + x⁸ + exp(2y³) + exp(2z²) + 10xyz)/14, often used since A. Fasshauer and L. Schumaker (1998)."""
    x, y, z = points.T
    return (1 + x**8 + np.exp(2 * y**3) + np.exp(2 * z**2) + 10 * x * y * z) / 14


def directions(rng: np.random.Generator, count: int) -> FloatArray:
    """Uniform unit vectors."""
    vectors = rng.standard_normal((count, 3))
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def row(space: str, size: int, library: str, method: str, errors: FloatArray, prepare: float, ask: float) -> Row:
    """One measurement: errors over the queries that have an answer, seconds to prepare and to ask."""
    missing = np.isnan(errors)
    errors = errors[~missing]
    return {
        "space": space,
        "points": size,
        "library": library,
        "method": method,
        "missing": int(missing.sum()),
        "rms": float(np.sqrt(np.mean(errors**2))),
        "largest": float(np.abs(errors).max()),
        "prepare": prepare,
        "ask": ask,
    }


def timed(work: Callable[[], Any]) -> tuple[Any, float]:
    """What `work` returns, and its seconds."""
    begin = time.perf_counter()
    result = work()
    return result, time.perf_counter() - begin


def ours(space: str, points: FloatArray, values: FloatArray, queries: FloatArray, exact: FloatArray) -> Iterator[Row]:
    """All methods of the library, each with its own triangulation."""
    triangulate = PlanarDelaunay if space == "plane" else SphericalDelaunay
    for name, method in METHODS.items():
        function, prepare = timed(lambda method=method: method(triangulate(points, workers=1), values))
        found, ask = timed(lambda function=function: function(queries, workers=1))
        yield row(space, len(points), "stereodel", name, found - exact, prepare, ask)


def scipys(points: FloatArray, values: FloatArray, queries: FloatArray, exact: FloatArray) -> Iterator[Row]:
    """The two of SciPy that fit."""
    for name, method in {"linear": LinearNDInterpolator, "smooth": CloughTocher2DInterpolator}.items():
        function, prepare = timed(lambda method=method: method(points, values))
        found, ask = timed(lambda function=function: function(queries))
        yield row("plane", len(points), "SciPy", name, found - exact, prepare, ask)


def stripys(points: FloatArray, values: FloatArray, queries: FloatArray, exact: FloatArray) -> Iterator[Row]:
    """The two of stripy, in an environment of its own; nothing if that is not there."""
    python = HERE / ".peers" / "python_numpy1" / "bin" / "python"
    if not python.exists():
        print("stripy is not installed: run benchmarks/install_peers.sh", file=sys.stderr)
        return
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "task.npz"
        np.savez(file, points=points, values=values, queries=queries)
        command = [str(python), str(HERE / "peers" / "stripy_interpolation.py"), str(file)]
        said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        for line in filter(None, map(str.strip, said.splitlines())):
            told = json.loads(line)
            found = np.load(told["file"])
            name = {1: "linear", 3: "smooth"}[told["order"]]
            yield row("sphere", len(points), "stripy", name, found - exact, told["prepare"], told["ask"])


def measure(size: int) -> Iterator[Row]:
    """Plane and sphere with so many points."""
    rng = np.random.default_rng(size)
    points, queries = rng.random((size, 2)), MARGIN + (1 - 2 * MARGIN) * rng.random((QUERIES, 2))
    yield from ours("plane", points, franke(points), queries, franke(queries))
    yield from scipys(points, franke(points), queries, franke(queries))
    points, queries = directions(rng, size), directions(rng, QUERIES)
    yield from ours("sphere", points, sphere_function(points), queries, sphere_function(queries))
    yield from stripys(points, sphere_function(points), queries, sphere_function(queries))


def main() -> None:
    """Measure, save, write the page."""
    rows = [row for size in SIZES for row in measure(size)]
    with replacing(RESULTS) as temporary:
        temporary.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    interpolation_page.write(rows)


if __name__ == "__main__":
    main()
