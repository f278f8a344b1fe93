# SPDX-License-Identifier: Apache-2.0
"""A virtual atomic force microscope whose truth is known: the library of TouchAFM.

Every number is in SI, and every force on the tip is positive away from the sample. Results are immutable; their arrays are
read-only views or copies in float64. as_dict() of a result is the JSON that the command touchafm prints, to the last digit.

An argument that the command would refuse raises ValueError with the command's words, and a curve or spectrum in which nothing
is found DataError, a ValueError. A file that cannot be read, understood or written raises FileError, an OSError. Long work releases Python's lock, and Ctrl-C ends it within 0.2 s.

touchafm.serve, imported by itself, controls a simulated microscope; touchafm.maps fits all curves of a map.
"""

from ._core import (
    Analysis,
    Contact,
    Curve,
    Cycle,
    DataError,
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
    lever,
    materials,
    paper_tables,
    probes,
    read,
    read_image,
    scan,
    session,
    study,
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
    "Sweep",
    "Tapping",
    "analyse",
    "cycle",
    "fit",
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
    "sweep",
    "tapping",
    "write_image",
]

for _each in __all__:
    globals()[_each].__module__ = __name__
del _each
