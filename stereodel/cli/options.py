"""Options that several commands share: words for typer, tables to read, files to write, and texts as numbers."""

from __future__ import annotations

import re
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from copy import copy
from dataclasses import MISSING, dataclass, field, fields, is_dataclass, replace
from inspect import Parameter, signature
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, get_args, get_origin, get_type_hints

import typer

from stereodel._arrays import as_scalar
from stereodel._tasks.interrupts import stop_if_interrupted
from stereodel._tasks.whole_files import said_of
from stereodel.cli.application import ARGUMENTS, NothingToDoError, reporting
from stereodel.constants import LARGEST_MAGNIFICATION
from stereodel.io.formats.names import spelling
from stereodel.sphere.latitudes import Latitude

if TYPE_CHECKING:
    from stereodel._arrays import FloatArray
    from stereodel.drawing import ColorScale
    from stereodel.io import PointTable


TABLES = ("csv", "geojson", "geojsonl", "parquet", "gpkg", "fgb", "shp", "kml", "xlsx")
FLAT = ("csv", "xlsx")  # those without shapes
PICTURES = ("svg", "pdf")
VALUED = ("nc", "vtp")  # formats of meshes that hold the columns of points
MESHES = ("nc", "glb", "ply", "vtp", *PICTURES)

# Arguments of scales, and the options that give them.
OF_SCALES = {"kind": "--scale", "threshold": "--scale", "low": "--limits", "high": "--limits", "center": "--center"}
OF_SCALES |= {"colors": "--colors", "scheme": "--classes", "count": "--classes"}

Place = tuple[float, float]  # longitude and latitude in degrees


def _magnification(value: float) -> float:
    return as_scalar(value, "--magnify", low=1 / LARGEST_MAGNIFICATION, high=LARGEST_MAGNIFICATION)


Points = Annotated[
    str, typer.Argument(metavar="POINTS", help="Table of points: .csv, .geojson, .gpkg, .shp, .xlsx …; - is stdin.")
]
Overwrite = Annotated[bool, typer.Option("--overwrite", help="Replace the file if it exists.")]
MaxSegment = Annotated[float, typer.Option(metavar="DEGREES", help="Longest straight piece of an arc, in map formats.")]
LatitudeKind = Annotated[Latitude, typer.Option(help="Model of the Earth: ellipsoid (authalic: true areas) or sphere.")]
Focus = Annotated[str | None, typer.Option(metavar="LON,LAT", help="Focus of the fisheye; by default the centre.")]
Magnify = Annotated[float, typer.Option(metavar="S", callback=_magnification, help="Magnification at the focus.")]


def option(metavar: str | None, said: str, default: Any = None, **more: Any) -> Any:
    """A field of a group of options: the name of its value, its help, and what else typer takes."""
    return field(default=default, metadata={"option": typer.Option(metavar=metavar, help=said, **more)})


@dataclass(frozen=True)
class Destination:
    """A file, or stdout when `name` is "-"; `kind` is its format, such as "csv"."""

    name: str
    kind: str

    @contextmanager
    def file(self) -> Iterator[Path]:
        """Where to write; for stdout a temporary file, which is copied there when it is complete."""
        stop_if_interrupted()
        if self.name != "-":
            yield Path(self.name)
            return
        with tempfile.TemporaryDirectory() as folder:
            whole = Path(folder, f"stdout.{self.kind}")
            with said_of("stdout", folder):
                yield whole
            if sys.stdout is None:
                raise ValueError("stdout is closed; name a file with --out")
            with said_of("stdout"), whole.open("rb") as source:
                shutil.copyfileobj(source, sys.stdout.buffer)
                sys.stdout.buffer.flush()


