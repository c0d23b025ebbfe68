"""Optional libraries: the extras that bring them, and the doors that name the extra where a library is missing."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Final


@dataclass(frozen=True)
class Library:
    """A distribution, the least version that works, and the module that is imported where it has another name."""

    name: str
    least: str
    imported: str = ""

    @property
    def module(self) -> str:
        """The module that is imported."""
        return self.imported or self.name


@dataclass(frozen=True)
class Extra:
    """Libraries that come together because one kind of work, `purpose`, needs them all, after those of `includes`."""

    purpose: str
    brings: tuple[Library, ...]
    includes: tuple[str, ...] = ()


TRIMESH: Final = Library("trimesh", "4.4")
PYARROW: Final = Library("pyarrow", "19")
RICH: Final = Library("rich", "13.7")

EXTRAS: Final[Mapping[str, Extra]] = {
    "cli": Extra(
        "the command line, guessed encodings",
        (Library("typer", "0.19"), RICH, Library("charset-normalizer", "3.4", "charset_normalizer")),
    ),
    "draw": Extra(
        "SVG, PDF, pictures of the plane, matplotlib axes",
        (Library("matplotlib", "3.9"), Library("pillow", "11.1", "PIL"), Library("mapbox_earcut", "1.0.3")),
    ),
    "render": Extra(
        "globes as PNG, scenes as GLB",
        (Library("pyrender2", "0.2.2", "pyrender"), Library("PyOpenGL", "3.1.9", "OpenGL"), TRIMESH),
        ("draw",),
    ),
    "film": Extra("moving pictures", (Library("av", "15"), Library("imageio", "2.34"), RICH), ("render",)),
    "scipy": Extra("stereodel.spatial, sparse matrices", (Library("scipy", "1.15"),)),
    "geo": Extra(
        "Parquet, GDAL's formats, coordinate systems, clipping, GeoDataFrames",
        (
            Library("shapely", "2.1"),
            Library("geopandas", "1.0"),
            Library("pyogrio", "0.12"),
            Library("pyproj", "3.6"),
            PYARROW,
        ),
    ),
    "grid": Extra("xarray, NetCDF, UGRID", (Library("xarray", "2024.7"), Library("netCDF4", "1.7.1.post1"))),
    "healpix": Extra("pixels of HEALPix", (Library("hpgeom", "1.4"),)),
    "raster": Extra("GeoTIFF", (Library("rasterio", "1.4"),)),
    "jupyter": Extra("the globe in notebooks", (Library("anywidget", "0.9.18"), Library("traitlets", "5.9"))),
    "partitioned": Extra("stereodel.partitioned: triangulations beyond memory, of Parquet", (PYARROW,)),
    "mesh": Extra("GLB, PLY", (TRIMESH,)),
    "vtk": Extra("VTP, PyVista", (Library("pyvista", "0.44.2"),)),
}
"""By name, as in pyproject.toml; tests compare the two. ``all`` is all of them but ``vtk``, which is half as large."""


class MissingExtraError(ModuleNotFoundError):
    """A library that an extra brings is missing; the message says how to get it."""


def libraries(extra: str) -> list[Library]:
    """All that an extra brings, those of the extras that come along first."""
    return [*(each for name in EXTRAS[extra].includes for each in libraries(name)), *EXTRAS[extra].brings]


def lacking(extra: str) -> list[Library]:
    """What is not installed of all that an extra brings."""
    return [library for library in libraries(extra) if find_spec(library.module) is None]


def installed_version(distribution: str) -> str:
    """Version of an installed distribution, or that it is missing."""
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version(distribution)
    except PackageNotFoundError:
        return "not installed"


def installing(extra: str) -> str:
    """The command that brings an extra into this environment, as it was made: by `make` in a checkout, or by pip.

    In a checkout pip gets its folder; elsewhere the name alone is known, not the index, wheel or folder that it came
    from, and the libraries that are missing serve whatever that was.
    """
    checkout = Path(__file__).resolve().parent.parent
    if (checkout / "Makefile").is_file():
        if any(Path(sys.prefix).glob("installed-*")):
            return f"make -C {checkout} install"
        return f"pip install '{checkout}[{extra}]'"
    return " ".join(["pip install", *(f'"{each.name}>={each.least}"' for each in lacking(extra))])


@contextmanager
def of_extra(extra: str) -> Iterator[None]:
    """Imports within say how to get what is missing, where that is a library of the extra; also decorates functions.

    Where one stands within another, the outer one speaks: it knows what all of the work needs.

    Examples
    --------
    >>> with of_extra("geo"):  # doctest: +ELLIPSIS
    ...     raise ModuleNotFoundError("No module named 'shapely'", name="shapely")
    Traceback (most recent call last):
        ...
    stereodel._extras.MissingExtraError: shapely is not installed; it comes with the extra 'geo': ...
    """
    try:
        yield
    except ModuleNotFoundError as error:
        for library in libraries(extra):
            if error.name == library.module:
                message = f"{library.name} is not installed; it comes with the extra '{extra}': {installing(extra)}"
                raise MissingExtraError(message, name=error.name) from error
        raise


def optional(module: str, extra: str) -> Any:
    """A module of an extra, or an ImportError that says how to get it."""
    with of_extra(extra):
        return import_module(module)


class OnUse:
    """A library that is loaded when something of it is asked for: ``OnUse(lambda: optional("shapely", "geo"))``."""

    def __init__(self, load: Callable[[], Any]) -> None:
        self._load = load

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):  # what inspects modules asks for these
            raise AttributeError(name)
        return getattr(self._load(), name)
