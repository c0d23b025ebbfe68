"""Write the type stubs of the kernel, or check that they are those that the compiled kernel gives.

python tools/kernel_stub.py [--check]
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STUBS = ROOT / "stereodel" / "_kernel"
"""A folder, as the kernel has submodules; Python takes the compiled module, which is no folder."""
KEPT = "space.pyi"
"""What plane and sphere have in common, written by hand: mypy compares both with it in `stereodel._spaces`."""


def generated() -> dict[str, str]:
    """The stubs as nanobind writes them, formatted like other code, by the name of the file."""
    with tempfile.TemporaryDirectory() as folder:
        _run("nanobind.stubgen", "-q", "-r", "-m", "stereodel._kernel", "-O", folder)
        _run("ruff", "format", "-q", "--config", str(ROOT / "pyproject.toml"), folder)
        return read(Path(folder))


def _run(module: str, *arguments: str) -> None:
    subprocess.run([sys.executable, "-m", module, *arguments], check=True)


def read(folder: Path) -> dict[str, str]:
    """Stubs in a folder and below it by their names, but for what is kept by hand."""
    return {path.name: path.read_text(encoding="utf-8") for path in folder.rglob("*.pyi") if path.name != KEPT}


def main(*options: str) -> None:
    """Write, or check; end with 1 where they differ."""
    stubs = generated()
    if options != ("--check",):
        STUBS.mkdir(exist_ok=True)
        for name, text in stubs.items():
            (STUBS / name).write_text(text, encoding="utf-8")
        for old in set(read(STUBS)) - set(stubs):
            (STUBS / old).unlink()
    elif read(STUBS) != stubs:
        sys.exit("the stubs in stereodel/_kernel are not those of the kernel: run make stub")
    else:
        print("the stubs are those of the kernel")


if __name__ == "__main__":
    main(*sys.argv[1:])
