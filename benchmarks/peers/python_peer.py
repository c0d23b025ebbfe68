"""Peers with a Python interface, in the conversation of benchmarks/processes.py.

    python python_peer.py NAME FILE

FILE holds doubles: points of the plane or unit vectors. Everything but the peer's own call stays outside the measured
time: reading, conversion to what the peer wants, counting. Needs NumPy and the peer alone, so that it runs in an
environment where stereodel is not installed.
"""

from __future__ import annotations

import importlib.metadata
import json
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

Call = Callable[[], np.ndarray]


def prepared(name: str, values: np.ndarray) -> Call:
    """The call of a peer on doubles: it triangulates and returns the triangles (m, 3)."""
    points = values.reshape(-1, 2 if name in ("scipy", "triangle", "triangular") else 3)
    if name == "scipy":  # with neighbours, by Qhull's paraboloid
        from scipy.spatial import Delaunay

        return lambda: Delaunay(points).simplices
    if name == "scipy_hull":  # with neighbours, of mixed orientation
        from scipy.spatial import ConvexHull

        return lambda: ConvexHull(points).simplices
    if name == "scipy_voronoi":  # the diagram with its regions sorted, as lists, and their areas
        from scipy.spatial import SphericalVoronoi

        points /= np.linalg.norm(points, axis=1)[:, None]

        def call() -> np.ndarray:
            diagram = SphericalVoronoi(points)
            diagram.sort_vertices_of_regions()
            diagram.calculate_areas()
            return diagram._simplices

        return call
    if name == "triangle":  # with neighbours (option n)
        import triangle

        return lambda: triangle.triangulate({"vertices": points}, "Qn")["triangles"]
    if name == "triangular":  # triangles alone: there are no neighbours to ask for
        import triangular

        return lambda: triangular.delaunay(points)
    from stripy import sTriangulation  # with STRIPACK's adjacency lists, from longitude and latitude in radians

    x, y, z = points.T
    lon, lat = np.arctan2(y, x), np.arctan2(z, np.hypot(x, y))
    return lambda: sTriangulation(lon, lat).simplices


def high_water() -> int:
    """High-water mark of resident memory, bytes."""
    with open("/proc/self/status", encoding="ascii") as status:
        return sum(1024 * int(line.split()[1]) for line in status if line.startswith("VmHWM:"))


def timed(prepared: Callable[[], Callable[[], Any]], repetitions: int) -> tuple[list[float], Any, int]:
    """Seconds of each call, what the last returned, growth of peak memory; to prepare a call takes no time."""
    with open("/proc/self/clear_refs", "w", encoding="ascii") as marks:
        marks.write("5")  # lowers the mark to what is resident now, so that imports and reading do not count
    before = high_water()
    seconds = []
    for _ in range(repetitions):
        call = prepared()
        begin = time.perf_counter()
        found = call()
        seconds.append(time.perf_counter() - begin)
    return seconds, found, high_water() - before


def answer(call: Call, repetitions: int) -> dict[str, object]:
    """Seconds of each call, vertices and triangles of the last, growth of peak memory."""
    seconds, triangles, peak = timed(lambda: call, repetitions)
    used = np.zeros(int(triangles.max(initial=-1)) + 1, dtype=np.bool_)
    used[triangles.ravel()] = True
    return {"seconds": seconds, "points": int(used.sum()), "triangles": len(triangles), "peak": peak}


def main(name: str, file: str) -> None:
    """Read, warm up the imports on a small set, say the version, answer."""
    prepared(name, np.random.default_rng(1).standard_normal(600))()
    call = prepared(name, np.fromfile(file))
    print(json.dumps({"version": importlib.metadata.version(name.partition("_")[0])}), flush=True)
    for line in sys.stdin:
        print(json.dumps(answer(call, int(line.split()[1]))), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
