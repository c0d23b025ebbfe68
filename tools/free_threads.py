"""Eight threads with one triangulation: equal answers to questions, and changes that wait for each other.

    python -W error tools/free_threads.py

With or without the interpreter's lock; where Python was built without, loading the kernel must not bring the lock back.
Needs stereodel and NumPy alone.
"""

from __future__ import annotations

import copy
import sys
import sysconfig
import threading
from collections.abc import Callable
from typing import Any

import numpy as np

from stereodel import PlanarDelaunay, SphericalDelaunay, check_delaunay

THREADS = 8
KINDS: dict[Any, int] = {PlanarDelaunay: 2, SphericalDelaunay: 3}
QUESTIONS: dict[str, Callable[[Any, Any], Any]] = {
    "simplices": lambda made, _: made.simplices,
    "neighbors": lambda made, _: made.neighbors,
    "edges": lambda made, _: made.edges,
    "circumcenters": lambda made, _: made.circumcenters,
    "find_simplex": lambda made, queries: made.find_simplex(queries),
    "nearest": lambda made, queries: made.nearest(queries),
}


def locked() -> bool:
    """Whether this Python was built without the interpreter's lock and has it all the same."""
    built_without = bool(sysconfig.get_config_var("Py_GIL_DISABLED"))
    return built_without and getattr(sys, "_is_gil_enabled", lambda: True)()


def at_once(work: Callable[[int], Any]) -> list[Any]:
    """What work(k) gives for each of the threads, which begin together; the first error that one of them raises."""
    barrier = threading.Barrier(THREADS)
    found: list[Any] = [None] * THREADS
    errors: list[Exception] = []

    def run(k: int) -> None:
        barrier.wait()
        try:
            found[k] = work(k)
        except Exception as error:  # raised below
            errors.append(error)

    threads = [threading.Thread(target=run, args=(k,)) for k in range(THREADS)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if errors:
        raise errors[0]
    return found


def answers(made: Any, queries: Any, first: int) -> dict[str, bytes]:
    """To all questions, asked one after the other from one of them on."""
    names = list(QUESTIONS)
    start = first % len(names)
    return {name: QUESTIONS[name](made, queries).tobytes() for name in names[start:] + names[:start]}


def wrong_answers(kind: Any, width: int, seed: int) -> int:
    """Threads that are answered otherwise than one alone, of those that ask one object first and at once."""
    rng = np.random.default_rng(seed)
    points, more, queries = (rng.normal(size=(size, width)) for size in (300, 20, 50))
    alone, shared = kind(points), kind(points)
    for made in (alone, shared):
        made.insert(more)  # so that nothing is known of it yet
    right = answers(alone, queries, 0)
    return sum(found != right for found in at_once(lambda k: answers(shared, queries, k)))


def changes(kind: Any, width: int, seed: int) -> int:
    """How many changes were made at once, in turn with questions: all of them, and the answers are of whole states."""
    rng = np.random.default_rng(seed)
    made = kind(rng.normal(size=(2000, width)))
    blocks = rng.normal(size=(THREADS, 700, width))

    def work(k: int) -> Any:
        numbers = made.insert(blocks[k])
        nearest = made.nearest(blocks[k])
        if k == 0:
            check_delaunay(copy.copy(made))  # of the changes so far, while others go on
        return numbers, nearest

    found = at_once(work)
    check_delaunay(made)
    for block, (numbers, nearest) in zip(blocks, found, strict=True):
        if not (made.points[numbers] == block).all() or not (numbers == nearest).all():
            raise AssertionError("points are not where they were put")
    if len(made.points) != 2000 + 700 * THREADS:
        raise AssertionError(f"{len(made.points)} points after {THREADS} changes")
    return THREADS


def main(rounds: int = 20) -> int:
    """Report and return the exit code."""
    cases = [(kind, width, seed) for seed in range(rounds) for kind, width in KINDS.items()]
    wrong = sum(wrong_answers(*case) for case in cases)
    done = sum(changes(*case) for case in cases)
    enabled = getattr(sys, "_is_gil_enabled", lambda: True)()
    lock = "brought back by the kernel" if locked() else "on" if enabled else "off"
    print(f"{THREADS} threads, the interpreter's lock {lock}: {wrong} wrong answers, {done} changes")
    return 1 if wrong or locked() else 0


if __name__ == "__main__":
    sys.exit(main())
