"""GMT's sphinterpolate, sphdistance and sphtriangulate beside the same here: grids of one degree, one thread each.

Seconds are those of the processor, of GMT less those of its start; it reads and writes binary files, we arrays.
"""

from __future__ import annotations

import os
import resource
import shutil
import statistics
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.distributions import make
from stereodel import SphericalDelaunay, lonlat_to_xyz, xyz_to_lonlat
from stereodel._arrays import FloatArray
from stereodel.interpolation import LinearInterpolator, SmoothInterpolator

ROUNDS, LONG = 7, 4.0
GRID = np.stack(np.meshgrid(np.arange(-180.0, 181.0), np.arange(90.0, -91.0, -1.0)), axis=-1)
KINDS = {"sphinterpolate -Qp": LinearInterpolator, "sphinterpolate -Ql": SmoothInterpolator}
COMMANDS = [*KINDS, "sphdistance -Ed -Ld", "sphtriangulate -Qd"]


def waves(lonlat: FloatArray) -> FloatArray:
    """A smooth function between -2 and 2."""
    lon, lat = np.radians(lonlat[..., 0]), np.radians(lonlat[..., 1])
    return np.asarray(np.sin(3 * lon) * np.cos(lat) ** 3 + np.sin(5 * lat))


def ours(command: str, lonlat: FloatArray) -> FloatArray:
    """What the command computes: values or degrees to the nearest point on the grid, triangles."""
    triangulation = SphericalDelaunay.from_lonlat(lonlat, workers=1)
    if command in KINDS:
        return KINDS[command](triangulation, waves(lonlat))(lonlat=GRID, workers=1)
    if command.startswith("sphtriangulate"):
        return np.asarray(triangulation.simplices)
    places = lonlat_to_xyz(GRID)
    chords = places - triangulation.points[triangulation.nearest(places, workers=1)]
    return np.asarray(np.degrees(2 * np.arcsin(np.linalg.norm(chords, axis=-1) / 2)))


def theirs(command: str, lonlat: FloatArray) -> FloatArray:
    """The same by GMT; a grid of its single precision, behind 892 bytes. `--version` starts it and no more."""
    with tempfile.TemporaryDirectory() as folder:
        np.column_stack([lonlat, waves(lonlat)]).tofile(Path(folder, "points"))
        grid = ["-Rd", "-I1", "-Ggrid=bf"] if command.startswith(("sphinterpolate", "sphdistance")) else []
        given = [] if command == "--version" else ["points", "-bi3d", *grid]
        environment = os.environ | {"OMP_NUM_THREADS": "1"}
        words = ["gmt", *command.split(), *given]
        subprocess.run(words, check=True, capture_output=True, env=environment, cwd=folder)
        return np.fromfile(f"{folder}/grid", np.float32, offset=892).reshape(GRID.shape[:2]) if grid else lonlat


def gmt(largest: int) -> list[dict[str, Any]]:
    """The experiment; no rows where GMT is not installed."""
    sizes = [n for n in (10_000, 100_000) if n <= largest and shutil.which("gmt")]
    sets = [xyz_to_lonlat(make("sphere", "uniform", n)) for n in sizes]
    return [measured(command, lonlat) for command in COMMANDS for lonlat in sets]


def measured(command: str, lonlat: FloatArray) -> dict[str, Any]:
    """Medians of the rounds, in turns, and errors of interpolation; what takes GMT long is done once."""
    row: dict[str, Any] = {"command": command, "n": len(lonlat)}
    times: dict[str, list[float]] = {"ours": [], "theirs": [], "start": []}
    calls = {"ours": (ours, command), "theirs": (theirs, command), "start": (theirs, "--version")}
    for number in range(1 + ROUNDS):
        for who, (call, word) in calls.items():
            whose = resource.RUSAGE_SELF if who == "ours" else resource.RUSAGE_CHILDREN
            if number < 2 or who == "ours" or times["theirs"][-1] < LONG:
                before = resource.getrusage(whose)
                found = call(word, lonlat)
                after = resource.getrusage(whose)
                times[who].append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
                if who != "start" and command in KINDS:
                    error = np.abs(found - waves(GRID))
                    row |= {f"{who} rms": float(np.sqrt((error**2).mean())), f"{who} max": float(error.max())}
    seconds = {who: statistics.median(own[1:]) for who, own in times.items()}
    return row | {"ours": seconds["ours"], "theirs": seconds["theirs"] - seconds["start"]}
