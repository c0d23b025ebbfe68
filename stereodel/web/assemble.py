"""Assembly of the page as one file with its script, style, kernel and data, which loads nothing else.

The template is `page.html`, which names its style and its script as files beside it; both, and what `contents`
has, are put in where it names them. Scripts that run when they are first needed are packed as the kernel is. A content
security policy allows these by their hashes and nothing else: whatever comes into the page, from a link or a file that
is dropped on it, no other script runs and nothing is sent anywhere.
"""

from __future__ import annotations

import base64
import hashlib
import json
import os
import re
from collections.abc import Mapping, Sequence
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Final

import numpy.typing as npt

from stereodel._arrays import as_choice, as_lonlat
from stereodel._tasks.whole_files import write_whole
from stereodel.drawing.page.colors import ColorLike
from stereodel.drawing.page.style import LengthLike
from stereodel.drawing.scene.by_value import ScaleLike
from stereodel.sphere.latitudes import KINDS, Latitude
from stereodel.web.contents import RESOLUTIONS, Given, built, contents, packed
from stereodel.web.looks import Looks

POLICY: Final = (
    "default-src 'none'; script-src 'wasm-unsafe-eval' {script}; style-src {style}; img-src data: blob:; "
    "base-uri 'none'; form-action 'none'"
)
"""Images come only from the reader's own files; `wasm-unsafe-eval` allows WebAssembly but not `eval`."""


def web(
    path: str | os.PathLike[str],
    *,
    lonlat: npt.ArrayLike | None = None,
    names: Sequence[str] | None = None,
    name: str = "points",
    resolution: str = "50m",
    latitude: Latitude = "authalic",
    title: str = "",
    source: str = "",
    size: LengthLike | npt.ArrayLike | None = None,
    color: ColorLike | npt.ArrayLike | None = None,
    values: npt.ArrayLike | None = None,
    scale: ScaleLike | None = None,
    legend: str = "",
    size_legend: str = "",
) -> Path:
    """Write the interactive page with the sphere, the lift and the globe, for any browser.

    It is one file that needs no server, network or library, and sends no data. With points it opens on the globe, whose
    lens and view are fitted to them.

    Parameters
    ----------
    path : path-like
        File to write, .html; an existing file is replaced.
    lonlat : (n, 2) array_like, optional
        Longitude and latitude in degrees of initial points, at most a million, stored exactly.
    names : sequence of str, optional
        Names of the points, one each, for the globe and the tables of the page.
    name : str
        Name of these points on the page, such as that of their file.
    resolution : {"50m", "110m"}
        Land at 1 : 50 or 1 : 110 million. The latter makes the page 0.1 MB smaller.
    latitude : {"spherical", "geodetic", "authalic"}, optional
        As in `lonlat_to_xyz`, of these points and of files that are opened on the page: its cells and their areas are
        those of `SphericalVoronoi.from_lonlat`. By default areas are those of the ellipsoid, as of ``stereodel
        voronoi``.
    title, source : str
        Heading of the globe, and the line below it that says where the data come from, on the page and in its pictures.
    size, color, values, scale, legend, size_legend
        Sizes and colours of the points on the globe, all alike or by value, and titles of their scales in the legend,
        with their units; as for `stereodel.globe.Globe.add_points`. The page fills cells and draws isolines by the same
        values. Pixels of CSS are 3/4 points.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError
        If a latitude is outside [−90, 90], there are more than a million points, or not as many names, sizes or values
        as points, or `resolution` or `latitude` is unknown, or there are sizes or colours and no points.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     page = web(f"{folder}/cities.html", lonlat=[(10.0, 48.4), (-78.5, -0.2)], name="cities", resolution="110m")
    ...     print(page.name, page.stat().st_size < 500_000)
    cities.html True
    """
    as_choice(resolution, tuple(RESOLUTIONS), "resolution")
    given = None if lonlat is None else Given(as_lonlat(lonlat).reshape(-1, 2), name, names)
    as_choice(latitude, KINDS, "latitude")
    looks = Looks(title, source, size, color, values, scale, legend, size_legend)
    if given is None and looks.said:
        raise ValueError(f"{looks.said[0]} is of points; give lonlat, too")
    own = {} if given is None else looks.blocks(given.lonlat, latitude)
    write_whole(path, html(resolution, given, latitude, own))
    return Path(path)


def html(
    resolution: str,
    given: Given | None = None,
    latitude: Latitude = "authalic",
    own: Mapping[str, str] | None = None,
) -> str:
    """The page as HTML: land at a resolution, optional points, the latitude of places, and what their owner says."""
    script, style = (_inline(built(f"page.{kind}").decode("utf-8")) for kind in ("js", "css"))
    later = {name: built(f"{name}.js") for name in ("exchange", "lift")}  # what files take, and the second room
    sources = [_source(code) for code in (script, *(code.decode("utf-8") for code in later.values()))]
    policy = POLICY.format(script=" ".join(sources), style=_source(style))
    carried = contents(resolution, given, latitude=latitude) | dict(own or {})
    carried |= {name: packed(code) for name, code in later.items()}
    scripts = [f'<script type="text/plain" id="block-{name}">{text}</script>' for name, text in carried.items()]
    scripts.append(f"<script>{script}</script>")
    page = template()
    # The template has these once each, the encoding first: the policy precedes the style.
    said = f'<meta charset="utf-8">\n<meta http-equiv="Content-Security-Policy" content="{policy}">'
    for place, part in (
        (r'<meta charset="utf-8"\s*/?>', said),
        (r'<link rel="stylesheet" href="page\.css"\s*/?>', f"<style>{style}</style>"),
        (r'<script(?: type="module"| defer)? src="page\.js"></script>', "\n".join(scripts)),
    ):
        if len(pieces := re.split(place, page)) != 2:
            raise ValueError("the template of the page must name its encoding, page.css and page.js, each once")
        page = part.join(pieces)
    return page


def template() -> str:
    """What is on the page, and where its style and its script belong."""
    return resources.files("stereodel.web").joinpath("page.html").read_text(encoding="utf-8")


@cache
def module(resolution: str) -> str:
    """The script of the widget, with its contents as a constant."""
    return f"const CONTENTS = {json.dumps(contents(resolution, latitude=None))};\n{built('widget.js').decode('utf-8')}"


def _inline(code: str) -> str:
    r"""Code that is safe inside an element: nothing in it ends a script or style, or begins an HTML comment.

    Examples
    --------
    >>> _inline('write("</script>")')
    'write("<\\/script>")'
    """
    return re.sub(r"<(?=/(?:script|style)|!--)", r"<\\", code, flags=re.IGNORECASE)


def _source(code: str) -> str:
    """The source expression that allows code in a content security policy."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(code.encode('utf-8')).digest()).decode('ascii')}'"
