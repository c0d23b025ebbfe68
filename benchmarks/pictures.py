"""Time and memory of a film and of large pictures.

    python -m benchmarks.pictures film [--frames 300] [--land] [--jobs N] [--out FILE]
    python -m benchmarks.pictures poster [--script figures/earth_airports.py] [--sizes 2048 8192 16384]

The film has frames of 1280 × 720, a globe with its coastline along a flight, as MP4. Processor seconds count this
process, those that draw and the encoder; they say more than the time on a clock where others use the machine, whose
load is printed too. Each large picture is drawn and written in a process of its own; memory is the largest resident
set above that of the process which has the page and has drawn a small picture of it.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.processes import Watch, peak_memory
from stereodel.film import Film, Flight, Stop
from stereodel.globe import Globe
from tools.build import load_drawing

PARIS, NEW_YORK, TOKYO = (2.35, 48.86), (-74.01, 40.71), (139.69, 35.69)


def flight(seconds: float) -> Flight:
    """Over three cities at S = 1, 8, 8, 8, 1, in that time; no stops, so that each frame must be drawn."""
    stops = [
        Stop(PARIS, hold=0.0),
        *(Stop(place, 8.0, 0.0) for place in (PARIS, NEW_YORK, TOKYO)),
        Stop(TOKYO, hold=0.0),
    ]
    return Flight(stops, pace=seconds / Flight(stops).seconds)


def film(options: argparse.Namespace) -> None:
    """Make the film, print what it took."""
    globe = Globe()
    if options.land:
        globe.add_land()
    globe.add_coastlines(resolution="50m")
    clip = Film.of_globe(globe, flight(options.frames / 25), size=(1280, 720))
    with tempfile.TemporaryDirectory() as folder:
        path = options.out or Path(folder, "film.mp4")
        with Watch(Path(folder)) as watch:
            clip.save(path, jobs=options.jobs)
        found, size = watch.told(), path.stat().st_size / 1e6
    used, here = found["cpu"], peak_memory() / 2**20
    print(f"{len(clip)} frames in {found['wall']:.0f} s, {used:.0f} processor seconds, {used / len(clip):.2f} a frame")
    print(f"{size:.1f} MB; this process {here:.0f} MB, largest other {found['rss_mb']:.0f} MB")
    print(f"{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}")


def poster(options: argparse.Namespace) -> None:
    """Measure one picture, or start a process for each."""
    if len(options.sizes) > 1:
        for size in options.sizes:
            command = [sys.executable, "-m", "benchmarks.pictures", "poster", "--script", str(options.script)]
            subprocess.run([*command, "--sizes", str(size)], check=True)
        return
    (size,) = options.sizes
    page = load_drawing(options.script).page()
    with tempfile.TemporaryDirectory() as folder:
        page.save(Path(folder, "small.png"), size=64)
        base, begin, work = peak_memory() / 2**20, time.perf_counter(), time.process_time()
        path = page.save(Path(folder, "large.png"), size=size)
        seconds, work = time.perf_counter() - begin, time.process_time() - work
        memory, file = peak_memory() / 2**20 - base, path.stat().st_size / 1e6
    height = round(size * page.height / page.width)
    print(f"{size:>6} x {height:<6} {seconds:7.1f} s {work:7.1f} s of processors", end=", ")
    print(f"{memory:6.0f} MB above {base:.0f}, file {file:.1f} MB", flush=True)


def main() -> None:
    """Measure what is asked for."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.pictures", description="Time of films and pictures.")
    kinds = parser.add_subparsers(required=True)
    one = kinds.add_parser("film")
    one.set_defaults(measure=film)
    one.add_argument("--frames", type=int, default=300)
    one.add_argument("--land", action="store_true", help="filled land as well")
    one.add_argument("--jobs", type=int, default=None, help="processes; by default one for each core")
    one.add_argument("--out", type=Path, default=None, help="keep the film under this name")
    one = kinds.add_parser("poster")
    one.set_defaults(measure=poster)
    one.add_argument("--script", type=Path, default=Path("figures/earth_airports.py"))
    one.add_argument("--sizes", type=int, nargs="+", default=[2048, 8192, 16384], help="widths in pixels")
    options = parser.parse_args()
    options.measure(options)


if __name__ == "__main__":
    main()
