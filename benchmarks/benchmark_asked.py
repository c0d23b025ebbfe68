"""The figures that the library has to reach, each with what was measured."""

from __future__ import annotations

import statistics
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from benchmarks.experiments import SPACES
from benchmarks.rounds import paired

Results = dict[str, Any]

TIES = ("circle", "exact circle", "integer cube")
"""Distributions of cocircular points, which are allowed more time."""

BATCH = 1000
"""Points inserted or removed at once, as in peers/stereodel_worker.py."""


@dataclass(frozen=True)
class Figure:
    """One figure: what, the limit, all values measured (rounds or sets), and whether more or less is better."""

    what: str
    limit: float
    values: list[float]
    unit: str
    at_least: bool = False
    note: str = ""

    @property
    def middle(self) -> float:
        """The median."""
        return statistics.median(self.values)

    @property
    def reached(self) -> bool:
        """Whether the median keeps the limit."""
        return self.middle >= self.limit if self.at_least else self.middle <= self.limit

    def row(self) -> list[str]:
        """What, asked, measured with the range over the rounds, reached."""
        asked = f"{'≥' if self.at_least else '≤'} {self.limit:g}{self.unit}"
        if not self.values:
            return [self.what, asked, "not measured", ""]
        measured = f"{digits(self.middle)}{self.unit}"
        if len(self.values) > 1:
            measured += f" ({digits(min(self.values))}–{digits(max(self.values))})"
        return [
            self.what,
            asked,
            measured + (f", {self.note}" if self.note else ""),
            "yes" if self.reached else "**no**",
        ]


def digits(value: float) -> str:
    """Three digits, or all of a larger number."""
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


def rounds(record: dict[str, Any] | None) -> list[float]:
    """Seconds of the rounds, none when stopped or absent."""
    return list(record.get("rounds", [])) if record else []


def faster(record: dict[str, Any], peer: str, ours: str) -> list[float]:
    """How many times the peer takes as long, round by round."""
    return paired(rounds(record.get(peer)), rounds(record.get(ours)))


def against_cgal(results: Results) -> Iterator[Figure]:
    """Uniform points from 1e5 to 1e7, one and two threads."""
    limits = {"plane": {1: 1.8, 2: 3.0}, "sphere": {1: 2.0, 2: 3.5}}
    for space in SPACES:
        for workers, words in ((1, "one thread"), (2, "two threads")):
            for n in (100_000, 1_000_000, 10_000_000):
                values = faster(results["sizes"][space].get(str(n), {}), "cgal", f"ours {workers}")
                what = f"{space}, uniform, {power(n)}, {words}: times as fast as CGAL"
                yield Figure(what, limits[space][workers], values, "×", at_least=True)


def against_others(results: Results) -> Iterator[Figure]:
    """SciPy and STRIPACK at 1e6."""
    for space, peer, name in (
        ("plane", "scipy", "SciPy"),
        ("sphere", "scipy", "SciPy"),
        ("sphere", "stripy", "STRIPACK"),
    ):
        values = faster(results["sizes"][space].get("1000000", {}), peer, "ours 1")
        yield Figure(f"{space}, uniform, 10⁶, one thread: times as fast as {name}", 25, values, "×", at_least=True)


def over_uniform(results: Results) -> Iterator[Figure]:
    """Every distribution against our own uniform points."""
    for space in SPACES:
        for name, sized in results["distributions"][space].items():
            for record in sized.values():
                what = f"{space}, {name}, {record['n']:,} points: time per point over that of uniform points"
                yield Figure(what, 4 if name in TIES else 2, record["over uniform"], "×")


def of_growth(results: Results) -> Iterator[Figure]:
    """From 1e5 to 1e7."""
    for space in SPACES:
        for workers, words in ((1, "one thread"), (2, "two threads")):
            values = results["growth"].get(f"{space} {workers}", [])
            what = f"{space}, {words}: time per point at {power(results['growth']['largest'])} over that at 10⁵"
            yield Figure(what, 1.4, values, "×")


def of_memory(results: Results) -> Iterator[Figure]:
    """Peak growth per point at 1e6 and 1e7."""
    for space in SPACES:
        for n in (1_000_000, 10_000_000):
            for workers, words in ((1, "one thread"), (2, "two threads")):
                record = results["sizes"][space].get(str(n), {}).get(f"ours {workers}", {})
                values = [record["peak"] / n] if "peak" in record else []
                yield Figure(
                    f"{space}, {power(n)}, {words}: peak memory per point, neighbors included", 200, values, " bytes"
                )


def of_small_sets(results: Results) -> Iterator[Figure]:
    """The whole call on 100 and 1000 points."""
    for space in SPACES:
        for n, limit in ((100, 25), (1000, 250)):
            values = [1e6 * s for s in rounds(results["sizes"][space].get(str(n), {}).get("ours 1"))]
            yield Figure(f"{space}, n = {n}: the whole call", limit, values, " µs")


def of_changes(results: Results) -> Iterator[Figure]:
    """Insertions, removals and queries."""
    words = {
        ("insert", 1): (f"insert a point, in batches of {BATCH}", 20, BATCH),
        ("remove", 1): (f"remove a point, in batches of {BATCH}", 40, BATCH),
        ("find", 1): ("find_simplex, each query, one thread", 0.8, None),
        ("find", 2): ("find_simplex, each query, two threads", 0.5, None),
    }
    n = results["changes"]["n"]
    for space in SPACES:
        for (word, workers), (what, limit, each) in words.items():
            seconds = rounds(results["changes"].get(f"{space} {workers}", {}).get(word))
            values = [1e6 * s / (each or n) for s in seconds]
            yield Figure(f"{space}, {power(n)} points: {what}", limit, values, " µs")


def of_diagrams(results: Results) -> Iterator[Figure]:
    """Sorted regions and areas on the sphere: time and memory beside SciPy's."""
    record = results["voronoi"].get("1000000", {})
    what = "sphere, 10⁶, Voronoi regions in order and areas"
    for workers, words, limit in ((1, "one thread", 20), (2, "two threads", 25)):
        values = faster(record, "scipy", f"voronoi {workers}")
        yield Figure(f"{what}, {words}: times as fast as SciPy", limit, values, "×", at_least=True)
    peaks = [record.get(key, {}).get("peak") for key in ("voronoi 2", "scipy")]
    values = [100 * peaks[0] / peaks[1]] if all(peaks) else []
    yield Figure(f"{what}: peak memory beside SciPy's", 33, values, " %")


def power(n: int) -> str:
    """10⁵ for 100000."""
    exponent = len(str(n)) - 1
    return f"10{str(exponent).translate(str.maketrans('0123456789', '⁰¹²³⁴⁵⁶⁷⁸⁹'))}" if n == 10**exponent else f"{n:,}"


def figures(results: Results) -> list[Figure]:
    """All of them."""
    kinds = (against_cgal, against_others, over_uniform, of_growth, of_memory, of_small_sets, of_changes, of_diagrams)
    needed = {over_uniform: "distributions", of_growth: "growth", of_changes: "changes", of_diagrams: "voronoi"}
    return [figure for kind in kinds if needed.get(kind, "sizes") in results for figure in kind(results)]
