"""Casting and checking of input: every error message about points, angles and indices lives here.

Public functions call these once, on entry; from then on arrays are float64, C-contiguous, finite and of known shape.
Nothing here modifies its argument; the result may share memory with it and is never written to.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Hashable
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from stereodel._numbers import as_doubles, entry, is_masked, refuse_masked
from stereodel.constants import UNIT_ROUNDOFF

FloatArray = npt.NDArray[np.float64]
SingleArray = npt.NDArray[np.float32]
IntArray = npt.NDArray[np.int32]
LongArray = npt.NDArray[np.int64]
BoolArray = npt.NDArray[np.bool_]
SignArray = npt.NDArray[np.int8]
"""Signs: −1, 0 or 1."""
Indices = npt.NDArray[np.intp]
"""Indices into other arrays, of NumPy's index type."""
AnyIndices = npt.NDArray[np.integer]
"""Indices into other arrays, of any width, from NumPy or the kernel."""
BigIntegers = npt.NDArray[Any]
"""Python integers of any size, dtype object."""
Bytes = npt.NDArray[np.uint8]
Pixels = npt.NDArray[np.uint8]
Texts = npt.NDArray[np.str_]
Column = npt.NDArray[np.generic]
"""One value per row, of any type."""
Geometries = npt.NDArray[np.object_]
"""Shapely geometries."""
Packed = npt.NDArray[np.object_]
"""Geometries as well-known binary, None where there is none."""
_Scalar = TypeVar("_Scalar", bound=np.generic)
_Word = TypeVar("_Word", bound=str)


class DataWarning(UserWarning):
    """Data are read, written or drawn as they are, but may not be what was meant."""


def as_floats(values: npt.ArrayLike, name: str) -> FloatArray:
    """Cast to a finite float64 array of any shape, or say which entry of `name` cannot be.

    Raises
    ------
    TypeError
        For complex numbers, strings, booleans, times and objects that are not real numbers.
    ValueError
        For NaN, infinities, masked values, ragged nesting, and for whole numbers and long doubles that no double equals
        (`Decimal` and `Fraction` are rounded to the nearest double, as a literal is).
    """
    result = as_doubles(values, name)
    _refuse(~np.isfinite(result), result, name, "every value must be a finite number")
    return result


def _refuse(wrong: BoolArray, array: FloatArray, name: str, expected: str) -> None:
    if np.count_nonzero(wrong):  # for few values four times as fast as wrong.any()
        index = _first(wrong)
        raise ValueError(f"{entry(name, index)} is {array[index]}; {expected}")


def _first(wrong: BoolArray) -> tuple[int, ...]:
    return tuple(int(i) for i in np.argwhere(wrong)[0])


def as_values(values: npt.ArrayLike, size: int, name: str = "values", *, axis: int = 0) -> FloatArray:
    """One value for each of `size` points along an axis: finite numbers, or NaN for missing values.

    Masked values count as missing.
    """
    masked = is_masked(values)
    array = as_doubles(np.ma.filled(values, 0) if masked else values, name)
    if masked:
        array = np.where(np.ma.getmaskarray(np.ma.asarray(values)), np.nan, array)
    if not -array.ndim <= axis < array.ndim or array.shape[axis] != size:
        expected = f"({size}, ...)" if axis == 0 else f"(..., {size})" if axis == -1 else f"{size} along axis {axis}"
        raise ValueError(f"{name} must have shape {expected}, one entry for each point, got {array.shape}")
    _refuse(np.isinf(array), array, name, "every value must be finite, or NaN where it is not known")
    return array


def as_levels(values: npt.ArrayLike) -> FloatArray:
    """One or more finite numbers, (l,); a single number stands for a list of one."""
    array = np.atleast_1d(as_floats(values, "levels"))
    if array.ndim != 1:
        raise ValueError(f"levels must be a number or a list of numbers, got shape {array.shape}")
    return array


