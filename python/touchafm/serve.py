# SPDX-License-Identifier: Apache-2.0
"""A microscope in simulated time, controlled through the socket of `touchafm serve`.

    with touchafm.serve.start(seed=7) as afm:
        afm.set(material="gold", line_rate_Hz=5.0)
        afm.approach()
        image = afm.scan()
        image["Height"], afm.truth()["tip_radius_m"]

Every number is in SI. A request that the microscope refuses raises Refused, a ValueError, with its words; a server that does not
answer raises TimeoutError or ConnectionError, an OSError. An object belongs to one thread.
"""

import base64
import contextlib
import json
import os
import pathlib
import shutil
import socket
import subprocess
import tempfile
import time
from types import TracebackType
from typing import Any, Callable, Optional, Union

import numpy as np
from numpy.typing import NDArray

__all__ = ["Client", "Refused", "connect", "start"]

_Floats = NDArray[np.float64]
_Path = Union[str, "os.PathLike[str]"]
_OnLine = Callable[[dict[str, Any]], Any]
_OnProgress = Callable[[int, int], Any]

_CHANNELS = {
    "height_m": "Height",
    "error_N": "Error",
    "lateral_N": "Lateral force",
    "error_m": "Amplitude error",
    "phase_deg": "Phase",
    "energy_J": "Energy dissipated",
    "peak_force_N": "Peak force",
}


class Refused(ValueError):
    """The microscope refused a request; the text is its reason."""


class _Lines:
    """Lines that come from a socket. A wait that is interrupted loses none of their bytes."""

    def __init__(self, source: socket.socket) -> None:
        self._source, self._bytes = source, bytearray()

    def readline(self) -> bytes:
        """The next line with its end; empty if the server left before."""
        searched = 0
        while (end := self._bytes.find(b"\n", searched)) < 0:
            searched = len(self._bytes)
            try:
                more = self._source.recv(1 << 18)
            except ConnectionResetError:
                more = b""
            if not more:
                return b""
            self._bytes += more
        line = bytes(self._bytes[: end + 1])
        del self._bytes[: end + 1]
        return line


