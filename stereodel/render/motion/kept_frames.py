"""Finished frames as lossless files in a folder, from which an interrupted film goes on."""

from __future__ import annotations

import os
import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from stereodel._files import replacing
from stereodel.render.motion.reels import Pixels


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
        """In the folder FILM.frames, made when it is missing."""
        folder = film.with_name(f"{film.name}.frames")
        folder.mkdir(parents=True, exist_ok=True)
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
        with Image.open(self.path(number)) as image:
            return np.asarray(image)

    def remove(self) -> None:
        """Remove the folder with all that is in it: the film is complete."""
        shutil.rmtree(self.folder)


def store_frame(picture: Pixels, path: str | os.PathLike[str]) -> None:
    """Write a picture without loss, quickly rather than small; whole or not at all."""
    with replacing(path) as temporary:
        Image.fromarray(picture).save(temporary, format="png", compress_level=1)