@dataclass(frozen=True)
class File:
    """What a command writes: a file, or stdout."""

    out: Annotated[str, typer.Option("--out", "-o", metavar="FILE", help="File whose ending says the format, or -.")]
    overwrite: Overwrite = False

    def of(self, allowed: tuple[str, ...], *inputs: str | None) -> Destination:
        """The destination, in the first of the formats for stdout; an impossible one is rejected before the work.

        An existing file is replaced only with --overwrite, an input never.
        """
        from stereodel.io.writing import SAME

        name, path, kind = self.out, Path(self.out), getattr(self, "format", None)
        if inputs.count("-") > 1:
            raise ValueError("two inputs cannot both be stdin; name a file for one of them")
        if name != "-" and kind is not None:
            raise ValueError(f"--format is for stdout (--out -); the format of {name} is given by its extension")
        chosen = ((kind or allowed[0]) if name == "-" else path.suffix).lower().removeprefix(".")
        chosen = chosen if chosen in allowed else SAME.get(chosen, chosen)
        if name == "-" and chosen == "shp":
            raise ValueError("a shapefile is several files, and stdout is one; name a file with --out")
        if chosen not in allowed:
            kinds = ", ".join(f".{kind}" for kind in allowed)
            raise ValueError(f"{name}: cannot write {chosen or 'a file without extension'}; choose {kinds}")
        if name != "-" and not path.resolve().parent.is_dir():
            raise ValueError(f"{name}: there is no folder {path.parent}")
        if path.is_dir():
            raise ValueError(f"{name}: is a folder")
        if path.is_file():
            if any(given is not None and Path(given).exists() and Path(given).samefile(name) for given in inputs):
                raise ValueError(f"{name}: is an input, so it cannot be overwritten; choose another name")
            if not self.overwrite:
                raise ValueError(f"{name}: already exists; replace it with --overwrite, or choose another name")
        return Destination(name, chosen)


@dataclass(frozen=True)
class Output(File):
    """What a command writes, to stdout in one of several formats."""

    format: str | None = option("NAME", "Format of stdout, when --out is -; an extension, such as csv or png.")


@dataclass(frozen=True)
class PictureOptions:
    """How a picture looks, and what is written on it."""

    heading: ClassVar[str] = "Picture"
    title: str = option("TEXT", "Title above the picture.", "")
    legend: bool = option(None, "Explain points and layers below the picture.", False)
    legend_text: list[str] | None = option("NAME=TEXT", "Text of an entry of the legend, with its unit; repeatable.")  # noqa: RUF009 - a field
    style: list[str] | None = option("STYLE", "dark, or a .toml file of styles; repeatable.")  # noqa: RUF009 - a field
    size: int | None = option("PIXELS", "Width; by default 1600, and 720 for films.", min=1, max=65_535)


@dataclass(frozen=True)
class OwnerOptions:
    """What the owner of a page says of its points."""

    heading: ClassVar[str] = "Picture"
    title: str = option("TEXT", "Heading of the globe.", "")
    source: str = option("TEXT", "Line below it that says where the data are from.", "")
    labels: str | None = option("COLUMN", "Names of points; by default a column name.")
    legend_text: list[str] | None = option("NAME=TEXT", "Title of a scale, with its unit; repeatable.")  # noqa: RUF009 - a field


@dataclass(frozen=True)
class ValueOptions:
    """Colours and sizes by value; of layers with ``column=`` and of points."""

    heading: ClassVar[str] = "By value"
    point_size: str | None = option("LENGTH|COLUMN", "Diameter of points, or amounts that their areas show.")
    point_color: str | None = option("COLOR|COLUMN", "Colour of points, or numbers or words that it shows.")
    scale: str | None = option("KIND", "linear, log, sqrt, or symlog:THRESHOLD, linear up to there.")
    classes: str | None = option("SCHEME:N|LIMITS", "equal:5, quantiles:5, natural:5, or limits with commas.")
    colors: str | None = option("MAP|COLORS", "A map of matplotlib, e.g. magma_r, or colours with commas.")
    limits: str | None = option("LOW,HIGH", "Numbers with the first and the last colour.")
    center: float | None = option("NUMBER", "Number with the middle colour, to show what is above and below.")

    @property
    def given(self) -> dict[str, object]:
        """The options that say something of the scale."""
        named = ("scale", "classes", "colors", "limits", "center")
        return {f"--{name}": True for name in named if getattr(self, name) is not None}

    def of(self, values: FloatArray) -> ColorScale:
        """The colour scale of values that the options describe."""
        from stereodel.drawing import ColorScale

        kind, _, bend = (self.scale or "linear").partition(":")
        scheme, _, count = (self.classes or "").partition(":")
        if self.classes:
            refuse({"--scale": self.scale, "--limits": self.limits}, "scales without --classes")
        colors: Any = self.colors.split(",") if self.colors and re.search("[,#]", self.colors) else self.colors
        try:
            if self.classes:
                own: Any = scheme if scheme.isalpha() else numbers(self.classes, "--classes", "limits", "0,10,50")
                (at,) = numbers(count or "5", "--classes", "SCHEME:N or limits", "quantiles:5", 1)
                if at % 1:
                    raise ValueError(f"count is {count}, but must be a whole number")
                return ColorScale.classes(values, own, int(at), colors, center=self.center)
            ends: Any = self.limits and numbers(self.limits, "--limits", "LOW,HIGH", "0,100", 2)
            (threshold,) = numbers(bend, "--scale", "KIND", "symlog:1000", 1) if bend else (None,)
            return ColorScale.of(values, colors, kind, limits=ends, center=self.center, threshold=threshold)  # type: ignore[arg-type]
        except ValueError as error:
            name, _, rest = str(error).partition(" ")
            raise ValueError(f"{OF_SCALES.get(name, name)} {rest}") from None


