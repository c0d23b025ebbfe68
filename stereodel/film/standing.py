"""Names in films: where each stands in every frame, decided for the whole film before any frame is drawn.

Name by name, in order of priority, the cheapest course is found by dynamic programming over the frames, as by Viterbi:
beside the prices of positions, a frame without the name has one, and so have coming, going and changing sides. So a
name keeps its side while it fits, and names that come later make way for it in all frames.
"""

from __future__ import annotations

from collections.abc import Iterable
from copy import copy
from dataclasses import replace
from typing import Final

import numpy as np

from stereodel._arrays import FloatArray, Indices
from stereodel.conformal import MoebiusMap
from stereodel.curves.chart import Chart
from stereodel.curves.view import MapView
from stereodel.drawing.page.placing import Placer, meets
from stereodel.drawing.page.style import LineStyle
from stereodel.globe.globe import Globe
from stereodel.globe.layers import Areas, Ground, Image, Names, OfEarth, Standing, radii

LEAST: Final = 8
"""Least number of frames for which a name stands on a side, or is away; less where the film begins or ends."""

FADING: Final = 4
"""Frames in which a name appears, and in which it vanishes."""

AWAY: Final = 30.0
"""Price of a frame without a name: more than the dots and lines that it may hide."""

COMING, CHANGING = 110.0, 450.0
"""Prices of appearing or vanishing, and of another side: a little less than of vanishing and appearing again."""

COARSE: Final = 0.5
"""Tolerance in points for lines that names avoid."""

Placed = tuple[tuple[Standing, ...], ...]
"""The names of a frame, by the layers that have names."""


def placed(globe: Globe, shots: Iterable[tuple[MoebiusMap, MapView]], count: int, unit: float) -> list[Placed]:
    """Where the names of a globe stand in each of the frames, `unit` points being its radius; [] if it has none."""
    layers = [replace(layer, leader=None) for layer in globe.layers if isinstance(layer, Names)]
    others = [layer for layer in globe.layers if not isinstance(layer, Names | Ground | Areas | Image)]
    others = [each for each in others if not isinstance(each, OfEarth) or isinstance(each.look, LineStyle)]
    dots = radii(globe.layers)
    names = [(number, row) for number, layer in enumerate(layers) for row in range(len(layer.xyz))]
    if not names:
        return []
    seats = [layers[number].seats(row, dots) for number, row in names]
    at = np.zeros((count, len(names), 2))
    prices = [np.full((count, len(each.boxes)), np.inf) for each in seats]
    for frame, (lens, view) in enumerate(shots):
        chart = Chart(lens, view, (0.0, 0.0), 1.0, COARSE / unit, unit)
        placer = Placer(chart, [item for layer in others for item in layer.lay(chart)])
        places, seen = chart.points(np.concatenate([layer.xyz for layer in layers]))
        at[frame] = unit * places
        for name in np.flatnonzero(seen).tolist():
            found = placer.prices(seats[name], at[frame, name])
            prices[name][frame] = np.where(placer.taken(seats[name], at[frame, name]), np.inf, found)
    frames: list[list[list[Standing]]] = [[[] for _ in layers] for _ in range(count)]
    kept = np.zeros((count, 1, 0, 2, 2))
    for name, (number, row) in enumerate(names):
        each, places = seats[name], at[:, name, None, None]
        sides = course(np.where(meets(each.rooms + places, kept), np.inf, prices[name]))
        strength = strengths(sides)
        for frame in np.flatnonzero(sides >= 0).tolist():
            frames[frame][number].append((row, int(sides[frame]), float(strength[frame])))
        boxes = np.where(sides[:, None, None] < 0, np.nan, each.boxes[sides] + places[:, 0])
        kept = np.concatenate([kept, boxes[:, None, None]], axis=2)
    return [tuple(map(tuple, frame)) for frame in frames]


def course(price: FloatArray) -> Indices:
    """The cheapest side (f,) in each frame by prices (f, n) of sides, −1 where the name is away.

    It stays on a side, or away, for `LEAST` frames or more, but where the film begins or ends.
    """
    count, sides = price.shape
    # States are sides, the last of which is away, with the number of frames since the change, at most `LEAST`.
    side, age = np.divmod(np.arange((sides + 1) * LEAST), LEAST)
    own = np.column_stack([price, np.full(count, AWAY)])[:, side]
    before, since, away = side[:, None], age[:, None], side == sides
    change = np.where(away | away[:, None], COMING, CHANGING)
    change[(before == side) | (since < LEAST - 1) | (age > 0)] = np.inf
    change[(before == side) & (age == np.minimum(since + 1, LEAST - 1))] = 0.0
    total = np.where(age == LEAST - 1, own[0], np.inf)
    links = []
    for frame in range(1, count):
        ways = total[:, None] + change
        links.append(ways.argmin(axis=0))
        total = ways.min(axis=0) + own[frame]
    states = [int(total.argmin())]
    for link in reversed(links):
        states.append(int(link[states[-1]]))
    found = side[states[::-1]]
    return np.where(found < sides, found, -1)


def strengths(sides: Indices) -> FloatArray:
    """How strong a name is in each frame: it fades in and out where its side, if any, is another."""
    changes = np.flatnonzero(np.diff(sides)) + 0.5
    away = np.abs(np.arange(len(sides))[:, None] - changes).min(axis=1, initial=np.inf)
    return np.minimum((away + 0.5) / FADING, 1.0)


def standing(globe: Globe, names: Placed) -> Globe:
    """The globe with names where they were placed."""
    shown, found = copy(globe), iter(names)
    shown.layers = [replace(each, standing=next(found)) if isinstance(each, Names) else each for each in globe.layers]
    return shown
