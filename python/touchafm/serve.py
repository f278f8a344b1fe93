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
import json
import os
import pathlib
import shutil
import socket
import subprocess
import tempfile
import time

import numpy as np

__all__ = ["Client", "Refused", "connect", "start"]

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


class Client:
    """One connection. Ends by close(), or as a context manager."""

    def __init__(self, path, *, timeout=60.0, server=None, folder=None):
        self._number = 0
        self._packs = None  # whether the server can pack arrays; None: not asked yet
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        try:
            self._socket.settimeout(timeout)
            self._socket.connect(os.fspath(path))
        except BaseException:
            self._socket.close()
            raise
        self._answers = self._socket.makefile("rb")
        self._server, self._folder = server, folder

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Disconnects; a server that start() started ends."""
        self._answers.close()
        self._socket.close()
        if self._server is not None:
            self._server.terminate()
            self._server.wait()
            self._server = None
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
            self._folder = None

    def request(self, do, *, on_line=None, **members):
        """The answer to any request as a dict, whose lists of numbers are arrays: they travel as bytes, which takes less time.
        on_line is called with each line of a scan as it comes; False stops the scan."""
        if self._packs is None and do != "hello":
            self._packs = "base64" in self.request("hello").get("arrays", ())
        if self._packs:
            members.setdefault("arrays", "base64")
        self._number += 1
        text = json.dumps({"id": self._number, "do": do, **members}, default=_plain)
        self._socket.sendall(text.encode() + b"\n")
        stopping = False
        while True:
            line = self._answers.readline()
            if not line.endswith(b"\n"):
                raise ConnectionError(f"the server left while it was asked to {do}")
            answer = json.loads(line, object_hook=_unpacked)
            if "line" in answer:
                if on_line is not None and on_line(answer) is False and not stopping:
                    stopping = True
                    self._socket.sendall(b'{"do": "stop"}\n')
                continue
            if stopping:
                self._answers.readline()  # that to "stop"
            if answer.get("ok"):
                return answer
            raise Refused(answer.get("error", "the server gave no reason"))

    def hello(self, seed=None):
        """Name, version and verbs of the server; with a seed, the microscope starts anew."""
        return self.request("hello", seed=seed)

    def get(self):
        """Every setting by its name."""
        return self.request("get")["values"]

    def set(self, **values):
        """Changes settings, all or none."""
        self.request("set", values=values)

    def approach(self, speed=None):
        """Lowers the tip until the setpoint is reached, or seems to be."""
        return self.request("approach", speed_m_per_s=speed)

    def withdraw(self, distance=None, speed=None):
        """Lifts the tip."""
        return self.request("withdraw", distance_m=distance, speed_m_per_s=speed)

    def move(self, x, y, speed=None):
        """Goes to another place of the sample."""
        return self.request("move", x_m=x, y_m=y, speed_m_per_s=speed)

    def wait(self, seconds):
        """Lets simulated time pass."""
        return self.request("wait", time_s=seconds)

    def curve(self, *, z_from=None, z_to=None, points=None, speed=None):
        """A force curve where the tip is: "z", "force" and "approach" as arrays, "spring_constant" in N/m."""
        answer = self.request("curve", z_from_m=z_from, z_to_m=z_to, points=points, speed_m_per_s=speed)
        z = np.array(answer["z_m"])
        return {
            "z": z,
            "force": np.array(answer["force_N"]),
            "approach": np.arange(len(z)) < answer["approach_points"],
            "spring_constant": answer["spring_constant_N_per_m"],
        }

    def tapping_curve(self, *, z_from=None, z_to=None, points=None):
        """Amplitude and phase over the height: "z", "amplitude", "phase" in rad, "approach", and the command's "figures"."""
        answer = self.request("tapping_curve", z_from_m=z_from, z_to_m=z_to, points=points)
        z = np.array(answer["z_m"])
        return {
            "z": z,
            "amplitude": np.array(answer["amplitude_m"]),
            "phase": np.array(answer["phase_rad"]),
            "approach": np.arange(len(z)) < answer["approach_points"],
            "figures": answer["figures"],
        }

    def scan(self, on_line=None):
        """An image around the tip: a dict of its channels, row 0 on top, "Height" to "Lateral force (retrace)", in
        tapping mode to "Peak force (retrace)".

        on_line is called with each line as it comes; if it returns False the scan ends, and what was not scanned is NaN."""
        rows = []

        def take(line):
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

    def thermal(self, *, points=None, most_Hz=None, averages=None):
        """Spectrum of the free lever: frequencies in Hz, densities in m^2/Hz."""
        answer = self.request("thermal", points=points, most_Hz=most_Hz, averages=averages)
        return np.array(answer["frequency_Hz"]), np.array(answer["density_m2_per_Hz"])

    def truth(self):
        """What no microscope shows."""
        return self.request("truth")

    def save(self, file):
        """Writes the newest image (.gwy, .gsf) or curve (.h5, .tab) into the server's folder."""
        return self.request("save", file=file)

    def quit(self):
        """Ends the server."""
        self.request("quit")
        self.close()


def _unpacked(members):
    if len(members) == 1 and "base64" in members:
        return np.frombuffer(base64.b64decode(members["base64"]), "<f8")
    return members


def _plain(value):
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"a request cannot hold {type(value).__name__}")


def connect(path, *, timeout=60.0):
    """A client of a running server. timeout: longest wait for an answer, s."""
    return Client(path, timeout=timeout)


def start(*, seed=1, sample=None, out=None, timeout=60.0):
    """Starts a server of its own, which nobody else can enter, and connects to it. sample, out: as the command's options."""
    program = pathlib.Path(__file__).parents[4] / "bin" / "touchafm"
    folder = tempfile.mkdtemp(prefix="touchafm-")
    path, messages = os.path.join(folder, "socket"), os.path.join(folder, "messages")
    command = [str(program), "serve", "--socket", path, "--seed", str(seed), "--once"]
    for option, value in (("--sample", sample), ("--out", out)):
        if value is not None:
            command += [option, os.fspath(value)]
    try:
        with open(messages, "w") as file:
            server = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=file)
    except OSError:
        shutil.rmtree(folder, ignore_errors=True)
        raise
    end = time.monotonic() + timeout
    while True:
        try:
            return Client(path, timeout=timeout, server=server, folder=folder)
        except (FileNotFoundError, ConnectionRefusedError):
            if server.poll() is None and time.monotonic() < end:
                time.sleep(0.005)
                continue
        server.kill()
        server.wait()
        why = pathlib.Path(messages).read_text().strip() or "it did not listen in time"
        shutil.rmtree(folder, ignore_errors=True)
        raise Refused(f"touchafm serve did not start: {why}")