def as_vectors(
    values: npt.ArrayLike, dimension: int, name: str, *, gaps: bool = False, instead: str = ""
) -> FloatArray:
    """Coordinates of any leading shape, (..., dimension); with `gaps` they may be NaN and infinite.

    `instead` is what to do with coordinates of the other space, plane or sphere.
    """
    array = as_doubles(values, name) if gaps else as_floats(values, name)
    if array.ndim == 0 or array.shape[-1] != dimension:
        advice = _advice(array, dimension, instead)
        raise ValueError(f"{name} must have shape (..., {dimension}), got {array.shape}{advice}")
    return array


def as_points(
    values: npt.ArrayLike, dimension: int, name: str = "points", *, hint: str = "", instead: str = ""
) -> FloatArray:
    """A list of points, (n, dimension); an empty list, (0,), has no points. `hint` ends a message about the shape.

    `instead` is what to do with points of the other space, plane or sphere.
    """
    array = as_floats(values, name)
    if array.shape == (0,):
        return np.zeros((0, dimension))
    if array.ndim != 2 or array.shape[1] != dimension:
        advice = f"; {hint}" if hint else _advice(array, dimension, instead)
        raise ValueError(f"{name} must have shape (n, {dimension}), got {array.shape}{advice}")
    return array


def _advice(array: FloatArray, dimension: int, instead: str) -> str:
    """The end of a message about a shape: what the shape means, if it is that of the other space, and what to do."""
    if not instead or array.shape[-1:] != (5 - dimension,):
        return ""
    return f", which means {'the plane' if dimension == 3 else 'directions'}; {instead}"


def as_directions(
    values: npt.ArrayLike,
    name: str,
    *,
    points: bool = False,
    instead: str = "make directions of longitude and latitude by lonlat_to_xyz",
) -> FloatArray:
    """Non-zero vectors of space, (..., 3), or (n, 3) when `points`; their lengths do not matter.

    `instead` is what to do with points of the plane.
    """
    array = as_points(values, 3, name, instead=instead) if points else as_vectors(values, 3, name, instead=instead)
    zero = array[..., 0] == 0.0  # column by column: ten times as fast as array.any(axis=-1)
    if np.count_nonzero(zero):
        zero &= (array[..., 1] == 0.0) & (array[..., 2] == 0.0)
        if np.count_nonzero(zero):
            raise ValueError(f"{entry(name, _first(zero))} is the zero vector, which has no direction")
    return array


def as_direction_or_lonlat(value: npt.ArrayLike, name: str) -> FloatArray:
    """One point of the sphere: (lon, lat) in degrees, shape (2,), or a direction, shape (3,)."""
    array = as_floats(value, name)
    if array.shape == (2,):
        return as_lonlat(array, name)
    if array.shape == (3,):
        return as_directions(array, name)
    raise ValueError(f"{name} must be (lon, lat) in degrees or a direction (x, y, z), got shape {array.shape}")


def _four(values: npt.ArrayLike, name: str, what: str) -> FloatArray:
    array = as_floats(values, name)
    if array.shape != (4,):
        raise ValueError(f"{name} must be {what}, got shape {array.shape}")
    return array


def as_shaped(value: npt.ArrayLike, shape: tuple[int, ...], name: str) -> FloatArray:
    """A vector or a matrix of this shape."""
    array = as_floats(value, name)
    if array.shape != shape:
        raise ValueError(f"{name} must have shape {shape}, got {array.shape}")
    return array


def as_lonlat(values: npt.ArrayLike, name: str = "lonlat") -> FloatArray:
    """(lon, lat) in degrees, (..., 2): any finite longitude, latitude in [-90, 90]."""
    array = as_vectors(values, 2, name)
    outside = np.abs(array[..., 1]) > 90.0
    if outside.any():
        where = (*_first(outside), 1)
        said = f"{entry(name, where)} is latitude {array[where]}"
        raise ValueError(f"{said}, outside [-90, 90]; the order is (longitude, latitude)")
    return array


def as_scalar(
    value: Any,
    name: str,
    *,
    low: float = -np.inf,
    high: float = np.inf,
    open_low: bool = False,
    open_high: bool = False,
) -> float:
    """One finite number in [low, high]; without `low` when `open_low`, without `high` when `open_high`."""
    array = as_floats(value, name)
    if array.ndim != 0:
        raise ValueError(f"{name} must be a single number, got shape {array.shape}")
    number = float(array)
    if number > high or number < low or (open_low and number == low) or (open_high and number == high):
        left, right = "(" if open_low else "[", ")" if open_high else "]"
        raise ValueError(f"{name} is {number}, outside {left}{low:g}, {high:g}{right}")
    return number


