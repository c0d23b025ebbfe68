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
from stereodel.globe.layers import Areas, Ground, Image, Names, OfEarth, Standing, disc_of, radii

LEAST: Final = 8
"""Least number of frames for which a name stands on a side, or is away; less where the film begins or ends."""

FADING: Final = 4
"""Frames in which a name appears, and in which it vanishes."""

AWAY: Final = 30.0
"""Price of a frame without a name: more than the dots and lines that it may hide."""

COMING, CHANGING = 110.0, 450.0
"""Prices of appearing or vanishing, and of another side: a little less than of vanishing and appearing again."""

IMPOSSIBLE: Final = 1e6
"""Price of a frame in a position that cannot be."""

COARSE: Final = 0.5
"""Tolerance in points for lines that names avoid."""

Placed = tuple[tuple[Standing, ...], ...]
"""The names of a frame, by the layers that have names."""


def placed(globe: Globe, shots: Iterable[tuple[MoebiusMap, MapView]], count: int, unit: float) -> list[Placed]:
    """Where the names of a globe stand in each of the frames, `unit` points being its radius; [] if it has none."""
    layers = [replace(layer, leader=None) for layer in globe.layers if isinstance(layer, Names)]
    dots = radii(globe.layers)
    seats = [[layer.seats(row, dots) for row in range(len(layer.xyz))] for layer in layers]
    if not any(seats):
        return []
    # All names of a layer at once: they differ in their boxes alone.
    whole = [replace(some[0], boxes=np.stack([each.boxes for each in some])) if some else None for some in seats]
    at = [np.zeros((count, len(some), 2)) for some in seats]
    prices = [np.full((count, *each.boxes.shape[:2]), np.inf) if each else np.zeros(0) for each in whole]
    for frame, (lens, view) in enumerate(shots):
        chart = Chart(lens, view, (0.0, 0.0), 1.0, COARSE / unit, unit)
        bare = [layer for layer in globe.layers if not isinstance(layer, Names | Ground | Areas | Image)]
        bare = [layer for layer in bare if not isinstance(layer, OfEarth) or isinstance(layer.look, LineStyle)]
        placer = Placer(disc_of(chart), [item for layer in bare for item in layer.lay(chart)])
        for layer, each, places, price in zip(layers, whole, at, prices, strict=True):
            if each:
                points, seen = chart.points(layer.xyz)
                places[frame] = unit * points
                found = each.prices(places[frame], placer.disc, placer.ink if each.movable else None)
                blocked = ~seen[:, None] | meets(each.claimed(places[frame]), placer.boxes)
                price[frame] = np.where(blocked, np.inf, found)
    frames: list[list[list[Standing]]] = [[[] for _ in layers] for _ in range(count)]
    kept = np.zeros((count, 1, 0, 2, 2))
    for number, (some, places, price) in enumerate(zip(seats, at, prices, strict=True)):
        for row, each in enumerate(some):
            room = np.where(meets(each.claimed(places[:, row]), kept), np.inf, price[:, row])
            if not np.isfinite(room).any():
                continue
            sides = course(room)
            for frame in np.flatnonzero(sides >= 0).tolist():
                frames[frame][number].append((row, int(sides[frame]), strength(sides, frame)))
            boxes = each.boxes[sides] + places[:, row, None]
            boxes[sides < 0] = np.nan
            kept = np.concatenate([kept, boxes[:, None, None]], axis=2)
    return [tuple(map(tuple, frame)) for frame in frames]


def course(price: FloatArray) -> Indices:
    """The cheapest side (f,) in each frame by prices (f, n) of sides, −1 where the name is away.

    It stays on a side, or away, for `LEAST` frames or more, but where the film begins or ends.
    """
    count, sides = price.shape
    per_frame = np.full((count, sides + 1), AWAY)  # away is the last state
    per_frame[:, :-1] = np.where(np.isfinite(price), price, IMPOSSIBLE)
    change = np.full((sides + 1,) * 2, CHANGING)
    change[-1], change[:, -1] = COMING, COMING
    total = np.concatenate([np.zeros((1, sides + 1)), per_frame.cumsum(axis=0)])
    cost = total[1:].copy()  # of all frames up to each, in a state that has lasted long enough
    link = np.zeros((*cost.shape, 2), dtype=np.intp)  # its first frame, and the state before
    for frame in range(1, count):
        cost[frame], link[frame] = cost[frame - 1] + per_frame[frame], link[frame - 1]
        latest = frame if frame == count - 1 else frame - LEAST + 1
        for first in range(max(frame - LEAST + 1, 1), latest + 1):
            ways = cost[first - 1, :, None] + change
            found = ways.min(axis=0) + total[frame + 1] - total[first]
            better = found < cost[frame]
            cost[frame][better] = found[better]
            link[frame][better] = np.stack([np.full(sides + 1, first), ways.argmin(axis=0)], axis=1)[better]
    way = np.zeros(count, dtype=np.intp)
    end, state = count, int(cost[-1].argmin())
    while end:
        first, before = link[end - 1, state].tolist()
        way[first:end] = state if state < sides else -1
        end, state = first, before
    return way


def strength(sides: Indices, frame: int) -> float:
    """How strong a name is in a frame: it fades in and out where its side, if any, is another."""
    padded = np.pad(sides, FADING, mode="edge")[frame : frame + 2 * FADING + 1]
    away = np.abs(np.arange(-FADING, FADING + 1))[padded != sides[frame]]
    return int(away.min(initial=FADING)) / FADING


def standing(globe: Globe, names: Placed) -> Globe:
    """The globe with names where they were placed."""
    shown, found = copy(globe), iter(names)
    shown.layers = [
        replace(layer, standing=next(found)) if isinstance(layer, Names) else layer for layer in globe.layers
    ]
    return shown
