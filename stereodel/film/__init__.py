"""Moving pictures: pages drawn in several processes and written as one file; ways to move over a globe."""

from stereodel.film.film import Film, FrameError
from stereodel.film.shots import Flight, Morph, Spin, Stop

__all__ = ["Film", "Flight", "FrameError", "Morph", "Spin", "Stop"]
