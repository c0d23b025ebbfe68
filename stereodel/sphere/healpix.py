"""HEALPix: pixels of equal area on the sphere, in rings of latitude (Górski et al. 2005)."""

from __future__ import annotations

import numpy as np

from stereodel._arrays import FloatArray, Indices, LongArray, as_count

_LARGEST = 2**29
"""Largest nside: 12 nside² pixels still have numbers below 2⁶³."""


def healpix_centers(nside: int, *, nested: bool = False) -> FloatArray:
    """Centres of the pixels of a HEALPix grid.

    Parameters
    ----------
    nside : int
        Pixels along the side of each of the twelve base pixels, 1 or more; with `nested` a power of two.
    nested : bool, optional
        Whether pixels are numbered in the NESTED scheme; otherwise in the RING scheme.

    Returns
    -------
    ndarray, shape (12 nside², 2)
        (lon, lat) in degrees, longitudes in [0, 360), in the order of the pixel numbers.

    Raises
    ------
    ValueError, TypeError
        For an `nside` that is not such a whole number.

    Notes
    -----
    Section 5 of the paper: ring i from the north pole has 4i pixels up to nside, then 4 nside. Latitudes near the poles
    come from 1 − sin φ, so that they keep their digits. All pixels have the area π/(3 nside²).

    K. M. Górski et al., "HEALPix: a framework for high-resolution discretization and fast analysis of data distributed
    on the sphere", Astrophys. J. 622 (2005), 759–771.

    Examples
    --------
    >>> from stereodel.sphere import healpix_centers
    >>> print(healpix_centers(1)[:5].round(3))
    [[ 45.    41.81]
     [135.    41.81]
     [225.    41.81]
     [315.    41.81]
     [  0.     0.  ]]
    """
    size = as_count(nside, "nside", high=_LARGEST)
    if not nested:
        return _in_rings(size)
    if size & (size - 1):
        raise ValueError(f"nside is {size}, but nested pixels need a power of two; give one, or nested=False")
    return _in_rings(size)[_ring_numbers(size)]


def _in_rings(nside: int) -> FloatArray:
    ring = np.arange(1, 4 * nside)
    from_pole = np.minimum(ring, 4 * nside - ring)
    counts = 4 * np.minimum(from_pole, nside)
    # 1 − |sin φ| of each ring, of the caps and of the belt.
    depth = np.where(from_pole < nside, from_pole**2 / (3 * nside**2), 1 - (4 - 2 * from_pole / nside) / 3)
    lat = np.degrees(np.arctan2(1 - depth, np.sqrt(depth * (2 - depth))))
    # Rings of the caps and every other one of the belt begin half a step from longitude 0.
    shift = np.where((from_pole < nside) | ((ring - nside) % 2 == 0), 0.5, 0.0)
    place = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    lon = 360 * (place + np.repeat(shift, counts)) / np.repeat(counts, counts)
    return np.column_stack([lon, np.repeat(np.where(ring <= 2 * nside, lat, -lat), counts)])


def _ring_numbers(nside: int) -> Indices:
    """The number in RING order of each pixel in NESTED order."""
    base, within = np.divmod(np.arange(12 * nside**2), nside**2)
    x, y = _every_other_bit(within), _every_other_bit(within >> 1)
    row, column = np.divmod(base, 4)
    # Ring and place along it, section 4: the corner of the base pixel, less the way north.
    ring = (row + 2) * nside - x - y - 1
    from_pole = np.minimum(ring, 4 * nside - ring)
    length = np.minimum(from_pole, nside)
    half_steps = np.where(row == 1, 2 * column, 2 * column + 1)
    shift = np.where((from_pole < nside) | ((ring - nside) % 2 == 0), 1, 0)
    place = (half_steps * length + x - y - shift) // 2 % (4 * length)
    north = 2 * length * (length - 1)
    before = np.where(
        ring < nside,
        north,
        np.where(
            ring <= 3 * nside,
            2 * nside * (nside - 1) + 4 * nside * (ring - nside),
            12 * nside**2 - 2 * length * (length + 1),
        ),
    )
    return before + place


def _every_other_bit(numbers: LongArray) -> LongArray:
    """Bits 0, 2, 4, … of each number as bits 0, 1, 2, …."""
    found = np.zeros_like(numbers)
    for bit in range(30):
        found |= (numbers >> (2 * bit) & 1) << bit
    return found
