"""What a warped raster is compared with: 16 × 16 samples a pixel, in NumPy, through other code than the kernel's."""

import numpy as np

SAMPLES = 16


def grid(height):
    """Longitude and latitude (h, 2h) of the texels of a raster, radians."""
    lon = (np.arange(2 * height) + 0.5) / height * np.pi - np.pi
    lat = np.pi / 2 - (np.arange(height) + 0.5) / height * np.pi
    return np.meshgrid(lon, lat)


def checkerboard(height, cells):
    """Squares of 180°/cells."""
    lon, lat = grid(height)
    squares = np.floor((lon + np.pi) / np.pi * cells) + np.floor((lat + np.pi / 2) / np.pi * cells)
    return np.where(squares % 2 == 0, 230, 20).astype(np.uint8)


def zone_plate(height):
    """Rings of every width down to two texels."""
    lon, lat = grid(height)
    x, y, z = np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)
    return np.round(127.5 + 110 * np.sin(height * 0.35 * (x * x + 0.3 * y + 0.6 * z * z))).astype(np.uint8)


def noise(height):
    """Every texel for itself."""
    return np.random.default_rng(5).integers(0, 256, (height, 2 * height), dtype=np.uint8)


def keys(t):
    """Weights of four texels for cubic convolution with a = -1/2, from its definition."""
    x = np.abs(t[..., None] - np.arange(-1, 3))
    near, far = 1.5 * x**3 - 2.5 * x**2 + 1, -0.5 * x**3 + 2.5 * x**2 - 4 * x + 2
    return np.where(x < 1, near, np.where(x < 2, far, 0))


def interpolated(raster, lon, lat):
    """Cubic convolution of a raster of the whole globe, degrees; beyond a pole it goes on along the other meridian."""
    height, width = raster.shape
    over = [np.roll(raster[1::-1], width // 2, axis=1), raster, np.roll(raster[:-3:-1], width // 2, axis=1)]
    padded = np.pad(np.concatenate(over).astype(np.float64), ((0, 0), (2, 2)), mode="wrap")
    u, v = (lon + 180) / 360 * width - 0.5, (90 - lat) / 180 * height - 0.5
    column, row = np.floor(u).astype(int), np.floor(v).astype(int)
    across, down = keys(u - column), keys(v - row)
    total = np.zeros(len(u))
    for m in range(4):
        for n in range(4):
            total += down[:, m] * across[:, n] * padded[row + 1 + m, column + 1 + n]
    return np.clip(total, 0, 255)


def means(samples):
    """Of the samples of each pixel."""
    height, width = (side // SAMPLES for side in samples.shape)
    return samples.reshape(height, SAMPLES, width, SAMPLES).mean(axis=(1, 3))


def reference(raster, lens, view, size, window):
    """The picture on black, (h, w) floats, and the share of each pixel that the disc covers."""
    left, top, width, height = window
    within = (np.arange(SAMPLES) + 0.5) / SAMPLES
    x = ((left + np.arange(width))[:, None] + within).ravel() * 2 / size - 1
    y = 1 - ((top + np.arange(height))[:, None] + within).ravel() * 2 / size
    xy = np.stack(np.meshgrid(x, y), axis=-1)
    inside = np.sum(xy**2, axis=-1) < 1
    points = lens.inverse()(view.raised(xy[inside]) @ view.matrix)
    lon, lat = np.degrees([np.arctan2(points[:, 1], points[:, 0]), np.arcsin(np.clip(points[:, 2], -1, 1))])
    values = np.zeros(inside.shape)
    values[inside] = interpolated(raster, lon, lat)
    return means(values), means(inside.astype(np.float64))


def psnr(expected, actual):
    """Peak signal-to-noise ratio in decibels, of 255 levels."""
    return 10 * np.log10(255**2 / max(np.mean((expected - actual) ** 2), 1e-10))
