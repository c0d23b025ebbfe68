"""Names of frames: digests of everything that a frame depends on, so that a kept one is taken only where it fits."""

from __future__ import annotations

import hashlib
import pickle
import pickletools
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from stereodel.render.provenance import library_digest


def frame_names(drawing: Any, shots: Iterable[Any]) -> list[str]:
    """A name for each shot: equal ones for equal shots drawn alike by the same versions of the same code.

    Parameters
    ----------
    drawing : object
        What draws the frames. Of code outside the library count the files of the modules that its pickle names.
    shots : iterable
        What each frame shows.

    Raises
    ------
    TypeError
        When something cannot be pickled, a local function for instance.
    """
    pickled = _pickled(drawing, "draw")
    common = hashlib.sha256(library_digest() + pickled)
    for path in _modules_named(pickled):
        common.update(path.read_bytes())
    names = []
    for number, shot in enumerate(shots):
        digest = common.copy()
        digest.update(_pickled(shot, f"shots[{number}]"))
        names.append(digest.hexdigest()[:32])
    return names


def _pickled(thing: Any, name: str) -> bytes:
    try:
        return pickle.dumps(thing)
    except Exception as error:  # pickle raises whatever the object raises
        raise TypeError(
            f"{name} cannot be sent to the processes that draw ({error}); "
            "use functions and classes of a module, not local ones or lambdas"
        ) from error


def _modules_named(pickled: bytes) -> Iterator[Path]:
    """Source files of the modules outside the library whose functions and classes a pickle refers to."""
    words = {argument for _, argument, _ in pickletools.genops(pickled) if isinstance(argument, str)}
    for name in sorted(words & set(sys.modules)):
        source = getattr(sys.modules[name], "__file__", None)
        if source and not name.startswith("stereodel.") and Path(source).suffix == ".py":
            yield Path(source)