class Client:
    """One connection. Ends by close(), or as a context manager."""

    def __init__(self, path: _Path, *, timeout: float = 60.0, server: Optional["subprocess.Popen[bytes]"] = None,
                 folder: Optional[str] = None) -> None:
        self._number = 0
        self._packs: Optional[bool] = None  # whether the server can pack arrays; None: not asked yet
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        try:
            self._socket.settimeout(timeout)
            _connect(self._socket, path, timeout)
        except BaseException:
            self._socket.close()
            raise
        self._answers = _Lines(self._socket)
        self._server, self._folder = server, folder

    def __enter__(self) -> "Client":
        return self

    def __exit__(self, kind: Optional[type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]) -> None:
        self.close()

    def close(self) -> None:
        """Disconnects; a server that start() started ends."""
        self._socket.close()
        if self._server is not None:
            self._server.terminate()
            self._server.wait()
            self._server = None
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
            self._folder = None

    def request(self, do: str, *, on_line: Optional[_OnLine] = None, **members: Any) -> dict[str, Any]:
        """The answer to any request as a dict, whose lists of numbers are arrays: they travel as bytes, which takes less time.
        on_line is called with each line of a scan, or of a tapping curve's progress, as it comes; False stops them."""
        if self._socket.fileno() < 0:
            raise ConnectionError(f"cannot {do}: this client is closed; connect() or start() another")
        if self._packs is None and do != "hello":
            self._packs = "base64" in self.request("hello").get("arrays", ())
        if self._packs:
            members.setdefault("arrays", "base64")
        self._number += 1
        try:
            text = json.dumps({"id": self._number, "do": do, **members}, default=_plain, allow_nan=False)
        except ValueError:
            raise ValueError(f"{do}: one of the numbers is not finite") from None
        with contextlib.suppress(BrokenPipeError, ConnectionResetError):  # the server's last words say why
            self._socket.sendall(text.encode() + b"\n")
        stopping = False
        try:
            while "ok" not in (answer := self._answer(do)):
                if on_line is not None and on_line(answer) is False and not stopping:
                    stopping = True
                    self._stop()
        except BaseException:
            if do in ("scan", "tapping_curve") and not stopping:
                self._stop()
            raise
        if answer["ok"]:
            return answer
        raise Refused(answer.get("error", "the server gave no reason"))

    def _answer(self, do: str) -> dict[str, Any]:
        """The next line that belongs to the newest request."""
        while True:
            try:
                line = self._answers.readline()
            except TimeoutError:
                raise TimeoutError(f"no answer to {do} within {self._socket.gettimeout():g} s: the server works on it, or serves another "
                                   "client first; give a longer timeout") from None
            if not line:
                raise ConnectionError(f"the server left while it was asked to {do}")
            answer: dict[str, Any] = json.loads(line, object_hook=_unpacked)
            if answer.get("id") == self._number or (answer.get("id") is None and not answer.get("ok", True)):
                return answer  # others are of a request whose wait was interrupted, or to "stop"

    def _stop(self) -> None:
        with contextlib.suppress(OSError):
            self._socket.sendall(b'{"do": "stop"}\n')

    def hello(self, seed: Optional[int] = None) -> dict[str, Any]:
        """Name, version and verbs of the server; with a seed, the microscope starts anew."""
        return self.request("hello", seed=seed)

    def get(self) -> dict[str, Any]:
        """Every setting by its name, which has the unit."""
        values: dict[str, Any] = self.request("get")["values"]
        return values

    def set(self, **values: Any) -> None:
        """Changes settings, all or none, by the names of get()."""
        self.request("set", values=values)

    def approach(self, speed: Optional[float] = None) -> dict[str, Any]:
        """Lowers the tip at this speed, m/s, until the setpoint is reached, or seems to be: "z_m" and "engaged"."""
        return self.request("approach", speed_m_per_s=speed)

    def withdraw(self, distance: Optional[float] = None, speed: Optional[float] = None) -> dict[str, Any]:
        """Lifts the tip by a distance, m, at a speed, m/s: "z_m" and "engaged"."""
        return self.request("withdraw", distance_m=distance, speed_m_per_s=speed)

    def set_z(self, z: float, speed: Optional[float] = None) -> dict[str, Any]:
        """Moves the lever's base to a height above the sample's mean level, m, at a speed, m/s, with the feedback off: the tip follows its
        law at rest, with both jumps. "z_m", "engaged" and "force_N", the force that the detector shows, N."""
        return self.request("set_z", z_m=z, speed_m_per_s=speed)

    def move(self, x: float, y: float, speed: Optional[float] = None) -> dict[str, Any]:
        """Goes to another place of the sample, m, at a speed, m/s."""
        return self.request("move", x_m=x, y_m=y, speed_m_per_s=speed)

    def wait(self, seconds: float) -> dict[str, Any]:
        """Lets simulated time pass, s."""
        return self.request("wait", time_s=seconds)

    def curve(self, *, z_from: Optional[float] = None, z_to: Optional[float] = None, points: Optional[int] = None,
              speed: Optional[float] = None) -> dict[str, Any]:
        """A force curve where the tip is, from z_from down to z_to, m, and back at a speed, m/s, with so many points each way:
        "z" in m, "force" in N and "approach" as arrays, "spring_constant" in N/m."""
        answer = self.request("curve", z_from_m=z_from, z_to_m=z_to, points=points, speed_m_per_s=speed)
        z = np.array(answer["z_m"])
        return {
            "z": z,
            "force": np.array(answer["force_N"]),
            "approach": np.arange(len(z)) < answer["approach_points"],
            "spring_constant": answer["spring_constant_N_per_m"],
        }

    def tapping_curve(self, *, z_from: Optional[float] = None, z_to: Optional[float] = None, points: Optional[int] = None,
                      on_progress: Optional[_OnProgress] = None) -> dict[str, Any]:
        """Amplitude and phase from z_from down to z_to, m, and back: "z" and "amplitude" in m, "phase" in rad, "approach", and the
        command's "figures".

        on_progress is called with the number of heights that are done and of all, which begins again if the swing has to be integrated
        directly; if it returns False the curve ends, and Refused is raised."""

        def report(line: dict[str, Any]) -> Any:
            return on_progress is None or on_progress(line["done"], line["of"])

        answer = self.request("tapping_curve", on_line=report, z_from_m=z_from, z_to_m=z_to, points=points, progress=True)
        z = np.array(answer["z_m"])
        return {
            "z": z,
            "amplitude": np.array(answer["amplitude_m"]),
            "phase": np.array(answer["phase_rad"]),
            "approach": np.arange(len(z)) < answer["approach_points"],
            "figures": answer["figures"],
        }

    def scan(self, on_line: Optional[_OnLine] = None, **values: Any) -> dict[str, _Floats]:
        """An image around the tip: a dict of its channels in SI, row 0 on top, "Height" to "Lateral force (retrace)", in
        tapping mode to "Peak force (retrace)". values: settings that are changed before, as by set(), such as lines=64.

        on_line is called with each line as it comes; if it returns False the scan ends, and what was not scanned is NaN."""
        if values:
            self.set(**values)
        rows: list[dict[str, Any]] = []

        def take(line: dict[str, Any]) -> Any:
            rows.append(line)
            return on_line is None or on_line(line)

        answer = self.request("scan", on_line=take)
        image = {}
        for key, name in ((key, _CHANNELS[key]) for key in rows[0]["trace"]):
            for side, ending in (("trace", ""), ("retrace", " (retrace)")):
                channel = np.full((answer["rows"], answer["columns"]), np.nan)
                for line in rows:
                    channel[line["line"]] = line[side][key]
                image[name + ending] = channel
        return image

    def thermal(self, *, points: Optional[int] = None, most_Hz: Optional[float] = None,
                averages: Optional[int] = None) -> tuple[_Floats, _Floats]:
        """Spectrum of the free lever: frequencies in Hz, densities in m^2/Hz."""
        answer = self.request("thermal", points=points, most_Hz=most_Hz, averages=averages)
        return np.array(answer["frequency_Hz"]), np.array(answer["density_m2_per_Hz"])

    def truth(self) -> dict[str, Any]:
        """What no microscope shows, by names that have the unit."""
        return self.request("truth")

    def save(self, file: str) -> dict[str, Any]:
        """Writes the newest image (.gwy, .gsf) or curve (.h5, .tab) into the server's folder."""
        return self.request("save", file=file)

    def quit(self) -> None:
        """Ends the server."""
        self.request("quit")
        self.close()


