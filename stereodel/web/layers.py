"""Shapes of the data on the globe of a notebook: regions, lines and points of a file or frame, by colour.

`script/notebook_globe.ts` reads them.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from stereodel._arrays import FloatArray, Indices
from stereodel.curves.insides import on_the_left
from stereodel.curves.ragged import Ragged
from stereodel.curves.seams import stitched
from stereodel.curves.trace import sides_of, unwrapped
from stereodel.drawing.page.colors import ColorLike, as_color, as_colors
from stereodel.drawing.page.style import MAP_DOT
from stereodel.drawing.scene.by_value import DotLooks, ScaleLike
from stereodel.drawing.scene.legend import LegendEntry
from stereodel.io.reading import Shapes, shapes_of
from stereodel.sphere.coordinates import lonlat_to_xyz
from stereodel.web.looks import css

STEP: Final = 1.0
"""Degrees between points along a side, which is straight in longitude and latitude."""

SPOTS: Final = 200
"""Places all over the sphere, of which one that is far from the rings of a region says whether it is in it."""


def layers_of(
    source: Any, color: ColorLike, column: str | None, scale: ScaleLike | None, title: str
) -> tuple[list[dict[str, Any]], dict[str, LegendEntry]]:
    """Shapes of a source by colour, polygons below lines below points, and their entries in a legend."""
    shapes = shapes_of(source)
    count, entry = len(shapes.properties), title or column or ""
    values: Any = None if column is None else shapes.words(column) or shapes.column(column)
    looks = DotLooks.of(count, MAP_DOT, values=values, scale=scale, legend=entry)
    colors = as_colors(color, count, "color") if looks.colors is None else looks.colors
    entries = looks.entries if column is not None else {title: as_color(color)} if title else {}
    inks = [css(ink) for ink in colors]
    layers = [{"kind": "region", "ink": inks[feature], **region} for feature, region in _regions(shapes).items()]
    lines = _fine(unwrapped(shapes.lines, turns=False))
    for kind, rows, feature in (("line", lines, shapes.line_feature), ("point", None, shapes.point_feature)):
        for ink in dict.fromkeys(inks[k] for k in feature):
            chosen = np.array([inks[k] == ink for k in feature])
            some = Ragged(shapes.points[chosen], np.arange(0)) if rows is None else rows.take(chosen)
            layers.append({"kind": kind, "ink": ink, **_sent(some)})
    return layers, dict(entries)


def _regions(shapes: Shapes) -> dict[int, dict[str, Any]]:
    """Polygons by feature: rings with the region on their left, and a place with whether it is in the region."""
    count, owner = len(shapes.properties), shapes.polygon_feature[shapes.ring_polygon]
    if len(shapes.rings) == 0:
        return {}
    closed = unwrapped(shapes.rings)
    spots = _spots()
    rings, (spot, region) = on_the_left(closed, owner, count, spots, straight=True)
    start, end, sides, owner = stitched(rings, owner)
    around = Ragged(np.stack([start, end], axis=1)[sides.values], sides.offsets)
    total = np.zeros((count, 3))
    np.add.at(total, owner[around.row], lonlat_to_xyz(start[sides.values]))
    far = np.argmin(total @ lonlat_to_xyz(spots).T, axis=1)
    inside = {*zip(region.tolist(), spot.tolist(), strict=True)}
    return {
        feature: {
            **_sent(_fine_sides(around.take(owner == feature))),
            "place": spots[far[feature]].tolist(),
            "inside": (feature, int(far[feature])) in inside,
        }
        for feature in np.unique(owner).tolist()
    }


def _spots() -> FloatArray:
    """Places all over the sphere, evenly."""
    k = np.arange(SPOTS)
    return np.stack([np.mod(137.50776405 * k, 360.0) - 180.0, np.degrees(np.arcsin((2 * k + 1) / SPOTS - 1))], axis=1)


def _fine(lines: Ragged) -> Ragged:
    """Lines with more points on them."""
    if len(lines) == 0:
        return lines
    first, sides = sides_of(lines)
    both = np.stack([lines.values[first], lines.values[first + 1]], axis=1)
    fine = _fine_sides(Ragged(both[sides.values], sides.offsets))
    ends = lines.values[lines.offsets[1:] - 1]
    return Ragged(np.insert(fine.values, fine.offsets[1:], ends, axis=0), fine.offsets + np.arange(len(lines) + 1))


def _fine_sides(sides: Ragged) -> Ragged:
    """Rows of points from rows of sides (k, 2, 2), without the last end of each."""
    start, way = sides.values[:, 0], np.diff(sides.values, axis=1)[:, 0]
    pieces: Indices = np.maximum(1, np.ceil(np.abs(way).max(axis=1, initial=0) / STEP)).astype(np.intp)
    offsets = np.concatenate([[0], np.cumsum(pieces)])
    part = np.arange(offsets[-1]) - np.repeat(offsets[:-1], pieces)
    share = (part / np.repeat(pieces, pieces))[:, None]
    points = np.repeat(start, pieces, axis=0) + share * np.repeat(way, pieces, axis=0)
    return Ragged(points, offsets[sides.offsets])


def _sent(rows: Ragged) -> dict[str, Any]:
    return {"lonlat": rows.values.astype("<f8").tobytes(), "offsets": rows.offsets.tolist()}
