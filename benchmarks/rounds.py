"""Taking turns: several engines at one time in memory, one of them at work, round after round.

A busy moment of the machine then meets all of them alike, and ratios are those of neighbouring measurements.
"""

from __future__ import annotations

import resource
import statistics
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, closing
from dataclasses import dataclass, field
from typing import Any

from benchmarks.processes import Engine, StoppedError

SLOW = 30.0
"""Seconds above which a first call counts and is the only one: it needs no warm-up."""

LONG = 4.0
"""Seconds of a first call above which an engine takes part in the first PAIRS rounds only, without warming up."""

PAIRS = 3
"""Neighbouring measurements that a ratio needs at least."""

SHORT = 0.2
"""Calls shorter than this many seconds are repeated to last about as long within a round."""


@dataclass
class Result:
    """What one engine did: what it said of its first call, seconds of a call in each round (medians of repeated)."""

    key: str
    version: str = ""
    said: dict[str, Any] = field(default_factory=dict)
    seconds: list[float] = field(default_factory=list)
    stopped: str | None = None

    def record(self) -> dict[str, Any]:
        """For the file of results."""
        if self.stopped:
            return {"stopped": self.stopped, "version": self.version}
        times = {"seconds": statistics.median(self.seconds), "rounds": self.seconds, "first": self.said["seconds"][0]}
        return self.said | times | {"version": self.version}


@dataclass(frozen=True)
class Entry:
    """An engine to start: its name in the results, its command, the word that it is asked with."""

    key: str
    command: Sequence[str]
    word: str = "run"


def _played(entry: Entry, result: Result, rounds: int) -> Iterator[None]:
    """An engine during the rounds: it starts and is called once, then a round follows after each pause."""
    try:
        with Engine(entry.command) as engine:
            result.version = engine.version
            result.said = engine.run(1, entry.word)
            (first,) = result.said["seconds"]
            if first > SLOW:
                result.seconds.append(first)
                return
            calls = 1
            if first < SHORT:  # again: the first call of a program is slower than the others
                calls = max(1, round(SHORT / max(1e-6, min(engine.run(3, entry.word)["seconds"]))))
            for _ in range(PAIRS if first > LONG else rounds):
                yield
                # One call more, not counted: while others had their turns the system may have given free memory back
                # to the machine, and who comes first after a long pause would pay for all.
                again = 0 if first > LONG else 1
                result.seconds.append(statistics.median(engine.run(again + calls, entry.word)["seconds"][again:]))
    except StoppedError as error:
        result.stopped = str(error)


def take_turns(entries: Sequence[Entry], rounds: int, say: Callable[[Result], None] | None = None) -> dict[str, Result]:
    """Start all, then let each call once (short calls: often) in every round."""
    results = {entry.key: Result(entry.key) for entry in entries}
    with ExitStack() as ended:
        players = [ended.enter_context(closing(_played(entry, results[entry.key], rounds))) for entry in entries]
        for _ in range(1 + rounds):
            for player in players:
                next(player, None)
    for result in results.values() if say else ():
        say(result)
    return results


def fastest(work: Callable[[], Any], repetitions: int) -> tuple[Any, float, float]:
    """What a call returns, and the least of its seconds: on the wall, and of all processors, in what it starts too."""
    wall, busy = [], []
    for _ in range(repetitions):
        begin, begin_busy = time.perf_counter(), processor_seconds()
        found = work()
        busy.append(processor_seconds() - begin_busy)
        wall.append(time.perf_counter() - begin)
    return found, min(wall), min(busy)


def processor_seconds() -> float:
    """Of this process, and of those that it started and that have ended."""
    used = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(each.ru_utime + each.ru_stime for each in used)


Calls = dict[str, Callable[[], object]]


def in_turns(calls: Calls, reference: str | None = None, rounds: int = 7) -> dict[str, dict[str, Any]]:
    """Calls in this process, each once in every round, after one that does not count.

    Of each the median of its seconds, those of all rounds, and their ratios to the reference if there is one.
    """
    seconds: dict[str, list[float]] = {key: [] for key in calls}
    for _ in range(1 + rounds):
        for key, call in calls.items():
            begin = time.perf_counter()
            call()
            seconds[key].append(time.perf_counter() - begin)
    found: dict[str, dict[str, Any]] = {}
    for key, (_, *own) in seconds.items():
        found[key] = {"seconds": statistics.median(own), "rounds": own}
        if reference is not None:
            found[key]["ratios"] = [mine / other for mine, other in zip(own, seconds[reference][1:], strict=True)]
    return found


def paired(slower: Sequence[float], faster: Sequence[float]) -> list[float]:
    """Ratios of the rounds that both took part in; that of the medians where these are fewer than PAIRS."""
    if not slower or not faster:
        return []
    if min(len(slower), len(faster)) < PAIRS:
        return [statistics.median(slower) / statistics.median(faster)]
    return [a / b for a, b in zip(slower, faster, strict=False)]
