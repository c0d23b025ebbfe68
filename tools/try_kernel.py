"""What is the same wherever the kernel was compiled and whatever runs it: stored answers, and eight threads at once.

    python -W error tools/try_kernel.py            1 if something differs
    python tools/try_kernel.py --write             store the answers in tests/kernel/answers.json

Triangles are decided by exact signs: they are equal on all systems. Circumcentres and areas pass through functions of
the C library: on that of GNU they are equal to the last bit, on others within `OTHER_LIBRARIES`. The points are made of
the raw numbers of a generator, which NumPy promises not to change.

Threads that share a triangulation get equal answers, and their changes wait for each other, with or without the
interpreter's lock; where Python was built without, loading the kernel must not bring the lock back. Needs stereodel
and NumPy alone.
"""

from __future__ import annotations

import copy
import hashlib
import json
import platform
import sys
import sysconfig
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np

import stereodel
from stereodel import PlanarDelaunay, SphericalDelaunay, SphericalVoronoi, check_delaunay

STORED = Path(__file__).resolve().parent.parent / "tests" / "kernel" / "answers.json"
OTHER_LIBRARIES = 2.0**-40
"""What values may differ by, relative to the largest: functions that other C libraries round otherwise, by a few units
in the last place, are followed by sums in which at most some thousands of such units remain."""
SAMPLES = 16
THREADS = 8
Floats = np.ndarray[Any, np.dtype[np.float64]]

# Stored answers


def uniform(seed: int, size: int, width: int) -> Floats:
    """Numbers from -1/2 to 1/2, multiples of 2⁻⁵³."""
    raw = np.random.PCG64(seed).random_raw(size * width) >> np.uint64(11)
    return (raw.astype(float) * 2.0**-53 - 0.5).reshape(size, width)


def grid(side: int, width: int) -> Floats:
    """Whole numbers about zero, which is left out: most decisions are ties."""
    steps = np.arange(side, dtype=float) - side // 2
    points = np.stack(np.meshgrid(*[steps] * width, indexing="ij"), axis=-1).reshape(-1, width)
    return points[np.any(points != 0, axis=1)]


SETS: dict[str, Callable[[], Floats]] = {
    "directions": lambda: uniform(1, 50_000, 3),
    "directions of a thousandth of a radian": lambda: np.array([0.6, 0.48, 0.64]) + 1e-3 * uniform(2, 50_000, 3),
    "directions of whole numbers": lambda: grid(17, 3),
    "plane": lambda: uniform(3, 50_000, 2),
    "plane of whole numbers": lambda: grid(101, 2),
}
"""Directions of any length, or points of the plane."""


def digest(array: Any) -> str:
    """SHA-256 of an array in one order and width of bytes."""
    kept = np.ascontiguousarray(array)
    return hashlib.sha256(kept.astype(kept.dtype.newbyteorder("<")).tobytes()).hexdigest()


def samples(values: Floats) -> list[str]:
    """Some of the values, to the last bit."""
    flat = values.ravel()
    return [float(value).hex() for value in flat[:: max(1, flat.size // SAMPLES)][:SAMPLES]]


def answers(points: Floats) -> dict[str, Any]:
    """The digest of the triangles of a set, and those of circumcentres and areas with some of their values."""
    on_sphere = points.shape[1] == 3
    made = SphericalDelaunay(points) if on_sphere else PlanarDelaunay(points)
    values = {"circumcenters": made.circumcenters} | ({"areas": SphericalVoronoi(made).areas()} if on_sphere else {})
    told = {key: {"digest": digest(value), "samples": samples(value)} for key, value in values.items()}
    return {"triangles": digest(made.simplices.astype(np.int64)), **told}


def same(ours: Any, theirs: Any) -> bool:
    """Whether answers are equal, or values those of another C library than that of GNU."""
    if ours == theirs or isinstance(ours, str) or platform.libc_ver()[0] == "glibc":
        return bool(ours == theirs)
    found, stored = ([float.fromhex(value) for value in each["samples"]] for each in (ours, theirs))
    return bool(np.allclose(found, stored, rtol=0, atol=OTHER_LIBRARIES * max(map(abs, stored))))


def other_answers() -> list[str]:
    """What is not as it is stored."""
    stored = json.loads(STORED.read_text(encoding="utf-8"))
    found = {name: answers(points()) for name, points in SETS.items()}
    pairs = [(name, key, found[name][key], stored[name][key]) for name in stored for key in stored[name]]
    return [f"{name}: {key}" for name, key, ours, theirs in pairs if not same(ours, theirs)]


# Threads

QUESTIONS: dict[str, Callable[[Any, Any], Any]] = {
    "simplices": lambda made, _: made.simplices,
    "neighbors": lambda made, _: made.neighbors,
    "edges": lambda made, _: made.edges,
    "circumcenters": lambda made, _: made.circumcenters,
    "find_simplex": lambda made, queries: made.find_simplex(queries),
    "nearest": lambda made, queries: made.nearest(queries),
}


def is_locked() -> bool:
    """Whether the interpreter has its lock."""
    return bool(getattr(sys, "_is_gil_enabled", lambda: True)())


def at_once(work: Callable[[int], Any]) -> list[Any]:
    """What work(k) gives for each of the threads, which begin together."""
    barrier = threading.Barrier(THREADS)
    with ThreadPoolExecutor(THREADS) as pool:
        return list(pool.map(lambda k: (barrier.wait(), work(k))[1], range(THREADS)))


def told(made: Any, queries: Any, first: int) -> dict[str, bytes]:
    """Answers to all questions, asked one after the other from one of them on."""
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
    right = told(alone, queries, 0)
    return sum(found != right for found in at_once(lambda k: told(shared, queries, k)))


def check_changes(kind: Any, width: int, seed: int) -> None:
    """Changes at once, in turn with questions: all are made, and the answers are of whole states."""
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


def wrong_threads(rounds: int) -> list[str]:
    """What is wrong when threads share a triangulation."""
    wrong = 0
    for seed in range(rounds):
        for kind, width in ((PlanarDelaunay, 2), (SphericalDelaunay, 3)):
            wrong += wrong_answers(kind, width, seed)
            check_changes(kind, width, seed)
    found = [f"{wrong} wrong answers to {THREADS} threads"] if wrong else []
    brought_back = is_locked() and sysconfig.get_config_var("Py_GIL_DISABLED")
    return [*found, "the kernel brought the interpreter's lock back"] if brought_back else found


def main(*arguments: str, rounds: int = 20) -> None:
    """Report; end with 1 where something is wrong."""
    if arguments == ("--write",):
        found = {name: answers(points()) for name, points in SETS.items()}
        STORED.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
        return
    threads = 0 if sys.platform == "emscripten" else THREADS  # which has none
    wrong = other_answers() + (wrong_threads(rounds) if threads else [])
    python = f"Python {platform.python_version()}{'' if is_locked() else ' without its lock'}, {platform.machine()}"
    where = f"{python}, {platform.libc_ver()[0] or platform.system()}, NumPy {np.__version__}"
    said = "OTHER ANSWERS" if wrong else f"{len(SETS)} sets and {threads} threads answered as they must be"
    print(f"stereodel {stereodel.__version__} on {where}: {said}")
    sys.exit("\n".join(wrong) or 0)


if __name__ == "__main__":
    main(*sys.argv[1:])
