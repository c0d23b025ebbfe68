"""stereodel itself, in the conversation of benchmarks/processes.py: the whole Python call with its checks.

    python stereodel_worker.py plane|sphere WORKERS FILE [MORE]

"run K": K triangulations, `simplices` and `neighbors` included; "bare K": the same without neighbors; "voronoi K":
K Voronoi diagrams, from the points to the arrays of regions and areas; "lists K": and the regions as lists. On one
triangulation of FILE with the points of MORE: "insert K", "remove K": K batches of BATCH points; "changed K": batches
of insertions, after each of which the arrays are read; "find K", "nearest K": K calls with all of MORE as queries.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from functools import cached_property

import numpy as np
from python_peer import timed

import stereodel
from stereodel import PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi

BATCH = 1000
Step = Callable[[], object]


class Worker:
    """The points, and what can be asked about them."""

    def __init__(self, space: str, workers: str, file: str, more: str | None = None) -> None:
        dimension, self._class = {"plane": (2, PlanarDelaunay), "sphere": (3, SphericalDelaunay)}[space]
        self._points = np.fromfile(file).reshape(-1, dimension)
        self._more = np.fromfile(more).reshape(-1, dimension) if more else None
        self._workers = int(workers)
        self._first = 0
        self._class(self._points[:100], workers=self._workers)

    @cached_property
    def built(self) -> PlanarDelaunay | SphericalDelaunay:
        """The triangulation that is changed and queried."""
        return self._class(self._points, workers=self._workers)

    def step(self, word: str) -> Step:
        """What is timed next; its preparation is not."""
        if word in ("run", "bare"):
            return lambda: self._build(neighbors=word == "run")
        if word in ("voronoi", "lists"):
            return lambda: self._diagram(lists=word == "lists")
        if word in ("find", "nearest"):
            query = {"find": self.built.find_simplex, "nearest": self.built.nearest}[word]
            return lambda: query(self._more)
        self._first = (self._first + BATCH) % len(
            self._more
        )  # other points each time: repeated ones would be duplicates
        if word == "remove":
            chosen = np.random.default_rng(self._first).choice(len(self.built.points), BATCH, replace=False)
            return lambda: self.built.remove(chosen)
        batch = self._more[self._first : self._first + BATCH]
        return lambda: self._insert(batch, read=word == "changed")

    def _build(self, *, neighbors: bool) -> None:
        self._last = None  # the last result is given back first, as in a loop of a user's
        self._last = self._class(self._points, workers=self._workers, neighbors=neighbors)
        _ = self._last.simplices
        if neighbors:
            _ = self._last.neighbors

    def _diagram(self, *, lists: bool) -> None:
        self._last = None
        self._last = self._class(self._points, workers=self._workers)
        diagram = {2: PlanarVoronoi, 3: SphericalVoronoi}[self._points.shape[1]](self._last)
        diagram.areas()
        if lists:
            _ = diagram.regions

    def _insert(self, batch: np.ndarray, *, read: bool) -> None:
        self.built.insert(batch)
        if read:
            _ = self.built.simplices, self.built.neighbors

    def answer(self, word: str, repetitions: int) -> dict[str, object]:
        """Seconds of each step, the state after the last, growth of peak memory."""
        alone = word in ("run", "bare", "voronoi", "lists")
        if not alone:
            _ = self.built
        seconds, _, peak = timed(lambda: self.step(word), repetitions)
        last = self._last if alone else self.built
        return {
            "seconds": seconds,
            "points": len(last.points) - len(last.duplicates),
            "triangles": len(last.simplices),
            "peak": peak,
            "inconclusive": dict(last.inconclusive),
        }


def main(arguments: list[str]) -> None:
    """Read, warm up, say the version, answer."""
    worker = Worker(*arguments)
    print(json.dumps({"version": stereodel.__version__}), flush=True)
    for line in sys.stdin:
        word, repetitions = line.split()
        print(json.dumps(worker.answer(word, int(repetitions))), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
