"""Who takes part: stereodel and its peers, how each is started, what each delivers."""

from __future__ import annotations

import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

from stereodel.drawing.page.colors import Color
from stereodel.drawing.page.style import BLACK, BLUE, GRAY, GREEN, ORANGE, SKY, VERMILION

HERE = Path(__file__).resolve().parent
PEERS = HERE / ".peers"


@dataclass(frozen=True)
class Contender:
    """One engine of the comparison.

    `key` names it in the results, `package` in the list of what could not be installed; `command` takes a file of
    points as its last word; `delivers` says what is finished when its time stops.
    """

    key: str
    label: str
    package: str
    command: tuple[str, ...]
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


def stereodel(space: str, workers: int) -> tuple[str, ...]:
    """Stereodel with a number of threads; after the file of points may come one of points to insert or to ask about."""
    return sys.executable, str(HERE / "peers" / "stereodel_worker.py"), space, str(workers)


def _compiled(name: str) -> tuple[str, ...]:
    return (str(PEERS / "bin" / name),)


def _python(environment: str, name: str) -> tuple[str, ...]:
    return str(PEERS / environment / "bin" / "python"), str(HERE / "peers" / "python_peer.py"), name


def _node(name: str) -> tuple[str, ...]:
    return shutil.which("node") or "node", "--max-old-space-size=8192", str(HERE / "peers" / "node_peer.mjs"), name


def _ours(space: str, workers: int, words: str, color: Color) -> Contender:
    done = "triangles and neighbours as arrays, checked input, duplicates listed"
    command = stereodel(space, workers)
    return Contender(f"ours {workers}", f"stereodel, {words}", "stereodel", command, done, color, "yes")


TRIANGULAR = _python("python312", "triangular")
DELAUNATOR, D3 = _node("delaunator"), _node("d3-geo-voronoi")
TRIANGLE, STRIPY = _python("python", "triangle"), _python("python_numpy1", "stripy")
PLANAR, HULL = _python("python", "scipy"), _python("python", "scipy_hull")
PLAIN, PROJECTING = _compiled("cgal_sphere"), _compiled("cgal_sphere_projecting")
BOTH, LINKED = "triangles and neighbours", "linked triangles, exact predicates (EPICK)"

PLANE = (
    _ours("plane", 1, "one thread", BLUE),
    _ours("plane", 2, "two threads", SKY),
    Contender("cgal", "CGAL", "cgal", _compiled("cgal_plane"), LINKED, VERMILION, "yes"),
    Contender("triangular", "triangular", "triangular", TRIANGULAR, "triangles", ORANGE, "yes"),
    Contender("triangle", "Triangle", "triangle", TRIANGLE, BOTH, GREEN, "yes"),
    Contender("delaunator", "Delaunator", "delaunator", DELAUNATOR, "triangles and half-edges", BLACK, "partly"),
    Contender("scipy", "SciPy (Qhull)", "scipy", PLANAR, BOTH, GRAY),
)  # fmt: skip

SPHERE = (
    _ours("sphere", 1, "one thread", BLUE),
    _ours("sphere", 2, "two threads", SKY),
    Contender("cgal", "CGAL on sphere", "cgal", PLAIN, "linked triangles, plain traits", VERMILION, "partly"),
    Contender(
        "projecting", "CGAL, projecting traits", "cgal", PROJECTING,
        "linked triangles, projecting traits", ORANGE, "partly",
    ),
    Contender("stripy", "stripy (STRIPACK)", "stripy", STRIPY, "triangles, adjacency", GREEN),
    Contender("d3", "d3-geo-voronoi", "d3-geo-voronoi", D3, "triangles, edges, neighbours, cells", BLACK),
    Contender("scipy", "SciPy ConvexHull", "scipy", HULL, f"{BOTH}, unoriented", GRAY),
)  # fmt: skip

CONTENDERS = {"plane": PLANE, "sphere": SPHERE}


def contenders(space: str, *keys: str) -> list[Contender]:
    """Those of a space that can run; all, or those named."""
    return [c for c in CONTENDERS[space] if c.missing is None and (not keys or c.key in keys)]
