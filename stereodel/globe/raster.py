"""Equirectangular images of the globe, drawn through a lens and a view."""

from __future__ import annotations

import os
import struct
import warnings
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass
from functools import cache, cached_property
from typing import Any, Final, Literal

import numpy as np

from stereodel import _kernel
from stereodel._arrays import FloatArray, Pixels, as_choice, as_count, as_edges, as_pixels, as_scalar, locked
from stereodel._extras import of_extra
from stereodel._notebook import Displayed
from stereodel._tasks.threads import thread_count
from stereodel.conformal import MoebiusMap
from stereodel.constants import MOST_PIXELS_ACROSS, MOST_TEXELS
from stereodel.curves.chart import Chart
from stereodel.curves.view import MapView, View
from stereodel.sphere import lonlat_to_xyz, xyz_to_lonlat
from stereodel.sphere.latitudes import KINDS, Latitude
from stereodel.sphere.vectors import turned

WHOLE = (-180.0, -90.0, 180.0, 90.0)

PanoramaForm = Literal["equirectangular", "cubemap", "planet"]

SHARES: Final[Mapping[PanoramaForm, int]] = {"equirectangular": 1, "cubemap": 4, "planet": 2}
"""Divisor of the panorama's width that gives the default width of each form."""

PLANET_RADIUS: Final = 140.0
"""Default angular radius of a little planet in degrees: the horizon is a circle about a third as wide as the image."""

FACES: Final[Mapping[str, FloatArray]] = {
    "right": np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]),
    "left": np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]),
    "up": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]),
    "down": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]),
    "front": np.eye(3),
    "back": np.array([[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]),
}
"""Faces of a cubemap in order: right, up and forward of each, as rows, in the axes of the front face."""

FORMATS: Final = ("PNG", "JPEG", "TIFF", "WEBP", "GIF", "BMP", "PPM", "TGA", "JPEG2000")
"""Formats that are opened: those that Pillow decodes itself. For others it starts programs such as Ghostscript."""

DAMAGED: Final = (OSError, SyntaxError, ValueError, EOFError, struct.error, IndexError, TypeError)
"""Exceptions that Pillow's decoders raise on truncated or corrupt files."""


