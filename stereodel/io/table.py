"""Tables of points: their places on the Earth or in a plane, their other columns, and what is said of wrong rows."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any, Final, Literal

import numpy as np

from stereodel._arrays import BoolArray, Column, FloatArray, Indices, as_choice, as_lonlat, as_points, read_only
from stereodel._extras import optional
from stereodel._notebook import Displayed, tabular
from stereodel.io.formats import Content, Wanted, notation
from stereodel.io.formats.columns import EXACT_INTEGERS, blanked, doubles, far, why_not
from stereodel.io.formats.map_rows import columns_of
from stereodel.io.formats.names import beside, has_lonlat, left_out, naming, note, spelled
from stereodel.sphere import lonlat_to_xyz
from stereodel.sphere.latitudes import Latitude

DEGREES: Final = "EPSG:4326"  # coordinate system of longitude and latitude
AXES: Final = {"sphere": ("lon", "lat"), "plane": ("x", "y")}  # unless a table has its own


@dataclass(frozen=True, eq=False)
class PointTable(Displayed):
    """Points of the Earth or of a plane and their other columns, from `read_points` and for `write`; read-only.

    Parameters
    ----------
    places : (n, 2) array_like
        Longitude and latitude in degrees, latitude in [−90, 90]; or coordinates of the plane.
    columns : mapping of str to (n,) array_like, or frame, optional
        The other columns by name; a frame is any of pandas, polars, Arrow or DuckDB.
    rows : (n,) array_like of int, optional
        Row number of each point in its source, for messages; the first row of data is 1.
    surface : {"sphere", "plane"}
        What the points are on.
    axes : tuple of str, optional
        Names of the two coordinates, by default lon and lat, or x and y.
    crs : str, optional
        Coordinate reference system of the plane, if it is known. Degrees are those of EPSG:4326.
    name : str
        Name of the source, for messages.

    Raises
    ------
    ValueError, TypeError
        If a latitude is out of range, a coordinate is not a finite real number, or a column has the wrong length.

    Examples
    --------
    >>> table = PointTable([[13.4, 52.5], [2.4, 48.9]], {"name": ["Berlin", "Paris"]})
    >>> print(len(table), table.columns["name"], table.rows)
    2 ['Berlin' 'Paris'] [1 2]
    >>> PointTable([[3500.0, 5400.0]], surface="plane", axes=("east", "north"), crs="EPSG:31467").points()
    array([[3500., 5400.]])
    """

    places: FloatArray
    columns: Mapping[str, Column] = field(default_factory=dict)
    rows: Indices = field(default_factory=lambda: np.zeros(0, dtype=np.intp))
    surface: Literal["sphere", "plane"] = "sphere"
    axes: tuple[str, ...] = ()
    crs: str | None = None
    name: str = ""
    _mimes = tabular(len, lambda it, k: {"row": it.rows[k]} | {name: its[k] for name, its in it.located().items()})

    def __post_init__(self) -> None:
        axes = self.axes or AXES[as_choice(self.surface, tuple(AXES), "surface")]
        places = as_points(self.places, 2, "places")
        if self.surface == "sphere":
            places = as_lonlat(places, "places")
            if self.crs not in (None, DEGREES):
                raise ValueError(f"crs is {self.crs!r}, but points of the sphere are in degrees, {DEGREES}")
        given = np.asarray(self.rows, dtype=np.intp)
        rows = given if given.size else np.arange(1, len(places) + 1)
        columns = {str(name): read_only(np.asarray(values)) for name, values in columns_of(self.columns).items()}
        for name, values in {**columns, "rows": rows}.items():
            if values.ndim < 1 or len(values) != len(places):
                raise ValueError(f"column {name!r} has shape {values.shape}, but there are {len(places)} points")
        held = {"places": read_only(places), "columns": MappingProxyType(columns), "rows": read_only(rows)}
        vars(self).update(held, axes=tuple(axes), crs=DEGREES if self.surface == "sphere" else self.crs)

    def __len__(self) -> int:
        return len(self.places)

    def __reduce__(self) -> tuple[Any, ...]:  # a read-only mapping cannot be pickled or copied
        given = self.places, dict(self.columns), self.rows, self.surface, self.axes, self.crs, self.name
        return type(self), given

    @property
    def lonlat(self) -> FloatArray:
        """(n, 2): longitude and latitude in degrees; ValueError for points of a plane."""
        if self.surface == "plane":
            raise ValueError("the points are those of a plane, not of the sphere; use places")
        return self.places

    def points(self, latitude: Latitude = "spherical") -> FloatArray:
        """Unit vectors (n, 3), see `lonlat_to_xyz`, or points of the plane (n, 2), as triangulations take them."""
        return self.places if self.surface == "plane" else lonlat_to_xyz(self.places, latitude=latitude)

    def located(self) -> dict[str, Column]:
        """Both coordinates by their names, followed by the other columns; those whose names are taken are renamed."""
        own: dict[str, Column] = dict(zip(self.axes, self.places.T, strict=True))
        return own | beside(own, self.columns)

    def column(self, name: str) -> Column:
        """A column by name; ValueError lists the columns that exist."""
        with naming(self.name):
            if name not in self.columns:
                known = ", ".join(self.columns) or "none besides the coordinates"
                raise ValueError(f"there is no column {name!r}; the columns are {known}")
        return self.columns[name]

    def numbers(self, name: str, *, gaps: bool = True) -> FloatArray:
        """A column of finite numbers, NaN where a cell is empty if `gaps`; ValueError names the first other row."""
        with naming(self.name):
            return numbers(self.column(name), name, self.rows, gaps=gaps)

    def values(self, names: Sequence[str], *, skip_missing: bool = False) -> tuple[FloatArray, PointTable]:
        """Columns of numbers (n, number of names) and their points, without incomplete rows if `skip_missing`."""
        values = np.column_stack([self.numbers(name, gaps=skip_missing) for name in names])
        for name, column in zip(names, values.T, strict=True):
            for value, count in far(column).items():
                said = f"{count} of the values of {name!r} are {value:g}, far outside all others"
                note(f"{said}; {spelled('missing', '=')} leaves them out")
        kept = np.flatnonzero(~np.isnan(values).any(axis=1))
        return values[kept], self.taken(kept)

    def beside(self, results: Mapping[str, Column], *, first: Mapping[str, Column] | None = None) -> PointTable:
        """The same points with more columns: `first` before the others, `results` after them.

        A column of the table whose name is that of a coordinate or of a new column is renamed, with a
        `RenamedColumnWarning`.
        """
        before = dict(first or {})
        others = beside([*self.axes, *before, *results], self.columns)
        return replace(self, columns=before | others | dict(results))

    def taken(self, which: BoolArray | Indices) -> PointTable:
        """Some of the points, by index or mask."""
        columns = {name: values[which] for name, values in self.columns.items()}
        return replace(self, places=self.places[which], columns=columns, rows=self.rows[which])


def located(found: Content, wanted: Wanted, name: str = "") -> PointTable:
    """A table of what was read: places from its geometries, else from columns, of degrees, `crs` or a plane.

    ValueError gives the first row that lacks a place, or has none on the Earth; `skip_missing` leaves out the former,
    `skip_invalid` both, with a warning. What is left out is in `found.invalid`.
    """
    gaps = wanted.skip_missing or wanted.skip_invalid
    pair, crs = None if wanted.plane else found.places(skip_missing=gaps), found.crs
    remedy = left_out("skip_invalid") if pair else f"give {spelled('crs', '=')}, or {left_out('skip_invalid')}"
    columns = {key: blanked(np.asarray(each), wanted.sentinels) for key, each in found.columns().items()}
    if pair is None:
        pair, columns, crs = _place_columns(columns, wanted, found.understood)
    named = wanted.plane or (("longitude", "latitude") if crs is None else ("easting", "northing"))
    rows = np.arange(1, len(pair[0]) + 1) if found.rows is None else found.rows
    decimal, wrong = wanted.plane is None and crs is None, found.invalid if wanted.skip_invalid else None
    said: dict[str, Any] = {"gaps": gaps, "decimal": decimal, "wrong": wrong}
    places = np.column_stack([numbers(each, axis, rows, **said) for axis, each in zip(named, pair, strict=True)])

    def there() -> tuple[FloatArray, Indices, dict[str, Column]]:
        kept = ~np.isnan(places).any(axis=1)
        return places[kept], rows[kept], {key: values[kept] for key, values in columns.items()}

    places, rows, columns = there()
    if wanted.plane is None:
        places = degrees(places, crs, rows, wrap=wanted.wrap, wrong=wrong, remedy=remedy)
        places, rows, columns = there()
    if found.invalid:
        first, many = min(found.invalid), len(found.invalid)
        told = f"{many} {'rows are' if many > 1 else 'row is'} left out: row {first}: {found.invalid[first]}"
        note(told + (f" (and {many - 1} more)" if many > 1 else ""))
    if wanted.plane is not None:
        return PointTable(places, columns, rows, "plane", wanted.plane, crs and known_crs(crs).to_string(), name)
    return PointTable(places, columns, rows, name=name)


def _place_columns(
    columns: dict[str, Column], wanted: Wanted, understood: dict[str, Any]
) -> tuple[tuple[Column, Column], dict[str, Column], str | None]:
    """Both coordinates of columns, the other columns, and the coordinate system.

    They are two columns or, where none has their names or both are said to be the same one, one that has both.
    """
    names, crs = list(columns), wanted.crs
    same = wanted.lon is not None and wanted.lon == wanted.lat
    if wanted.plane is None and (same or not (wanted.lon or wanted.lat or has_lonlat(names))):
        asked = [name for name in names if not same or name == wanted.lon]
        every = {name: each for name in asked if (each := notation.both(columns[name], name)) is not None}
        found = {name: each for name, each in every.items() if each[2] == notation.WELL_KNOWN} or every
        if len(found) == 1:
            ((name, (x, y, how, system)),) = found.items()
            understood |= {"place": [name], "notation": how}
            if not same and how != notation.WELL_KNOWN:
                other = "latlon" if how.startswith("lon") else "lonlat"
                note(f"column {name!r} is read as {how}; the name {other!r} says it if that is wrong")
            return (x, y), {key: columns[key] for key in names if key != name}, system or crs
        if same and names.count(str(wanted.lon)):
            both = "both coordinates, as POINT (10 48.4) or '48.4, 10'"
            raise ValueError(f"column {wanted.lon!r} is to have {both}, but has not")
    axes = wanted.axes(names)
    understood["place"] = [*axes]
    others, angles = {key: columns[key] for key in names if key not in axes}, wanted.plane is None and crs is None
    kinds = zip(axes, ("longitude", "latitude"), strict=True)
    x, y = (notation.with_letters(columns, name, kind) if angles else columns[name] for name, kind in kinds)
    return (x, y), others, crs


def degrees(
    places: FloatArray,
    crs: str | None,
    rows: Sequence[int] | Indices,
    *,
    wrap: bool = True,
    wrong: dict[int, str] | None = None,
    remedy: str = "",
) -> FloatArray:
    """Places in degrees, transformed if `crs` is given, easting first; ValueError names the first row with a wrong one.

    With `wrong`, those are NaN, and it takes their rows. Without `wrap`, longitudes beyond ±360° are wrong.
    """
    lonlat = places
    if crs is not None and len(places):
        transformer = optional("pyproj", "geo").Transformer.from_crs(known_crs(crs), DEGREES, always_xy=True)
        lonlat = np.column_stack(transformer.transform(*places.T))
        lost, what = ~np.isfinite(lonlat).all(axis=1), f"has no longitude and latitude in {crs}"
        _refuse(lost, rows, lambda k: f"({places[k, 0]}, {places[k, 1]}) {what}", wrong=wrong)
        lonlat[lost] = np.nan
    if wrong is None:
        _refuse(~np.isfinite(lonlat).all(axis=1), rows, lambda k: "a coordinate is not finite")
    advice = f"is it the longitude, or not in degrees? {remedy}".rstrip()
    outside = np.abs(lonlat[:, 1]) > 90.0
    _refuse(outside, rows, lambda k: f"latitude {lonlat[k, 1]} is outside [-90, 90]", advice, wrong)
    far_round = np.abs(lonlat[:, 0]) > (np.inf if wrap or crs is not None else 360.0)
    advice = f"{left_out('skip_invalid')}, or take it as it is with {spelled('wrap', '=True')}"
    _refuse(far_round, rows, lambda k: f"longitude {lonlat[k, 0]} is outside [-360, 360]", advice, wrong)
    return lonlat if wrong is None else np.where((outside | far_round)[:, None], np.nan, lonlat)


def known_crs(crs: str) -> Any:
    """The coordinate system of this name; ValueError if PROJ does not know it."""
    pyproj = optional("pyproj", "geo")
    try:
        return pyproj.CRS(crs)
    except pyproj.exceptions.CRSError as error:
        said = f"{spelled('crs')} is {crs!r}, which PROJ does not know"
        raise ValueError(f"{said}; give one such as EPSG:25832") from error


def numbers(
    values: Column,
    name: str,
    rows: Sequence[int] | Indices,
    *,
    gaps: bool = False,
    decimal: bool = False,
    advice: str = "",
    wrong: dict[int, str] | None = None,
) -> FloatArray:
    """A column as finite numbers, with NaN for missing ones if `gaps`; ValueError names the first invalid row.

    With `decimal`, cells of text may be angles in degrees, minutes and seconds. With `wrong`, invalid numbers are NaN,
    and it takes their rows.
    """
    array = np.asarray(values)
    if array.dtype.kind in "iuf":
        result = array.astype(np.float64)
        rounded = np.zeros(len(array), dtype=np.bool_)
        for k in np.flatnonzero(np.abs(result) >= EXACT_INTEGERS).tolist() if array.dtype.kind in "iu" else []:
            rounded[k] = int(array[k]) != int(result[k])
        remedy = "subtract an origin that all share, or round it yourself"
        _refuse(rounded, rows, lambda k: f"the {name} {array[k]} is not a double", remedy)
    else:
        result, bad = doubles(array, decimal=decimal)
        for k in np.flatnonzero(bad).tolist() if decimal else ():
            found = notation.angle(str(array[k]))
            if found is not None and found.axis in ("", name) and found.degrees == found.degrees:
                result[k], bad[k] = found.degrees, False

        def why(k: int) -> str:
            said = str(array[k]).strip()
            found = notation.angle(said) if decimal else None
            unsure = notation.O_IS if decimal and notation.LONE_O.search(said) else why_not(said)
            return f"the {name} {said!r} {f'is a {found.axis}' if found and found.axis not in ('', name) else unsure}"

        _refuse(bad, rows, why, left_out("skip_invalid") if decimal else "", wrong)
    remedy = "correct or drop such rows first"
    _refuse(np.isinf(result), rows, lambda k: f"the {name} is {result[k]}, but must be finite", remedy, wrong)
    if not gaps or wrong is not None:
        unsaid = np.isnan(result) & ~np.isin(rows, [*(wrong or ())])
        _refuse(unsaid, rows, lambda k: f"the {name} is missing", advice or left_out(), wrong)
    return result if wrong is None else np.where(np.isinf(result), np.nan, result)


def _refuse(
    bad: Any,
    rows: Sequence[int] | Indices,
    said: Callable[[int], str],
    advice: str = "",
    wrong: dict[int, str] | None = None,
) -> None:
    """A ValueError for the first bad row, how many more there are, and what to do; `wrong` takes them instead."""
    places = np.flatnonzero(bad)
    if wrong is not None:
        wrong.update({int(rows[k]): said(k) for k in places.tolist() if int(rows[k]) not in wrong})
    elif len(places):
        more = f" (and {len(places) - 1} more rows like it)" if len(places) > 1 else ""
        raise ValueError(f"row {rows[places[0]]}: {said(places[0])}{more}{advice and '; '}{advice}")
