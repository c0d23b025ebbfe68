"""Ask the validator of the Khronos Group what is wrong with glTF files.

    python -m tools.gltf FILE…

It is a program of Node, which `tools/gltf_validator.sh` installs into the environment of the tests.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

SEVERITIES: Final = ("error", "warning", "information", "hint")
"""Of an issue, by its number."""

HERE: Final = Path(__file__).resolve().parent


class ValidatorError(Exception):
    """The validator is missing or could not run: said in one line."""


def issues(files: Sequence[Path], prefix: Path = Path(sys.prefix)) -> list[list[str]]:
    """Of each file what is wrong, the gravest first: "error ACCESSOR_…: …, at /meshes/0".

    Parameters
    ----------
    files : sequence of Path
    prefix : Path
        The environment that has the validator.

    Raises
    ------
    ValidatorError
        If the validator is not there, or fails.
    """
    folder = prefix / "gltf"
    node, module = folder / "node", folder / "node_modules" / "gltf-validator"
    if not node.exists() or not module.is_dir():
        raise ValidatorError(f"{folder} holds no validator of glTF; get it with: tools/gltf_validator.sh {prefix}")
    command = [str(node), str(HERE / "gltf_validator.js"), str(module.resolve()), *map(str, files)]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    if ran.returncode:
        raise ValidatorError(f"the validator of glTF failed: {ran.stderr.strip()}")
    reports = json.loads(ran.stdout)
    return [[_told(issue) for issue in sorted(report, key=lambda issue: issue["severity"])] for report in reports]


def _told(issue: dict[str, Any]) -> str:
    where = issue.get("pointer") or "the file"
    return f"{SEVERITIES[issue['severity']]} {issue['code']}: {issue['message']}, at {where}"


def main(arguments: Sequence[str]) -> int:
    """Say what is wrong with files; exit code 0: nothing, 1: something, 2: no validator."""
    files = [Path(name) for name in arguments]
    try:
        found = issues(files)
    except ValidatorError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    for file, lines in zip(files, found, strict=True):
        print(f"{file}: {'; '.join(lines) if lines else 'valid'}")
    return 1 if any(found) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
