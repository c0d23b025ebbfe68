"""Files of geometries that GDAL knows, through pyogrio: GeoPackage, Shapefile, FlatGeobuf, KML and others."""

from __future__ import annotations

import os
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

from stereodel._extras import optional
from stereodel.io.columns import RenamedColumnWarning, beside, listed

RESERVED: Final = {"gpkg": ("fid", "geom"), "fgb": (), "shp": (), "kml": ()}
"""Names that a format has for its own columns."""

DRIVERS: Final = {"gpkg": "GPKG", "fgb": "FlatGeobuf", "shp": "ESRI Shapefile", "kml": "LIBKML"}

LAUNDERED: Final = re.compile(r"field name: '(.*)' to '(.*)'")
"""What GDAL warns of a column whose name it cuts."""


def read_frame(source: str | os.PathLike[str] | bytes, *, layer: str | None = None) -> Any:
    """A layer of a file, or of its bytes, as a GeoDataFrame; of a file with several, the one that is named.

    Raises
    ------
    ValueError
        For a damaged file, one that GDAL does not know, a layer that is not there, and several when none is named.
    """
    pyogrio = optional("pyogrio", "geo")
    optional("geopandas", "geo")
    with told():
        names = [name for name, kind in pyogrio.list_layers(source) if kind is not None]
        if layer is not None and layer not in names:
            raise ValueError(f"layer is {layer!r}, which is not one of {listed(names)}")
        if layer is None and len(names) > 1:
            raise ValueError(f"there are several layers, {listed(names)}; say which with layer=")
        # Whole numbers with gaps stay whole numbers, which doubles may not hold.
        objects = {"integer_object_nulls": True}
        return pyogrio.read_dataframe(source, layer=layer, use_arrow=True, arrow_to_pandas_kwargs=objects)


def write_frame(frame: Any, path: Path, *, layer: str) -> None:
    """A GeoDataFrame as a file of one layer, in the format that the ending of `path` names."""
    kind = path.suffix[1:].lower()
    geometry = frame.geometry.name
    others = {name: frame[name] for name in frame.columns if name != geometry}
    named = beside([geometry, *RESERVED[kind]], others, any_case=True)
    renamed = frame.rename(columns={old: new for old, new in zip(others, named, strict=True) if old != new})
    with told(), warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        renamed.to_file(path, driver=DRIVERS[kind], layer=layer, engine="pyogrio")
    for warning in said:  # names of shapefiles have ten letters; that a plane has no coordinate system is no news
        found = LAUNDERED.search(str(warning.message))
        if found:
            text = f"column {found[1]!r} is written as {found[2]!r}, which is as long as the format allows"
            warnings.warn(text, RenamedColumnWarning, stacklevel=2)


@contextmanager
def told() -> Iterator[None]:
    """What GDAL says of a file, as an error in its words, without the names that it was given."""
    try:
        yield
    except RuntimeError as error:  # all of pyogrio's are, and have no class in common but that
        said = re.sub(r"; It might help to specify.*", "", str(error), flags=re.DOTALL)
        raise ValueError(f"the file cannot be read or written: {' '.join(said.split())}") from error
