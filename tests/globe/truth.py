"""What pictures of globes are compared with: points in polygons of the sphere, and views and lenses, by NumPy alone.

Nothing of the engine of curves is used here: a place of the disc is mapped back through view and lens by formulas of
their own, and asked of the source polygons on the map of longitude and latitude by counting crossings.
"""

import numpy as np


def unit(lon, lat):
    """Places in degrees as unit vectors (..., 3)."""
    lon, lat = np.radians(lon), np.radians(lat)
    return np.stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)], axis=-1)


def degrees(xyz):
    """Unit vectors as longitudes and latitudes (..., 2)."""
    x, y, z = np.moveaxis(xyz, -1, 0)
    return np.stack([np.degrees(np.arctan2(y, x)), np.degrees(np.arctan2(z, np.hypot(x, y)))], axis=-1)


def raised(view, xy):
    """Places (n, 2) of the unit disc of a view as unit vectors of the Earth: orthographic or stereographic."""
    square = np.sum(xy**2, axis=1)
    if view.round:
        axes = np.column_stack([xy, np.sqrt(1 - square)])
    else:
        size = np.tan(np.radians(view.angular_radius) / 2)
        square = square * size**2
        axes = np.column_stack([2 * size * xy, 1 - square]) / (1 + square)[:, None]
    lon, lat = np.radians(view.lon), np.radians(view.lat)
    east = np.array([-np.sin(lon), np.cos(lon), 0.0])
    north = np.array([-np.sin(lat) * np.cos(lon), -np.sin(lat) * np.sin(lon), np.cos(lat)])
    return axes @ np.stack([east, north, unit(view.lon, view.lat)])


def before(focus, size, xyz):
    """Where a fisheye took unit vectors from: tan(angle/2) about the focus is divided by the magnification."""
    center = unit(*focus)
    height = xyz @ center
    across = xyz - height[:, None] * center
    sine = np.linalg.norm(across, axis=1)
    angle = 2 * np.arctan2(sine, (1 + height) * size)
    way = across / np.where(sine > 0, sine, 1.0)[:, None]
    return np.cos(angle)[:, None] * center + np.sin(angle)[:, None] * way


def inside(polygons, lonlat):
    """Which places (n, 2) lie in polygons: an odd number of sides above them on the map, of all rings together."""
    starts, ends = [], []
    for rings in polygons:
        for ring in rings:
            points = np.asarray(ring, dtype=float)
            starts.append(points)
            ends.append(np.roll(points, -1, axis=0))
    (x0, y0), (x1, y1) = np.concatenate(starts).T, np.concatenate(ends).T
    turned = x0 > x1
    x0, y0, x1, y1 = (np.where(turned, b, a) for a, b in ((x0, x1), (y0, y1), (x1, x0), (y1, y0)))
    found = np.zeros(len(lonlat), dtype=int)
    for k, (x, y) in enumerate(lonlat):
        there = (x0 <= x) & (x < x1) & (np.maximum(y0, y1) > y)
        height = y0[there] + (y1 - y0)[there] * (x - x0[there]) / (x1 - x0)[there]
        found[k] = np.count_nonzero(height > y)
    return found % 2 == 1


def slivers(rng, count):
    """Strips and triangles 1e-9 to 0.1 degrees wide and up to 170 long, sides sampled at different places.

    Some begin or end at 180° or at a pole.
    """
    found = []
    for _ in range(count):
        wide, long = 10 ** rng.uniform(-9, -1), float(rng.choice([0.4, 5.0, 20.0, 60.0, 120.0]))
        lon, lat, part = rng.uniform(-180, 180 - long), rng.uniform(-80, 80), rng.uniform(0.2, 0.8)
        lon = float(rng.choice([lon, -180.0, 180.0 - long], p=[0.8, 0.1, 0.1]))
        end = float(np.clip(lat + rng.uniform(-long, long), -85, 85)) if rng.random() < 0.5 else lat
        if end != lat:
            lat, end = (
                float(rng.choice([lat, -90.0], p=[0.9, 0.1])),
                float(rng.choice([end, 90.0 - wide], p=[0.9, 0.1])),
            )
        strip = [(lon, lat), (lon + long, end), (lon + long, end + wide)]
        strip += [(lon + part * long, lat + part * (end - lat) + wide), (lon, lat + wide)]
        upright = [(lon, lat), (lon + wide, lat), (lon + wide, -lat), (lon, -lat), (lon, -0.4 * lat)]
        ring = [strip, upright, strip[:3], [(-80, 0), (90, 0), (90, wide)]][rng.choice(4, p=[0.5, 0.2, 0.2, 0.1])]
        found.append(np.clip(ring, [-180, -90], [180, 90])[:: int(rng.choice([1, -1]))])
    return found
