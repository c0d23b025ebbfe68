"""Print the least versions of what the library and its extras need, as pip's requirements: ``numpy==2.0``.

    python tools/lowest.py

pip takes the newest version that is allowed and has no option for the oldest; what these need in turn is left to it.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

PYPROJECT = Path(__file__).resolve().parent.parent / "pyproject.toml"
REQUIREMENT = re.compile(r"([\w-]+)(?:\[([\w,]+)\]|>=([\w.]+))")


def lowest(project: Mapping[str, Any], extra: str) -> dict[str, str]:
    """Least versions by name, of the dependencies and of an extra with those that it includes."""
    found = {}
    for line in [*project["dependencies"], *project["optional-dependencies"][extra]]:
        name, included, version = REQUIREMENT.fullmatch(line).groups()
        if included:
            found |= {key: least for each in included.split(",") for key, least in lowest(project, each).items()}
        else:
            found[name] = version
    return found


if __name__ == "__main__":
    project = tomllib.loads(PYPROJECT.read_text(encoding="utf-8"))["project"]
    least = lowest(project, "all") | lowest(project, "vtk")
    print(*(f"{name}=={least[name]}" for name in sorted(least)), sep="\n")