def panorama_sides(form: PanoramaForm, size: int | None, whole: int) -> tuple[int, int]:
    """Columns and rows of what `Raster.panorama` draws, of a cubemap those of its faces in a row.

    `whole` is the width of an image of all directions at the same resolution, for which there is a default.
    """
    as_choice(form, tuple(SHARES), "form")
    usual = whole + whole % 2 if form == "equirectangular" else max(1, whole // SHARES[form])
    width = as_count(usual if size is None else size, "size")
    if form == "equirectangular" and width % 2:
        raise ValueError(f"size is {width}, but an equirectangular panorama is twice as wide as high; give an even one")
    sides = {"equirectangular": (width, width // 2), "cubemap": (6 * width, width), "planet": (width, width)}[form]
    if (count := sides[0] * sides[1]) > MOST_TEXELS:
        raise ValueError(f"size is {width}, which makes {count} pixels of its {form}; at most {MOST_TEXELS} are drawn")
    return sides


def read_photo(path: str | os.PathLike[str]) -> tuple[Pixels, bytes]:
    """The first image of a file, (h, w, 4), rotated upright by its EXIF data, and the ICC profile of its colours.

    Opacity is not premultiplied; the profile is empty for sRGB. OSError if the file cannot be read; ValueError if it is
    not an image, has more than `MOST_TEXELS` pixels, which is checked before decoding, or is damaged.
    """
    with of_extra("draw"):
        from PIL import Image, ImageOps, UnidentifiedImageError

    name = os.fspath(path)
    # Pillow warns at half the size that it refuses, which exceeds our own limit.
    with open(name, "rb") as file, warnings.catch_warnings():
        warnings.simplefilter("ignore", Image.DecompressionBombWarning)
        try:
            with Image.open(file, formats=FORMATS) as image:
                if image.width * image.height > MOST_TEXELS:
                    raise Image.DecompressionBombError
                boxes = [tile[1] or (0, 0, 0, 0) for tile in image.tile]
                covered = sum((right - left) * (low - top) for left, top, right, low in boxes)
                if image.format == "TIFF" and covered < image.width * image.height:
                    raise EOFError("it has pixels of a part of its size alone")
                image.load()
                ImageOps.exif_transpose(image, in_place=True)
        except UnidentifiedImageError as error:
            raise ValueError(f"{name} is not a picture of a kind that is read: {', '.join(FORMATS)}") from error
        except Image.DecompressionBombError as error:
            raise ValueError(f"{name} has too many pixels: at most {MOST_TEXELS} are read; make it smaller") from error
        except DAMAGED as error:
            raise ValueError(f"{name} is damaged or cut off: {error}") from error
        # Profiles for gray or printing inks do not apply to the converted pixels.
        profile = image.info.get("icc_profile") if image.mode in ("RGB", "RGBA", "P") else None
        return _converted(name, image), profile or b""


def _converted(name: str, image: Any) -> Pixels:
    if image.mode not in ("F", "I", "I;16", "I;16B", "I;16L", "I;16N"):
        return np.asarray(image.convert("RGBA"))
    gray = np.asarray(image)
    wrong = "floating-point numbers" if image.mode == "F" else "numbers beyond 16 bits"
    if image.mode == "F" or gray.max(initial=0) > 65535 or gray.min(initial=0) < 0:
        raise ValueError(f"{name} holds {wrong}; scale them to 0 to 255 and give them as an array")
    levels = ((gray.astype(np.uint32) + 128) // 257).astype(np.uint8)
    return np.dstack([levels, levels, levels, np.full_like(levels, 255)])


@dataclass(frozen=True, eq=False)
class Raster(Displayed):
    """An equirectangular image of the Earth or part of it.

    Parameters
    ----------
    pixels : array_like of uint8, shape (h, w), (h, w, 3) or (h, w, 4)
        Gray, sRGB, or sRGB with opacity (not premultiplied); rows from north to south, columns from west to east. At
        most `MOST_TEXELS` pixels.
    bounds : tuple of float, optional
        (west, south, east, north) of the outer edges in degrees, 0 < east − west ≤ 360. Without it the image covers the
        whole globe from −180 to 180 and must be twice as wide as high.
    latitude : {"spherical", "geodetic", "authalic"}
        Kind of latitude of rows and bounds; see `stereodel.lonlat_to_xyz`.

    Notes
    -----
    Row i is centred at latitude north − (i + 1/2)·(north − south)/h; columns likewise in longitude. A raster that spans
    360° has no seam, and one that reaches a pole continues beyond it along the opposite meridian.

    Where the image shrinks, `warp` averages the raster over the area of each pixel, so films do not flicker. Where it
    grows, the raster is interpolated by cubic convolution (Catmull and Rom), which is sharp and overshoots at edges by
    at most a fourteenth, clipped to 0 and 255. Averages are taken of sRGB values directly, as everywhere in
    `stereodel.render`.

    Examples
    --------
    >>> from stereodel.drawing import View
    >>> stripes = Raster(np.arange(0, 240, 20, dtype=np.uint8)[None, :].repeat(6, axis=0))
    >>> picture = stripes.warp(MoebiusMap.identity(), View(0.0, 0.0), 101)
    >>> picture.shape, picture[50, 50].tolist(), picture[0, 0].tolist()
    ((101, 101, 4), [110, 110, 110, 255], [0, 0, 0, 0])
    """

    pixels: Pixels
    bounds: tuple[float, float, float, float] | None = None
    _: KW_ONLY
    latitude: Latitude = "spherical"

    def __post_init__(self) -> None:
        as_choice(self.latitude, KINDS, "latitude")
        pixels = as_pixels(self.pixels, "pixels", most=MOST_TEXELS)
        height, width = pixels.shape[:2]
        if self.bounds is None and width != 2 * height:
            raise ValueError(
                f"pixels is {width} wide and {height} high; a picture of the whole globe is twice as wide as high: "
                "for any other, give bounds=(west, south, east, north) in degrees"
            )
        object.__setattr__(self, "pixels", locked(pixels))
        object.__setattr__(self, "bounds", as_edges(WHOLE if self.bounds is None else self.bounds, "bounds"))

    @classmethod
    def open(
        cls,
        path: str | os.PathLike[str],
        *,
        bounds: tuple[float, float, float, float] | None = None,
        latitude: Latitude = "spherical",
    ) -> Raster:
        """Read an image file in any format that Pillow reads, including palettes, gray, 16 bits and opacity.

        Parameters
        ----------
        path : path-like
            Image file; of several images the first is read.
        bounds, latitude
            As for `Raster`.

        Raises
        ------
        OSError, ValueError
            As for `read_photo`, and as for `Raster`.
        """
        pixels, _ = read_photo(path)
        try:
            return cls(pixels, bounds, latitude=latitude)
        except ValueError as error:
            raise ValueError(f"{os.fspath(path)}: {error}") from error

    def warp(self, lens: MoebiusMap, view: MapView, size: int, *, workers: int | None = None) -> Pixels:
        """Image of the globe through a lens, (size, size, 4); `painted` gives a part of it.

        Parameters
        ----------
        lens : MoebiusMap
            Conformal map applied to the globe.
        view : View or StereographicView
        size : int
            Diameter of the globe in pixels, which touches all four sides of the image.
        workers : int, optional
            As for `panorama`.

        Returns
        -------
        uint8 array
            sRGB and opacity, not premultiplied, rows from the top. Opacity is that of the raster times the fraction of
            the pixel covered by the globe.
        """
        across = as_count(size, "size", high=MOST_PIXELS_ACROSS)
        step = 2.0 / across
        return self.painted(lens, view, (-1.0, 1.0, step, step), (across, across), workers=workers)

    def painted(
        self,
        lens: MoebiusMap,
        view: MapView,
        place: tuple[float, float, float, float],
        pixels: tuple[int, int],
        *,
        covered: bool = True,
        workers: int | None = None,
    ) -> Pixels:
        """As for `warp`, for pixels anywhere on the page.

        Parameters
        ----------
        lens, view, workers
            As for `warp`.
        place : tuple of float
            Left and upper edge of the image, then width and height of a pixel, in radii of the disc from its centre, y
            up.
        pixels : tuple of int
            Numbers of columns and rows.
        covered : bool
            Whether opacity on the limb includes the fraction of the pixel covered by the disc. Otherwise it is that of
            the raster, for an image that is then clipped to the disc.
        """
        reach = 0.0 if view.round else float(np.tan(np.radians(view.angular_radius) / 2))
        projection = "orthographic" if view.round else "stereographic"
        return self._warped(lens, view.matrix, projection, reach, place, pixels, covered=covered, workers=workers)

    def panorama(
        self,
        lens: MoebiusMap | None = None,
        form: PanoramaForm = "equirectangular",
        *,
        view: View | None = None,
        size: int | None = None,
        angular_radius: float = PLANET_RADIUS,
        workers: int | None = None,
    ) -> Pixels:
        """Image of all directions through a lens, for panorama viewers or as a little planet.

        Parameters
        ----------
        lens : MoebiusMap, optional
            Conformal map of the directions; by default the identity. A fisheye enlarges the surroundings of its focus,
            and circles of the sphere stay circles.
        form : {"equirectangular", "cubemap", "planet"}
            "equirectangular" is linear in longitude and latitude and twice as wide as high. "cubemap" has the six faces
            of a cube as seen from inside, in the order of OpenGL: right (+X), left (−X), up (+Y), down (−Y), front
            (+Z), back (−Z); the lower edge of the upper face and the upper edge of the lower face meet the front.
            "planet" is a stereographic image that fills a square, called a little planet.
        view : View, optional
            Direction at the centre of the image or of the front face, and which way is up; by default longitude and
            latitude 0, for a planet the nadir.
        size : int, optional
            Width in pixels, for a cubemap that of a face; must be even for "equirectangular". By default large enough
            to keep the detail at the centre: the width of a raster of the whole sphere at this resolution, a quarter of
            it for a face, and half of it for a planet.
        angular_radius : float
            For a planet, the angle in degrees between the centre and the midpoints of the sides, at most 160.
        workers : int, optional
            Number of threads; −1 for all processors. By default all, except for very small images. Does not affect the
            result.

        Returns
        -------
        uint8 array
            sRGB and opacity, not premultiplied, rows from the top, at most `MOST_TEXELS` pixels: (size/2, size, 4),
            (6, size, size, 4) for a cubemap, (size, size, 4) for a planet. Directions outside the raster are
            transparent.

        Examples
        --------
        >>> from stereodel import fisheye
        >>> stripes = Raster(np.arange(0, 240, 20, dtype=np.uint8)[None, :].repeat(6, axis=0))
        >>> stripes.panorama(fisheye((10, 0), magnification=3.0)).shape, stripes.panorama(form="cubemap").shape
        ((6, 12, 4), (6, 3, 3, 4))
        """
        west, _, east, _ = WHOLE if self.bounds is None else self.bounds
        columns, rows = panorama_sides(form, size, max(4, round(self.pixels.shape[1] * 360.0 / (east - west))))
        seen = View(0.0, -90.0 if form == "planet" else 0.0) if view is None else view
        bend = MoebiusMap.identity() if lens is None else lens
        square = (rows, rows)
        if form == "cubemap":
            place = (-1.0, 1.0, 2.0 / rows, 2.0 / rows)
            faces = (face @ seen.matrix for face in FACES.values())
            return np.stack([self._warped(bend, f, "gnomonic", 0.0, place, square, workers=workers) for f in faces])
        if form == "planet":
            # Beyond 160° the corners are more than 166° from the centre, and their scale 67 times as large.
            radius = as_scalar(angular_radius, "angular_radius", low=0.0, high=160.0, open_low=True)
            # The square is centred in a disc twice as wide, which contains its corners.
            reach, place = 2.0 * float(np.tan(np.radians(radius) / 2)), (-0.5, 0.5, 1.0 / rows, 1.0 / rows)
            given = bend, seen.matrix, "stereographic", reach, place, square
            return self._warped(*given, covered=False, workers=workers)
        step = 2 * np.pi / columns
        place = (-np.pi, np.pi / 2, step, step)
        return self._warped(bend, seen.matrix, "equirectangular", 0.0, place, (columns, rows), workers=workers)

    def _warped(
        self,
        lens: MoebiusMap,
        axes: FloatArray,
        projection: str,
        reach: float,
        place: tuple[float, float, float, float],
        pixels: tuple[int, int],
        *,
        covered: bool = True,
        workers: int | None = None,
    ) -> Pixels:
        """Pixels of a page whose axes (right, up, toward) are the rows of a matrix; see `stereodel._kernel`."""
        back = lens.inverse()
        return _kernel.warp_raster(
            self._texels,
            self._levels,
            self._edges,
            _shifts(self.latitude),
            turned(back.right.matrix, axes),
            back.magnification,
            back.left.matrix,
            projection,
            reach,
            place,
            pixels,
            covered,
            thread_count(workers, pixels[0] * pixels[1]),
        )

    @cached_property
    def _texels(self) -> Pixels:
        """Premultiplied colours, from which averages are computed."""
        opacity = self.pixels[..., 3:]
        if opacity.min() == 255:
            return self.pixels
        texels = self.pixels.copy()
        # At most 255² + 127, which fits in 16 bits.
        texels[..., :3] = (self.pixels[..., :3] * opacity.astype(np.uint16) + 127) // 255
        return texels

    @cached_property
    def _levels(self) -> Pixels:
        return _kernel.raster_levels(self._texels, self._edges, thread_count(None, self.pixels.size))

    @property
    def _edges(self) -> FloatArray:
        return np.radians(np.array(self.bounds))


@cache
def _shifts(latitude: Latitude) -> FloatArray:
    """Differences between the latitude of rows and that on the sphere, at 1025 latitudes, in radians.

    Linear interpolation between them is accurate to 2e-8 rad: the difference is at most 0.0034 rad · sin 2φ, its second
    derivative is below 0.0135, and the entries are π/1024 apart.
    """
    if latitude == "spherical":
        return np.zeros(0)
    degrees = np.linspace(-90.0, 90.0, 1025)
    at = lonlat_to_xyz(np.column_stack([np.zeros(1025), degrees]))
    return np.radians(xyz_to_lonlat(at, latitude=latitude)[:, 1] - degrees)


@dataclass(frozen=True, eq=False)
class RasterOnDisc:
    """A raster on the disc of a chart, for a `stereodel.drawing.page.Picture`; `opacity` multiplies its own."""

    raster: Raster
    chart: Chart
    opacity: float = 1.0

    def paint(self, place: tuple[float, float, float, float], pixels: tuple[int, int]) -> Pixels:
        """Pixels of the page, (rows, columns, 4); see `stereodel.drawing.page.Painter`."""
        (left, top, width, height), (x, y), scale = place, self.chart.at, self.chart.scale
        in_disc = ((left - x) / scale, (top - y) / scale, width / scale, height / scale)
        found = self.raster.painted(self.chart.lens, self.chart.view, in_disc, pixels, covered=False)
        if self.opacity < 1:
            found[..., 3] = np.floor(found[..., 3] * self.opacity + 0.5)
        return found