def _connect(to_server: socket.socket, path: _Path, timeout: float) -> None:
    """Waits while so many clients do that the system takes no more."""
    end = time.monotonic() + timeout
    while True:
        try:
            to_server.connect(os.fspath(path))
            return
        except BlockingIOError:
            if time.monotonic() > end:
                raise TimeoutError(f"cannot connect to {os.fspath(path)} within {timeout:g} s: too many clients wait there") from None
            time.sleep(0.01)


def _unpacked(members: dict[str, Any]) -> Any:
    if len(members) == 1 and "base64" in members:
        return np.frombuffer(base64.b64decode(members["base64"]), "<f8")
    return members


def _plain(value: object) -> object:
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"a request cannot hold {type(value).__name__}")


def connect(path: Optional[_Path] = None, *, timeout: float = 60.0) -> Client:
    """A client of a running server; without a path of start(), a server of its own. timeout: longest wait for an answer, s. OSError if
    nobody listens there."""
    if path is None:
        return start(timeout=timeout)
    try:
        return Client(path, timeout=timeout)
    except OSError as error:
        why = f"cannot connect to {os.fspath(path)}: {error.strerror or error}; start touchafm serve --socket PATH, or use start()"
        raise (OSError(why) if error.errno is None else type(error)(error.errno, why)) from None


def start(*, seed: int = 1, sample: Optional[_Path] = None, out: Optional[_Path] = None, timeout: float = 60.0) -> Client:
    """Starts a server of its own, which nobody else can enter, and connects to it. sample, out: as the command's options;
    timeout: longest wait for an answer, s. Refused if the command refuses them."""
    program = pathlib.Path(__file__).parents[4] / "bin" / "touchafm"
    folder = tempfile.mkdtemp(prefix="touchafm-")
    if len(os.fsencode(folder)) > 90:  # the system takes no longer path of a socket
        shutil.rmtree(folder)
        folder = tempfile.mkdtemp(prefix="touchafm-", dir="/tmp")
    path, messages = os.path.join(folder, "socket"), os.path.join(folder, "messages")
    command = [str(program), "serve", "--socket", path, "--seed", str(seed), "--once"]
    for option, value in (("--sample", sample), ("--out", out)):
        if value is not None:
            command += [option, os.fspath(value)]
    try:
        with open(messages, "w") as file:
            # in a session of its own: Ctrl-C is for the script
            server = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=file, start_new_session=True)
    except OSError:
        shutil.rmtree(folder, ignore_errors=True)
        raise
    end = time.monotonic() + timeout
    try:
        while server.poll() is None and time.monotonic() < end:
            try:
                return Client(path, timeout=timeout, server=server, folder=folder)
            except (FileNotFoundError, ConnectionRefusedError):
                time.sleep(0.005)
        server.kill()
        server.wait()
        why = pathlib.Path(messages).read_text().strip() or "it did not listen in time"
        raise Refused(f"touchafm serve did not start: {why}")
    except BaseException:
        server.kill()
        server.wait()
        shutil.rmtree(folder, ignore_errors=True)
        raise
