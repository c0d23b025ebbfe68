"""Films: sequences of pages, drawn in parallel and written as one file."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from pathlib import Path
from typing import Any, Final, Generic, TypeVar, cast

import numpy as np

from stereodel._arrays import FloatArray, Pixels, as_count, as_frame, as_scalar
from stereodel._extras import of_extra
from stereodel._notebook import Displayed, playing
from stereodel._tasks.crew import Crew, main_script_here
from stereodel._tasks.progress import Progress, reporting
from stereodel._tasks.whole_files import replacing
from stereodel.constants import MOST_FRAME_PIXELS, MOST_FRAMES
from stereodel.drawing.page import Page
from stereodel.drawing.page.colors import ColorLike, as_color
from stereodel.drawing.page.fonts import MissingCharactersWarning, missing_characters, warn_of_missing
from stereodel.drawing.page.page import LARGEST_SIZE
from stereodel.drawing.page.sheets import Style, StyledDraw
from stereodel.drawing.page.style import WHITE
from stereodel.film.frames import KeptFrames, frame_names, store_frame
from stereodel.film.shots import GlobePages, Motion, Samples, Shot
from stereodel.film.writers import Reel, format_of, frame_seconds
from stereodel.globe.globe import Globe
from stereodel.render.figure import run_script, source_of

T = TypeVar("T")

FPS: Final = 25.0
"""Default number of frames per second."""

LIFETIME: Final = 32
"""Frames that a process draws before it is replaced, so that memory held by graphics libraries does not accumulate."""


def as_frame_size(width: int, height: int) -> None:
    """Raise ValueError for frames with too many pixels."""
    if width * height > MOST_FRAME_PIXELS:
        raise ValueError(f"size makes frames of {width} × {height} pixels; give at most {MOST_FRAME_PIXELS} of them")


class FrameError(RuntimeError):
    """A frame could not be drawn; the message gives its number, and the cause is the error itself."""


@dataclass(frozen=True)
class Film(Generic[T], Displayed):
    """A film: drawn in parallel, resumed after interruptions, written in several formats.

    Parameters
    ----------
    draw : callable
        Function of a shot that returns a `Page`, or pixels (h, w, 3) uint8, all of the same extent or size. Frames are
        drawn in other processes, so it must be picklable: a module-level function, an instance of a module-level class,
        or a `functools.partial` of one.
    shots : sequence
        Argument of `draw` for each frame, also picklable. Equal shots are drawn once; repeat a shot to hold it.
    fps : float, optional
        Frames per second; by default 25.
    seconds : float or sequence of float, optional
        Duration of all frames, or of each, in seconds; instead of `fps`.
    size : int
        Width in pixels; the height follows from the pages. Frames that are already pixels keep their size.
    text : bool
        Whether to draw labels.

    Raises
    ------
    ValueError
        If there are no shots or more than `MOST_FRAMES`, both `fps` and `seconds` are given, a duration is not
        positive, their number differs from that of the shots, or `size` is outside 1 to 65535.

    Examples
    --------
    >>> import numpy as np
    >>> from stereodel.drawing.page import Dots
    >>> def ball(x):
    ...     return Page((0.0, 4.0, 0.0, 2.0), (Dots(np.array([[x, 1.0]]), 40.0, (0.8, 0.1, 0.1, 1.0)),))
    >>> film = Film(ball, [1.0, 2.0, 3.0], fps=10, size=80)
    >>> round(film.duration, 9), film.picture(1).shape
    (0.3, (40, 80, 3))
    """

    draw: Callable[[T], Page | Pixels]
    shots: Sequence[T]
    _: KW_ONLY
    fps: float | None = None
    seconds: float | Sequence[float] | None = None
    size: int = 1280
    text: bool = True
    _mimes = playing

    def __post_init__(self) -> None:
        if len(self.shots) == 0:
            raise ValueError("shots is empty; give what at least one frame shows")
        if len(self.shots) > MOST_FRAMES:
            raise ValueError(f"shots has {len(self.shots)} entries, and at most {MOST_FRAMES} frames are drawn")
        if self.fps is not None and self.seconds is not None:
            raise ValueError("fps and seconds both say how long a frame is shown; give one of them")
        as_count(self.size, "size", high=LARGEST_SIZE)
        _ = self.times  # checks them

    @classmethod
    def of_globe(
        cls,
        globe: Globe,
        motion: Motion,
        *,
        size: tuple[int, int] = (1280, 720),
        fps: float = FPS,
        background: ColorLike = WHITE,
        legend: bool = False,
    ) -> Film[Shot]:
        """A film of a globe along a motion; ``Film.of_globe(...).save("flight.mp4")`` draws it.

        Parameters
        ----------
        globe : Globe
        motion : Flight, Spin, Morph, or any object with `seconds` that maps a time to (lens, view)
        size : (int, int)
            Width and height in pixels, with a product of at most `MOST_FRAME_PIXELS`; the globe is centred and as large
            as they allow. Line widths and type have a fixed size in pixels on globes 720 pixels across or larger; on
            smaller globes they scale with the square root of the size.
        fps : float
            Frames per second.
        background : color
            Colour behind the globe.
        legend : bool
            Whether to draw `Globe.legend` below the globe in each frame.

        Returns
        -------
        Film
            Film whose frame k shows the motion at time k / fps; the last frame is at or before the end.

        Raises
        ------
        ValueError
            If `size` is not positive or too large, or the motion and `fps` give no frames or more than `MOST_FRAMES`.

        Examples
        --------
        >>> from stereodel.film import Flight, Stop
        >>> globe = Globe()
        >>> globe.add_coastlines(resolution="110m")
        >>> trip = Flight([Stop((2.35, 48.86)), Stop((2.35, 48.86), 8.0)])
        >>> film = Film.of_globe(globe, trip, size=(320, 180), fps=10)
        >>> len(film), film.picture(0).shape
        (41, (180, 320, 3))
        """
        width, height = (as_count(side, "size", high=LARGEST_SIZE) for side in size)
        as_frame_size(width, height)
        rate = as_scalar(fps, "fps", low=0.0, open_low=True)
        pages = GlobePages(globe, width, height, as_color(background, "background"), legend, motion)
        return Film(pages, Samples(motion, rate, pages), fps=rate, size=width)

    @classmethod
    def of_pictures(
        cls, pictures: Reel, *, fps: float | None = None, seconds: float | Sequence[float] | None = None
    ) -> Film[Pixels]:
        """A film of existing pictures.

        Parameters
        ----------
        pictures : sequence of (h, w, 3) uint8 arrays
            sRGB, rows from the top, all of one size. Any object with a length and indexing will do: pictures are read
            in order (for a GIF, some of them twice), and none is kept.
        fps, seconds
            As for `Film`.

        Examples
        --------
        >>> import tempfile
        >>> grays = [np.full((4, 6, 3), level, dtype=np.uint8) for level in (0, 128, 255)]
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     file = Film.of_pictures(grays, seconds=0.5).save(Path(folder, "grays.gif"), progress=False)
        ...     print(file.name, file.read_bytes()[:6])
        grays.gif b'GIF89a'
        """
        width = as_frame(pictures[0], "pictures[0]").shape[1] if len(pictures) else 1
        return Film(_as_it_is, cast(Sequence[Pixels], pictures), fps=fps, seconds=seconds, size=width)

    def __len__(self) -> int:
        """The number of frames."""
        return len(self.shots)

    @property
    def times(self) -> FloatArray:
        """Duration of each frame in seconds, (n,)."""
        if self.seconds is not None:
            return frame_seconds(self.seconds, len(self))
        rate = FPS if self.fps is None else as_scalar(self.fps, "fps", low=0.0, open_low=True)
        return np.full(len(self), 1 / rate)

    @property
    def duration(self) -> float:
        """Total duration in seconds."""
        return float(self.times.sum())

    def styled(self, *styles: Style) -> Film[T]:
        """The same film in other styles, see `stereodel.drawing.styled`; `draw` must return pages."""
        return replace(self, draw=StyledDraw(self.draw, styles))

    def page(self, number: int) -> Page:
        """One frame as a page; TypeError if `draw` returns pixels."""
        drawn = self.draw(self.shots[number])
        if not isinstance(drawn, Page):
            raise TypeError(f"draw gives {type(drawn).__name__}, not a Page; picture({number}) is the frame as pixels")
        return drawn

    def picture(self, number: int) -> Pixels:
        """One frame as pixels, (h, w, 3), drawn now."""
        return self._camera.picture(self.shots[number])

    @property
    def _camera(self) -> _Camera[T]:
        return _Camera(self.draw, self.size, self.text)

    def save(self, path: str | os.PathLike[str], *, jobs: int | None = None, progress: bool = True) -> Path:
        """Draw the frames and write the file, whose path is returned.

        Finished frames are kept in the folder PATH.frames next to the file until the file is complete. After an
        interruption the same call resumes and produces the same file. Frames are redrawn if the film, the library or
        `draw` has changed; for functions outside the library, only changes of their own module are noticed.

        Parameters
        ----------
        path : path-like
            File to write; the extension gives the format: .gif, .png or .apng, .webp, .mp4. An existing file is
            replaced at the end.
        jobs : int, optional
            Number of drawing processes; by default one for each core. Does not affect the file.
        progress : bool
            Whether to report progress on standard error: a bar on a terminal, lines elsewhere.

        Raises
        ------
        stereodel.film.FrameError
            If a frame cannot be drawn; the message gives its number.
        ValueError, TypeError, ImportError
            Before anything is drawn: if the extension is unknown, the format cannot hold the frames, `draw` or a shot
            cannot be pickled, or the encoding library is missing (the extra ``film``).
        OSError
            If the file or the folder cannot be written.

        Notes
        -----
        A GIF has 255 colours, chosen from moments spread over the whole film. It stores durations in hundredths of a
        second, the other formats in thousandths; they are rounded such that the start of every frame is as accurate as
        possible. An APNG is lossless; WebP and MP4 are not. An MP4 has an even number of rows and columns: the last one
        is repeated if a picture's number is odd.
        """
        target, times = Path(path), self.times
        kind = format_of(target)
        if self.draw is _as_it_is:  # existing pictures are neither drawn nor stored
            kind.check(target.name, self.picture(0).shape[:2], times)
            with replacing(target) as temporary, reporting(shown=progress, lines=True) as told:
                kind.write(_Counted(cast(Reel, self.shots), told), temporary, times)
            return target
        sides = (self.draw.width, self.draw.height) if isinstance(self.draw, GlobePages) else (self.size,)
        kind.check(target.name, sides, times)
        crew = Crew(None if jobs is None else as_count(jobs, "jobs"), lifetime=LIFETIME)
        kept = KeptFrames.beside(target, frame_names(self._camera, self.shots))
        missing, unwritten = kept.missing(), set[str]()
        with crew, reporting(shown=progress, lines=True) as told:
            drawn = crew.each(self._camera, _Tasks(self.shots, kept, missing))
            for done, (number, outcome) in enumerate(drawn, 1):
                if outcome.error is not None:
                    message = f"frame {missing[number]}: {outcome.message}; what was finished is kept"
                    raise FrameError(message) from outcome.error
                unwritten |= outcome.value()
                told("drawing", done, len(missing))
        warn_of_missing(unwritten)
        whole = kept.folder / target.name
        with reporting(shown=progress, lines=True) as told:
            kind.write(_Counted(kept, told), whole, times)
        os.replace(whole, target)
        kept.remove()
        return target

    def main(self, argv: Sequence[str] | None = None) -> None:
        """Run as a script: write a GIF named after the script and report its path; errors become messages.

        The script is the file that defines `draw`. Its options are the output folder, by default ``out`` next to the
        script's folder, the width, and whether to draw labels.
        """
        run_script(self, argv, source_of(self.draw).stem, f"{self.size}")

    def _files(self, folder: Path, *, size: int | None, text: bool) -> list[str]:
        """See `stereodel.render.figure.run_script`."""
        folder.mkdir(parents=True, exist_ok=True)
        film = replace(self, size=self.size if size is None else size, text=text)
        jobs = None if main_script_here() else 1  # the documentation runs scripts as text
        return [film.save(folder / f"{source_of(self.draw).stem}.gif", jobs=jobs, progress=False).name]


@dataclass(frozen=True)
class _Camera(Generic[T]):
    """Draws frames, in any process."""

    draw: Callable[[T], Page | Pixels]
    size: int
    text: bool

    @of_extra("render")
    def picture(self, shot: T) -> Pixels:
        return self._pixels(self.draw(shot))

    def __call__(self, task: tuple[T, Path]) -> frozenset[str]:
        """Store the frame of a shot; returns its characters that no font has, which a film reports once."""
        shot, path = task
        drawn = self.draw(shot)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", MissingCharactersWarning)
            store_frame(self._pixels(drawn), path)
        return missing_characters(drawn.labels) if isinstance(drawn, Page) and self.text else frozenset()

    def _pixels(self, drawn: Page | Pixels) -> Pixels:
        if not isinstance(drawn, Page):
            return as_frame(drawn, "a picture")
        as_frame_size(self.size, drawn.pixels_up(self.size))
        return drawn.pixels(size=self.size, text=self.text)


@dataclass(frozen=True, eq=False)
class _Tasks(Sequence[Any]):
    """Shots with the paths of their frames, created on access, as shots may be."""

    shots: Sequence[Any]
    kept: KeptFrames
    numbers: Sequence[int]

    def __len__(self) -> int:
        return len(self.numbers)

    def __getitem__(self, task: Any) -> Any:
        number = self.numbers[task]
        return self.shots[number], self.kept.path(number)


@dataclass
class _Counted:
    """A reel that counts its frames as they are read in order."""

    reel: Reel
    told: Progress
    read: int = 0

    def __len__(self) -> int:
        return len(self.reel)

    def __getitem__(self, number: int) -> Pixels:
        if number == self.read:
            self.read += 1
            self.told("writing", self.read, len(self))
        return self.reel[number]


def _as_it_is(picture: Pixels) -> Pixels:
    return picture
