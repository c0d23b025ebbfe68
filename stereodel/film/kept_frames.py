"""Finished frames as lossless files in a folder, from which an interrupted film goes on."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from PIL import Image

from stereodel._files import replacing
from stereodel.film.reels import Pixels

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
        try:
            with Image.open(self.path(number)) as image:
                return np.asarray(image)
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
    with replacing(path) as temporary:
        Image.fromarray(picture).save(temporary, format="png", compress_level=1)
