"""Colours: accepted forms, their form on pages, sRGB and opacity, and colorimetry.

Contrast is that of the Web Content Accessibility Guidelines 2.1; OKLab is Björn Ottosson's ("A perceptual color space
for image processing", 2020). Arrays of colours (..., 3) hold red, green and blue of sRGB in [0, 1], encoded.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from numbers import Real
from typing import Any, Final, cast

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_floats
from stereodel._extras import of_extra

Color = tuple[float, float, float, float]
"""Red, green, blue, opacity in [0, 1], sRGB, opacity not premultiplied."""

ColorLike = str | Sequence[float] | FloatArray | tuple[str | Sequence[float], float]
"""A colour in any form of matplotlib: "tab:red", "#abc", "0.5", three or four numbers, each also with an opacity."""


def as_color(value: ColorLike, name: str = "color") -> Color:
    """A colour as red, green, blue and opacity.

    Parameters
    ----------
    value : color-like
        Red, green, blue and optionally opacity, each in [0, 1]; or any other form of matplotlib: a name, "#rrggbb", a
        gray such as "0.5", a colour with an opacity. Matplotlib is not loaded for numbers.
    name : str
        Name of the argument, for messages.

    Examples
    --------
    >>> as_color((0.2, 0.4, 0.6)), as_color("#ff000080")[3] == 128 / 255
    ((0.2, 0.4, 0.6, 1.0), True)
    >>> as_color((0.2, 0.4, 255), "ink")
    Traceback (most recent call last):
    ValueError: ink is (0.2, 0.4, 255); red, green, blue and opacity must be in [0, 1]
    """
    given: Any = value
    if isinstance(given, np.ndarray):
        given = tuple(given.tolist()) if given.ndim == 1 else None
    if isinstance(given, tuple | list) and len(given) in (3, 4) and all(isinstance(part, Real) for part in given):
        red, green, blue, opacity = (*map(float, given), 1.0)[:4]
        if not all(0 <= part <= 1 for part in (red, green, blue, opacity)):
            raise ValueError(f"{name} is {value!r}; red, green, blue and opacity must be in [0, 1]")
        return (red, green, blue, opacity)
    with of_extra("draw"):
        from matplotlib.colors import to_rgba

    try:
        red, green, blue, opacity = map(float, to_rgba(given))
    except (ValueError, TypeError):
        kinds = 'give a name such as "tab:red", "#rrggbb", "0.5" or (red, green, blue)'
        raise ValueError(f"{name} is {value!r}, which is not a colour; {kinds}") from None
    return (red, green, blue, opacity)


def as_colors(values: ColorLike | npt.ArrayLike, count: int, name: str = "colors") -> FloatArray:
    """Colours (n, 4) of `count` items, from one for all, or from names or red, green, blue and opacity of each."""
    if isinstance(values, list | tuple) and len(values) and all(isinstance(value, str) for value in values):
        if len(values) != count:
            raise ValueError(f"{name} has {len(values)} colours, but there are {count} items")
        return np.array([as_color(cast(str, value), name) for value in values])
    if isinstance(values, str) or np.ndim(np.asarray(values, dtype=object)) < 2:
        return np.tile(as_color(cast(ColorLike, values), name), (count, 1))
    array = as_floats(cast(npt.ArrayLike, values), name)
    if array.shape not in ((count, 3), (count, 4)):
        raise ValueError(f"{name} must have shape ({count}, 3) or ({count}, 4), got {array.shape}")
    if ((array < 0) | (array > 1)).any():
        raise ValueError(f"{name} must be in [0, 1]; divide numbers of 0 to 255 by 255")
    return np.concatenate([array, np.ones((count, 4 - array.shape[-1]))], axis=1)


def color_map(colors: str | Sequence[ColorLike]) -> Callable[[FloatArray], FloatArray]:
    """Colours (..., 4) of numbers (...) in [0, 1]: a colour map of matplotlib by its name, or a mixture of colours."""
    with of_extra("draw"):
        from matplotlib import colormaps
        from matplotlib.colors import LinearSegmentedColormap

    if not isinstance(colors, str):
        several = [as_color(color, "colors") for color in colors]
        return LinearSegmentedColormap.from_list("colors", several if len(several) > 1 else 2 * several)
    if colors not in colormaps:
        raise ValueError(f"colors is {colors!r}, which is not a colour map of matplotlib; give such a name, or colours")
    return colormaps[colors]


LUMINANCE: Final = np.array([0.2126, 0.7152, 0.0722])
"""Luminances of the primaries of sRGB, relative to white."""

FLARE: Final = 0.05
"""Luminance of the light that a screen reflects, which the definition of contrast adds."""

CONES: Final = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
"""Linear sRGB to cone responses in OKLab."""

OPPONENTS: Final = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)
"""Cube roots of cone responses to OKLab: lightness, green to red, blue to yellow."""


def linear(colors: npt.ArrayLike) -> FloatArray:
    """Linear light (...) of sRGB colours."""
    encoded = np.asarray(colors, dtype=np.float64)
    return np.where(encoded <= 0.04045, encoded / 12.92, (np.maximum(encoded, 0.0) + 0.055) ** 2.4 / 1.055**2.4)


def encoded(light: npt.ArrayLike) -> FloatArray:
    """Linear light (...) as sRGB colours, the inverse of `linear`, clipped to [0, 1]."""
    values = np.clip(np.asarray(light, dtype=np.float64), 0.0, 1.0)
    return np.where(values <= 0.0031308, 12.92 * values, 1.055 * values ** (1 / 2.4) - 0.055)


def luminance(colors: npt.ArrayLike) -> FloatArray:
    """Relative luminance (...) of colours (..., 3): 0 for black, 1 for white."""
    return np.asarray(np.sum(linear(colors) * LUMINANCE, axis=-1))


def contrast(a: npt.ArrayLike, b: npt.ArrayLike) -> FloatArray:
    """Contrast (...) of colours (..., 3), from 1 to 21 for black and white."""
    first, second = luminance(a) + FLARE, luminance(b) + FLARE
    return np.asarray(np.maximum(first, second) / np.minimum(first, second))


def to_oklab(colors: npt.ArrayLike) -> FloatArray:
    """Lightness, green to red and blue to yellow (..., 3) of colours (..., 3)."""
    cones = np.sum(linear(colors)[..., None, :] * CONES, axis=-1)
    return np.asarray(np.sum(np.cbrt(cones)[..., None, :] * OPPONENTS, axis=-1))


def with_luminance(colors: FloatArray, target: FloatArray) -> FloatArray:
    """Colours (n, 3) of the same hue in OKLab, and chroma as far as sRGB has it, with a luminance (n,) in [0, 1]."""
    hue = to_oklab(colors)[:, 1:]
    light = _with_chroma(hue, target)
    low, high = np.zeros(len(hue)), np.ones(len(hue))
    for _ in range(24):  # halvings: to a thousandth of the smallest 8-bit step
        middle = (low + high) / 2
        holds = _displayable(_with_chroma(middle[:, None] * hue, target))
        low, high = np.where(holds, middle, low), np.where(holds, high, middle)
    return encoded(np.where(_displayable(light)[:, None], light, _with_chroma(low[:, None] * hue, target)))


def _displayable(light: FloatArray) -> npt.NDArray[np.bool_]:
    return np.asarray(((light >= 0) & (light <= 1)).all(axis=1))


def _with_chroma(hue: FloatArray, target: FloatArray) -> FloatArray:
    """Linear light (n, 3) of colours with given opponent components (n, 2) and luminance, inside or outside sRGB."""
    from_cones = np.linalg.inv(CONES)
    roots = np.sum(hue[:, None, :] * np.linalg.inv(OPPONENTS)[:, 1:], axis=-1)
    share = np.sum(LUMINANCE[:, None] * from_cones, axis=0)
    lightness = np.cbrt(target)
    for _ in range(8):  # Newton's: within sRGB doubles need at most five
        cones = lightness[:, None] + roots
        slope = 3 * np.sum(share * cones**2, axis=1)
        excess = np.sum(share * cones**3, axis=1) - target
        lightness = lightness - np.where(slope > 0, excess / np.where(slope > 0, slope, 1.0), 0.0)
    cones = (lightness[:, None] + roots) ** 3
    return np.asarray(np.sum(cones[:, None, :] * from_cones, axis=-1))