@dataclass(frozen=True)
class Where:
    """What says where a table has its places; `of` is the option that names the table, where there is a second one."""

    heading: ClassVar[str] = "Reading {of}"
    lon: str | None = option("COLUMN", "Column of longitudes{of}; recognised by its name by default.")
    lat: str | None = option("COLUMN", "Column of latitudes{of}; recognised by its name by default.")
    layer_name: str | None = option("NAME", "Layer of the points{of}, if the file has several.")
    crs: str | None = option("NAME", "Coordinate system of the columns{of}, e.g. EPSG:25832; else degrees or a plane.")
    of: str = ""

    @property
    def given(self) -> dict[str, object]:
        """Values by option, to be refused where there is no table."""
        named = {each.name: getattr(self, each.name) for each in fields(self) if each.name != "of"}
        return {f"{self.of or '-'}-{name.replace('_', '-')}": value for name, value in named.items()}


@dataclass(frozen=True)
class Table(Where):
    """How a table of places of the Earth is read."""

    encoding: str | None = option("NAME", "Encoding of text, e.g. cp1252; UTF-8 or a guess by default.")
    decimal: str | None = option("MARK", "Decimal mark of text, . or ,; the other separates thousands.")
    skip_rows: int = option("N", "Lines above the header; the header is found by default.", 0, min=0)
    missing: list[str] | None = option("VALUE", "Value that stands for a missing one; repeatable.")  # noqa: RUF009 - a field
    skip_missing: bool = option(None, "Leave out rows without a position or a value, instead of stopping.", False)
    skip_invalid: bool = option(None, "Leave out rows with a wrong position, too, and say how many.", False)
    wrap: bool = option(None, "Accept longitudes beyond ±360.", False)

    @property
    def arguments(self) -> dict[str, Any]:
        """The options as `read_points` takes them."""
        named = {each.name: getattr(self, each.name) for each in fields(Table) if each.name != "of"}
        return named | {"layer": named.pop("layer_name"), "missing": named["missing"] or ()}

    def read(self, name: str, reader: Callable[..., PointTable] | None = None) -> PointTable:
        """The table in a file, or on stdin if `name` is "-"; NothingToDoError for one without points."""
        from stereodel.io import read_points
        from stereodel.io.formats.names import naming

        shown = "stdin" if name == "-" else name
        source = sys.stdin.buffer if name == "-" else name
        with reporting(f"reading {shown}") as told, naming(shown if name == "-" else None):
            given = {"plane": getattr(self, "plane", None), "progress": told, **self.arguments}
            table = (reader or read_points)(source, **given)
        if len(table) == 0:
            raise NothingToDoError(f"{shown}: there are no points")
        return table if table.name else replace(table, name=shown)


@dataclass(frozen=True)
class AnyTable(Table):
    """How a table of points is read, which may be of a plane."""

    plane: tuple[str, str] | None = option("X Y", "Columns of coordinates in a plane, instead of degrees.")


