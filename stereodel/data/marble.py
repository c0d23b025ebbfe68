"""A picture of the whole Earth from space."""

from __future__ import annotations

import io
from functools import cache

import numpy as np

from stereodel._arrays import Pixels, locked
from stereodel._extras import of_extra
from stereodel.data import stored


@cache
def blue_marble() -> Pixels:
    """The Earth without clouds, in a northern winter: NASA's Blue Marble, Next Generation, with the sea floor's relief.

    Returns
    -------
    (1024, 2048, 3) array of uint8
        Red, green, blue on an equirectangular map: rows from north to south, columns from 180° W to 180° E; pixel
        (i, j) covers latitudes from 90° − i · 180°/1024 down and longitudes from j · 360°/2048 − 180° on. Pixels are
        those that the installed pillow decodes from a JPEG file.

    Examples
    --------
    >>> picture = blue_marble()
    >>> picture.shape
    (1024, 2048, 3)
    >>> red, green, blue = picture[512, 0].tolist()  # the Pacific
    >>> blue > 2 * red
    True
    """
    with of_extra("draw"):
        from PIL import Image

    with Image.open(io.BytesIO(stored.read("blue_marble"))) as picture:
        return locked(np.asarray(picture.convert("RGB")).copy())
