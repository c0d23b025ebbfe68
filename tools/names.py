"""The tables of docs/names.md: every public name with its signature, the first line of its docstring, and its members.

    python -m tools.names

Between the markers `<!-- names: PACKAGE -->` and `<!-- end -->` the page holds what this writes from the package
itself; around them stands by hand what is promised beyond it. A test compares.
"""

from __future__ import annotations

import importlib
import inspect
import re
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any, Final

import stereodel
from stereodel._tasks.whole_files import write_whole

PAGE: Final = Path(__file__).resolve().parent.parent / "docs" / "names.md"

PACKAGES: Final = tuple(re.findall(r"<!-- names: (\S+) -->", PAGE.read_text(encoding="utf-8")))
"""All that users import from: what has its place on the page."""

LONGEST_DEFAULT: Final = 24
"""Characters of a default that a signature shows; of a longer one it says only that it is there."""

_BLOCK = re.compile(r"<!-- names: (\S+) -->\n.*?<!-- end -->", re.DOTALL)

_ATTRIBUTES = re.compile(r"^Attributes\n-+\n(.*?)(?:\n\n\w+\n-+\n|\Z)", re.MULTILINE | re.DOTALL)


def public_names(module: ModuleType) -> list[str]:
    """The names that a package exports; those of a module without a list are its constants."""
    return list(
        getattr(module, "__all__", None) or (name for name in vars(module) if re.fullmatch(r"[A-Z][A-Z_]*", name))
    )


def signature(value: Any) -> str:
    """The parameters of a class or function, without types, with short defaults; empty for what is not called."""
    if not callable(value) or (inspect.isclass(value) and issubclass(value, Exception)):
        return ""
    given, empty = inspect.signature(value), inspect.Parameter.empty
    parameters = [
        each.replace(annotation=empty, default=empty if each.default is empty else _Shown(each.default))
        for each in given.parameters.values()
    ]
    return str(given.replace(parameters=parameters, return_annotation=empty))


class _Shown:
    """A default as a signature shows it."""

    def __init__(self, value: Any) -> None:
        self._text = repr(value)

    def __repr__(self) -> str:
        plain = self._text.replace("'", '"')
        return plain if len(plain) <= LONGEST_DEFAULT and not plain.startswith("<") else "…"


def first_line(module: ModuleType, name: str) -> str:
    """The first line of an object's docstring, or of the text below a constant."""
    value = getattr(module, name)
    if isinstance(value, int | float | str):
        below = re.search(rf'^{name}: .*\n"""(.*?)(?:"""|$)', inspect.getsource(module), re.MULTILINE)
        return below[1] if below else ""
    return (inspect.getdoc(value) or "").partition("\n")[0]


def members(value: Any) -> list[str]:
    """Public attributes and methods that our classes define, annotate or describe, in alphabetical order."""
    if not inspect.isclass(value):
        return []
    return sorted({name for owner in value.__mro__ for name in _own(owner) if not name.startswith("_")})


def _own(owner: type) -> Iterator[str]:
    if owner.__module__.partition(".")[0] == "stereodel":
        yield from vars(owner)
        yield from inspect.get_annotations(owner)
        section = _ATTRIBUTES.search(inspect.cleandoc(owner.__doc__ or ""))
        for names in re.findall(r"^(\w[\w, ]*)(?: :|$)", section[1] if section else "", re.MULTILINE):
            yield from names.split(", ")


def table(package: str) -> str:
    """The table of a package, a row a name; those that `import stereodel` gives are bold."""
    module = importlib.import_module(package)
    rows = ["| name | |", "|---|---|"]
    for name in public_names(module):
        value = getattr(module, name)
        call = f"`{name}{signature(value)}`"
        call = f"**{call}**" if name in stereodel.__all__ else call
        told = first_line(module, name)
        own = ", ".join(f"`{member}`" for member in members(value))
        text = f"{told}<br>{own}" if own else told
        rows.append("| " + " | ".join(cell.replace("|", r"\|") for cell in (call, text)) + " |")
    return "\n".join(rows)


def filled(text: str) -> str:
    """The page with every table as it is now."""
    return _BLOCK.sub(lambda block: f"<!-- names: {block[1]} -->\n\n{table(block[1])}\n\n<!-- end -->", text)


if __name__ == "__main__":
    write_whole(PAGE, filled(PAGE.read_text(encoding="utf-8")))
