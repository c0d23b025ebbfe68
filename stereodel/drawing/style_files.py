"""Style files: colours, widths and sizes for the parts of a page.

The file is TOML. Parts are identified by their names, which are ids in SVG: "ball", "land", "coast", "graticule",
"voronoi" ….
"""

from __future__ import annotations

import os
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._arrays import as_scalar
from stereodel.drawing.colors import Color, as_color
from stereodel.drawing.fonts import as_font
from stereodel.drawing.legend import PREFIX
from stereodel.drawing.lengths import as_length
from stereodel.drawing.page import Dots, Fill, Item, Label, Page, Polygons, Polylines, Stroke

Changes = Mapping[str, Any]
"""New values for fields of an item."""


def _width(value: Any, name: str) -> float:
    """A length that may be 0."""
    return as_length(value, name) if isinstance(value, str) else as_scalar(value, name, low=0.0)


READERS: Final[Mapping[str, Mapping[str, Callable[[Any, str], Any]]]] = {
    "lines": {"color": as_color, "width": _width},
    "dots": {"color": as_color, "radius": _width, "rim": as_color, "rim_width": _width},
    "labels": {"color": as_color, "font": as_font, "size": as_length, "halo": _width, "halo_color": as_color},
}
"""Tables of a file with their keys, and the function that parses the value of each."""


@dataclass(frozen=True)
class PageStyle:
    """Colours, widths and sizes of the parts of a page, by name; other parts are unchanged.

    Parameters
    ----------
    base : tuple of {"column", "slide", "dark"}
        Styles applied first.
    background : Color, optional
        Colour of the background.
    fills : mapping of str to Color
        Colours of regions by name; regions with several colours, such as cells, keep them.
    lines, dots : mapping of str to mapping
        "color" and "width" of lines by name; "color", "radius", "rim" and "rim_width" of dots by name.
    labels : mapping
        "color", "font", "size", "halo" and "halo_color" of all text.
    """

    base: tuple[str, ...] = ()
    background: Color | None = None
    fills: Mapping[str, Color] = field(default_factory=dict)
    lines: Mapping[str, Changes] = field(default_factory=dict)
    dots: Mapping[str, Changes] = field(default_factory=dict)
    labels: Changes = field(default_factory=dict)

    @classmethod
    def of_file(cls, path: str | os.PathLike[str]) -> PageStyle:
        """The style in a TOML file.

        Raises
        ------
        OSError
            If the file cannot be read.
        ValueError
            If the file is not TOML, or a key or value is invalid; the message names file and key.
        """
        source = Path(path)
        try:
            table = tomllib.loads(source.read_text(encoding="utf-8"))
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise ValueError(f"{source}: is not TOML: {error}") from error
        try:
            return cls._of_table(table)
        except ValueError as error:
            raise ValueError(f"{source}: {error}") from error

    @classmethod
    def _of_table(cls, table: Mapping[str, Any]) -> PageStyle:
        _known(table, [entry.name for entry in fields(cls)], "")
        base = table.get("base", ())
        return cls(
            (base,) if isinstance(base, str) else tuple(base),
            as_color(table["background"], "background") if "background" in table else None,
            {name: as_color(value, f"fills.{name}") for name, value in _table(table, "fills").items()},
            _parts(table, "lines"),
            _parts(table, "dots"),
            _read("labels", _table(table, "labels"), "labels."),
        )

    def __call__(self, page: Page) -> Page:
        """A page in this style."""
        background = page.background if self.background is None else self.background
        return replace(page, background=background, items=tuple(map(self._item, page.items)))

    def _item(self, item: Item) -> Item:
        name = item.name.removeprefix(PREFIX)
        match item:
            case Stroke() | Polylines():
                return replace(item, **self.lines.get(name, {}))
            case Dots():
                return replace(item, **self.dots.get(name, {}))
            case Label():
                return replace(item, **self.labels, on_ground=item.on_ground and "halo_color" not in self.labels)
            case Fill() if name in self.fills:
                return replace(item, color=self.fills[name])
            case Polygons() if name in self.fills and len(item.by_color[0]) == 1:
                return replace(item, colors=np.tile(self.fills[name], (len(item.colors), 1)))
            case _:
                return item


def _table(parts: Mapping[str, Any], name: str, within: str = "") -> Mapping[str, Any]:
    found = parts.get(name, {})
    if not isinstance(found, Mapping):
        raise ValueError(f"{within}{name} is {found!r}, but must be a table, such as [{within}{name}]")
    return found


def _parts(table: Mapping[str, Any], kind: str) -> Mapping[str, Changes]:
    """Tables of changes by the names of the parts."""
    named = _table(table, kind)
    return {name: _read(kind, _table(named, name, f"{kind}."), f"{kind}.{name}.") for name in named}


def _known(given: Mapping[str, Any], keys: list[str], within: str) -> None:
    for key in given:
        if key not in keys:
            raise ValueError(f"{within}{key} is not a key of styles; give {', '.join(keys)}")


def _read(kind: str, given: Mapping[str, Any], within: str) -> Changes:
    readers = READERS[kind]
    _known(given, list(readers), within)
    found = {}
    for key, value in given.items():
        try:
            found[key] = readers[key](value, f"{within}{key}")
        except TypeError as error:
            raise ValueError(str(error)) from error
    return found
