# SPDX-License-Identifier: Apache-2.0
"""Fits of all curves of a map, as arrays.

>>> import touchafm
>>> found = touchafm.fit_map(touchafm.read("cell.h5"), model="paraboloid", tip_radius=5e-6)
>>> found.E[0]  # the top row, Pa
>>> found.image("E").save("cell.gwy")
>>> found.table.to_csv("cell.csv")

touchafm.fit_map is fit() of this module.

The numbers are those of touchafm.fit() for each curve alone, and of the maps that touchafm analyse --fit writes.
"""

import csv
import importlib
import os
import typing
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Callable, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import Analysis, Curve, DataError, Fit, analyse, write_image
from . import fit as fit_curve

__all__ = ["FitMap", "MapImage", "Table", "fit"]

_UNITS = {"E": "Pa", "contact_point": "m", "depth": "m", "W": "J/m^2", "adhesion": "N"}


class MapImage(typing.NamedTuple):
    """One quantity of a map as an image. SI."""

    name: str  #: "E", for example
    values: NDArray[np.float64]  #: row 0 at the top
    unit: str  #: SI unit of the values
    width: float  #: width of the map, m
    height: float  #: height of the map, m

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes .gwy or .gsf, whole or not at all. FileError if it cannot be written, ValueError for another ending."""
        write_image(path, {self.name: (self.values, self.unit)}, width=self.width, height=self.height)


class Table(dict[str, list[Any]]):
    """Columns by their names, which have SI units; a row for each pixel. Where pandas is installed, a DataFrame indexed by row and
    column takes its place."""

    def to_csv(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the columns as text between commas, numbers with all digits, NaN as nothing. OSError if it cannot be written."""
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(self)
            for row in zip(*self.values()):
                writer.writerow("" if isinstance(each, float) and each != each else each for each in row)


class FitMap(typing.NamedTuple):
    """What was fitted, at the pixels of the map: row 0 at the top, column 0 at the left; NaN where nothing was found."""

    E: NDArray[np.float64]  #: Young's modulus, Pa
    contact_point: NDArray[np.float64]  #: height of the contact, m
    depth: NDArray[np.float64]  #: largest depth, m
    W: NDArray[np.float64]  #: work of adhesion, J/m2; all NaN without adhesion in the model
    adhesion: NDArray[np.float64]  #: strongest pull of the curve itself, N: negative
    flag: NDArray[np.str_]  #: whether E can be trusted, in a word; empty without a fit
    fits: list[Optional[Fit]]  #: in the order of the curves; None where a curve cannot be fitted
    reasons: dict[int, str]  #: why, by the number of the curve
    width: float  #: width of the map, m; touchafm.write_image() takes it
    height: float  #: height of the map, m

    def image(self, name: str) -> MapImage:
        """"E", "contact_point", "depth", "W" or "adhesion" as an image, in SI. ValueError for another name."""
        if name not in _UNITS:
            raise ValueError(f"a map has no image {name!r}; choose {', '.join(_UNITS)}")
        return MapImage(name, getattr(self, name), _UNITS[name], self.width, self.height)

    @property
    def table(self) -> Any:
        """A row for each pixel, the top one first: row and column from the top left, numbers in SI, and the flag. A DataFrame of pandas,
        indexed by row and column, if it is installed, else a Table; to_csv() of both writes the same columns. Where nothing was fitted a
        number is NaN."""
        rows, columns = np.indices(self.E.shape)
        table = Table(row=rows.ravel().tolist(), column=columns.ravel().tolist())
        for name, unit in _UNITS.items():
            table[f"{name}_{unit.replace('/', '_per_').replace('^', '')}"] = getattr(self, name).ravel().tolist()
        table["flag"] = self.flag.ravel().tolist()
        try:
            return importlib.import_module("pandas").DataFrame(table).set_index(["row", "column"])
        except ImportError:
            return table


class _Found(typing.NamedTuple):
    fit: Optional[Fit]
    analysis: Optional[Analysis]
    reason: str


def _found(curve: Curve, settings: dict[str, Any]) -> _Found:
    analysis = None
    try:
        analysis = analyse(curve)
        return _Found(fit_curve(analysis, **settings), analysis, "")
    except DataError as error:
        return _Found(None, analysis, str(error))


def _places(curves: typing.Sequence[Curve]) -> tuple[tuple[int, int], list[tuple[int, int]]]:
    """Shape of the map, and row and column of each curve."""
    if any(curve.metadata.get("grid") is None for curve in curves):
        raise ValueError("one of the curves has no pixel; touchafm.fit() fits curves that are not a map")
    grids = {curve.metadata["grid"] for curve in curves}
    if len(grids) != 1:
        raise ValueError(f"the curves are of {len(grids)} grids; give those of one map")
    columns, rows = next(iter(grids))
    if columns * rows > max(512 * 512, 16 * len(curves)):
        raise ValueError(f"{len(curves)} curves on a grid of {columns} x {rows} pixels are not a map")
    pixels = [curve.metadata["pixel"] for curve in curves]
    return (rows, columns), [(rows - 1 - row, column) for column, row in pixels]


def _curves(given: Any) -> list[Curve]:
    if isinstance(given, (str, bytes, os.PathLike)):
        raise TypeError(f"curves: give curves, such as touchafm.read({given!r})")
    curves: list[Any] = [None] if isinstance(given, Curve) else list(given)
    if not all(isinstance(each, Curve) for each in curves):
        raise TypeError("curves: give all curves of a map, as touchafm.read() returns them")
    if not curves:
        raise ValueError("there is no curve")
    return curves


def fit(curves: typing.Iterable[Curve], *, threads: Optional[int] = None, **settings: Any) -> FitMap:
    """Fits every curve of a map, on all cores or so many threads. settings: the arguments of touchafm.fit().

    A curve that nothing fits is NaN, with its reason; of two curves at one pixel the later counts. ValueError for curves
    that are not a map, and for what touchafm.fit() refuses; TypeError for anything but curves.
    """
    curves = _curves(curves)
    shape, places = _places(curves)
    width, height = curves[0].metadata["grid_size"]
    pool = ThreadPoolExecutor(threads or os.cpu_count())
    try:
        work = [pool.submit(_found, curve, settings) for curve in curves]
        found = [each.result() for each in work]
    finally:
        pool.shutdown(wait=False, cancel_futures=True)  # Ctrl-C does not wait for the fits that run

    def of_fits(value: Callable[[Fit], Optional[float]]) -> NDArray[np.float64]:
        array = np.full(shape, np.nan)
        for place, each in zip(places, found):
            number = None if each.fit is None else value(each.fit)
            array[place] = np.nan if number is None else number
        return array

    adhesion = np.full(shape, np.nan)
    flag = np.full(shape, "", dtype="<U16")
    for place, each in zip(places, found):
        pull = None if each.analysis is None else each.analysis.adhesion
        adhesion[place] = np.nan if pull is None else pull
        flag[place] = "" if each.fit is None else each.fit.flag
    return FitMap(
        E=of_fits(lambda of: of.E),
        contact_point=of_fits(lambda of: of.contact_point),
        depth=of_fits(lambda of: of.depth),
        W=of_fits(lambda of: of.W),
        adhesion=adhesion,
        flag=flag,
        fits=[each.fit for each in found],
        reasons={number: each.reason for number, each in enumerate(found) if each.reason},
        width=width,
        height=height,
    )
