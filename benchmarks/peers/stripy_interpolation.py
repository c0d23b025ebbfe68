"""Interpolation by stripy (STRIPACK, SSRFPACK), for benchmarks/interpolation.py.

    python stripy_interpolation.py FILE

FILE is an .npz with unit vectors `points`, `values` and unit vectors `queries`. Prints a line of JSON for each order,
1 linear, 3 cubic: seconds of preparation and of asking, and the name of a file with the answers. Needs NumPy and stripy
alone.
"""

from __future__ import annotations

import importlib.metadata
import json
import sys
import time

import numpy as np
from stripy import sTriangulation


def lonlat(vectors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Radians."""
    x, y, z = vectors.T
    return np.arctan2(y, x), np.arctan2(z, np.hypot(x, y))


def main(file: str) -> None:
    """Answer for both orders."""
    with np.load(file) as data:
        points, values, queries = data["points"], data["values"], data["queries"]
    sTriangulation(*lonlat(points[:20]))
    begin = time.perf_counter()
    triangulation = sTriangulation(*lonlat(points))
    prepared = time.perf_counter() - begin
    where = lonlat(queries)
    for order in (1, 3):
        begin = time.perf_counter()
        found, _ = triangulation.interpolate(*where, values, order=order)
        asked = time.perf_counter() - begin
        answers = f"{file}.{order}.npy"
        np.save(answers, found)
        version = importlib.metadata.version("stripy")
        print(json.dumps({"order": order, "version": version, "prepare": prepared, "ask": asked, "file": answers}))


if __name__ == "__main__":
    main(sys.argv[1])
