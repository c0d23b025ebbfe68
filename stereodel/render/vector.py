"""Pages on paper: SVG and PDF, by matplotlib.

The files hold true curves, have the page's size to the last digit, and carry no date, no version and no random
identifier: the same page always gives the same bytes. Text is outlines in SVG, so that it looks the same everywhere,
and text in PDF, so that it can be searched.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import AbstractContextManager
from itertools import groupby
from pathlib import Path
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray
from stereodel._extras import of_extra
from stereodel._files import replacing
from stereodel.constants import FINEST_POINTS, PIXEL_ROUNDING
from stereodel.curves.fill import union
from stereodel.curves.ragged import Ragged, thinned
from stereodel.drawing.page import (
    Beziers,
    Dots,
    Fill,
    Item,
    Label,
    Page,
    Picture,
    Polygons,
    Polylines,
    Stroke,
)
from stereodel.drawing.style import PRINT_DPI, TYPE
from stereodel.render.mends import exact_mathtext
from stereodel.render.sizes import pixel_height

with of_extra("draw"):
    import matplotlib as mpl
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Canvas
    from matplotlib.image import AxesImage
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path as Outline
    from matplotlib.patheffects import withStroke
    from matplotlib.transforms import ScaledTranslation

CIRCLE_KAPPA = 4 / 3 * np.tan(np.pi / 16)
"""Reach of the controls of a circle drawn as eight cubics, in radii."""

PAPER_DPI: Final = 72.0
"""Dots per inch of a canvas that is written as paths: points."""

STRAIGHTENED: Final = 4
"""How often every other point of a loop is left out where it lies on the line of its neighbours."""

METADATA = {"svg": {"Date": None, "Creator": None}, "pdf": {"CreationDate": None, "Creator": None, "Producer": None}}


Pictures = Sequence[npt.NDArray[np.uint8]]


def save_vector(page: Page, path: str | os.PathLike[str], *, mosaics: Pictures = ()) -> Path:
    """Write a page as SVG or PDF, as the ending of `path` says.

    Parameters
    ----------
    page : Page
    path : path-like
        Written under a temporary name in the same folder first; an existing file is replaced.
    mosaics : sequence of (h, w, 3) uint8 arrays
        A picture of the whole page for each of `page.pictured`, of which the part inside the polygons is shown.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError
        For an ending other than .svg and .pdf, and for another number of pictures than are needed.
    OSError
        Where the file cannot be written.
    """
    target = Path(path)
    kind = target.suffix.lower().lstrip(".")
    if kind not in METADATA:
        raise ValueError(f"path must end in .svg or .pdf, got {target.name!r}")
    with matplotlib_settings(), exact_mathtext():
        canvas = drawn(page, dpi=PAPER_DPI, mosaics=mosaics)
        with replacing(target) as temporary:
            canvas.savefig(temporary, format=kind, metadata=METADATA[kind], facecolor=page.background)
    return target


def matplotlib_settings() -> AbstractContextManager[None]:
    """Matplotlib as it comes, whatever the user has set, with the type of `style`."""
    # rc_context does not give the backend back, so it stays out.
    settings: dict[Any, Any] = {key: value for key, value in mpl.rcParamsDefault.items() if key != "backend"}
    settings.update(TYPE)
    return mpl.rc_context(settings)


def pixel_grid(page: Page, width_px: int) -> tuple[float, tuple[int, int]]:
    """Pixels per inch of a picture of a page, and its width and height in pixels."""
    return 72.0 * width_px / page.width, (width_px, pixel_height(page, width_px))


def drawn(page: Page, dpi: float, pixels: tuple[int, int] | None = None, mosaics: Pictures = ()) -> Canvas:
    """The page on a canvas of its own size, or of whole pixels."""
    width, height = page.width, page.height
    if pixels is not None:  # a little more, because Agg cuts a size such as 2007.9999999 to 2007
        width, height = ((side + PIXEL_ROUNDING) * 72 / dpi for side in pixels)
    canvas = Canvas(figsize=(width / 72, height / 72), dpi=dpi)
    left, right, bottom, top = page.extent
    axes = canvas.add_axes((0.0, 0.0, 1.0, 1.0), xlim=(left, right), ylim=(bottom, top))
    axes.set_axis_off()
    names: Counter[str] = Counter()
    for number, artist in enumerate(_artists(page, axes, mosaics)):
        name = artist.get_gid() or "item"
        names[name] += 1
        artist.set(gid=name if names[name] == 1 else f"{name}-{names[name]}", zorder=1 + number, snap=False)
        artist.set_clip_on(isinstance(artist, AxesImage))
        axes.add_artist(artist)
    for label in page.labels:
        # FreeType refuses type much smaller than a pixel, and nobody could read it.
        if pixels is None or label.size * dpi / 72 >= 1:
            _draw_label(axes, label)
    return canvas


def _artists(page: Page, axes: Axes, mosaics: Pictures) -> Iterator[PathPatch | AxesImage]:
    """Page items as patches; neighbours of one look share one, so that a name is a group and files stay small."""
    count = len(page.pictured)
    if len(mosaics) != count:
        raise ValueError(
            f"mosaics has {len(mosaics)} pictures, but {count} items of the page have too many colours; give each one"
        )
    pictures = iter(mosaics)
    for _, group in groupby(page.without_labels().items, key=_look):
        items = list(group)
        match items[0]:
            case Stroke() as first:
                yield _stroke_patch([item for item in items if isinstance(item, Stroke)], first)
            case Polylines() as lines:
                yield _polylines_patch(lines)
            case Polygons() as polygons if polygons.pictured:
                yield _polygons_image(polygons, next(pictures), page, axes)
            case Polygons() as polygons:
                yield from _polygons_patches(polygons, FINEST_POINTS / page.points_per_unit)
            case Fill():
                yield from (_fill_patch(item) for item in items if isinstance(item, Fill))
            case Picture() as picture:
                yield _picture_image(picture, page, axes)
            case Dots():
                scale = page.points_per_unit
                yield from (patch for item in items if isinstance(item, Dots) for patch in _dot_patches(item, scale))


def _look(item: Item) -> tuple[Any, ...]:
    """What neighbours must have in common to be drawn as one; see-through strokes stay apart, as they darken."""
    if isinstance(item, Stroke) and item.color[3] == 1:
        return (Stroke, item.color, item.width, item.dash, item.cap, item.name)
    return (id(item),)


def _stroke_patch(strokes: list[Stroke], look: Stroke) -> PathPatch:
    outline = _outline((stroke.path, stroke.closed) for stroke in strokes)
    dash = (0.0, look.dash) if look.dash else "solid"
    return PathPatch(
        outline,
        fill=False,
        edgecolor=look.color,
        linewidth=look.width,
        linestyle=dash,
        capstyle=look.cap,
        joinstyle="round",
        gid=look.name,
    )


def _polylines_patch(lines: Polylines) -> PathPatch:
    # A point alone is a dot: a piece of no length with round ends.
    alone = np.diff(lines.offsets) == 1
    points = np.insert(lines.points, lines.offsets[:-1][alone], lines.points[lines.offsets[:-1][alone]], axis=0)
    offsets = lines.offsets + np.concatenate([[0], np.cumsum(alone)])
    codes = np.full(len(points), Outline.LINETO)
    codes[offsets[:-1]] = Outline.MOVETO
    starts, ends = offsets[:-1], offsets[1:] - 1
    closed = (points[starts] == points[ends]).all(axis=1) & (ends - starts > 2)
    codes[ends[closed]] = Outline.CLOSEPOLY
    return PathPatch(
        Outline(points, codes),
        fill=False,
        edgecolor=lines.color,
        linewidth=lines.width,
        capstyle="round",
        joinstyle="round",
        gid=lines.name,
    )


def _fill_patch(item: Fill) -> PathPatch:
    outline = _outline((path, True) for path in _oriented(list(item.paths)))
    return PathPatch(outline, facecolor=item.color, linewidth=0.0, edgecolor="none", gid=item.name)


def _polygons_patches(polygons: Polygons, spacing: float) -> Iterator[PathPatch]:
    """A path for each colour."""
    colors, number = polygons.by_color
    for k, color in enumerate(colors):
        loops = thinned_loops(polygons.loops.take(number == k), spacing)
        yield PathPatch(_loops(loops), facecolor=color, linewidth=0.0, edgecolor="none", gid=polygons.name)


def _polygons_image(polygons: Polygons, picture: npt.NDArray[np.uint8], page: Page, axes: Axes) -> AxesImage:
    """The part of a picture of the whole page that lies in polygons."""
    image = AxesImage(axes, extent=page.extent, origin="upper", interpolation="none")
    image.set_data(picture)
    image.set(gid=polygons.name, transform=axes.transData)
    border = thinned_loops(union(polygons.loops), FINEST_POINTS / page.points_per_unit)
    image.set_clip_path(_loops(border), axes.transData)
    return image


def thinned_loops(loops: Ragged, spacing: float) -> Ragged:
    """Loops with at most a point in each piece of a length, and without what then encloses nothing.

    Where points stray from a straight line by less than a twentieth of the length together, they are thinned, too: arcs
    of the limb are very many chords.
    """
    loops = thinned(loops, spacing)
    for _ in range(STRAIGHTENED):
        points, row = loops.values, loops.row
        place = np.arange(len(points)) - loops.offsets[row]
        odd = np.flatnonzero((place % 2 == 1) & (place < loops.sizes[row] - 1))
        a, b = points[odd - 1], points[odd + 1] - points[odd - 1]
        step = points[odd] - a
        across, ahead = np.abs(b[:, 0] * step[:, 1] - b[:, 1] * step[:, 0]), np.sum(step * b, axis=1)
        kept = np.ones(len(points), dtype=bool)
        # The tip of a needle is beyond its neighbours.
        between = (ahead >= 0) & (ahead <= np.sum(b**2, axis=1))
        kept[odd] = ~between | (across >= spacing / (20 * STRAIGHTENED) * np.hypot(*b.T))
        loops = loops.kept(kept)
    return loops.take(loops.sizes > 3)


def _loops(loops: Ragged) -> Outline:
    codes = np.full(len(loops.values), Outline.LINETO)
    codes[loops.offsets[:-1]] = Outline.MOVETO
    codes[loops.offsets[1:] - 1] = Outline.CLOSEPOLY
    return Outline(loops.values, codes)


def _picture_image(picture: Picture, page: Page, axes: Axes) -> AxesImage:
    """A picture on the pixels of the canvas, or of print where that is paper, as far as its outline goes."""
    figure = axes.get_figure()
    dpi = PRINT_DPI if figure is None or figure.dpi == PAPER_DPI else figure.dpi
    side = PAPER_DPI / (dpi * page.points_per_unit)
    corner = np.array([page.extent[0], page.extent[3]])
    points = np.concatenate(picture.outline).reshape(-1, 2)
    # Whole pixels of the page's own grid, so that those of Agg are met one to one.
    cells = (points - corner) / (side, -side)
    (left, top), (right, bottom) = (
        np.floor(cells.min(axis=0) + PIXEL_ROUNDING),
        np.ceil(cells.max(axis=0) - PIXEL_ROUNDING),
    )
    place = (corner[0] + left * side, corner[1] - top * side, side, side)
    extent = (place[0], corner[0] + right * side, corner[1] - bottom * side, place[1])
    image = AxesImage(axes, extent=extent, origin="upper", interpolation="none")
    image.set_data(picture.painter.paint(place, (int(right - left), int(bottom - top))))
    image.set(gid=picture.name, transform=axes.transData)
    image.set_clip_path(_outline((path, True) for path in picture.outline), axes.transData)
    return image


def _dot_patches(dots: Dots, points_per_unit: float) -> Iterator[PathPatch]:
    """A dot is a disc, and a smaller one on top when it has a rim."""
    discs = [(dots.radius, dots.rim if dots.rim_width else dots.color)]
    if dots.rim_width:
        discs.append((dots.radius - dots.rim_width, dots.color))
    for radius, color in discs:
        outline = _outline((_disc(center, radius / points_per_unit), True) for center in dots.centers)
        yield PathPatch(outline, facecolor=color, linewidth=0.0, edgecolor="none", gid=dots.name)


def _disc(center: FloatArray, radius: float) -> Beziers:
    t = np.arange(9) * (np.pi / 4)
    ends = np.stack([np.cos(t), np.sin(t)], axis=1)
    ends[-1] = ends[0]
    reach = CIRCLE_KAPPA * np.stack([-ends[:, 1], ends[:, 0]], axis=1)
    unit = np.stack([ends[:-1], ends[:-1] + reach[:-1], ends[1:] - reach[1:], ends[1:]], axis=1)
    path: Beziers = center + radius * unit
    return path


def _oriented(paths: list[Beziers]) -> list[Beziers]:
    """Runs turned so that the nonzero rule, which is all that matplotlib has, fills what the even-odd rule would.

    Runs do not cross, so a run inside an even number of others must go counterclockwise and any other clockwise.
    """
    turned = []
    for number, path in enumerate(paths):
        others = paths[:number] + paths[number + 1 :]
        depth = sum(_polygon_contains(_corners(other), path[0, 0]) for other in others)
        corners = _corners(path)
        x, y = (corners - corners[0]).T
        counterclockwise = float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) > 0
        turned.append(path if counterclockwise == (depth % 2 == 0) else path[::-1, ::-1])
    return turned


def _corners(path: Beziers) -> FloatArray:
    """Points along a run, close enough to tell its inside from its outside."""
    s = np.linspace(0.0, 1.0, 8, endpoint=False)[None, :, None]
    p0, p1, p2, p3 = (path[:, i, None] for i in range(4))
    points = (1 - s) ** 3 * p0 + 3 * s * (1 - s) ** 2 * p1 + 3 * s**2 * (1 - s) * p2 + s**3 * p3
    return points.reshape(-1, 2)


def _polygon_contains(corners: FloatArray, point: FloatArray) -> bool:
    return bool(Outline(corners).contains_point((point[0], point[1])))


def _outline(runs: Iterable[tuple[Beziers, bool]]) -> Outline:
    """Runs of Béziers as one compound path; straight pieces become straight lines."""
    vertices: list[FloatArray] = []
    codes: list[np.uint8] = []
    for path, closed in runs:
        vertices.append(path[:1, 0])
        codes.append(Outline.MOVETO)
        thirds = path[:, :1] + np.array([[[1 / 3], [2 / 3]]]) * (path[:, 3:] - path[:, :1])
        close: npt.NDArray[np.bool_] = np.isclose(path[:, 1:3], thirds, atol=0)
        for piece, straight in zip(path, np.logical_and.reduce(close, axis=(1, 2)), strict=True):
            vertices.append(piece[3:] if straight else piece[1:])
            codes += [Outline.LINETO] if straight else [Outline.CURVE4] * 3
        if closed:
            vertices.append(path[:1, 0])
            codes.append(Outline.CLOSEPOLY)
    return Outline(np.concatenate(vertices), codes)


def _draw_label(axes: Axes, label: Label) -> None:
    shift = ScaledTranslation(label.offset[0] / 72, label.offset[1] / 72, axes.figure.dpi_scale_trans)
    axes.text(
        *label.anchor,
        label.text,
        transform=axes.transData + shift,
        fontsize=label.size,
        color=label.color,
        ha=label.align,
        va=label.valign,
        rotation=label.rotation,
        rotation_mode="anchor",
        zorder=1e6,
        gid=label.name,
        clip_on=False,
        path_effects=[withStroke(linewidth=2 * label.halo, foreground=label.halo_color)] if label.halo else None,
    )
