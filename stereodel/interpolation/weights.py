"""Weights of points at query points as a sparse matrix: interpolation set up once for many fields."""

from __future__ import annotations

import os
from abc import abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from stereodel._arrays import AnyIndices, FloatArray, Indices, as_values, locked
from stereodel._docs import shared
from stereodel._extras import optional
from stereodel._notebook import Shown, tabular
from stereodel._tasks.whole_files import replacing
from stereodel.curves.ragged import offsets_of, spans
from stereodel.interpolation.interpolator import Interpolator
from stereodel.sphere.coordinates import LONLAT


class Shares(NamedTuple):
    """Rows of points and their weights, one row for each query."""

    indptr: Indices
    columns: AnyIndices
    data: FloatArray


@dataclass(frozen=True, eq=False)
class Weights(Shown):
    """The weight of each point at each query: a sparse matrix with a row for each query.

    Returned by `weights` of `LinearInterpolator`, `NearestInterpolator` and `NaturalNeighborInterpolator`.

    Parameters
    ----------
    indptr : (m + 1,) array of int
        Row i has the entries ``indptr[i]`` to ``indptr[i + 1]``; none where the interpolant is not defined.
    columns : (s,) array of int
        The point of each entry.
    data : (s,) array
        Weight of each entry: not negative; those of a row sum to one, up to rounding.
    shape : tuple of int
        Shape of the m queries.
    size : int
        Number of points n.

    Notes
    -----
    ``weights @ values`` accepts values (n,) or (n, ...); `apply` accepts values with the points along another axis. The
    result is bitwise that of the interpolator for these values; only for coincident points, among which the weight is
    divided, is it equal up to rounding. A row is summed as differences from the value of its heaviest point, in the
    order of its entries. A NaN among the values of a row gives NaN, even if its weight is zero, and so does a row
    without entries.

    Examples
    --------
    >>> import numpy as np
    >>> from stereodel.interpolation import LinearInterpolator
    >>> plane = LinearInterpolator([[0, 0], [4, 0], [0, 4], [4, 4]], np.zeros(4))
    >>> weights = plane.weights([[1, 2], [3, 3], [5, 0]])
    >>> (weights @ [0.0, 4.0, 8.0, 12.0]).tolist()
    [5.0, 9.0, nan]
    >>> hours = np.outer([1, 10], [0.0, 4.0, 8.0, 12.0])  # (time, point)
    >>> weights.apply(hours, axis=1).tolist()
    [[5.0, 9.0, nan], [50.0, 90.0, nan]]
    >>> weights.to_scipy().shape
    (3, 4)
    """

    indptr: Indices
    columns: AnyIndices
    data: FloatArray
    shape: tuple[int, ...]
    size: int
    _mimes = tabular(
        lambda it: len(it.data),
        lambda it, k: {"query": it.indptr.searchsorted(k, "right") - 1, "point": it.columns[k], "weight": it.data[k]},
    )

    def __post_init__(self) -> None:
        for array in (self.indptr, self.columns, self.data):
            locked(array)

    @cached_property
    def rows(self) -> Indices:
        """The row of each entry, (s,)."""
        return locked(np.repeat(np.arange(len(self.indptr) - 1), np.diff(self.indptr)))

    @cached_property
    def _heaviest(self) -> Indices:
        """The first entry of the largest weight of each row that has entries."""
        held = np.flatnonzero(np.diff(self.indptr))
        largest = np.maximum.reduceat(self.data, self.indptr[held]) if len(held) else self.data
        entries = np.flatnonzero(self.data == np.repeat(largest, np.diff(self.indptr)[held]))
        return entries[np.diff(self.rows[entries], prepend=-1) > 0]

    def __matmul__(self, values: npt.ArrayLike) -> FloatArray:
        return self.apply(values)

    def apply(self, values: npt.ArrayLike, *, axis: int = 0) -> FloatArray:
        """Values at the queries.

        Parameters
        ----------
        values : array_like
            Values of the points, finite or NaN; masked values count as NaN.
        axis : int, optional
            The axis of the points, of length n.

        Returns
        -------
        array
            Array with the shape of `values`, the axis of the points replaced by the shape of the queries.

        Raises
        ------
        ValueError, TypeError
            If a value is infinite or not a real number, or the axis does not have length n.
        """
        array = as_values(values, self.size, axis=axis)
        fields = np.moveaxis(array, axis, -1)
        before = axis % array.ndim
        found = np.full((*fields.shape[:-1], len(self.indptr) - 1), np.nan)
        for index in np.ndindex(fields.shape[:-1]):
            self._fill(found[index], np.ascontiguousarray(fields[index]))
        result = np.moveaxis(found, -1, before)
        return np.ascontiguousarray(result).reshape(result.shape[:before] + self.shape + result.shape[before + 1 :])

    def _fill(self, found: FloatArray, field: FloatArray) -> None:
        """Evaluate one field (n,) at the queries (m,) whose rows have entries."""
        leads = self._heaviest
        held = self.rows[leads]
        base = np.zeros(len(found))
        base[held] = field[self.columns[leads]]
        with np.errstate(all="ignore"):
            rises = self.data * (field[self.columns] - base[self.rows])
            # Entry by entry, as in the interpolators.
            above = np.bincount(self.rows, rises, len(found))
            found[held] = (base + above)[held]

    def to_scipy(self) -> Any:
        """As a sparse array of SciPy, (m, n), in CSR format, with the same entries, including zeros.

        Its product with values is the same up to rounding, except that rows without entries give zero instead of NaN.
        """
        sparse = optional("scipy.sparse", "scipy")
        parts = (self.data.copy(), self.columns.copy(), self.indptr.copy())
        return sparse.csr_array(parts, shape=(len(self.indptr) - 1, self.size))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write to a file, an npz archive of the parameters; an existing file is replaced."""
        with replacing(path) as temporary, temporary.open("wb") as file:
            np.savez_compressed(
                file, indptr=self.indptr, columns=self.columns, data=self.data, shape=self.shape, size=self.size
            )

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Weights:
        """Read from a file written by `save`; ValueError if it does not contain weights."""
        with np.load(path, allow_pickle=False) as archive:
            missing = {"indptr", "columns", "data", "shape", "size"} - set(getattr(archive, "files", ()))
            if missing:
                raise ValueError(f"{os.fspath(path)} is not a file of weights: {', '.join(sorted(missing))} is missing")
            indptr, columns, data = (archive[name] for name in ("indptr", "columns", "data"))
            shape, size = tuple(archive["shape"].tolist()), int(archive["size"])
        agree = (
            len(indptr) == np.prod(shape, dtype=np.intp) + 1
            and indptr[0] == 0
            and indptr[-1] == len(columns) == len(data)
            and not (np.diff(indptr) < 0).any()
            and not ((columns < 0) | (columns >= size)).any()
        )
        if not agree:
            raise ValueError(f"{os.fspath(path)} is not a file of weights: its arrays do not fit together")
        return cls(indptr, columns, data, shape, size)

    def __repr__(self) -> str:
        return f"Weights({self.size} points at {self.shape} places, {len(self.data)} entries)"


class WeightedInterpolator(Interpolator):
    """An interpolator whose results are weighted sums of the values, with weights that depend only on places."""

    @shared(**LONLAT)
    def weights(
        self,
        queries: npt.ArrayLike | None = None,
        *,
        lonlat: npt.ArrayLike | None = None,
        workers: int | None = None,
    ) -> Weights:
        """Weights of the points at queries, for use with other values such as time series.

        {asked}

        Returns
        -------
        Weights
            ``weights @ values`` is the result of an interpolator of these values at the queries.

        {asked_raises}

        Examples
        --------
        >>> import numpy as np
        >>> from stereodel.interpolation import LinearInterpolator
        >>> stations = LinearInterpolator.from_lonlat([(10.0, 48.4), (2.3, 48.9), (12.5, 41.9)], np.zeros(3))
        >>> weights = stations.weights(lonlat=(9.2, 45.5))
        >>> [round(float(weights @ month), 1) for month in ([8.1, 11.4, 15.9], [1.0, 4.0, 8.0])]
        [12.8, 5.2]
        """
        array, flat = self._as_queries(queries, lonlat)
        with np.errstate(all="ignore"):
            shares = self._among_duplicates(self._shares(flat, workers))
        return Weights(*shares, array.shape[:-1], len(self.values))

    @abstractmethod
    def _shares(self, queries: FloatArray, workers: int | None) -> Shares:
        """Points and weights at queries (m, d), without duplicates."""

    def _with_nearest(self, shares: Shares, queries: FloatArray, outside: AnyIndices, workers: int | None) -> Shares:
        """The shares with the empty rows of queries `outside` replaced by the nearest point, if extrapolation is on."""
        if not self._nearest_outside or not len(outside):
            return shares
        counts = np.diff(shares.indptr)
        counts[outside] = 1
        indptr = offsets_of(counts)
        alone = np.zeros(indptr[-1], dtype=np.bool_)
        alone[indptr[outside]] = True
        columns, data = np.empty(len(alone), dtype=np.int32), np.ones(len(alone))
        columns[alone] = self.triangulation.nearest(queries[outside], workers=workers)
        columns[~alone], data[~alone] = shares.columns, shares.data
        return Shares(indptr, columns, data)

    def _among_duplicates(self, shares: Shares) -> Shares:
        """The shares with the weight of each place divided among its coincident points."""
        dropped, kept = self.triangulation.duplicates.T
        if len(dropped) == 0:
            return shares
        place = np.arange(len(self.values))
        place[dropped] = kept
        members = np.argsort(place, kind="stable")  # the points of each place in a row, the kept one first
        counts = np.bincount(place, minlength=len(place))
        each = counts[shares.columns]
        columns = members[spans((np.cumsum(counts) - counts)[shares.columns], each)]
        return Shares(offsets_of(each)[shares.indptr], columns, np.repeat(shares.data / each, each))
