"""Contents of a page: the kernel, land, data sets of the package, and the reader's own points, as texts by name.

Numbers are deflated, then written in base64, which all browsers decode natively; `script/contents.ts` reads them.
"""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import Bytes, FloatArray
from stereodel.curves.ragged import Ragged
from stereodel.curves.seams import stitched
from stereodel.data import airports, cities, land, stars
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation import SphericalDelaunay

RESOLUTIONS: Final = {"50m": ("110m", "50m"), "110m": ("110m",)}
"""Land included for each resolution; the coarse one is drawn while the globe moves."""

LAND_DIGITS: Final = 2
"""Decimals of land in degrees: 1.1 km, a third of a pixel on a globe 4000 pixels across."""

SITE_DIGITS: Final = {"airports": 6, "cities": 5, "everywhere": 3, "gap": 3, "hemisphere": 3, "sheet": 3, "stars": 5}
"""Digits of the coordinates of the sets, all that they have."""

MOST_POINTS: Final = 1_000_000
"""Largest number of points on a page."""


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


def packed(content: bytes) -> str:
    """Bytes as text."""
    return base64.b64encode(zlib.compress(content, 9)).decode("ascii")


def packed_places(places: Ragged, digits: int) -> str:
    """Rows of longitude and latitude in degrees, rounded to `digits` decimals, as packed numbers of `varints`.

    They are digits, number of rows, size of each row, then the steps of all longitudes and of all latitudes from one
    place to the next, in units of the last digit. A negative step s is written as −2s − 1, any other as 2s. Integers
    divided by a power of ten give the doubles nearest to the decimals.
    """
    units = np.rint(places.values * 10.0**digits).astype(np.int64)
    steps = np.diff(units, axis=0, prepend=np.zeros((1, 2), dtype=np.int64)).T.ravel()
    zigzag = np.where(steps < 0, -2 * steps - 1, 2 * steps)
    return packed(varints(np.concatenate([[digits, len(places)], places.sizes, zigzag])).tobytes())


def packed_doubles(values: FloatArray) -> str:
    """Doubles stored exactly: the lowest byte of all, then the second lowest of all, and so on.

    Grouped in this way, high bytes are similar and compress well.
    """
    planes = np.ascontiguousarray(values, dtype="<f8").reshape(-1, 1).view(np.uint8).T
    return packed(planes.tobytes())


def varints(numbers: npt.NDArray[np.int64]) -> Bytes:
    """Non-negative integers, seven bits per byte, lowest first; the eighth bit marks that more bytes follow."""
    rest = numbers.astype(np.uint64)
    groups, more = [], []
    while True:
        groups.append((rest & np.uint64(0x7F)).astype(np.uint8))
        rest = rest >> np.uint64(7)
        more.append(rest > 0)
        if not more[-1].any():
            break
    lengths = 1 + np.sum(more, axis=0)
    table = np.stack(groups, axis=1) | np.where(np.stack(more, axis=1), 0x80, 0).astype(np.uint8)
    return table[np.arange(len(groups)) < lengths[:, None]]


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
    """One of the sets of `SITE_DIGITS`: stars are the bright ones, airports those nearest to the large cities."""
    if name in (drawn := scattered()):
        places = drawn[name]
    elif name == "stars":
        places = stars().lonlat[stars().magnitude <= 3.0]
    else:
        places = cities().lonlat[cities().population >= 2_000_000]
    if name == "airports":
        near = SphericalDelaunay.from_lonlat(airports().lonlat).nearest(lonlat=places)
        places = airports().lonlat[np.unique(near)]
    return packed_places(Ragged(places, np.array([0, len(places)])), SITE_DIGITS[name])


def scattered() -> dict[str, FloatArray]:
    """The sites that rooms begin with, drawn once and kept so that the first pictures stay.

    "gap": 54 sites, each the farthest of 14 drawn, none within 68° of the first pole of projection; "everywhere" and
    "hemisphere" likewise 72 and 40, these within 75° of (0° E, 0° N); "sheet": 48 places of a sheet of 3 by 2 about its
    middle, each the farthest of 12 drawn.
    """
    text = resources.files("stereodel.web").joinpath("scattered.json").read_text(encoding="utf-8")
    return {name: np.array(rows) for name, rows in json.loads(text).items()}


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
            # Empty where a name is missing, and with a mark for halves of letters.
            texts = ["" if name is None or name != name else str(name) for name in given.names]
            shown = [text.encode("utf-8", "replace").decode() for text in texts]
            blocks["given-names"] = packed(json.dumps(shown).encode())
    return blocks
