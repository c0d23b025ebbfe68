"""Films of globes: what a motion shows, sampled, as pages of one size."""

from __future__ import annotations

from dataclasses import dataclass, replace

from stereodel._arrays import as_count, as_scalar
from stereodel.drawing.colors import Color
from stereodel.drawing.page import Page
from stereodel.drawing.style import WHITE
from stereodel.film.film import Film
from stereodel.globe.flights import Motion, Shot
from stereodel.globe.globe import Globe

POINTS_PER_PIXEL = 0.375
"""Of a page of a film: lines keep their width in pixels whatever the size, 1 pt being 2⅔ of them."""

FINE = 0.2
"""How far what is drawn may be from what it stands for, pixels."""


def film(
    globe: Globe,
    motion: Motion,
    *,
    size: tuple[int, int] = (1280, 720),
    fps: float = 25.0,
    text: bool = True,
    background: Color = WHITE,
) -> Film[Shot]:
    """A film of a globe along a motion; ``film(...).save("flight.mp4")`` draws it.

    Parameters
    ----------
    globe : Globe
    motion : Flight, Spin, Morph, or any object with `seconds` that maps a time to (lens, view)
    size : (int, int)
        Width and height in pixels; the globe is as large as they allow, in the middle.
    fps : float
        Frames a second.
    text : bool
        Whether labels are drawn.
    background : Color
        Behind the globe.

    Returns
    -------
    Film
        Frame k shows the motion at the time k / fps, the last one before or at its end.

    Raises
    ------
    ValueError
        For a size that is not positive, or a motion or `fps` that gives no frame.

    Examples
    --------
    >>> from stereodel.globe import Flight, Stop
    >>> globe = Globe()
    >>> globe.add_coastlines(resolution="110m")
    >>> trip = Flight([Stop((2.35, 48.86)), Stop((2.35, 48.86), 8.0)])
    >>> clip = film(globe, trip, size=(320, 180), fps=10)
    >>> len(clip), clip.picture(0).shape
    (41, (180, 320, 3))
    """
    width, height = (as_count(side, "size") for side in size)
    rate = as_scalar(fps, "fps", low=0.0, open_low=True)
    count = round(motion.seconds * rate)
    if count < 1:
        raise ValueError(
            f"a motion of {motion.seconds:g} s has no frame at {rate:g} frames a second; give a larger fps"
        )
    shots = [motion(number / rate) for number in range(count)]
    return Film(_Pages(globe, width, height, background), shots, fps=rate, size=width, text=text)


@dataclass(frozen=True, eq=False)
class _Pages:
    """Draws a globe in the middle of a page of any shape."""

    globe: Globe
    width: int
    height: int
    background: Color

    def __call__(self, shot: Shot) -> Page:
        square = min(self.width, self.height)
        page = self.globe.page(*shot, width=square * POINTS_PER_PIXEL, tolerance=FINE * POINTS_PER_PIXEL)
        left, right, bottom, top = page.extent
        x, y, half = (left + right) / 2, (bottom + top) / 2, (right - left) / 2 / square
        extent = (x - half * self.width, x + half * self.width, y - half * self.height, y + half * self.height)
        return replace(page, extent=extent, width=self.width * POINTS_PER_PIXEL, background=self.background)