def as_count(value: Any, name: str, *, low: int = 1, high: int | None = None) -> int:
    """One whole number, at least `low`, at most `high`."""
    array = np.asarray(value)
    whole = array.dtype.kind in "iu" or (isinstance(value, int) and not isinstance(value, bool))
    if array.ndim != 0 or not whole:
        raise TypeError(f"{name} must be one integer, got {value!r}")
    if array < low:
        raise ValueError(f"{name} is {value}, but must be at least {low}")
    if high is not None and array > high:
        raise ValueError(f"{name} is {value}, but must be at most {high}")
    return int(array)


def as_workers(value: Any) -> int | None:
    """A number of threads, at least 1; -1 stands for all processors, None for a choice by the size of the task."""
    if value is None:
        return None
    # The kernel takes an int, and starts no more threads than its task can keep busy.
    return -1 if value == -1 else min(as_count(value, "workers"), np.iinfo(np.int32).max)


def as_steps(width: float, spacing: Any, name: str) -> int:
    """How many steps of `spacing` make up `width` degrees, which must be a whole number."""
    step = as_scalar(spacing, name, low=0.0, high=width, open_low=True)
    count = round(width / step)
    # Both are decimal fractions that were rounded once, so their quotient is off by two roundings at most.
    if abs(width / step - count) > 3 * UNIT_ROUNDOFF * count:
        raise ValueError(f"{name} is {step:g}, but {width:g} must be a whole multiple of it")
    return count


def as_choice(value: Any, choices: tuple[_Word, ...], name: str) -> _Word:
    """One of a few words."""
    if value not in choices:
        raise ValueError(f"{name} is {value!r}, but must be one of {', '.join(map(repr, choices))}")
    return choices[choices.index(value)]


def as_amounts(values: npt.ArrayLike, name: str, what: str) -> FloatArray:
    """Finite numbers of any shape that are not negative, as no such thing is."""
    array = as_floats(values, name)
    _refuse(array < 0, array, name, f"a {what} cannot be negative")
    return array


def as_complex_matrix(value: npt.ArrayLike, name: str) -> npt.NDArray[np.complex128]:
    """A 2×2 matrix of finite complex numbers."""
    array = np.asarray(value)
    if array.dtype.kind != "c":
        return as_shaped(value, (2, 2), name).astype(np.complex128)
    parts = as_shaped(array.real, (2, 2), f"{name}.real"), as_shaped(array.imag, (2, 2), f"{name}.imag")
    return np.stack(parts, axis=-1).view(np.complex128)[..., 0]


def private(array: FloatArray, given: npt.ArrayLike) -> FloatArray:
    """`array`, made from what was `given`, in memory that the caller does not hold; nobody can write to it."""
    shared = array is given or not isinstance(given, np.ndarray) or np.may_share_memory(array, given)
    return locked(array.copy() if shared else array)


def keep_freed_memory() -> None:
    """Have glibc keep up to 32 MB of freed memory, for the temporaries of one block of a computation after another.

    Else it gives back what exceeds twice the largest array freed so far, and each page is made anew, for up to half of
    the time. To free a large array that nobody touched raises that bound; other allocators take no notice.
    """
    np.empty(2**21)


def locked(array: npt.NDArray[_Scalar]) -> npt.NDArray[_Scalar]:
    """Make an array of our own read-only."""
    array.flags.writeable = False
    return array


def read_only(array: npt.NDArray[_Scalar]) -> npt.NDArray[_Scalar]:
    """A private copy that nobody can write to, for frozen value objects."""
    return locked(np.array(array))


