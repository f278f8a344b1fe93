# SPDX-License-Identifier: Apache-2.0
"""The virtual microscope behind the method names of DTMicroscope's AFM, for scripts that were written for it.

>>> from touchafm.compat.dtmicroscope import AFM_Microscope
>>> afm = AFM_Microscope(size=40e-9, pixels=32, seed=3)
>>> afm.setup_microscope("gold")
>>> afm.get_scan(channels=["Height"]).shape
(1, 32, 32)
>>> hurried = afm.get_scan(["Height"], modification=[{"effect": "real_PID", "kwargs": {"integral_gain": 50.0}}], scan_rate=20.0)
>>> z, force = afm.get_spectrum(location=(5e-9, 0.0))

DTMicroscope replays a data set; here each image is taken anew, in simulated time, by touchafm.scan(), and its artefacts are those of
a tip and a feedback: lengths are in m, the channels are those of touchafm.scan(), and no call waits.
https://github.com/pycroscopy/DTMicroscope
"""

import os
import typing
import warnings
from typing import Any, Literal, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import Contact, Scan, cycle, scan

__all__ = ["AFM_Microscope"]

_Floats = NDArray[np.float64]
_Channels = Optional[list[str]]
_Modification = Optional[list[typing.Mapping[str, Any]]]

_RETRACE = " (retrace)"
_EFFECTS = {  # the arguments of touchafm.scan() and Contact.material() that each may have
    "real_tip": {"tip_radius", "tip", "tip_angle"},
    "tip_doubling": {"second_apex_distance", "second_apex_height"},
    "real_PID": {"integral_gain", "proportional_gain", "setpoint", "noise", "detector_delay"},
}


