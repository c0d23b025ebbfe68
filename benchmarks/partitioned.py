"""Triangulations in partitions beside the same in memory: seconds of wall and processors, peak memory, disk.

    python -m benchmarks.partitioned FOLDER [--sizes 1e6 1e7] [--partition 6.5e5] [--workers 2]

FOLDER takes the points, the results and the scratch: 100 bytes a point beside the triangles. Of each size uniform
points and points like those of Gaia, as longitude and latitude in Parquet; up to --in-memory points the same is done in
memory: read, triangulated, diagram, nearest points, written. Writes benchmarks/partitioned.json, and the table of
docs/partitioned.md.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import shutil
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from benchmarks import pages
from benchmarks.__main__ import machine
from benchmarks.distributions import Distribution, uniform_lonlat
from benchmarks.peers.python_peer import high_water
from benchmarks.processes import Watch
from stereodel import SphericalDelaunay, SphericalVoronoi, lonlat_to_xyz
from stereodel._arrays import FloatArray
from stereodel.partitioned import Execution, triangulate

FILE = 1_000_000
"""Points of a file at most."""


def gaia_like(n: int, rng: np.random.Generator) -> FloatArray:
    """Six of ten in a disc of five degrees, three in 300 clusters of 1e-1 to 1e-5 rad, the rest uniform."""
    lonlat = uniform_lonlat(n, rng)
    disc, cluster = 6 * n // 10, 3 * n // 10
    lonlat[:disc, 1] = np.clip(rng.laplace(0, 5, disc), -89, 89)
    centres = np.random.default_rng(5).normal(size=(300, 3))
    which = rng.integers(0, 300, cluster)
    v = centres[which] / np.linalg.norm(centres[which], axis=1)[:, None]
    v += 10.0 ** (-1 - 4 * which / 300)[:, None] * rng.normal(size=(cluster, 3))
    lonlat[disc : disc + cluster, 0] = np.degrees(np.arctan2(v[:, 1], v[:, 0]))
    lonlat[disc : disc + cluster, 1] = np.degrees(np.arctan2(v[:, 2], np.hypot(v[:, 0], v[:, 1])))
    return lonlat


SKIES: dict[str, Distribution] = {"uniform": uniform_lonlat, "gaia-like": gaia_like}


def write_points(folder: Path, sky: str, size: int) -> list[Path]:
    """Points in files, each a sample of the whole sky; kept from an earlier call."""
    count = max(8, -(-size // FILE))
    paths = [folder / f"{k:04}.parquet" for k in range(count)]
    folder.mkdir(parents=True, exist_ok=True)
    for k, path in enumerate(paths):
        if not path.exists():
            rows = size * (k + 1) // count - size * k // count
            lonlat = SKIES[sky](rows, np.random.default_rng([7, k]))
            table = pa.table({"lon": lonlat[:, 0].copy(), "lat": lonlat[:, 1].copy()})
            pq.write_table(table, path, compression="none", use_dictionary=False)
    return paths


def in_partitions(points: Path, folder: Path, size: int, partition: int, workers: int) -> dict[str, Any]:
    """A run, and what it took; its results are deleted."""
    passes: dict[str, float] = {}
    scratch = folder / "scratch"
    with (
        ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("forkserver")) as executor,
        Watch(scratch) as watch,
    ):

        def told(name: str, *_: Any) -> None:
            passes[name] = time.perf_counter()

        execution = Execution(partition, executor=executor, scratch=scratch, resume=False, progress=told)
        run = triangulate(points, folder / "out", execution=execution)
    statistics, ends = run.statistics, list(passes.values())
    found = watch.found()
    shutil.rmtree(folder / "out")
    shutil.rmtree(scratch, ignore_errors=True)
    seconds = {name: end - begin for name, begin, end in zip(passes, [ends[0], *ends[:-1]], ends, strict=True)}
    return {
        **found,
        "scratch_a_point": found["scratch_bytes"] / size,
        "cpu_us_a_point": 1e6 * found["cpu"] / size,
        "passes": seconds,
        "beyond": statistics["read"] / size - 1,
        **{name: statistics[name] for name in ("triangles", "area", "partitions", "rounds", "largest", "compact")},
    }


def _in_memory(points: Path, folder: Path, workers: int) -> dict[str, float]:
    began = time.perf_counter()
    table = pa.concat_tables([pq.read_table(path) for path in sorted(points.glob("*.parquet"))])
    xyz = lonlat_to_xyz(np.column_stack([table["lon"].to_numpy(), table["lat"].to_numpy()]), workers=workers)
    del table
    mesh = SphericalDelaunay(xyz, workers=workers)
    diagram = SphericalVoronoi(mesh, workers=workers)
    found = mesh.nearest(xyz, k=2, workers=workers)
    nearest = np.where(found[:, 0] == np.arange(len(xyz)), found[:, 1], found[:, 0]).astype(np.int64)
    kept = np.arange(len(xyz))
    kept[mesh.duplicates[:, 0]] = mesh.duplicates[:, 1]
    distance = 2 * np.arcsin(np.linalg.norm(xyz - xyz[nearest], axis=1) / 2)
    degree = np.diff(diagram.region_offsets).astype(np.int32)
    told = {"area": diagram.areas(), "degree": degree, "nearest": nearest, "distance": distance, "kept": kept}
    corners = dict(zip("abc", mesh.simplices.T.astype(np.int64), strict=True)) | {"closing": mesh.closing}
    for name, columns in (("rows", told), ("triangles", corners)):
        pq.write_table(pa.table(columns), folder / f"{name}.parquet", compression="none", use_dictionary=False)
    return {
        "wall": time.perf_counter() - began,
        "cpu": time.process_time(),
        "rss_mb": high_water() / 2**20,
        "triangles": len(mesh.simplices),
    }


def in_memory(points: Path, folder: Path, workers: int) -> dict[str, float]:
    """The same with all points at once, in a process of its own."""
    folder.mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as executor:
        found = executor.submit(_in_memory, points, folder, workers).result()
    shutil.rmtree(folder)
    return found


def main() -> None:
    """Measure, and save after each set."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.partitioned")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--sizes", type=float, nargs="+", default=[1e6, 1e7])
    parser.add_argument("--skies", nargs="+", choices=list(SKIES), default=list(SKIES))
    parser.add_argument("--partition", type=float, default=6.5e5)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--in-memory", type=float, default=2e7, help="up to so many points also in memory")
    options = parser.parse_args()
    results = json.loads((pages.HERE / "partitioned.json").read_text(encoding="utf-8"))
    for size in map(int, options.sizes):
        for sky in options.skies:
            folder = options.folder / f"{sky}-{size}"
            write_points(folder / "points", sky, size)
            row: dict[str, Any] = {"sky": sky, "size": size, "partition": int(options.partition)}
            row["workers"], row["machine"] = options.workers, machine()
            if size <= options.in_memory:
                row["memory"] = in_memory(folder / "points", folder / "memory", options.workers)
            row["partitions"] = in_partitions(folder / "points", folder, size, int(options.partition), options.workers)
            if "memory" in row:
                row |= {f"{what}_ratio": row["partitions"][what] / row["memory"][what] for what in ("cpu", "wall")}
            others = [other for other in results["rows"] if (other["sky"], other["size"]) != (sky, size)]
            results["rows"] = sorted([*others, row], key=lambda each: (each["sky"], each["size"]))
            pages.record("partitioned", results)
            print(json.dumps(row), flush=True)
            shutil.rmtree(folder)


if __name__ == "__main__":
    main()
