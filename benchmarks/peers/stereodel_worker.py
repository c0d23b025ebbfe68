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
KINDS = {"plane": (2, PlanarDelaunay, PlanarVoronoi), "sphere": (3, SphericalDelaunay, SphericalVoronoi)}
ANEW = ("run", "bare", "voronoi", "lists")
"""What begins with the points; the others change or ask one triangulation."""


class Worker:
    """The points, and what can be asked about them."""

    def __init__(self, space: str, workers: str, file: str, more: str | None = None) -> None:
        dimension, self._delaunay, self._voronoi = KINDS[space]
        self._points = np.fromfile(file).reshape(-1, dimension)
        self._more = np.fromfile(more).reshape(-1, dimension) if more else None
        self._workers = int(workers)
        self._first = 0
        self._delaunay(self._points[:100], workers=self._workers)

    @cached_property
    def built(self) -> PlanarDelaunay | SphericalDelaunay:
        """The triangulation that is changed and queried."""
        return self._delaunay(self._points, workers=self._workers)

    def step(self, word: str) -> Callable[[], object]:
        """What is timed next; its preparation is not."""
        if word in ANEW:
            return lambda: self._anew(word)
        if word in ("find", "nearest"):
            query = {"find": self.built.find_simplex, "nearest": self.built.nearest}[word]
            return lambda: query(self._more)
        # Other points each time: repeated ones would be duplicates.
        self._first = (self._first + BATCH) % len(self._more)
        if word == "remove":
            chosen = np.random.default_rng(self._first).choice(len(self.built.points), BATCH, replace=False)
            return lambda: self.built.remove(chosen)
        batch = self._more[self._first : self._first + BATCH]
        return lambda: (self.built.insert(batch), word == "changed" and (self.built.simplices, self.built.neighbors))

    def _anew(self, word: str) -> None:
        self._last = None  # the last result is given back first, as in a loop of a user's
        self._last = self._delaunay(self._points, workers=self._workers, neighbors=word != "bare")
        if word in ("voronoi", "lists"):
            diagram = self._voronoi(self._last)
            diagram.areas()
            _ = diagram.regions if word == "lists" else None
        else:
            _ = self._last.simplices, self._last.neighbors if word == "run" else None

    def answer(self, word: str, repetitions: int) -> dict[str, object]:
        """Seconds of each step, the state after the last, growth of peak memory."""
        if word not in ANEW:
            _ = self.built
        seconds, _, peak = timed(lambda: self.step(word), repetitions)
        last = self._last if word in ANEW else self.built
        return {
            "seconds": seconds,
            "points": len(last.points) - len(last.duplicates),
            "triangles": len(last.simplices),
            "peak": peak,
            "inconclusive": dict(last.inconclusive),
        }


if __name__ == "__main__":
    worker = Worker(*sys.argv[1:])
    print(json.dumps({"version": stereodel.__version__}), flush=True)
    for line in sys.stdin:
        word, repetitions = line.split()
        print(json.dumps(worker.answer(word, int(repetitions))), flush=True)
