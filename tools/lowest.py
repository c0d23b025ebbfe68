"""Print the least versions of what the library and its extras need, as pip's requirements: ``numpy==2.0``.

    python tools/lowest.py

pip takes the newest version that is allowed and has no option for the oldest; what these need in turn is left to it.
"""

from __future__ import annotations

import re
import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

PYPROJECT = Path(__file__).resolve().parent.parent / "pyproject.toml"
REQUIREMENT = re.compile(r"([\w-]+)(?:\[([\w,]+)\])?(?:>=([\w.]+))?")


def lowest(project: Mapping[str, Any], extra: str) -> dict[str, str]:
    """Least versions by name, of the dependencies and of an extra with those that it includes."""
    found = {}
    for line in [*project["dependencies"], *project["optional-dependencies"][extra]]:
        each = REQUIREMENT.fullmatch(line)
        if each is None:
            raise ValueError(f"{PYPROJECT.name}: {line} is not of the form name>=version")
        name, extras, version = each.groups()
        if name == project["name"]:
            found |= {key: least for included in extras.split(",") for key, least in lowest(project, included).items()}
        elif version is None:
            raise ValueError(f"{PYPROJECT.name}: {name} has no least version")
        else:
            found[name] = version
    return found


def main() -> int:
    """Print them and return the exit code."""
    project = tomllib.loads(PYPROJECT.read_text(encoding="utf-8"))["project"]
    print(*(f"{name}=={version}" for name, version in sorted(lowest(project, "all").items())), sep="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
