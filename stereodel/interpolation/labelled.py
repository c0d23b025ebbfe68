"""Labelled arrays: DataArrays of xarray in, DataArrays out.

xarray is never imported here: whoever passes such an array has imported it.
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
    """Dimensions, coordinates, name and attributes of an array."""

    dims: tuple[Any, ...]
    coords: dict[Any, Any]
    attrs: dict[Any, Any]
    name: Any = None


def labels_of_one(values: Any) -> Labels | None:
    """Labels of a single value, from labelled values (n, ...); None if they have none."""
    if not is_labelled(values) or not values.dims:
        return None
    points = values.dims[0]
    coords = {name: coord for name, coord in values.coords.items() if points not in coord.dims}
    return Labels(tuple(values.dims[1:]), coords, dict(values.attrs), values.name)


@dataclass(frozen=True)
class Places:
    """Places whose two coordinates were given as DataArrays.

    pairs: (..., 2).
    labels: labels of the leading shape.
    """

    pairs: FloatArray
    labels: Labels

    @classmethod
    def of(cls, first: Any, second: Any, names: tuple[str, str] = ("lon", "lat")) -> Places:
        """Places from two coordinates; a grid, with the second coordinate first, if they have different dimensions.

        `names` are for coordinates without a name.
        """
        xarray = optional("xarray", "grid")
        two, one = xarray.broadcast(*xarray.align(second, first, join="exact"))
        coords = dict(two.coords)
        for given, name in zip((first, second), names, strict=True):
            coords[name if given.name is None else given.name] = (given.dims, given.values, given.attrs)
        return cls(np.stack([one.values, two.values], axis=-1), Labels(tuple(two.dims), coords, {}))

    def array(self, found: FloatArray, value: Labels | None) -> Any:
        """Results at the places, one value with these labels at each, as a DataArray."""
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
