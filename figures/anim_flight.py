"""
Animation: Paris, New York, Tokyo
=================================

A flight over a globe that bends: each city in turn is magnified eight times, and on the way the lens lets go just as
far as the distance asks for. Every frame is conformal and shows the whole Earth but for its far side. The way is the
shortest in hyperbolic space, where a fisheye of magnification S lies at the distance ln S from the globe as it is.
"""

from functools import partial

from stereodel.drawing import LineStyle, Page
from stereodel.drawing.style import BLACK
from stereodel.film import Film, Flight, Stop
from stereodel.film.shots import Shot
from stereodel.globe import Globe

CITIES = {"Paris": (2.35, 48.86), "New York": (-74.01, 40.71), "Tokyo": (139.69, 35.69)}
MAGNIFICATION = 8.0
SECONDS = 0.12  # of a frame
SIZE = 440  # pixels
WIDTH = 165.0  # points: 192 dots per inch
COAST = LineStyle((0.33, 0.4, 0.47, 1.0), 0.35)


def trip() -> Flight:
    """From city to city, and over the globe as it is back to the first."""
    paris, new_york, tokyo = CITIES.values()
    near = [Stop(place, MAGNIFICATION, hold=0.6) for place in (paris, new_york, tokyo)]
    home = [Stop(tokyo, hold=0.0), Stop(paris, hold=0.3), Stop(paris, MAGNIFICATION, hold=0.0)]
    return Flight([*near, *home], pace=0.5)


def earth() -> Globe:
    """Land, a graticule and the cities."""
    globe = Globe()
    globe.add_land(outline=COAST)
    globe.add_graticule(15)
    globe.add_points(list(CITIES.values()))
    globe.add_labels(list(CITIES.values()), list(CITIES), size=7.0, color=BLACK)
    return globe


def frame(shot: Shot, globe: Globe) -> Page:
    """The globe as it is seen at one moment."""
    return globe.page(*shot, width=WIDTH)


def film() -> Film:
    """A shot for each moment."""
    flight = trip()
    shots = [flight(SECONDS * k) for k in range(round(flight.seconds / SECONDS))]
    return Film(partial(frame, globe=earth()), shots, seconds=SECONDS, size=SIZE)


if __name__ == "__main__":
    film().main()
