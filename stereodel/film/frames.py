"""Finished frames as lossless files in a folder, from which an interrupted film resumes, where they are still valid."""

from __future__ import annotations

import hashlib
import json
import os
import pickle
import pickletools
import platform
import re
import sys
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel import _kernel
from stereodel._arrays import Pixels
from stereodel._extras import installed_version, libraries, optional
from stereodel._tasks.whole_files import replacing
from stereodel.render.gl import VARIABLE

OURS: Final = re.compile(r"\.?[0-9a-f]{32}\.png(\.\d+\.tmp)?")
"""Names of frames, and of unfinished frames left by terminated processes."""

DRAWN_WITH: Final = ("numpy", "scipy", *(library.name for library in libraries("film") if library.name != "rich"))
"""Distributions whose version can change a picture."""


@dataclass(frozen=True)
class KeptFrames:
    """The folder of a film's frames, one PNG each.

    folder: next to the film.
    names: file name of each frame, a digest of all that the frame depends on, so that equal frames share a file and
        frames of another film are never reused.
    """

    folder: Path
    names: Sequence[str]

    @classmethod
    def beside(cls, film: Path, names: Sequence[str]) -> KeptFrames:
        """Frames in the folder FILM.frames, which is created if needed; OSError if that fails."""
        if film.is_dir():
            raise IsADirectoryError(f"{film} is a folder; give the name of a file")
        folder = film.with_name(f"{film.name}.frames")
        folder.mkdir(exist_ok=True)
        return cls(folder, names)

    def path(self, number: int) -> Path:
        """The file of a frame."""
        return self.folder / f"{self.names[number]}.png"

    def missing(self) -> list[int]:
        """Indices of the frames to draw, without repeats of equal frames."""
        numbers = {name: number for number, name in reversed(list(enumerate(self.names)))}
        return sorted(number for number in numbers.values() if not self.path(number).is_file())

    def __len__(self) -> int:
        return len(self.names)

    def __getitem__(self, number: int) -> Pixels:
        iio = optional("imageio.v3", "film")
        try:
            return np.asarray(iio.imread(self.path(number)))
        except OSError as error:
            raise OSError(f"{self.path(number)} cannot be read ({error}); remove it and try again") from error

    def remove(self) -> None:
        """Remove all frames, including those of other films of this name, and the folder if it is then empty."""
        for path in self.folder.iterdir():
            if OURS.fullmatch(path.name):
                path.unlink()
        with suppress(OSError):
            self.folder.rmdir()


def store_frame(picture: Pixels, path: str | os.PathLike[str]) -> None:
    """Write a picture losslessly and atomically, fast rather than small."""
    with replacing(path) as temporary:
        optional("imageio.v3", "film").imwrite(temporary, picture, extension=".png", compress_level=1)


def frame_names(drawing: Any, shots: Iterable[Any]) -> list[str]:
    """A name for each shot, the same for equal shots drawn by the same versions of the same code.

    Code outside the library is identified by the files of the modules in the pickle of `drawing`. TypeError if
    something cannot be pickled, such as a local function.
    """
    pickled = _pickled(drawing, "draw")
    common = hashlib.sha256(library_digest() + pickled)
    words = {argument for _, argument, _ in pickletools.genops(pickled) if isinstance(argument, str)}
    for name in sorted(words & set(sys.modules)):
        source = getattr(sys.modules[name], "__file__", None)
        if source and not name.startswith("stereodel.") and Path(source).suffix == ".py":
            common.update(Path(source).read_bytes())
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


def library_versions() -> dict[str, str]:
    """Version of Python and of every library that a picture depends on."""
    return {"python": platform.python_version(), **{name: installed_version(name) for name in DRAWN_WITH}}


def library_digest() -> bytes:
    """SHA-256 of the library's modules, its kernel and data, the versions of others, and the renderer asked for."""
    library = Path(__file__).resolve().parent.parent
    sources = library / "data" / "sources.json"  # with the checksums of the real data
    files = [*sorted(library.rglob("*.py")), Path(_kernel.__file__), sources]
    digest = hashlib.sha256(json.dumps(library_versions()).encode())
    digest.update(f"{os.environ.get(VARIABLE, '')} {os.environ.get('PYOPENGL_PLATFORM', '')}".encode())
    for path in files:
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.digest()
