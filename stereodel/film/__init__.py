"""Films: pages drawn in parallel and written as one file; motions over a globe."""

from stereodel.film.film import Film, FrameError
from stereodel.film.shots import Flight, Morph, Spin, Stop

__all__ = ["Film", "Flight", "FrameError", "Morph", "Spin", "Stop"]
