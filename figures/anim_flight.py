"""
Animation: Paris, New York, Tokyo
=================================

A flight over a globe under a changing fisheye: each city in turn is magnified eight times, and in between the
magnification decreases only as far as the distance requires. Every frame is conformal and shows the whole Earth except
its far side. The path is the shortest in hyperbolic space, where a fisheye of magnification S is at distance ln S from
the undistorted globe.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from _film import WIDTH, add_gauge, timed, whole

from stereodel.curves.chart import Chart
from stereodel.drawing import LineStyle, Page, Sketch
from stereodel.drawing.page import Item, Label
from stereodel.drawing.page.style import HALO, with_opacity
from stereodel.film import Film, Flight, Stop
from stereodel.film.shots import Shot, eased
from stereodel.globe import Globe
from stereodel.sphere import lonlat_to_xyz

CITIES = {"Paris": (2.35, 48.86), "New York": (-74.01, 40.71), "Tokyo": (139.69, 35.69)}
MAGNIFICATION = 8.0
STEP, HOLD = 0.1, 2.0  # seconds of a frame on the way, and of a stay
PACE = 0.5  # seconds for magnifying e times
HEIGHT, RADIUS = 206.0, 86.0  # points
SIZE = 440  # pixels: coasts and seas make large files
TOLERANCE = 0.07  # points
COAST = LineStyle((0.33, 0.4, 0.47, 1.0), 0.35)
APPEARS, WHOLE = 0.5, 0.9  # how far toward the viewer a city is whose name begins to appear, and is quite there, radii


@dataclass(frozen=True)
class FadingNames:
    """Names of places, a layer of the globe: the fainter, the nearer they are to the limb."""

    names: tuple[str, ...]
    places: tuple[tuple[float, float], ...]

    def lay(self, chart: Chart) -> Iterator[Item]:
        """A label below each place, centred."""
        xyz = lonlat_to_xyz(self.places)
        at, _ = chart.points(xyz)
        toward = chart.lens(xyz) @ chart.view.matrix[2]
        for name, (x, y), depth in zip(self.names, at.tolist(), toward.tolist(), strict=True):
            strength = eased(float(np.clip((depth - APPEARS) / (WHOLE - APPEARS), 0.0, 1.0)))
            if strength:
                label = Label(name, (x, y), (0.0, -4.0), valign="top", size=8.0, halo=HALO)
                yield replace(
                    label,
                    color=with_opacity(label.color, strength),
                    halo_color=with_opacity(label.halo_color, strength),
                )


def legs() -> list[Flight]:
    """From city to city, and over the globe as it is back to the first."""
    paris, new_york, tokyo = CITIES.values()
    ways = [[(paris, 8), (new_york, 8)], [(new_york, 8), (tokyo, 8)], [(tokyo, 8), (tokyo, 1), (paris, 1), (paris, 8)]]
    return [Flight([Stop(place, size, hold=0.0) for place, size in way], pace=PACE) for way in ways]


def moments() -> Iterator[tuple[Shot, float]]:
    """What is seen, and for how long: stays at the cities, and frames on the way."""
    for leg in legs():
        yield leg(0.0), HOLD
        for frame_number in range(1, round(leg.seconds / STEP)):
            yield leg(STEP * frame_number), STEP


def earth() -> Globe:
    """Land, a graticule and the cities."""
    globe = Globe()
    globe.add_land(outline=COAST, resolution="50m")
    globe.add_graticule(15)
    globe.add_points(list(CITIES.values()))
    globe.add(FadingNames(tuple(CITIES), tuple(CITIES.values())))
    return globe


def frame(shot: Shot, globe: Globe) -> Page:
    """The globe as it is seen at one moment, and a scale of magnifications."""
    lens, view = shot
    chart = Chart(lens, view, (WIDTH / 2, HEIGHT - RADIUS - 4), RADIUS, TOLERANCE)
    sketch = Sketch().add_items(globe.items(chart))
    ticks = {float(np.log(size) / np.log(MAGNIFICATION)): [f"{size}"] for size in (1, 2, 4, 8)}
    place = float(np.log(lens.magnification) / np.log(MAGNIFICATION))
    add_gauge(sketch, place, ticks, 15.0, left=26.0, title=["$S$"])
    return whole(sketch, HEIGHT)


def film() -> Film:
    """A shot for each moment."""
    shots, seconds = timed(moments())
    return Film(partial(frame, globe=earth()), shots, seconds=seconds, size=SIZE)


if __name__ == "__main__":
    film().main()
