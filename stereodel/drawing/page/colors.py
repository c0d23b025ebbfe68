"""Colours: accepted forms, and their form on pages, sRGB and opacity."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from numbers import Real
from typing import Any, cast

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

    Returns
    -------
    tuple of four floats
        Red, green, blue, opacity.

    Raises
    ------
    ValueError
        If the colour is invalid, or a number is outside [0, 1].

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
    """Colours (n, 4) of `count` items, from one for all or from red, green, blue and optionally opacity of each.

    ValueError if a colour is invalid, a number is outside [0, 1], or the number of colours differs from that of items.
    """
    if isinstance(values, str) or np.ndim(np.asarray(values, dtype=object)) < 2:
        return np.tile(as_color(cast(ColorLike, values), name), (count, 1))
    array = as_floats(cast(npt.ArrayLike, values), name)
    if array.shape not in ((count, 3), (count, 4)):
        raise ValueError(f"{name} must have shape ({count}, 3) or ({count}, 4), got {array.shape}")
    if ((array < 0) | (array > 1)).any():
        raise ValueError(f"{name} must be in [0, 1]; divide numbers of 0 to 255 by 255")
    return np.concatenate([array, np.ones((count, 4 - array.shape[-1]))], axis=1)


def color_map(name: str) -> Callable[[FloatArray], FloatArray]:
    """A colour map of matplotlib: numbers (...) in [0, 1] to colours (..., 4); ValueError for unknown names."""
    with of_extra("draw"):
        from matplotlib import colormaps

    if name not in colormaps:
        raise ValueError(f"name is {name!r}, which is not a colour map of matplotlib")
    return colormaps[name]
