"""The measurements: sizes, distributions, changes and queries. Each returns what goes into the results."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np

from benchmarks.conformal_maps import conformal_maps
from benchmarks.derived import derived
from benchmarks.distributions import FOR_DIRECTIONS, PLANE, REAL, SPHERE, make
from benchmarks.engines import HERE, Contender, contenders, stereodel
from benchmarks.gmt import gmt
from benchmarks.rounds import SLOW, Entry, Result, take_turns
from stereodel._arrays import FloatArray

Records = dict[str, Any]
SPACES = ("plane", "sphere")
DISTRIBUTIONS = {"plane": PLANE, "sphere": SPHERE}
EVERY_PEER = 100_000
"""Largest size at which all peers get all distributions; above it the fastest of them only."""
CHANGED = 1_000_000
BATCHES = 5
QUERIES = 1_000_000


@contextmanager
def on_disk(*sets: FloatArray) -> Iterator[list[str]]:
    """Files of doubles, for as long as they are needed."""
    with tempfile.TemporaryDirectory() as folder:
        files = [os.path.join(folder, f"{k}.f64") for k in range(len(sets))]
        for points, file in zip(sets, files, strict=True):
            points.tofile(file)
        yield files


def say(text: str) -> Callable[[Result], None]:
    """A printer of results under a heading."""

    def line(result: Result) -> None:
        known = result.record()
        told = result.stopped or f"{known['seconds']:10.6f} s of {len(result.seconds)}, {known['triangles']} triangles"
        print(f"{text:34} {result.key:12} {told}", flush=True)

    return line


def rounds_for(n: int) -> int:
    """More rounds where they are short."""
    return 7 if n <= 100_000 else 5 if n <= 1_000_000 else 4


def sizes(largest: int) -> Records:
    """Uniform points of every size, all contenders; one that was stopped is not asked for larger sets."""
    found: Records = {}
    for space in SPACES:
        found[space], out = {}, {}
        for n in (10**k for k in range(2, 8) if 10**k <= largest):
            players = [c for c in contenders(space) if c.key not in out]
            results = _uniform(space, n, players, found[space].get(str(n // 10), {}))
            found[space][str(n)] = {key: result.record() for key, result in results.items()}
            found[space][str(n)] |= {key: {"stopped": f"{why} at {at:,}"} for key, (why, at) in out.items()}
            out |= {key: (result.stopped, n) for key, result in results.items() if result.stopped}
    return found


def _uniform(space: str, n: int, players: Sequence[Contender], smaller: Records) -> dict[str, Result]:
    """Those that take long are measured alone: there is nothing to take turns with, and memory to be kept free."""
    slow = [c for c in players if 10 * smaller.get(c.key, {}).get("seconds", 0.0) > SLOW]
    results: dict[str, Result] = {}
    with on_disk(make(space, "uniform", n)) as (file,):
        for group in ([c for c in players if c not in slow], *([c] for c in slow)):
            entries = [Entry(c.key, [*c.command, file]) for c in group]
            results |= take_turns(entries, rounds_for(n), say(f"{space} uniform {n}"))
    return results


def distributions(largest: int) -> Records:
    """Every distribution at 1e5 and 1e6."""
    counts = [n for n in (100_000, 1_000_000) if n <= largest]
    return {
        space: {
            name: {str(n): _distribution(space, name, n) for n in counts[: 1 if name in REAL else None]}
            for name in DISTRIBUTIONS[space]
            if name != "uniform"
        }
        for space in SPACES
    }


def _distribution(space: str, name: str, n: int) -> Records:
    points = make(space, name, n)
    # Peers want points of the unit sphere; we take the directions as they are.
    units = points / np.linalg.norm(points, axis=1)[:, None] if name in FOR_DIRECTIONS else points
    players = contenders(space) if n <= EVERY_PEER else contenders(space, "ours 1", "ours 2", "cgal")
    with on_disk(points, units) as (file, unit_file):
        entries = [Entry(c.key, [*c.command, file if c.ours else unit_file]) for c in players]
        results = take_turns(entries, 5, say(f"{space} {name} {len(points)}"))
    return {"n": len(points)} | {key: result.record() for key, result in results.items()}


def changes(largest: int) -> Records:
    """Insertion, removal, queries on 1e6 points; also the triangulation without neighbors."""
    n = min(CHANGED, largest)
    found: Records = {"n": n}
    for space in SPACES:
        more = make(space, "uniform", QUERIES if n == CHANGED else n, seed=2)
        with on_disk(make(space, "uniform", n), more) as files:
            for workers in (1, 2):
                found[f"{space} {workers}"] = _changes(space, workers, files)
    return found


def _changes(space: str, workers: int, files: list[str]) -> Records:
    command = [*stereodel(space, workers), *files]
    found: Records = {}
    for word in ("run", "bare", "find", "nearest", "insert", "changed", "remove"):
        result = take_turns([Entry(word, command, word)], BATCHES, say(f"{space} {workers} threads"))[word]
        found[word] = result.record()
    return found


def voronoi(largest: int) -> Records:
    """Regions in order and areas of uniform points of the sphere, from the points, beside SciPy's."""
    found: Records = {}
    peer = [sys.executable, str(HERE / "peers" / "python_peer.py"), "scipy_voronoi"]
    for n in (n for n in (100_000, 1_000_000) if n <= largest):
        with on_disk(make("sphere", "uniform", n)) as (file,):
            ours = [
                Entry(f"{word} {workers}", [*stereodel("sphere", workers), file], word)
                for word in ("voronoi", "lists")
                for workers in (1, 2)
            ]
            results = take_turns([*ours, Entry("scipy", [*peer, file])], 3, say(f"sphere voronoi {n}"))
        found[str(n)] = {key: result.record() for key, result in results.items()}
    return found


EXPERIMENTS: dict[str, Callable[[int], Records]] = {
    "sizes": sizes,
    "distributions": distributions,
    "changes": changes,
    "voronoi": voronoi,
    "derived": derived,
    "conformal maps": conformal_maps,
    "gmt": gmt,
}
RESULTS = HERE / "results.json"
