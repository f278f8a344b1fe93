# SPDX-License-Identifier: Apache-2.0
"""Fits of all curves of a map, as arrays.

>>> import touchafm.maps
>>> found = touchafm.maps.fit(touchafm.read("cell.h5"), model="paraboloid", tip_radius=5e-6)
>>> found.E[0]  # the top row, Pa
>>> touchafm.write_image("cell.gwy", {"Modulus": (found.E, "Pa")}, width=found.width, height=found.height)

The numbers are those of touchafm.fit() for each curve alone, and of the maps that touchafm analyse --fit writes.
"""

import os
import typing
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Callable, Optional

import numpy as np
from numpy.typing import NDArray

from . import Analysis, Curve, DataError, Fit, analyse
from . import fit as fit_curve

__all__ = ["FitMap", "fit"]


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


def fit(curves: typing.Sequence[Curve], *, threads: Optional[int] = None, **settings: Any) -> FitMap:
    """Fits every curve of a map, on all cores or so many threads. settings: the arguments of touchafm.fit().

    A curve that nothing fits is NaN, with its reason; of two curves at one pixel the later counts. ValueError for curves
    that are not a map, and for what touchafm.fit() refuses.
    """
    if not curves:
        raise ValueError("there is no curve")
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