class AFM_Microscope:
    """A microscope over one sample. data_path: a sample of one's own, as touchafm.scan(sample=); scan: further arguments of
    touchafm.scan(), such as size and pixels. x and y: place of the tip, m."""

    def __init__(self, data_path: Optional[Union[str, os.PathLike[str]]] = None, **scan: Any) -> None:
        self.name, self.instrument_vendor, self.instrument_type = "AFM Microscope", "TouchAFM", "AFM"
        self.data_source: Optional[str] = None
        self._channels: list[str] = []
        self._units: dict[str, str] = {}
        self.scan_rate: float = scan.pop("rate", 0.5)  #: lines per second
        self.x = self.y = 0.0
        self._keywords: dict[str, Any] = dict(scan) if data_path is None else {"sample": data_path, **scan}

    def setup_microscope(self, data_source: str = "mica", dset_subset: None = None) -> None:
        """Puts this material of touchafm.materials() below the tip, in the middle of a first image. dset_subset: no effect."""
        del dset_subset
        image = self._image(None, None, data_source)
        self.data_source = data_source
        self._channels = [name for name in image.channels if not name.endswith(_RETRACE)]
        self._units = image.units
        self.scan_ar = np.stack([image[name] for name in self._channels])
        rows, columns = self.scan_ar.shape[1:]
        self.x_coords = image.x_offset + (np.arange(columns) + 0.5) * image.width / columns
        self.y_coords = image.y_offset - (np.arange(rows) + 0.5) * image.height / rows  # row 0 at the top
        self.x_min, self.x_max = float(self.x_coords.min()), float(self.x_coords.max())
        self.y_min, self.y_max = float(self.y_coords.min()), float(self.y_coords.max())
        self.x, self.y = float(self.x_coords[columns // 2]), float(self.y_coords[rows // 2])

    def get_dataset_info(self) -> list[tuple[str, list[Any]]]:
        """Channels of an image and the spectrum, with their units."""
        self._material()
        names = [*self._channels, "Force"]
        return [("channels", names), ("signals", names), ("units", [*(self._units[name] for name in self._channels), "N"]),
                ("scans", list(range(len(self._channels)))), ("spectra", [len(self._channels)]), ("point_clouds", [])]

    def get_scan(self, channels: _Channels = None, modification: _Modification = None, scan_rate: Optional[float] = None,
                 trace: Literal["forward", "backward"] = "forward",
                 direction: Literal["horizontal", "vertical"] = "horizontal") -> _Floats:
        """An image at scan_rate, lines per second: channels by rows by columns. trace "backward": of the way back. The fast axis is
        x: ValueError for the other."""
        if direction != "horizontal":
            raise ValueError("direction: the lines of an image run along x, \"horizontal\"")
        if trace not in ("forward", "backward"):
            raise ValueError(f"trace: \"{trace}\" is neither \"forward\" nor \"backward\"")
        self._material()
        if channels is not None and not isinstance(channels, list):
            raise TypeError("channels: give a list of names, or None for all")
        names = [name for name in channels or self._channels if name in self._channels]
        for name in channels or ():
            if name not in names:
                warnings.warn(f"there is no channel \"{name}\"; choose from {', '.join(self._channels)}", stacklevel=2)
        if not names:
            raise ValueError(f"channels: none of {channels} is known; choose from {', '.join(self._channels)}")
        image = self._image(modification, scan_rate)
        return np.stack([image[name + (_RETRACE if trace == "backward" else "")] for name in names])

    def scanning_emulator(self, direction: Literal["horizontal", "vertical"] = "horizontal", channels: _Channels = None,
                          scan_rate: Optional[float] = None, modification: _Modification = None) -> typing.Iterator[_Floats]:
        """The lines of an image at scan_rate, lines per second, one after the other: channels by pixels, rows from the top or
        columns from the left."""
        image = self.get_scan(channels, modification, scan_rate)
        yield from np.moveaxis(image, self._axis(direction), 0)

    def go_to(self, x: float, y: float) -> bool:
        """Moves the tip to a place, m; one outside the image becomes the nearest inside, with a warning."""
        self._material()
        if not np.isfinite([x, y]).all():
            raise ValueError(f"{x} m, {y} m is no place")
        inside = float(np.clip(x, self.x_min, self.x_max)), float(np.clip(y, self.y_min, self.y_max))
        if inside != (x, y):
            warnings.warn(f"{x} m, {y} m is outside the image; the tip is at {inside[0]} m, {inside[1]} m", stacklevel=2)
        self.x, self.y = inside
        return True

    def scan_individual_line(self, direction: Literal["horizontal", "vertical"] = "horizontal",
                             trace: Literal["forward", "backward"] = "forward", coord: float = 0.0,
                             channels: _Channels = None, modification: _Modification = None) -> _Floats:
        """The line of an image nearest to y = coord, m, or x = coord of a vertical one: channels by pixels."""
        axis = self._axis(direction)
        if not np.isfinite(coord):
            raise ValueError(f"coord: {coord} m is no place")
        image = self.get_scan(channels, modification, trace=trace)
        places = self.y_coords if axis == 1 else self.x_coords
        line: _Floats = np.take(image, int(np.argmin(np.abs(places - coord))), axis=axis)
        return line

    def scan_arbitrary_path(self, path_points: ArrayLike, channels: _Channels = None,
                            modification: _Modification = None) -> _Floats:
        """The pixels of an image along straight lines between places (x, y), m: channels by pixels."""
        points = np.asarray(path_points, dtype=float)
        if points.ndim != 2 or points.shape[1] != 2 or len(points) < 2:
            raise ValueError(f"path_points: give two or more places (x, y), not an array of {points.shape}")
        self._material()
        if not np.isfinite(points).all():
            raise ValueError("path_points: one of the places is not finite")
        columns = np.abs(self.x_coords[:, None] - points[:, 0]).argmin(axis=0)
        rows = np.abs(self.y_coords[:, None] - points[:, 1]).argmin(axis=0)
        places = [np.rint(np.linspace(begin, end, np.abs(end - begin).max() + 1)).astype(int)
                  for begin, end in zip(np.stack([rows, columns], 1)[:-1], np.stack([rows, columns], 1)[1:])]
        path = np.concatenate(places)
        return self.get_scan(channels, modification)[:, path[:, 0], path[:, 1]]

    def get_spectrum(self, location: Optional[typing.Sequence[float]] = None, channel: Optional[str] = None) -> tuple[_Floats, _Floats]:
        """A force curve at a place, m, down and up: height of the base above the surface in m, force in N. The tip stays there."""
        if channel not in (None, "Force"):
            raise ValueError(f"channel: \"{channel}\" is no spectrum; choose \"Force\"")
        if location is not None:
            self.go_to(*location)
        curve = cycle(Contact.material(self._material()))
        return curve.z, curve.force

    def _material(self) -> str:
        if self.data_source is None:
            raise ValueError("there is no sample yet; call setup_microscope() first")
        return self.data_source

    def _image(self, modification: _Modification, scan_rate: Optional[float], material: Optional[str] = None) -> Scan:
        """An image of a material, by default the one below the tip. What is refused changes nothing."""
        rate = self.scan_rate if scan_rate is None else scan_rate
        given: dict[str, Any] = {"rate": rate, **self._keywords}
        if not isinstance(modification, (list, type(None))):
            raise ValueError("modification: give a list of dicts with \"effect\" and \"kwargs\"")
        for each in modification or ():
            known = _EFFECTS.get(each.get("effect", ""))
            if known is None:
                raise ValueError(f"there is no effect \"{each.get('effect')}\"; choose from {', '.join(_EFFECTS)}")
            unknown = set(each.get("kwargs", {})) - known
            if unknown:
                raise ValueError(f"{each['effect']} takes {', '.join(sorted(known))}, not {', '.join(sorted(unknown))}")
            given.update(each.get("kwargs", {}))
        radius = given.pop("tip_radius", None)
        name = self._material() if material is None else material
        image = scan(Contact.material(name, **({} if radius is None else {"tip_radius": radius})), **given)
        self.scan_rate = rate
        return image

    @staticmethod
    def _axis(direction: str) -> int:
        if direction not in ("horizontal", "vertical"):
            raise ValueError(f"direction: \"{direction}\" is neither \"horizontal\" nor \"vertical\"")
        return 1 if direction == "horizontal" else 2
