"""How long a film takes: 300 frames of 1280 × 720, a globe with its coastline along a flight, as MP4.

    python -m benchmarks.film [--frames 300] [--land] [--jobs N] [--out FILE]

Processor seconds count this process, those that draw and the encoder; they say more than the time on a clock where
others use the machine, whose load is printed too.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from pathlib import Path

from benchmarks.processes import Watch, peak_memory
from stereodel.film import Film, Flight, Stop
from stereodel.globe import Globe

PARIS, NEW_YORK, TOKYO = (2.35, 48.86), (-74.01, 40.71), (139.69, 35.69)


def flight(seconds: float) -> Flight:
    """Over three cities at S = 1, 8, 8, 8, 1, in that time; no stops, so that each frame must be drawn."""
    stops = [
        Stop(PARIS, hold=0.0),
        *(Stop(place, 8.0, 0.0) for place in (PARIS, NEW_YORK, TOKYO)),
        Stop(TOKYO, hold=0.0),
    ]
    return Flight(stops, pace=seconds / Flight(stops).seconds)


def main() -> int:
    """Make the film, print what it took."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.film", description="Time of a film of a globe.")
    parser.add_argument("--frames", type=int, default=300)
    parser.add_argument("--land", action="store_true", help="filled land as well")
    parser.add_argument("--jobs", type=int, default=None, help="processes; by default one for each core")
    parser.add_argument("--out", type=Path, default=None, help="keep the film under this name")
    options = parser.parse_args()
    globe = Globe()
    if options.land:
        globe.add_land()
    globe.add_coastlines(resolution="50m")
    clip = Film.of_globe(globe, flight(options.frames / 25), size=(1280, 720))
    with tempfile.TemporaryDirectory() as folder:
        path = options.out or Path(folder, "film.mp4")
        with Watch(Path(folder)) as watch:
            clip.save(path, jobs=options.jobs)
        found, size = watch.told(), path.stat().st_size
    here = peak_memory() / 2**20
    print(f"{len(clip)} frames in {found['wall']:.0f} s, {found['cpu']:.0f} processor seconds", end=", ")
    print(f"{found['cpu'] / len(clip):.2f} a frame")
    print(f"{size / 1e6:.1f} MB; this process {here:.0f} MB, largest other {found['rss_mb']:.0f} MB")
    print(f"{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
