"""Time and memory of a film: frames of 1280 × 720, a globe with its coastline along a flight, as MP4.

    python -m benchmarks.pictures [--frames 300] [--jobs N]

Processor seconds count this process, those that draw and the encoder; they say more than the time on a clock where
others use the machine.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from benchmarks.peers.python_peer import high_water
from benchmarks.processes import Watch
from stereodel.film import Film, Flight, Stop
from stereodel.globe import Globe

PARIS, NEW_YORK, TOKYO = (2.35, 48.86), (-74.01, 40.71), (139.69, 35.69)


def flight(seconds: float) -> Flight:
    """Over three cities at S = 1, 8, 8, 8, 1, in that time; no stops, so that each frame must be drawn."""
    over = [Stop(place, 8.0, 0.0) for place in (PARIS, NEW_YORK, TOKYO)]
    stops = [Stop(PARIS, hold=0.0), *over, Stop(TOKYO, hold=0.0)]
    return Flight(stops, pace=seconds / Flight(stops).seconds)


def main() -> None:
    """Make the film, print what it took."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.pictures")
    parser.add_argument("--frames", type=int, default=300)
    parser.add_argument("--jobs", type=int, default=None, help="processes; by default one for each core")
    options = parser.parse_args()
    globe = Globe()
    globe.add_coastlines(resolution="50m")
    film = Film.of_globe(globe, flight(options.frames / 25), size=(1280, 720))
    with tempfile.TemporaryDirectory() as folder, Watch(Path(folder)) as watch:
        film.save(Path(folder, "film.mp4"), jobs=options.jobs)
    found = watch.found()
    print(f"{len(film)} frames in {found['wall']:.0f} s, {found['cpu'] / len(film):.2f} processor seconds each")
    print(f"{high_water() / 2**20:.0f} MB here, {found['rss_mb']:.0f} MB in the largest other process")


if __name__ == "__main__":
    main()
