"""Pages on a matplotlib canvas: pictures drawn by Agg, and labels over those drawn by OpenGL."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np

from stereodel._extras import of_extra
from stereodel.constants import PIXEL_ROUNDING
from stereodel.drawing.page import Fill, Label, Page
from stereodel.drawing.page.fonts import face_of, families_of, font_properties, quiet_fonts
from stereodel.drawing.page.items import corners_along
from stereodel.drawing.page.style import TYPE
from stereodel.render.vector.outlines import Drawn, Filled, Shape, Shown, shapes

with of_extra("draw"):
    import matplotlib as mpl
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Canvas
    from matplotlib.image import AxesImage
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path
    from matplotlib.patheffects import withStroke
    from matplotlib.transforms import ScaledTranslation


@contextmanager
def matplotlib_settings() -> Iterator[None]:
    """Matplotlib with its defaults, independent of the user's settings, and with the type of `style`."""
    # rc_context does not restore the backend, so it is excluded.
    settings: dict[Any, Any] = {key: value for key, value in mpl.rcParamsDefault.items() if key != "backend"}
    settings.update(TYPE)
    with mpl.rc_context(settings), quiet_fonts():
        yield


def pixel_grid(page: Page, width_px: int) -> tuple[float, tuple[int, int]]:
    """Pixels per inch of a picture of a page, and its width and height in pixels."""
    return 72.0 * width_px / page.width, (width_px, page.pixels_up(width_px))


def drawn(page: Page, dpi: float, pixels: tuple[int, int] | None = None) -> Canvas:
    """The page on a canvas of its own size, or of a whole number of pixels."""
    width, height = page.width, page.height
    if pixels is not None:  # slightly more, because Agg truncates a size such as 2007.9999999 to 2007
        width, height = ((side + PIXEL_ROUNDING) * 72 / dpi for side in pixels)
    canvas = Canvas(figsize=(width / 72, height / 72), dpi=dpi)
    left, right, bottom, top = page.extent
    axes = canvas.add_axes((0.0, 0.0, 1.0, 1.0), xlim=(left, right), ylim=(bottom, top))
    axes.set_axis_off()
    turned = replace(page, items=tuple(_turned(item) if isinstance(item, Fill) else item for item in page.items))
    for number, shape in enumerate(shapes(turned, dpi, gradients=False)):
        artist = _artist(shape, axes)
        artist.set(zorder=1 + number, snap=False, clip_on=isinstance(artist, AxesImage))
        axes.add_artist(artist)
    for label in page.labels:
        # FreeType rejects type much smaller than a pixel, which would be illegible anyway.
        if pixels is None or label.size * dpi / 72 >= 1:
            _draw_label(axes, label)
    return canvas


def _artist(shape: Shape, axes: Axes) -> PathPatch | AxesImage:
    path = Path(shape.outline.points, shape.outline.kinds)
    match shape:
        case Filled():
            return PathPatch(path, facecolor=shape.color, linewidth=0.0, edgecolor="none")
        case Drawn():
            return PathPatch(
                path,
                fill=False,
                edgecolor=shape.color,
                linewidth=shape.width,
                linestyle=(0.0, shape.dash) if shape.dash else "solid",
                capstyle=shape.cap,
                joinstyle="round",
            )
        case Shown():
            image = AxesImage(axes, extent=shape.extent, origin="upper", interpolation="none")
            image.set_data(shape.pixels)
            image.set(transform=axes.transData)
            image.set_clip_path(path, axes.transData)
            return image


def _turned(fill: Fill) -> Fill:
    """A region with runs oriented so that matplotlib's nonzero rule fills the same as the even-odd rule.

    Runs do not cross, so a run inside an even number of others must be counterclockwise, any other clockwise.
    """
    turned, outlines = [], [corners_along(path) for path in fill.paths]
    for path, corners in zip(fill.paths, outlines, strict=True):
        others = [Path(other) for other in outlines if other is not corners]
        depth = sum(other.contains_point(tuple(path[0, 0])) for other in others)
        x, y = (corners - corners[0]).T
        counterclockwise = float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) > 0
        turned.append(path if counterclockwise == (depth % 2 == 0) else path[::-1, ::-1])
    return replace(fill, paths=tuple(turned))


def _draw_label(axes: Axes, label: Label) -> None:
    shift = ScaledTranslation(label.offset[0] / 72, label.offset[1] / 72, axes.figure.dpi_scale_trans)
    axes.text(
        *label.anchor,
        label.text,
        transform=axes.transData + shift,
        fontproperties=font_properties(families_of(label), label.size, face_of(label.font)),
        parse_math=label.formulas,
        color=label.color,
        ha=label.align,
        va=label.valign,
        rotation=label.rotation,
        rotation_mode="anchor",
        zorder=1e6,
        clip_on=False,
        path_effects=[withStroke(linewidth=2 * label.halo, foreground=label.halo_color)] if label.halo else None,
    )
