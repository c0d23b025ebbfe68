"""Conformal maps of Shapely geometries, for libraries that draw longitude and latitude: cartopy, GeoPandas."""

from __future__ import annotations

from typing import Any

import numpy as np

from stereodel._arrays import as_scalar
from stereodel._extras import optional
from stereodel.conformal import MoebiusMap


def warp(shapes: Any, lens: MoebiusMap, *, tolerance: float = 0.01) -> Any:
    """The images of geometries under a conformal map, as geometries of longitude and latitude.

    Parameters
    ----------
    shapes : geometry, array_like of geometries, GeoSeries or GeoDataFrame
        In degrees. Polygons are as in GeoJSON and shapefiles: valid, cut at ±180°, with edges straight in longitude and
        latitude. Lines that jump by more than 180° continue across ±180°. Frames in another coordinate system are
        transformed to EPSG:4326 first. Heights are dropped.
    lens : MoebiusMap
    tolerance : float
        Largest deviation of the straight segments of the result from the exact image, in degrees on the sphere.

    Returns
    -------
    geometry, ndarray of geometries, GeoSeries or GeoDataFrame
        Same type and order as the input, None and empty geometries unchanged. Coordinates are in [−180, 180] × [−90,
        90], with new vertices where edges bend. Polygons are valid, cut at ±180° and closed along ±90° around poles
        that they contain; parts that met at ±180° are merged if they no longer lie there. A polygon may become a
        MultiPolygon, a line a MultiLineString.

    Raises
    ------
    ValueError
        If a latitude is outside [−90, 90], or `tolerance` outside (0, 45].
    ImportError
        If Shapely is missing (the extra ``geo``).

    Notes
    -----
    The image of a great-circle arc is a circular arc, which is computed in closed form rather than by bisection, so an
    edge near the focus is as exact as any other. The interior of a polygon is on the left of its boundary, and a
    conformal map keeps it there, however large it becomes.

    The chords of a polygon narrower than 2⁻⁸ of the tolerance may cross: it becomes a row of slivers that deviate by no
    more than the tolerance. Below 1e-8 degrees, and at a pole, its sides may have the same chords: it is then empty.

    Examples
    --------
    >>> import shapely
    >>> from stereodel import fisheye
    >>> square = shapely.box(0, 40, 5, 45)
    >>> larger = warp(square, fisheye((2.5, 42.5), magnification=4))
    >>> larger.is_valid, [round(side) for side in larger.bounds]
    (True, [-9, 32, 14, 52])
    """
    shapely = optional("shapely", "geo")
    slack = float(np.radians(as_scalar(tolerance, "tolerance", low=0.0, high=45.0, open_low=True)))
    from stereodel.io.maps.through_lens import images_of

    if hasattr(shapes, "set_geometry"):
        return shapes.set_geometry(warp(shapes.geometry, lens, tolerance=tolerance))
    if hasattr(shapes, "crs") and hasattr(shapes, "to_crs"):
        degrees = shapes.to_crs("EPSG:4326") if shapes.crs is not None else shapes
        images = images_of(np.asarray(degrees, dtype=object), lens, slack)
        return type(shapes)(images, index=shapes.index, crs=degrees.crs, name=shapes.name)
    array = np.asarray(shapes, dtype=object)
    images = images_of(array.ravel(), lens, slack).reshape(array.shape)
    return images[()] if isinstance(shapes, shapely.Geometry) else images
