"""Films: many pages, drawn in several processes and written as one file."""

from stereodel.film.animation import Animation
from stereodel.film.film import Film
from stereodel.film.formats import save_pictures
from stereodel.film.workers import FrameError

__all__ = ["Animation", "Film", "FrameError", "save_pictures"]
