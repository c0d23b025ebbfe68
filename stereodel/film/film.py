"""Films: many pages, drawn in several processes and written as one file."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np

from stereodel._arrays import as_count, as_scalar
from stereodel.drawing.page import Page
from stereodel.film.formats import format_of
from stereodel.film.kept_frames import KeptFrames, store_frame
from stereodel.film.keys import frame_names
from stereodel.film.progress import counting
from stereodel.film.reels import Pixels, Reel
from stereodel.film.workers import draw_all, refuse_in_worker
from stereodel.render.cores import usable_cores
from stereodel.render.sizes import LARGEST_SIZE

Shot = TypeVar("Shot")


@dataclass(frozen=True)
class Film(Generic[Shot]):
    """A moving picture of many frames: drawn in parallel, resumed where it was interrupted, written in any format.

    Parameters
    ----------
    draw : callable
        shot → `Page`, all of one extent. Frames are drawn in other processes, so it is a function of a module, an
        instance of a class of a module, or a `functools.partial` of one.
    shots : sequence
        What each frame shows: the arguments of `draw`, which can be pickled too. Equal shots are drawn once; repeat one
        to hold it.
    fps : float
        Frames a second.
    size : int
        Width in pixels; the height is that of the pages.
    text : bool
        Whether labels are drawn.
    platform : {"osmesa", "egl"}, optional
        See `stereodel.render.gl`.

    Raises
    ------
    ValueError
        For no shots, an `fps` that is not positive, or a `size` outside 1 to 20000.

    Examples
    --------
    >>> import numpy as np
    >>> from stereodel.drawing.page import Dots
    >>> def ball(x):
    ...     return Page((0.0, 4.0, 0.0, 2.0), (Dots(np.array([[x, 1.0]]), 40.0, (0.8, 0.1, 0.1, 1.0)),))
    >>> film = Film(ball, [1.0, 2.0, 3.0], fps=10, size=80)
    >>> film.seconds, film.picture(1).shape
    (0.3, (40, 80, 3))
    """

    draw: Callable[[Shot], Page]
    shots: Sequence[Shot]
    _: KW_ONLY
    fps: float = 25.0
    size: int = 1280
    text: bool = True
    platform: str | None = None

    def __post_init__(self) -> None:
        if len(self.shots) == 0:
            raise ValueError("shots is empty; give what at least one frame shows")
        as_scalar(self.fps, "fps", low=0.0, open_low=True)
        as_count(self.size, "size", high=LARGEST_SIZE)

    def __len__(self) -> int:
        """The number of frames."""
        return len(self.shots)

    @property
    def seconds(self) -> float:
        """How long it takes to see it."""
        return len(self.shots) / self.fps

    def page(self, number: int) -> Page:
        """One frame as a page."""
        return self.draw(self.shots[number])

    def picture(self, number: int) -> Pixels:
        """One frame as pixels, (h, w, 3), drawn now."""
        return self._camera.picture(self.shots[number])

    @property
    def _camera(self) -> _Camera[Shot]:
        return _Camera(self.draw, self.size, self.text, self.platform)

    def save(self, path: str | os.PathLike[str], *, jobs: int | None = None, progress: bool = True) -> Path:
        """Draw the frames and write the file.

        Finished frames are kept in the folder PATH.frames beside the file until that is complete. After an
        interruption the same call goes on where it was and gives the same file. Frames that a changed film, library or
        function does not fit are drawn anew; of functions outside the library, their own module alone is looked at.

        Parameters
        ----------
        path : path-like
            Its ending decides: .gif, .png or .apng, .webp, .mp4. An existing file is replaced when all is done.
        jobs : int, optional
            Processes that draw at once; by default one for each core. The file does not depend on it.
        progress : bool
            Whether to tell on the standard error stream what is being done: a bar on a terminal, lines elsewhere.

        Returns
        -------
        Path
            The file.

        Raises
        ------
        stereodel.film.FrameError
            If a frame cannot be drawn, with its number.
        ValueError, TypeError, ImportError
            Before anything is drawn: if the ending is another one, the format cannot hold the frames (see
            `save_pictures`), `draw` or a shot cannot be pickled, or ffmpeg is missing.
        OSError
            If the file or the folder cannot be written.
        """
        refuse_in_worker()
        target = Path(path)
        kind = format_of(target)
        seconds = np.full(len(self), 1 / self.fps)
        kind.check(target.name, (self.size,), seconds)
        processes = usable_cores() if jobs is None else as_count(jobs, "jobs")
        kept = KeptFrames.beside(target, frame_names(self._camera, self.shots))
        missing = kept.missing()
        with counting("drawing", len(missing), shown=progress) as count:
            for _ in draw_all(self._camera, [(n, self.shots[n], kept.path(n)) for n in missing], processes):
                count()
        whole = kept.folder / target.name
        with counting("writing", len(self), shown=progress) as count:
            kind.write(_Counted(kept, count), whole, seconds)
        os.replace(whole, target)
        kept.remove()
        return target


@dataclass(frozen=True)
class _Camera(Generic[Shot]):
    """What draws a frame, in whichever process."""

    draw: Callable[[Shot], Page]
    size: int
    text: bool
    platform: str | None

    def picture(self, shot: Shot) -> Pixels:
        from stereodel.render.raster import render

        return render(self.draw(shot), size=self.size, text=self.text, platform=self.platform)

    def __call__(self, shot: Shot, path: Path) -> None:
        store_frame(self.picture(shot), path)


class _Counted:
    """A reel that counts its frames as they are asked for in order."""

    def __init__(self, reel: Reel, count: Callable[[], Any]) -> None:
        self._reel, self._count, self._next = reel, count, 0

    def __len__(self) -> int:
        return len(self._reel)

    def __getitem__(self, number: int) -> Pixels:
        if number == self._next:
            self._next += 1
            self._count()
        return self._reel[number]
