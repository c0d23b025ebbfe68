"""Who takes part: stereodel and its peers, how each is started, what each delivers."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from stereodel.drawing.page.colors import Color
from stereodel.drawing.page.style import BLACK, BLUE, GRAY, GREEN, ORANGE, SKY, VERMILION

HERE = Path(__file__).resolve().parent
PEERS = HERE / ".peers"


@dataclass(frozen=True)
class Contender:
    """One engine of the comparison.

    `key` names it in the results, `package` in the list of what could not be installed; `delivers` says what is
    finished when its time stops.
    """

    key: str
    label: str
    package: str
    command: Callable[[str], list[str]]
    delivers: str
    color: Color
    exact: str = "no"

    @property
    def missing(self) -> str | None:
        """Why it cannot run, or None."""
        listed = PEERS / "missing.txt"
        if self.package == "stereodel":
            return None
        if not listed.exists():
            return "not installed: run benchmarks/install_peers.sh"
        reasons = dict(line.split("\t", 1) for line in listed.read_text(encoding="utf-8").splitlines())
        return reasons.get(self.package)

    @property
    def ours(self) -> bool:
        """Whether it is stereodel."""
        return self.package == "stereodel"


def stereodel(space: str, workers: int, more: str | None = None) -> Callable[[str], list[str]]:
    """How to start stereodel with a number of threads; `more` is a file of points to insert or to ask about."""
    script = str(HERE / "peers" / "stereodel_worker.py")
    return lambda file: [sys.executable, script, space, str(workers), file, *([more] if more else [])]


def _compiled(name: str) -> Callable[[str], list[str]]:
    return lambda file: [str(PEERS / "bin" / name), file]


def _python(environment: str, name: str) -> Callable[[str], list[str]]:
    program, script = str(PEERS / environment / "bin" / "python"), str(HERE / "peers" / "python_peer.py")
    return lambda file: [program, script, name, file]


def _node(name: str) -> Callable[[str], list[str]]:
    script = str(HERE / "peers" / "node_peer.mjs")
    return lambda file: [shutil.which("node") or "node", "--max-old-space-size=8192", script, name, file]


def _ours(space: str) -> tuple[Contender, Contender]:
    done = "triangles and neighbours as arrays, checked input, duplicates listed"
    threads = ((1, "one thread", BLUE), (2, "two threads", SKY))
    one, two = (
        Contender(f"ours {n}", f"stereodel, {words}", "stereodel", stereodel(space, n), done, color, "yes")
        for n, words, color in threads
    )
    return one, two


PLANE = (
    *_ours("plane"),
    Contender(
        "cgal", "CGAL", "cgal", _compiled("cgal_plane"), "linked triangles, exact predicates (EPICK)", VERMILION, "yes"
    ),
    Contender("triangular", "triangular", "triangular", _python("python312", "triangular"), "triangles", ORANGE, "yes"),
    Contender(
        "triangle", "Triangle", "triangle", _python("python", "triangle"), "triangles and neighbours", GREEN, "yes"
    ),
    Contender(
        "delaunator", "Delaunator", "delaunator", _node("delaunator"), "triangles and half-edges", BLACK, "partly"
    ),
    Contender("scipy", "SciPy (Qhull)", "scipy", _python("python", "scipy"), "triangles and neighbours", GRAY),
)

SPHERE = (
    *_ours("sphere"),
    Contender(
        "cgal",
        "CGAL on sphere",
        "cgal",
        _compiled("cgal_sphere"),
        "linked triangles, plain traits",
        VERMILION,
        "partly",
    ),
    Contender(
        "projecting",
        "CGAL, projecting traits",
        "cgal",
        _compiled("cgal_sphere_projecting"),
        "linked triangles, projecting traits",
        ORANGE,
        "partly",
    ),
    Contender(
        "stripy", "stripy (STRIPACK)", "stripy", _python("python_numpy1", "stripy"), "triangles, adjacency", GREEN
    ),
    Contender(
        "d3", "d3-geo-voronoi", "d3-geo-voronoi", _node("d3-geo-voronoi"), "triangles, edges, neighbours, cells", BLACK
    ),
    Contender(
        "scipy",
        "SciPy ConvexHull",
        "scipy",
        _python("python", "scipy_hull"),
        "triangles and neighbours, unoriented",
        GRAY,
    ),
)

CONTENDERS = {"plane": PLANE, "sphere": SPHERE}


def contenders(space: str, *keys: str) -> list[Contender]:
    """Those of a space that can run; all, or those named."""
    return [c for c in CONTENDERS[space] if c.missing is None and (not keys or c.key in keys)]
