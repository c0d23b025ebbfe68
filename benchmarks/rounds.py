"""Taking turns: several engines at one time in memory, one of them at work, round after round.

A busy moment of the machine then meets all of them alike, and ratios are those of neighbouring measurements.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from typing import Any

from benchmarks.processes import Engine, StoppedError

SLOW = 30.0
"""Seconds above which a first call counts and is the only one: it needs no warm-up."""

BRIEF = 10.0
"""Seconds of a first call above which no round begins with a call that does not count."""

LONG = 4.0
"""Seconds of a first call above which an engine takes part in the first PAIRS rounds only."""

PAIRS = 3
"""Neighbouring measurements that a ratio needs at least."""

SHORT = 0.2
"""Calls shorter than this many seconds are repeated to last about as long within a round."""


@dataclass
class Result:
    """What one engine did: seconds of a call in each round (medians of repeated calls), counts, the first call."""

    key: str
    version: str = ""
    seconds: list[float] = field(default_factory=list)
    points: int = 0
    triangles: int = 0
    peak: int = 0
    first: float = 0.0
    stopped: str | None = None
    extra: dict[str, Any] = field(default_factory=dict)

    @property
    def median(self) -> float:
        """Of the rounds."""
        return statistics.median(self.seconds)

    def record(self) -> dict[str, Any]:
        """For the file of results."""
        if self.stopped:
            return {"stopped": self.stopped, "version": self.version}
        known = {"seconds": self.median, "rounds": self.seconds, "points": self.points, "triangles": self.triangles}
        return known | {"peak": self.peak, "first": self.first, "version": self.version, **self.extra}


@dataclass(frozen=True)
class Entry:
    """An engine to start: its name in the results, its command, the word that it is asked with."""

    key: str
    command: Sequence[str]
    word: str = "run"


class _Player:
    """An engine during the rounds."""

    def __init__(self, entry: Entry) -> None:
        self.result = Result(entry.key)
        self._entry = entry
        self._engine: Engine | None = None
        self._calls = 1
        self._rounds = sys.maxsize

    def start(self) -> None:
        """Start, and make the first call: it gives memory, counts, and how often to call in a round."""
        try:
            self._engine = Engine(list(self._entry.command))
            self.result.version = self._engine.version
            self._first(self._engine)
        except StoppedError as error:
            self.result.stopped = str(error)

    def _first(self, engine: Engine) -> None:
        first = engine.run(1, self._entry.word)
        self.result.points, self.result.triangles = first.points, first.triangles
        self.result.peak, self.result.extra = first.peak, first.extra
        self.result.first = first.seconds[0]
        if first.seconds[0] > SLOW:
            self.result.seconds.append(first.seconds[0])
            self._rounds = 0
            engine.close()
        elif first.seconds[0] > LONG:
            self._rounds = PAIRS
        elif first.seconds[0] < SHORT:
            # Again: the first call of a program is slower than the others.
            second = max(1e-6, min(engine.run(3, self._entry.word).seconds))
            self._calls = max(1, round(SHORT / second))

    def play(self) -> None:
        """One round."""
        if self.result.stopped or self._rounds == 0:
            return
        self._rounds -= 1
        # One call more, not counted: while others had their turns the system may have given free memory back to the
        # machine, and who comes first after a long pause would pay for all.
        again = 1 if self.result.first < BRIEF else 0
        try:
            seconds = self._engine.run(again + self._calls, self._entry.word).seconds
            self.result.seconds.append(statistics.median(seconds[again:]))
        except StoppedError as error:
            self.result.stopped = str(error)

    def close(self) -> None:
        """End the process."""
        if self._engine is not None:
            self._engine.close()


def take_turns(entries: Sequence[Entry], rounds: int, say: Callable[[Result], None] | None = None) -> dict[str, Result]:
    """Start all, then let each call once (short calls: often) in every round."""
    players = [_Player(entry) for entry in entries]
    with ExitStack() as ended:
        for player in players:
            ended.callback(player.close)
            player.start()
        for _ in range(rounds):
            for player in players:
                player.play()
    for player in players:
        if say:
            say(player.result)
    return {player.result.key: player.result for player in players}


Calls = dict[str, Callable[[], object]]


def in_turns(calls: Calls, reference: str | None = None, rounds: int = 7) -> dict[str, dict[str, Any]]:
    """Calls in this process, each once in every round, after one that does not count.

    Of each the median of its seconds, those of all rounds, and their ratios to the reference if there is one.
    """
    seconds: dict[str, list[float]] = {key: [] for key in calls}
    for number in range(rounds + 1):
        for key, call in calls.items():
            begin = time.perf_counter()
            call()
            if number > 0:
                seconds[key].append(time.perf_counter() - begin)
    found: dict[str, dict[str, Any]] = {}
    for key, own in seconds.items():
        found[key] = {"seconds": statistics.median(own), "rounds": own}
        if reference is not None:
            found[key]["ratios"] = [mine / other for mine, other in zip(own, seconds[reference], strict=True)]
    return found


def paired(slower: Sequence[float], faster: Sequence[float]) -> list[float]:
    """Ratios of the rounds that both took part in; that of the medians where these are fewer than PAIRS."""
    if not slower or not faster:
        return []
    if min(len(slower), len(faster)) < PAIRS:
        return [statistics.median(slower) / statistics.median(faster)]
    return [a / b for a, b in zip(slower, faster, strict=False)]
