"""Triangulations in partitions beside the same in memory: seconds of wall and processors, peak memory, disk.

    python -m benchmarks.partitioned FOLDER [--sizes 1e6 1e7] [--partition 6.5e5] [--workers 2]

FOLDER takes the points, the results and the scratch: 100 bytes a point beside the triangles. Of each size uniform
points, points like those of Gaia, and uniform ones whose files are patches of the sky, so that they are the partitions,
as longitude and latitude in Parquet; up to --in-memory points the same is done in
memory: read, triangulated, diagram, nearest points, written. From three sizes or more the seconds of 1e9 points are
extrapolated: by a straight line through the largest three, with what it misses of them. Writes
benchmarks/partitioned.json, and the tables of docs/partitioned.md.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import resource
import shutil
import threading
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from pathlib import Path
from typing import Any, Self

import numpy as np
import psutil
import pyarrow as pa
import pyarrow.parquet as pq

from benchmarks import pages
from benchmarks.__main__ import machine, save
from stereodel import SphericalDelaunay, SphericalVoronoi, lonlat_to_xyz
from stereodel.partitioned import triangulate

RESULTS = Path(__file__).resolve().parent / "partitioned.json"
FILE = 1_000_000
"""Points of a file at most."""

BILLION = 1e9
LOOK = 0.1
"""Seconds between two looks at memory and disk."""


def uniform(rng: np.random.Generator, n: int, *_: int) -> np.ndarray:
    """Longitude and latitude all over the sphere."""
    return np.column_stack([rng.uniform(-180, 180, n), np.degrees(np.arcsin(rng.uniform(-1, 1, n)))])


def patches(rng: np.random.Generator, n: int, number: int, count: int) -> np.ndarray:
    """Uniform in one of so many patches of equal area, in rows and columns of longitude and latitude."""
    rows = max(k for k in range(1, count + 1) if count % k == 0 and 2 * k * k <= count)
    row, column = divmod(number, count // rows)
    z = (row + rng.uniform(size=n)) * 2 / rows - 1
    return np.column_stack([(column + rng.uniform(size=n)) * 360 * rows / count - 180, np.degrees(np.arcsin(z))])


def gaia_like(rng: np.random.Generator, n: int, *_: int) -> np.ndarray:
    """Six of ten in a disc of five degrees, three in 300 clusters of 1e-1 to 1e-5 rad, the rest uniform."""
    lonlat = uniform(rng, n)
    disc, cluster = 6 * n // 10, 3 * n // 10
    lonlat[:disc, 1] = np.clip(rng.laplace(0, 5, disc), -89, 89)
    centres = np.random.default_rng(5).normal(size=(300, 3))
    which = rng.integers(0, 300, cluster)
    v = centres[which] / np.linalg.norm(centres[which], axis=1)[:, None]
    v += 10.0 ** (-1 - 4 * which / 300)[:, None] * rng.normal(size=(cluster, 3))
    lonlat[disc : disc + cluster, 0] = np.degrees(np.arctan2(v[:, 1], v[:, 0]))
    lonlat[disc : disc + cluster, 1] = np.degrees(np.arctan2(v[:, 2], np.hypot(v[:, 0], v[:, 1])))
    return lonlat


SKIES: dict[str, Callable[[np.random.Generator, int, int, int], np.ndarray]] = {
    "uniform": uniform,
    "gaia-like": gaia_like,
    "in patches": patches,
}


def write_points(folder: Path, sky: str, size: int) -> list[Path]:
    """Points in files, each a sample of the whole sky or one of its patches; kept from an earlier call."""
    count = max(8, -(-size // FILE))
    paths = [folder / f"{k:04}.parquet" for k in range(count)]
    folder.mkdir(parents=True, exist_ok=True)
    for k, path in enumerate(paths):
        if not path.exists():
            rows = size * (k + 1) // count - size * k // count
            lonlat = SKIES[sky](np.random.default_rng([7, k]), rows, k, count)
            table = pa.table({"lon": lonlat[:, 0].copy(), "lat": lonlat[:, 1].copy()})
            pq.write_table(table, path, compression="none", use_dictionary=False)
    return paths


class Watch(threading.Thread):
    """The peaks of the memory of child processes and of the bytes in a folder, and the seconds of processors."""

    def __init__(self, folder: Path) -> None:
        super().__init__(daemon=True)
        self._folder, self._ended = folder, threading.Event()
        self._whole: dict[int, int] = {}
        self._own: dict[int, int] = {}
        self._cpu: dict[int, float] = {}
        self._disk = 0

    def __enter__(self) -> Self:
        self._began, self._cpu_before = time.perf_counter(), time.process_time()
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.wall = time.perf_counter() - self._began
        self._ended.set()
        self.join()
        self.driver = time.process_time() - self._cpu_before

    def run(self) -> None:
        """Look again and again."""
        while not self._ended.wait(LOOK):
            for child in psutil.Process().children(recursive=True):
                try:
                    memory, cpu = child.memory_info(), child.cpu_times()
                except psutil.Error:
                    continue
                self._whole[child.pid] = max(self._whole.get(child.pid, 0), memory.rss)
                self._own[child.pid] = max(self._own.get(child.pid, 0), memory.rss - memory.shared)
                self._cpu[child.pid] = cpu.user + cpu.system
            self._disk = max(self._disk, size_of(self._folder))

    def told(self) -> dict[str, float]:
        """Seconds of wall and processors, megabytes of the largest process with and without pages of files, disk."""
        return {
            "wall": self.wall,
            "cpu": self.driver + sum(self._cpu.values()),
            "rss_mb": max(self._whole.values(), default=0) / 2**20,
            "own_mb": max(self._own.values(), default=0) / 2**20,
            "scratch_bytes": self._disk,
        }


def size_of(folder: Path) -> int:
    """Bytes of the files of a folder; files and folders may vanish meanwhile."""
    total = 0
    for place, _, names in os.walk(folder):
        for name in names:
            with suppress(FileNotFoundError):
                total += (Path(place) / name).stat().st_size
    return total


def in_partitions(points: Path, folder: Path, size: int, partition: int, workers: int) -> dict[str, Any]:
    """A run, and what it took; its results are deleted."""
    passes: dict[str, float] = {}
    scratch = folder / "scratch"
    with (
        ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("forkserver")) as executor,
        Watch(scratch) as watch,
    ):
        run = triangulate(
            points,
            folder / "out",
            partition=partition,
            executor=executor,
            scratch=scratch,
            resume=False,
            progress=lambda name, *_: passes.update({name: time.perf_counter()}),
        )
    statistics, ends = run.statistics, list(passes.values())
    told = watch.told()
    shutil.rmtree(folder / "out")
    shutil.rmtree(scratch, ignore_errors=True)
    seconds = {name: end - begin for name, begin, end in zip(passes, [ends[0], *ends[:-1]], ends, strict=True)}
    return {
        **told,
        "scratch_a_point": told.pop("scratch_bytes") / size,
        "cpu_us_a_point": 1e6 * told["cpu"] / size,
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
    used = resource.getrusage(resource.RUSAGE_SELF)
    return {
        "wall": time.perf_counter() - began,
        "cpu": used.ru_utime + used.ru_stime,
        "rss_mb": used.ru_maxrss / 1024,
        "triangles": len(mesh.simplices),
    }


def in_memory(points: Path, folder: Path, workers: int) -> dict[str, float]:
    """The same with all points at once, in a process of its own."""
    folder.mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as executor:
        found = executor.submit(_in_memory, points, folder, workers).result()
    shutil.rmtree(folder)
    return found


def extrapolated(rows: list[dict[str, Any]], size: float = BILLION) -> dict[str, float] | None:
    """Seconds of processors of so many points, by a line through the three largest sizes; None of fewer.

    Examples
    --------
    >>> rows = [{"sky": "uniform", "size": n, "partitions": {"cpu": 2e-6 * n + 1}} for n in (1e6, 1e7, 1e8)]
    >>> found = extrapolated(rows)
    >>> round(found["cpu"]), round(found["misses"], 6)
    (2001, 0.0)
    """
    known = sorted((row["size"], row["partitions"]["cpu"]) for row in rows if row["sky"] == "uniform")[-3:]
    if len(known) < 3:
        return None
    sizes, seconds = np.array(known, dtype=float).T
    slope, start = np.polyfit(sizes, seconds, 1, w=1 / seconds)
    misses = np.abs((slope * sizes + start) / seconds - 1).max()
    return {"size": size, "cpu": float(slope * size + start), "misses": float(misses)}


def table(rows: list[dict[str, Any]]) -> str:
    """A row for each set of points."""
    head = ["points", "sky", "seconds", "processor: µs a point", "of that in memory", "MB a worker"]
    head += ["scratch: bytes a point", "read beyond the own"]
    body = []
    for row in sorted(rows, key=lambda each: (each["size"], each["sky"])):
        found, ratio = row["partitions"], row.get("cpu_ratio")
        body.append(
            [
                f"{row['size']:,}".replace(",", " "),
                row["sky"],
                f"{found['wall']:.0f}",
                f"{found['cpu_us_a_point']:.1f}",
                "–" if ratio is None else f"{100 * ratio:.0f} %",
                f"{found['own_mb']:.0f}",
                f"{found['scratch_a_point']:.0f}",
                f"{100 * found['beyond']:.1f} %",
            ]
        )
    return pages.table(head, body, "rlrrrrrr")


def billion(results: dict[str, Any]) -> str:
    """The sentence on the points that nobody waited for."""
    found = results["billion"]
    if found is None:
        return ""
    minutes, misses = found["cpu"] / 60 / 2, 100 * found["misses"]
    return (
        f"A straight line through the largest three sets of uniform points, which misses them by {misses:.0f} % at "
        f"most, leads to {minutes:.0f} minutes for 10⁹ points on two processors. That was not run."
    )


def main() -> int:
    """Measure, and save after each set."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.partitioned")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--sizes", type=float, nargs="+", default=[1e6, 1e7])
    parser.add_argument("--skies", nargs="+", choices=list(SKIES), default=list(SKIES))
    parser.add_argument("--partition", type=float, default=6.5e5)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--in-memory", type=float, default=2e7, help="up to so many points also in memory")
    parser.add_argument("--results", type=Path, default=RESULTS)
    options = parser.parse_args()
    results = json.loads(options.results.read_text(encoding="utf-8")) if options.results.exists() else {"rows": []}
    for size in map(int, options.sizes):
        for sky in options.skies:
            folder = options.folder / f"{sky.replace(' ', '-')}-{size}"
            write_points(folder / "points", sky, size)
            row: dict[str, Any] = {"sky": sky, "size": size, "partition": int(options.partition)}
            row["workers"], row["machine"] = options.workers, machine()
            if size <= options.in_memory:
                row["memory"] = in_memory(folder / "points", folder / "memory", options.workers)
            row["partitions"] = in_partitions(folder / "points", folder, size, int(options.partition), options.workers)
            if "memory" in row:
                row["cpu_ratio"] = row["partitions"]["cpu"] / row["memory"]["cpu"]
                row["wall_ratio"] = row["partitions"]["wall"] / row["memory"]["wall"]
            others = [other for other in results["rows"] if (other["sky"], other["size"]) != (sky, size)]
            results["rows"] = sorted([*others, row], key=lambda each: (each["sky"], each["size"]))
            results["billion"] = extrapolated(results["rows"])
            save(results, options.results)
            if options.results == RESULTS:
                pages.fill("partitioned.md", {"partitions": table(results["rows"]), "billion": billion(results)})
            print(json.dumps(row), flush=True)
            shutil.rmtree(folder)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
