# SPDX-License-Identifier: Apache-2.0
"""A virtual atomic force microscope whose truth is known: the library of TouchAFM.

Every number is in SI, and every force on the tip is positive away from the sample. Results are immutable; their arrays are
read-only views or copies in float64. as_dict() of a result is the JSON that the command touchafm prints, to the last digit.

An argument that the command would refuse raises ValueError with the command's words, and a curve or spectrum in which nothing
is found DataError, a ValueError. A file that cannot be read, understood or written raises FileError, an OSError. Long work releases Python's lock, and Ctrl-C ends it within 0.2 s.

touchafm.serve controls a simulated microscope, fit_map() fits all curves of a map.
"""

import importlib
from typing import Any, Optional

from . import _core
from ._core import (
    Analysis,
    Contact,
    Curve,
    Cycle,
    DataError,
    Drive,
    Event,
    Figures,
    FileError,
    Fit,
    FrequencyShift,
    Law,
    Lever,
    Scan,
    Session,
    Study,
    Surface,
    Sweep,
    Tapping,
    __version__,
    analyse,
    cycle,
    fit,
    frequency_shift,
    generate,
    generate_map,
    law,
    level,
    materials,
    paper_tables,
    probes,
    read,
    read_image,
    scan,
    session,
    study,
    surface,
    sweep,
    tapping,
    write_image,
)

__all__ = [
    "Analysis",
    "Contact",
    "Curve",
    "Cycle",
    "DataError",
    "Drive",
    "Event",
    "Figures",
    "FileError",
    "Fit",
    "FrequencyShift",
    "Law",
    "Lever",
    "Scan",
    "Session",
    "Study",
    "Surface",
    "Sweep",
    "Tapping",
    "analyse",
    "cycle",
    "fit",
    "fit_map",
    "frequency_shift",
    "generate",
    "generate_map",
    "law",
    "level",
    "lever",
    "materials",
    "paper_tables",
    "probes",
    "read",
    "read_image",
    "scan",
    "session",
    "study",
    "surface",
    "sweep",
    "tapping",
    "write_image",
]

for _each in __all__:
    if _each in globals():
        globals()[_each].__module__ = __name__
del _each

from .maps import fit as fit_map  # noqa: E402


class _LeverCalibration:
    __doc__ = _core.lever.__doc__

    def __call__(self, **given: Any) -> Lever:
        return _core.lever(**given)

    def thermal(self, frequency: Any, density: Any, *, invols: Optional[float] = None, **given: Any) -> Lever:
        """Calibrates a lever by the spectrum of its thermal noise: lever(thermal=(frequency, density), ...).

        frequency, Hz; density, m^2/Hz, or with invols, the sensitivity of the optical lever in m/V, V^2/Hz. given: the other
        arguments of lever(), such as temperature, K. Raises ValueError and DataError as lever().
        """
        if invols is not None:
            if "sensitivity" in given or "unit" in given:
                raise ValueError("invols is the sensitivity, and its unit is m/V; leave out sensitivity and unit")
            given.update(sensitivity=invols, unit="V")
        return _core.lever(thermal=(frequency, density), **given)


lever = _LeverCalibration()


def __getattr__(name: str) -> Any:
    """touchafm.serve and touchafm.compat, imported when they are first used."""
    if name in ("compat", "serve"):
        return importlib.import_module(f"{__name__}.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
