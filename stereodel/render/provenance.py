"""Dependencies of every picture besides its description: the library itself, and the libraries that draw."""

from __future__ import annotations

import hashlib
import json
import os
import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Final

from stereodel import _kernel
from stereodel.render.gl import VARIABLE

LIBRARIES: Final = (
    "numpy",
    "scipy",
    "matplotlib",
    "mapbox_earcut",
    "trimesh",
    "imageio",
    "av",
    "pillow",
    "pyrender2",
    "PyOpenGL",
)
"""Distributions whose version can change a picture."""

NOT_DRAWN_WITH: Final = ("cli", "_doctor.py", "__main__.py")
"""Modules and packages of the library that no picture depends on."""


NOT_INSTALLED: Final = "not installed"
"""Version of a missing distribution."""


def library_versions() -> dict[str, str]:
    """Version of Python and of every library that a picture depends on."""
    return {"python": platform.python_version(), **{name: library_version(name) for name in LIBRARIES}}


def library_version(name: str) -> str:
    """Version of an installed distribution, or that it is missing."""
    try:
        return version(name)
    except PackageNotFoundError:
        return NOT_INSTALLED


def library_digest() -> bytes:
    """SHA-256 of the library's modules, its kernel and data, the versions of others, and the renderer asked for."""
    library = Path(__file__).resolve().parent.parent
    skipped = {library / name for name in NOT_DRAWN_WITH}
    files = [path for path in sorted(library.rglob("*.py")) if skipped.isdisjoint((path, *path.parents))]
    files += [Path(_kernel.__file__), library / "data" / "sources.json"]  # with the checksums of the real data
    digest = hashlib.sha256(json.dumps(library_versions()).encode())
    digest.update(f"{os.environ.get(VARIABLE, '')} {os.environ.get('PYOPENGL_PLATFORM', '')}".encode())
    for path in files:
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.digest()
