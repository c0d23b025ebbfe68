"""Weights of points at query points as a sparse matrix: interpolation set up once for many fields."""

from __future__ import annotations

import os
from abc import abstractmethod
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from stereodel._arrays import AnyIndices, FloatArray, Indices, as_choice, as_values, locked
from stereodel._docs import shared
from stereodel._extras import optional
from stereodel._notebook import Displayed, tabular
from stereodel._tasks.whole_files import replacing, write_netcdf
from stereodel.constants import WEIGHT_ROUNDING
from stereodel.curves.ragged import offsets_of, spans
from stereodel.interpolation.interpolator import Interpolator
from stereodel.sphere.coordinates import LONLAT


class Shares(NamedTuple):
    """Rows of points and their weights, one row for each query."""

    indptr: Indices
    columns: AnyIndices
    data: FloatArray


@dataclass(frozen=True, eq=False)
class Weights(Displayed):
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
    >>> weights.to_scipy().shape, weights.to_xarray()["row"].values.tolist()
    ((3, 4), [1, 1, 1, 2, 2, 2])
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
        held, base = self.rows[self._heaviest], np.zeros(len(self.indptr) - 1)
        for index in np.ndindex(fields.shape[:-1]):
            field = np.ascontiguousarray(fields[index])
            base[held] = field[self.columns[self._heaviest]]
            with np.errstate(all="ignore"):
                rises = self.data * (field[self.columns] - base[self.rows])
                # Entry by entry, as in the interpolators.
                found[index][held] = (base + np.bincount(self.rows, rises, len(base)))[held]
        result = np.moveaxis(found, -1, before)
        return np.ascontiguousarray(result).reshape(result.shape[:before] + self.shape + result.shape[before + 1 :])

    def to_scipy(self) -> Any:
        """As a sparse array of SciPy, (m, n), in CSR format, with the same entries, including zeros.

        Its product with values is the same up to rounding, except that rows without entries give zero instead of NaN.
        """
        sparse = optional("scipy.sparse", "scipy")
        parts = (self.data.copy(), self.columns.copy(), self.indptr.copy())
        return sparse.csr_array(parts, shape=(len(self.indptr) - 1, self.size))

    def _layout(self) -> dict[str, tuple[str, Any]]:
        """Arrays of the layout, each with the name of its dimension."""
        held = np.diff(self.indptr) > 0
        kind: Any = np.int32 if max(len(held), self.size) < 2**31 else np.int64
        return {
            "row": ("n_s", (self.rows + 1).astype(kind)),
            "col": ("n_s", self.columns.astype(kind) + 1),
            "S": ("n_s", self.data.copy()),
            "frac_a": ("n_a", np.zeros(self.size)),
            "frac_b": ("n_b", held.astype(np.float64)),
            "src_grid_dims": ("src_grid_rank", np.array([self.size], kind)),
            "dst_grid_dims": ("dst_grid_rank", np.array(self.shape[::-1], kind)),
        }

    def to_xarray(self) -> Any:
        """As a dataset in the layout of the weight files of ESMF and xESMF.

        Returns
        -------
        xarray.Dataset
            For each entry (n_s) the query `row` and the point `col`, numbered from 1, and the weight `S`; `frac_b`
            (n_b) is 1 for queries that have entries, else 0, `frac_a` (n_a) 0, as no areas are conserved;
            `src_grid_dims` is n, `dst_grid_dims` the shape of the queries, the axis that varies fastest first.
        """
        return optional("xarray", "grid").Dataset(self._layout(), attrs={"title": "weights of stereodel, as of ESMF"})

    @classmethod
    def from_xarray(cls, dataset: Any) -> Weights:
        """From a dataset as of `to_xarray` or of ESMF; to one of xESMF add `src_grid_dims` and `dst_grid_dims`.

        Raises
        ------
        ValueError
            If something is missing or does not fit together; if the weights of a row do not sum to one, as in
            conservative remapping, which `apply` cannot do.
        """
        return cls._read(dataset.variables, dataset.encoding.get("source", "the dataset"))

    @classmethod
    def _read(cls, held: Any, where: str | os.PathLike[str]) -> Weights:
        """From the arrays of the layout that are used, by name."""
        refused = f"{os.fspath(where)} is not a file of weights"
        names = ("row", "col", "S", "src_grid_dims", "dst_grid_dims")
        if missing := [name for name in names if name not in held]:
            raise ValueError(f"{refused}, it lacks {', '.join(missing)}")
        row, column, data, source, target = (np.asarray(held[name]) for name in names)
        size, count = int(source.prod()), int(target.prod())
        agree = row.shape == column.shape == data.shape == (row.size,)
        if not agree or any(((of < 1) | (of > most)).any() for of, most in ((row, count), (column, size))):
            raise ValueError(f"{refused}: its arrays do not fit together")
        sums, entries = np.bincount(row, data, count + 1), np.bincount(row, minlength=count + 1)
        wrong = np.flatnonzero((entries > 0) & ~(np.abs(sums - 1.0) <= WEIGHT_ROUNDING))
        if len(wrong):
            said = f"the weights of row {wrong[0]} sum to {sums[wrong[0]]:g}, not to one as for interpolation"
            raise ValueError(f"{os.fspath(where)}: {said}; scipy.sparse.coo_array takes any")
        order = np.argsort(row, kind="stable")
        parts = column[order] - 1, data[order].astype(np.float64), tuple(target[::-1].tolist())
        return cls(offsets_of(entries[1:]), *parts, size)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write to a file, by its name .npz or .nc (NetCDF), in the layout of `to_xarray`; an old one is replaced."""
        form = as_choice(Path(path).suffix.lower(), (".npz", ".nc"), "the ending of path")
        with replacing(path) as temporary:
            if form == ".nc":
                write_netcdf(self.to_xarray(), temporary)
            else:
                with temporary.open("wb") as file:
                    np.savez_compressed(file, **{name: array for name, (_, array) in self._layout().items()})

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Weights:
        """Read from a file written by `save`, or by ESMF; ValueError if it does not contain weights."""
        if as_choice(Path(path).suffix.lower(), (".npz", ".nc"), "the ending of path") == ".nc":
            with optional("xarray", "grid").open_dataset(path, engine="netcdf4") as dataset:
                return cls.from_xarray(dataset)
        with np.load(path, allow_pickle=False) as archive:
            return cls._read(archive, path)

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
        """The shares with the empty rows of those queries `outside` that take the value of a point filled."""
        outside, points = self._beyond(queries, outside, workers)
        counts, at = np.diff(shares.indptr), shares.indptr[outside]
        counts[outside] = 1
        return Shares(offsets_of(counts), np.insert(shares.columns, at, points), np.insert(shares.data, at, 1.0))

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
