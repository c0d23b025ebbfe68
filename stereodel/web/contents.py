"""Contents of a page: the kernel, land, data sets of the package, and the reader's own points, as texts by name."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Final

import numpy as np

from stereodel._arrays import FloatArray, Indices
from stereodel.curves.ragged import Ragged
from stereodel.curves.seams import stitched
from stereodel.data import airports, cities, land, stars
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation import SphericalDelaunay
from stereodel.web.packing import packed, packed_doubles, packed_places

RESOLUTIONS: Final = {"50m": ("110m", "50m"), "110m": ("110m",)}
"""Land included for each resolution; the coarse one is drawn while the globe moves."""

LAND_DIGITS: Final = 2
"""Decimals of land in degrees: 1.1 km, a third of a pixel on a globe 4000 pixels across."""

SITE_DIGITS: Final = {"airports": 6, "cities": 5, "gap": 3, "sheet": 3, "stars": 5}
"""Digits of the coordinates of the sets, all that they have."""

MOST_POINTS: Final = 1_000_000
"""Largest number of points on a page."""

LARGE_CITY: Final = 2_000_000
"""Smallest population of the page's cities; its airports are those nearest to them."""

BRIGHT_STAR: Final = 3.0
"""The largest magnitude of the page's stars."""


@dataclass(frozen=True, eq=False)
class Given:
    """Points given by the reader, in degrees: `name` of all, such as that of their file, and `names` of each."""

    lonlat: FloatArray
    name: str
    names: Sequence[str] | None = None

    def __post_init__(self) -> None:
        if self.names is not None and len(self.names) != len(self.lonlat):
            raise ValueError(f"names has {len(self.names)} entries, but there are {len(self.lonlat)} points")
        if len(self.lonlat) > MOST_POINTS:
            raise ValueError(
                f"{self.name} has {len(self.lonlat)} points, but a page takes up to {MOST_POINTS}; "
                "for more there is the Python library"
            )


def built(name: str) -> bytes:
    """A built file of the page, shipped with the library."""
    return resources.files("stereodel.web").joinpath("built", name).read_bytes()


@cache
def kernel() -> str:
    """The kernel as WebAssembly."""
    return packed(built("stereodel.wasm"))


@cache
def land_rings(resolution: str) -> str:
    """Land as rings, interior on the left, joined across the map's cuts at ±180° and along the South Pole.

    The first point of a ring is not repeated at its end. Neighbouring points that round to the same place are merged,
    and rings that collapse are left out.
    """
    table = land(resolution)
    rings = Ragged(table.lonlat, table.ring_offsets.astype(np.intp))
    start, _, edges, _ = stitched(rings, np.zeros(len(rings), dtype=np.intp))
    rounded = Ragged(np.round(start[edges.values], LAND_DIGITS), edges.offsets)
    moved = (rounded.values != rounded.values[rounded.following]).any(axis=1)
    distinct = rounded.kept(moved)
    return packed_places(distinct.take(distinct.sizes > 2), LAND_DIGITS)


@cache
def sites(name: str) -> str:
    """One of the small sets, those of `SITE_DIGITS`."""
    places = _places(name)
    return packed_places(Ragged(places, np.array([0, len(places)])), SITE_DIGITS[name])


def _places(name: str) -> FloatArray:
    """The sites that a room begins with, the largest cities, the airports nearest to them, or the brightest stars."""
    if name in ("gap", "sheet"):
        return scattered()[name]
    if name == "stars":
        return stars().lonlat[stars().magnitude <= BRIGHT_STAR]
    large = cities().lonlat[cities().population >= LARGE_CITY]
    return large if name == "cities" else airports().lonlat[_nearest(airports().lonlat, large)]


def scattered() -> dict[str, FloatArray]:
    """The sites that rooms begin with, drawn once and kept so that the first pictures stay.

    "gap": 54 sites, each the farthest of 14 drawn, none within 68° of the first pole of projection; "sheet": 48 places
    of a sheet of 3 by 2 about its middle, each the farthest of 12 drawn.
    """
    text = resources.files("stereodel.web").joinpath("scattered.json").read_text(encoding="utf-8")
    return {name: np.array(rows) for name, rows in json.loads(text).items()}


def _nearest(places: FloatArray, to: FloatArray) -> Indices:
    """Indices of the places nearest to `to`, sorted and without repeats."""
    return np.unique(SphericalDelaunay.from_lonlat(places).nearest(lonlat=to))


def _shown(name: object) -> str:
    """A name as text: empty where it is missing, and with a mark for halves of letters."""
    missing = name is None or name != name
    return "" if missing else str(name).encode("utf-8", "replace").decode()


def contents(resolution: str, given: Given | None = None, *, latitude: Latitude | None) -> dict[str, str]:
    """All contents by name, as read by `script/contents.ts`; a widget has no sets and no latitude of places."""
    blocks = {"kernel": kernel()}
    blocks |= {f"land-{each}": land_rings(each) for each in RESOLUTIONS[resolution]}
    if latitude is not None:
        blocks |= {name: sites(name) for name in SITE_DIGITS} | {"latitude": packed(latitude.encode())}
    if given is not None:
        blocks["given-name"] = packed(json.dumps(given.name).encode())
        blocks["given"] = packed_doubles(given.lonlat)
        if given.names is not None:
            blocks["given-names"] = packed(json.dumps(list(map(_shown, given.names))).encode())
    return blocks
