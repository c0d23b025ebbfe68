"""Optional libraries: the extras that bring them, and the doors that name the extra where a library is missing."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any, Final


@dataclass(frozen=True)
class Extra:
    """Libraries that come together because one kind of work needs them all.

    Parameters
    ----------
    purpose : str
        What works with them.
    brings : mapping
        Module that is imported, by the name of its distribution.
    includes : tuple of str
        Other extras that come along.
    """

    purpose: str
    brings: Mapping[str, str]
    includes: tuple[str, ...] = ()


EXTRAS: Final[Mapping[str, Extra]] = {
    "cli": Extra("the command line", {"typer": "typer", "rich": "rich"}),
    "draw": Extra(
        "SVG, PDF, pictures of the plane, matplotlib axes",
        {"matplotlib": "matplotlib", "pillow": "PIL", "mapbox_earcut": "mapbox_earcut"},
    ),
    "render": Extra(
        "globes as PNG, scenes as GLB",
        {"pyrender2": "pyrender", "PyOpenGL": "OpenGL", "trimesh": "trimesh"},
        ("draw",),
    ),
    "film": Extra(
        "moving pictures",
        {"av": "av", "imageio": "imageio", "rich": "rich"},
        ("render",),
    ),
    "scipy": Extra("stereodel.spatial, grids as NetCDF", {"scipy": "scipy"}),
    "geo": Extra(
        "GeoJSON of shapes, Parquet, GDAL's formats, coordinate systems, GeoDataFrames",
        {
            "shapely": "shapely",
            "geopandas": "geopandas",
            "pyogrio": "pyogrio",
            "pyproj": "pyproj",
            "pyarrow": "pyarrow",
        },
    ),
    "grid": Extra("UGRID", {"xarray": "xarray", "netCDF4": "netCDF4"}),
    "raster": Extra("GeoTIFF", {"rasterio": "rasterio"}),
    "jupyter": Extra("the globe in notebooks", {"anywidget": "anywidget", "traitlets": "traitlets"}),
    "partitioned": Extra("stereodel.partitioned: triangulations beyond memory, of Parquet", {"pyarrow": "pyarrow"}),
    "dask": Extra("the same on a cluster", {"distributed": "distributed"}, ("partitioned",)),
    "mesh": Extra("GLB, PLY, VTP", {"trimesh": "trimesh", "pyvista": "pyvista"}),
}
"""By name, as in pyproject.toml, where the least versions stand; tests compare the two. ``all`` is all of them."""


class MissingExtraError(ModuleNotFoundError):
    """A library that an extra brings is missing; the message says how to get it."""


def distributions(extra: str) -> dict[str, str]:
    """All that an extra brings: modules by distribution, those of the extras that come along first."""
    return {
        name: module
        for brought in (*map(distributions, EXTRAS[extra].includes), EXTRAS[extra].brings)
        for name, module in brought.items()
    }


def installing(extra: str) -> str:
    """The command that brings an extra into this environment, as it was made: by `make` in a checkout, or by pip.

    In a checkout pip gets its folder; elsewhere the name alone is known, not the index, wheel or folder that it came
    from, and the libraries themselves serve whatever that was.
    """
    checkout = Path(__file__).resolve().parent.parent
    if (checkout / "Makefile").is_file():
        if any(Path(sys.prefix).glob("installed-*")):
            return f"make -C {checkout} install"
        return f"pip install '{checkout}[{extra}]'"
    return f"pip install {' '.join(distributions(extra))}"


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
    stereodel._extras.MissingExtraError: shapely is not installed; it comes with: ...
    """
    try:
        yield
    except ModuleNotFoundError as error:
        for name, module in distributions(extra).items():
            if error.name == module:
                message = f"{name} is not installed; it comes with: {installing(extra)}"
                raise MissingExtraError(message, name=module) from error
        raise


def optional(module: str, extra: str) -> Any:
    """A module of an extra, or an ImportError that says how to get it."""
    with of_extra(extra):
        return import_module(module)
