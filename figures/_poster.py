"""What the pictures of real data share: title, credit and legend."""

from dataclasses import replace

from stereodel.drawing import ColorScale, Label, Page

LATITUDE = "authalic"  # areas of cells are those on the ellipsoid


def spaced(number: int) -> str:
    """A number with its thousands apart."""
    return f"{number:,}".replace(",", "\N{NO-BREAK SPACE}")


def captioned(
    page: Page, title: str, subtitle: str, credit: str, *, ink: tuple, above: float = 44.0, below: float = 52.0
) -> Page:
    """A page of globes with a title above and a credit below, in strips of so many points."""
    left, right, bottom, top = page.extent
    point = (right - left) / page.width
    edge, faint = left + 10 * point, (*ink[:3], 0.62)
    texts = (
        Label(title, (edge, top + (above - 24) * point), align="left", valign="baseline", size=17.0, color=ink),
        Label(subtitle, (edge, top + (above - 38) * point), align="left", valign="baseline", size=8.5, color=ink),
        Label(credit, (edge, bottom - (below - 7) * point), align="left", valign="baseline", size=6.0, color=faint),
    )
    extent = (left, right, bottom - below * point, top + above * point)
    return replace(page, extent=extent, items=(*page.items, *texts))


def with_legend(
    page: Page, scale: ColorScale, ticks: dict, title: str, *, ink: tuple, ends: tuple[str, str] | None = None
) -> Page:
    """The same page with a bar of colours in the strip below a caption's globe, and words at its two ends."""
    left, right, bottom, _ = page.extent
    width = right - left
    corner, size = (left + 0.22 * width, bottom + 0.073 * width), (0.56 * width, 0.0136 * width)
    bar = scale.legend(corner, size, ticks, title=title, ink=ink, type_size=8.0)
    middle = corner[1] + size[1] / 2
    words = [
        Label(word, (x, middle), (shift, 0.0), align, "center", size=8.0, color=ink)
        for word, x, shift, align in zip(
            ends or (), (corner[0], corner[0] + size[0]), (-6.0, 6.0), ("right", "left"), strict=False
        )
    ]
    return replace(page, items=(*page.items, *bar, *words))