def as_indices(values: npt.ArrayLike, size: int, name: str = "indices") -> Indices:
    """Point numbers in [0, size), one-dimensional; negative numbers are refused rather than counted from the end."""
    array = np.atleast_1d(np.asarray(values))
    if array.ndim != 1:
        raise ValueError(f"{name} must be one-dimensional, got shape {array.shape}")
    if array.size == 0:
        return np.zeros(0, dtype=np.intp)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} must be integers, not {array.dtype}")
    outside = (array < 0) | (array >= size)
    if outside.any():
        where = int(np.argmax(outside))
        raise ValueError(f"{name}[{where}] is {array[where]}, but there are {size} points (0 to {size - 1})")
    return array.astype(np.intp)


def as_plane_or_sphere(values: npt.ArrayLike, name: str = "points") -> FloatArray:
    """Points of the plane, (n, 2), or non-zero directions of space, (n, 3), distinguished by their shape."""
    array = as_floats(values, name)
    if array.shape[1:] == (3,):
        return as_directions(array, name, points=True)
    if array.shape != (0,) and array.shape[1:] != (2,):
        raise ValueError(f"{name} must have shape (n, 2) or (n, 3), got {array.shape}")
    return as_points(array, 2, name)


def as_frame(values: npt.ArrayLike, name: str) -> Pixels:
    """A picture in three channels of eight bits, (h, w, 3), h and w ≥ 1."""
    array = np.asarray(values)
    if array.ndim != 3 or array.shape[2] != 3 or array.size == 0:
        raise ValueError(f"{name} must have shape (h, w, 3), got {array.shape}")
    return _of_bytes(array, name)


def _of_bytes(array: npt.NDArray[Any], name: str) -> Pixels:
    if array.dtype != np.uint8:
        raise TypeError(f"{name} must be of uint8, not {array.dtype}; scale the numbers to 0 to 255 and cast them")
    return array


def as_pixels(values: npt.ArrayLike, name: str, *, most: int) -> Pixels:
    """A picture of at most `most` pixels, (h, w), (h, w, 3) or (h, w, 4) uint8, as a copy with four channels."""
    refuse_masked(values, name)
    array = _of_bytes(np.asarray(values), name)
    if array.ndim not in (2, 3) or array.shape[2:] not in ((), (3,), (4,)) or array.size == 0:
        raise ValueError(f"{name} must have shape (h, w), (h, w, 3) or (h, w, 4) and be not empty, got {array.shape}")
    height, width = array.shape[:2]
    if height * width > most:
        raise ValueError(f"{name} has {width} × {height} pixels, more than {most}; make the picture smaller")
    pixels = np.full((height, width, 4), 255, dtype=np.uint8)
    channels = array.reshape(height, width, -1)
    pixels[..., : max(3, channels.shape[2])] = channels
    return pixels


def as_edges(values: npt.ArrayLike, name: str) -> tuple[float, float, float, float]:
    """(west, south, east, north) in degrees: not empty, at most once round, latitudes in [-90, 90]."""
    west, south, east, north = _four(values, name, "(west, south, east, north) in degrees").tolist()
    if not 0 < east - west <= 360:
        raise ValueError(f"{name} runs from longitude {west:g} to {east:g}; east must be up to 360 more than west")
    if not -90 <= south < north <= 90:
        raise ValueError(f"{name} runs from latitude {south:g} to {north:g}; -90 <= south < north <= 90 is needed")
    return west, south, east, north


def as_bounds(values: npt.ArrayLike, name: str = "bounds") -> tuple[float, float, float, float]:
    """(xmin, ymin, xmax, ymax) of a rectangle of the plane that is not empty."""
    left, bottom, right, top = _four(values, name, "(xmin, ymin, xmax, ymax)").tolist()
    if not (left < right and bottom < top):
        raise ValueError(
            f"{name} (xmin, ymin, xmax, ymax) is {(left, bottom, right, top)}; xmin < xmax and ymin < ymax is needed"
        )
    return left, bottom, right, top


class Keyed(ABC):
    """Values that hold arrays, which have no truth of their own: equal exactly where their keys are."""

    @property
    @abstractmethod
    def _key(self) -> Hashable:
        """What tells values apart."""

    def __eq__(self, other: object) -> bool:
        return self._key == other._key if isinstance(other, type(self)) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._key)
