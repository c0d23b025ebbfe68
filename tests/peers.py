"""The neighbours' lines of the pages `docs/from`, run with the neighbours: `make peers` installs and asks them.

No file of pytest's by its name, as `make test` has no neighbours: `python -m pytest tests/peers.py`.
"""

import shutil
import subprocess
from pathlib import Path

import pytest

from tests.test_neighbours import sections

PEERS = Path(__file__).resolve().parent.parent / "benchmarks" / ".peers"
NEXT = "-- next --"


def python_of(environment):
    return lambda code, folder: ([PEERS / environment / "bin" / "python", "-c", code], f"print({NEXT!r})")


def node(code, folder):
    (folder / "node_modules").symlink_to(PEERS / "node" / "node_modules")
    (folder / "lines.mjs").write_text(code, encoding="utf-8")
    return ["node", "lines.mjs"], f"console.log({NEXT!r});"


def compiled(code, folder):
    """Lines of C++ are those of one function; what they include and name stands before it."""
    head, body = [], []
    for line in code.splitlines():
        (head if line.startswith(("#include", "using ", "typedef ")) else body).append(line)
    (folder / "lines.cpp").write_text("\n".join([*head, "int main() {", *body, "}"]), encoding="utf-8")
    if code:
        build = ["g++", "-std=c++17", "-O1", "-frounding-math", "lines.cpp", "-o", "lines", "-lgmp", "-lmpfr"]
        subprocess.run(build, cwd=folder, check=True)
    return ["./lines"], f'std::cout << "{NEXT}\\n";'


RUNS = {
    "scipy": python_of("python"),
    "stripy": python_of("python_numpy1"),
    "cartopy": python_of("cartopy"),
    "d3_geo_voronoi": node,
    "gmt": lambda code, folder: (["bash", "-euc", code], f"echo '{NEXT}'"),
    "cgal": compiled,
}
"""How the neighbour's lines are run, where `benchmarks/install_peers.sh` can install it. ESMF comes by no index."""


@pytest.mark.parametrize("page", RUNS)
def test_the_neighbours_lines_print_the_same(page, tmp_path):
    both = [(title, theirs[1], printed) for title, theirs, _, printed in sections(page) if theirs]
    (scratch := tmp_path / "scratch").mkdir()
    _, separator = RUNS[page]("", scratch)
    shutil.rmtree(scratch)
    command, _ = RUNS[page](f"\n{separator}\n".join(code for _, code, _ in both), tmp_path)
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    said = [part.strip("\n") for part in ran.stdout.split(NEXT)]
    assert [*zip([title for title, _, _ in both], said, strict=True)] == [
        (title, printed.strip("\n")) for title, _, printed in both
    ]
