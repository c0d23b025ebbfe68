"""A million cells to files of maps: time on the wall and of processors, and memory, from the points to the file.

    python -m benchmarks.map_files [--points 1e6]

Each format in a process of its own. Writes benchmarks/map_files.json and the table in docs/files.md, for a million: the
time of processors and memory, which depend less on what else the machine does; the time on the wall is printed.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from benchmarks import pages

POINTS = 1_000_000
FORMATS = ("parquet", "fgb", "gpkg", "geojson")

MEASURE = r"""
import json, sys, time
import numpy as np
from benchmarks.peers.python_peer import high_water
from stereodel import SphericalVoronoi
from stereodel.io import write
path, points = sys.argv[1], np.random.default_rng(1).normal(size=(int(sys.argv[2]), 3))
begin, busy = time.perf_counter(), time.process_time()
write(path, SphericalVoronoi(points))
times = {"seconds": time.perf_counter() - begin, "busy": time.process_time() - busy}
print(json.dumps(times | {"peak": high_water()}))
"""


def measure(kind: str, points: int) -> dict[str, Any]:
    """Seconds on the wall and of processors, and the peak of memory in bytes, with all that Python holds."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-c", MEASURE, str(Path(folder, f"cells.{kind}")), str(points)]
        ran = subprocess.run(command, cwd=pages.HERE.parent, capture_output=True, text=True, check=True)
    return {"format": kind, **json.loads(ran.stdout)}


def main() -> None:
    """Measure, save, write the page."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.map_files", description="Time of files of cells.")
    parser.add_argument("--points", type=float, default=POINTS)
    points = int(parser.parse_args().points)
    rows = []
    for kind in FORMATS:
        rows.append(measure(kind, points))
        print(f"{kind}: {rows[-1]['seconds']:.1f} s", flush=True)
    if points == POINTS:
        pages.record("map_files", rows)


if __name__ == "__main__":
    main()
