"""Arrays with names of dimensions and coordinates: DataArrays of xarray in, DataArrays out.

xarray is not imported before somebody has such an array, who imported it then.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._extras import optional


def is_labelled(array: Any) -> bool:
    """Whether it is a DataArray."""
    return hasattr(array, "dims") and hasattr(array, "coords")


@dataclass(frozen=True)
class Labels:
    """Names that go with the axes of an array."""

    dims: tuple[Any, ...]
    coords: dict[Any, Any]
    attrs: dict[Any, Any]
    name: Any = None


def labels_of_one(values: Any) -> Labels | None:
    """Those of a single value, of values (n, ...) with names; None if they have none."""
    if not is_labelled(values) or not values.dims:
        return None
    points = values.dims[0]
    coords = {name: coord for name, coord in values.coords.items() if points not in coord.dims}
    return Labels(tuple(values.dims[1:]), coords, dict(values.attrs), values.name)


@dataclass(frozen=True)
class Places:
    """Places whose two coordinates were given as DataArrays.

    Parameters
    ----------
    pairs : (..., 2) array
    labels : Labels
        Of the leading shape.
    """

    pairs: FloatArray
    labels: Labels

    @classmethod
    def of(cls, first: Any, second: Any, names: tuple[str, str] = ("lon", "lat")) -> Places:
        """All places of both: a grid, with the second coordinate first, if they have dimensions of their own.

        `names` are for coordinates without a name.
        """
        xarray = optional("xarray", "grid")
        two, one = xarray.broadcast(*xarray.align(second, first, join="exact"))
        coords = dict(two.coords)
        for given, name in zip((first, second), names, strict=True):
            coords[name if given.name is None else given.name] = (given.dims, given.values, given.attrs)
        return cls(np.stack([one.values, two.values], axis=-1), Labels(tuple(two.dims), coords, {}))

    def array(self, found: FloatArray, value: Labels | None) -> Any:
        """What was found at the places, one value of these labels at each, as a DataArray."""
        if value is None:
            further = found.ndim - len(self.labels.dims)
            value = Labels(tuple(f"value_{k}" for k in range(further)), {}, {})
        coords = value.coords | self.labels.coords
        dims = self.labels.dims + value.dims
        return optional("xarray", "grid").DataArray(found, coords, dims, name=value.name, attrs=value.attrs)


def places_of(queries: Any, lonlat: Any) -> Places | None:
    """Places given as a tuple of two DataArrays, as points of the plane or as longitude and latitude."""
    given = queries if lonlat is None else lonlat
    if not isinstance(given, tuple) or len(given) != 2 or not all(map(is_labelled, given)):
        return None
    return Places.of(*given, names=("x", "y") if lonlat is None else ("lon", "lat"))
