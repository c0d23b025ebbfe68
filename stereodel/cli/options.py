"""Options shared by several commands, with the same wording."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from math import isfinite
from typing import Annotated

import typer


class Latitude(StrEnum):
    """The kind of latitude in a table."""

    spherical = "spherical"
    geodetic = "geodetic"
    authalic = "authalic"


Place = tuple[float, float]
"""Longitude and latitude in degrees."""

Points = Annotated[
    str, typer.Argument(metavar="POINTS", help="Table of points: .csv, .geojson, .gpkg, .shp, .xlsx …; - is stdin.")
]
Out = Annotated[
    str, typer.Option("--out", "-o", metavar="FILE", help="File to write; its extension gives the format; - is stdout.")
]
Overwrite = Annotated[bool, typer.Option("--overwrite", help="Replace the file if it exists.")]
Format = Annotated[
    str | None, typer.Option("--format", metavar="NAME", help="Format of stdout, when --out is -; csv by default.")
]
Lon = Annotated[
    str | None, typer.Option("--lon", metavar="COLUMN", help="Column of longitudes; recognised by its name by default.")
]
Lat = Annotated[
    str | None, typer.Option("--lat", metavar="COLUMN", help="Column of latitudes; recognised by its name by default.")
]
LayerName = Annotated[
    str | None, typer.Option("--layer-name", metavar="NAME", help="Layer of the points, if the file has several.")
]
Crs = Annotated[
    str | None,
    typer.Option(
        "--crs",
        metavar="NAME",
        help="Coordinate system of the columns, e.g. EPSG:25832; by default degrees, or with --plane none.",
    ),
]
SkipMissing = Annotated[
    bool, typer.Option("--skip-missing", help="Leave out rows without a position or a value, instead of stopping.")
]
MaxSegment = Annotated[
    float, typer.Option("--max-segment", metavar="DEGREES", help="Longest straight piece of an arc, in map formats.")
]
LatitudeKind = Annotated[
    Latitude,
    typer.Option(
        "--latitude",
        help="Model of the Earth: an ellipsoid, by directions from its centre (geodetic) or with true areas "
        "(authalic), or a sphere.",
    ),
]
Magnify = Annotated[float, typer.Option(metavar="S", help="Magnification at the focus.")]
Plane = Annotated[
    tuple[str, str] | None,
    typer.Option(
        "--plane", metavar="X Y", help="Columns of coordinates in a plane, instead of longitude and latitude."
    ),
]


def refuse(given: Mapping[str, object], purpose: str) -> None:
    """Refuse options that do not apply: those of `given`, values by name, that say anything; with what they are for."""
    names = [name for name, value in given.items() if value]
    if names:
        several = f"{', '.join(names[:-1])} and {names[-1]} are" if len(names) > 1 else f"{names[0]} is"
        raise ValueError(f"{several} for {purpose}")


def as_magnification(value: float) -> float:
    """The value of --magnify, checked."""
    if not 0 < value < float("inf"):
        raise ValueError(f"--magnify is {value:g}, but a magnification is positive and finite")
    return value


def place(text: str | None, option: str) -> Place | None:
    """Longitude and latitude from the text of an option."""
    return None if text is None else pair(text, option, "LON,LAT")


def pair(text: str, option: str, meaning: str) -> Place:
    """Longitude and latitude separated by a comma, such as ``10.5,48``."""
    try:
        lon, lat = (float(part) for part in text.split(","))
    except ValueError:
        raise ValueError(f"{option} is {text!r}, but must be {meaning}, e.g. {option}=10.5,48") from None
    if not isfinite(lon):
        raise ValueError(f"{option} is {text!r}, but its longitude must be finite")
    if not -90 <= lat <= 90:
        raise ValueError(f"{option} is {text!r}, but its latitude is outside [-90, 90]; the longitude comes first")
    return lon, lat


def box_of(text: str, option: str) -> tuple[float, float, float, float]:
    """Bounds of a box "W,S,E,N" in degrees; the eastern one exceeds 180 if the box crosses ±180°."""
    try:
        west, south, east, north = (float(part) for part in text.split(","))
    except ValueError:
        raise ValueError(f"{option} is {text!r}, but must be W,S,E,N in degrees, e.g. {option}=-25,34,45,72") from None
    if not (isfinite(west) and isfinite(east)):
        raise ValueError(f"{option} is {text!r}, but its west and east borders must be finite")
    if not -90 <= south < north <= 90:
        raise ValueError(f"{option} is {text!r}, but its south border must be below its north border in [-90, 90]")
    return west, south, east if east > west else east + 360.0, north
