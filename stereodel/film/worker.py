"""A process that draws frames: what to draw comes in through standard input, as pickles; it ends when that ends.

First comes the main script if it is needed, then what draws, then a task at a time. There is an answer to each task.
"""

from __future__ import annotations

import os
import pickle
import runpy
import signal
import sys
import traceback
import types
from collections.abc import Callable
from pathlib import Path
from typing import Any, BinaryIO, Final, Literal

DRAWS_FRAMES: Final = "STEREODEL_DRAWS_FRAMES"
"""Environment variable that tells code of the main script that it runs in a worker."""

MainScript = tuple[Literal["module", "path"], str]
"""The name of the module that `python -m` runs, or the path of a file."""

Answer = tuple[str, str]
"""One line and the whole traceback of what went wrong; both empty when nothing did."""


def attempt(store: Callable[[Any, Path], None], shot: Any, path: Path) -> Answer:
    """Draw one frame into a file; an error becomes text, because not every exception can be sent."""
    try:
        store(shot, path)
    except Exception as error:
        return _in_words(error)
    return "", ""


def serve(requests: BinaryIO, answers: BinaryIO) -> None:
    """Take requests until there are no more."""
    sys.argv, script, drawing = pickle.load(requests)
    problem, store = ("", ""), None
    try:
        if script:
            _import_main(script)
        store = pickle.loads(drawing)
    except Exception as error:
        problem = _in_words(error)
    while True:
        try:
            shot, path = pickle.load(requests)
        except EOFError:
            return
        pickle.dump(attempt(store, shot, path) if store else problem, answers)
        answers.flush()


def _in_words(error: Exception) -> Answer:
    return f"{type(error).__name__}: {error}", "".join(traceback.format_exception(error))


def _import_main(script: MainScript) -> None:
    """Make what the main script defines known under the names that pickles have for it, as multiprocessing does."""
    main = types.ModuleType("__mp_main__")
    sys.modules["__main__"] = sys.modules["__mp_main__"] = main
    kind, name = script
    run = runpy.run_module if kind == "module" else runpy.run_path
    main.__dict__.update(run(name, run_name="__mp_main__"))


def main() -> None:
    """Serve standard input; what libraries print goes to the error stream, so that it is not taken for an answer."""
    # Ctrl-C reaches all processes of a terminal, but the one that started this one decides what it means.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with os.fdopen(os.dup(1), "wb") as answers:
        os.dup2(2, 1)
        serve(sys.stdin.buffer, answers)