@dataclass(frozen=True)
class SecondTable(Where):
    """How the table that an option names is read, where it differs from the first one."""

    def read(self, name: str, first: AnyTable) -> PointTable:
        """The table; in a plane both have the columns of --plane, and by default the coordinate system of the first."""
        crs = self.crs or (first.crs if first.plane else None)
        table = replace(first, **vars(self) | {"crs": crs, "encoding": None, "skip_rows": 0})
        own = {key: f"{self.of}{ARGUMENTS[key][1:]}" for key in ("lon", "lat", "layer", "crs")}
        with spelling({**ARGUMENTS, **own}):
            return table.read(name)


def grouped(command: Callable[..., None]) -> Callable[..., None]:
    """A command as typer reads it: a parameter that is a dataclass of options stands for one option a field.

    ``Annotated[SecondTable, "--of"]`` gives the fields options of its own, ``--of-lon`` and so on. In the help they
    stand under the `heading` of the class, if it has one, below all others.
    """
    groups: dict[str, tuple[Any, dict[str, str], dict[str, str]]] = {}
    parameters: list[Parameter] = []
    for name, parameter in signature(command, eval_str=True).parameters.items():
        group = getattr(parameter.annotation, "__origin__", parameter.annotation)
        if not is_dataclass(group):
            parameters.append(parameter.replace(kind=Parameter.KEYWORD_ONLY, annotation=named(parameter.annotation)))
            continue
        of = "".join(getattr(parameter.annotation, "__metadata__", ()))
        hints = get_type_hints(group, include_extras=True)
        options = {each.name: each for each in fields(group) if each.name != "of"}
        names = {key: f"{of.removeprefix('--')}_{key}" if of else key for key in options}
        for key, each in options.items():
            kind, said = (hints[key], each.metadata["option"]) if each.metadata else get_args(hints[key])
            told = copy(said)
            if kind is bool and each.metadata:  # without an option that says no
                told.param_decls = (f"--{key.replace('_', '-')}",)
            told.help = told.help.format(of=of and f" of {of}")
            told.rich_help_panel = getattr(group, "heading", "").format(of=of).strip() or None
            default = Parameter.empty if each.default is MISSING else each.default
            typed = named(Annotated[kind, told])
            parameters.append(Parameter(names[key], Parameter.KEYWORD_ONLY, default=default, annotation=typed))
        groups[name] = (group, names, {"of": of} if of else {})

    def called(**given: Any) -> None:
        for name, (group, names, of) in groups.items():
            given[name] = group(**of, **{key: given.pop(option) for key, option in names.items()})
        command(**given)

    called.__doc__ = command.__doc__
    called.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    called.__signature__ = signature(command).replace(parameters=parameters)  # type: ignore[attr-defined]
    return called


def named(annotation: Any) -> Any:
    """An option that lists the words that it takes, if it is a choice."""
    kind, option = annotation.__origin__, copy(annotation.__metadata__[0])
    if get_origin(kind) is Literal:
        option.metavar = "|".join(get_args(kind))
    return Annotated[kind, option]


def refuse(given: Mapping[str, object], purpose: str) -> None:
    """Refuse options that do not apply: those of `given`, values by name, that say anything; with what they are for."""
    names = [name for name, value in given.items() if value]
    if names:
        several = f"{', '.join(names[:-1])} and {names[-1]} are" if len(names) > 1 else f"{names[0]} is"
        raise ValueError(f"{several} for {purpose}")


def numbers(text: str, option: str, meaning: str, example: str, count: int = 0) -> list[float]:
    """Finite numbers, if need be so many, separated by commas."""
    try:
        found = [float(part) for part in text.split(",")]
    except ValueError:
        found = []
    if not found or not all(map(isfinite, found)) or len(found) != (count or len(found)):
        raise ValueError(f"{option} is {text!r}, but must be {meaning}, e.g. {option}={example}")
    return found


def place(text: str, option: str) -> Place:
    """Longitude and latitude separated by a comma, such as ``10.5,48``."""
    lon, lat = numbers(text, option, "LON,LAT", "10.5,48", 2)
    if not -90 <= lat <= 90:
        raise ValueError(f"{option} is {text!r}, but its latitude is outside [-90, 90]; the longitude comes first")
    return lon, lat
