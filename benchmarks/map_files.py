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
from stereodel._files import replacing

RESULTS = Path(__file__).resolve().parent / "map_files.json"
POINTS = 1_000_000
FORMATS = {"parquet": "GeoParquet", "fgb": "FlatGeobuf", "gpkg": "GeoPackage", "geojson": "GeoJSON"}

MEASURE = r"""
import json, re, sys, time
import numpy as np
from stereodel import SphericalVoronoi
from stereodel.io import write
path, points = sys.argv[1], np.random.default_rng(1).normal(size=(int(sys.argv[2]), 3))
begin, busy = time.perf_counter(), time.process_time()
write(path, SphericalVoronoi(points))
times = {"seconds": time.perf_counter() - begin, "busy": time.process_time() - busy}
# Of this program alone: what getrusage tells counts the memory of the process that started it.
peak = 1024 * int(re.search(r"VmHWM:\s*(\d+)", open("/proc/self/status").read())[1])
print(json.dumps(times | {"peak": peak}))
"""


def measure(kind: str, points: int) -> dict[str, Any]:
    """Seconds on the wall and of processors, and the peak of memory in bytes, with all that Python holds."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-c", MEASURE, str(Path(folder, f"cells.{kind}")), str(points)]
        ran = subprocess.run(command, capture_output=True, text=True, check=True)
    return {"format": kind, **json.loads(ran.stdout)}


def table(rows: list[dict[str, Any]]) -> str:
    """A row for each format."""
    body = [[FORMATS[row["format"]], f"{row['busy']:.0f}", f"{row['peak'] / 1e9:.1f}"] for row in rows]
    return pages.table(["", "processor seconds", "memory, GB"], body, "lrr")


def main() -> None:
    """Measure, save, write the page."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.map_files", description="Time of files of cells.")
    parser.add_argument("--points", type=float, default=POINTS)
    points = int(parser.parse_args().points)
    rows = []
    for kind in FORMATS:
        rows.append(measure(kind, points))
        print(f"{FORMATS[kind]}: {rows[-1]['seconds']:.1f} s", flush=True)
    if points == POINTS:
        with replacing(RESULTS) as temporary:
            temporary.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
        pages.fill("files.md", {"cells": table(rows)})


if __name__ == "__main__":
    main()
