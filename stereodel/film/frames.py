"""Finished frames as lossless files in a folder, from which an interrupted film goes on.

The name of a file is a digest of everything that its frame depends on, so that it is taken only where it fits.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import pickletools
import re
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._arrays import Pixels
from stereodel._extras import of_extra
from stereodel._files import replacing
from stereodel.render.provenance import library_digest

OURS: Final = re.compile(r"\.?[0-9a-f]{32}\.png(\.\d+\.tmp)?")
"""Names of frames, and of frames that a process which was ended had begun."""


@dataclass(frozen=True)
class KeptFrames:
    """The folder of a film's frames, a PNG each.

    Parameters
    ----------
    folder : Path
        Beside the film.
    names : sequence of str
        The name of each frame's file: a digest of all that the frame depends on, so that frames that look alike share
        one, and a frame of another film is never taken for one of this.
    """

    folder: Path
    names: Sequence[str]

    @classmethod
    def beside(cls, film: Path, names: Sequence[str]) -> KeptFrames:
        """In the folder FILM.frames, made when it is missing; an OSError where that is not possible."""
        if film.is_dir():
            raise IsADirectoryError(f"{film} is a folder; give the name of a file")
        folder = film.with_name(f"{film.name}.frames")
        folder.mkdir(exist_ok=True)
        return cls(folder, names)

    def path(self, number: int) -> Path:
        """The file of a frame."""
        return self.folder / f"{self.names[number]}.png"

    def missing(self) -> list[int]:
        """Numbers of the frames to draw, of frames that look alike the first."""
        numbers = {name: number for number, name in reversed(list(enumerate(self.names)))}
        return sorted(number for number in numbers.values() if not self.path(number).is_file())

    def __len__(self) -> int:
        return len(self.names)

    def __getitem__(self, number: int) -> Pixels:
        with of_extra("film"):
            import imageio.v3 as iio

        try:
            return np.asarray(iio.imread(self.path(number)))
        except OSError as error:
            raise OSError(f"{self.path(number)} cannot be read ({error}); remove it and try again") from error

    def remove(self) -> None:
        """Remove all frames, those of other films of the same name too, and the folder if nothing else is in it."""
        for path in self.folder.iterdir():
            if OURS.fullmatch(path.name):
                path.unlink()
        with suppress(OSError):
            self.folder.rmdir()


def store_frame(picture: Pixels, path: str | os.PathLike[str]) -> None:
    """Write a picture without loss, quickly rather than small; whole or not at all."""
    with of_extra("film"):
        import imageio.v3 as iio

    with replacing(path) as temporary:
        iio.imwrite(temporary, picture, extension=".png", compress_level=1)


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
