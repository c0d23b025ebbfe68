"""Write the type stub of the kernel, or check that it is the one that the compiled kernel gives.

python tools/kernel_stub.py [--check]
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STUB = ROOT / "stereodel" / "_kernel.pyi"


def generated() -> str:
    """The stub as nanobind writes it, formatted like other code."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / STUB.name
        write = ["nanobind.stubgen", "-q", "-m", "stereodel._kernel", "-o", str(path)]
        for command in (write, ["ruff", "format", "-q", "--config", str(ROOT / "pyproject.toml"), str(path)]):
            subprocess.run([sys.executable, "-m", *command], check=True)
        return path.read_text(encoding="utf-8")


def main(*options: str) -> int:
    """Write or check, and return the exit code."""
    text = generated()
    if options != ("--check",):
        STUB.write_text(text, encoding="utf-8")
        return 0
    if STUB.is_file() and STUB.read_text(encoding="utf-8") == text:
        print(f"{STUB.name} is that of the kernel")
        return 0
    print(f"{STUB.name} is not that of the kernel: run make stub", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
