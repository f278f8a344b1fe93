# SPDX-License-Identifier: Apache-2.0
"""A window that shows a served microscope: it changes no byte of the answers, and its end does not end the microscope."""

import json
import os
import shutil
import socket
import subprocess
import tempfile
import time
import unittest

REQUESTS = [
    {"do": "hello", "seed": 7},
    {"do": "set", "values": {"pixels": 24, "size_m": 30e-9, "force_noise_N": 20e-12, "blunting_force_N": 1e-9}},
    {"do": "curve", "points": 300},
    {"do": "approach"},
    {"do": "scan"},
    {"do": "move", "x_m": 5e-9, "y_m": -5e-9},
    {"do": "set", "values": {"material": "gold"}},
    {"do": "curve", "points": 200},
    {"do": "scan"},
    {"do": "set", "values": {"material": "pdms-air"}},  # the wall lacks it, and opens again
    {"do": "curve"},
    {"do": "truth"},
]


class Server:
    """A server with a client."""

    def __init__(self, folder, name, *options, display=""):
        self.path = os.path.join(folder, name)
        self.messages = os.path.join(folder, name + ".err")
        environment = {key: value for key, value in os.environ.items() if key != "WAYLAND_DISPLAY"}
        with open(self.messages, "w", encoding="utf-8") as messages:
            self.process = subprocess.Popen(
                [os.environ["TOUCHAFM"], "serve", "--socket", self.path, *options], stderr=messages, cwd=folder,
                env={**environment, "DISPLAY": display})
        while not os.path.exists(self.path) and self.process.poll() is None:
            time.sleep(0.05)
        if self.process.poll() is not None:
            return
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.connect(self.path)
        self.answers = self.socket.makefile("rb")

    def ask(self, request):
        """The answer's bytes, those of its lines included."""
        self.socket.sendall(json.dumps({"id": 1, **request}).encode() + b"\n")
        answer = b""
        while b'"ok":' not in answer:
            answer += self.answers.readline()
        return answer

    def said(self):
        with open(self.messages, encoding="utf-8") as messages:
            return messages.read()

    def end(self):
        """What it ends with once it is asked to quit."""
        self.ask({"do": "quit"})
        self.answers.close()
        self.socket.close()
        return self.process.wait(timeout=60)


class View(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        read, write = os.pipe()
        cls.xserver = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "800x600x24"], pass_fds=[write],
                                       stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as number:
            cls.display = ":" + number.readline().strip()

    @classmethod
    def tearDownClass(cls):
        cls.xserver.terminate()
        cls.xserver.wait()

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def viewed(self, name, *options):
        server = Server(self.folder, name, "--view", "--size", "320x240", *options, display=self.display)
        self.addCleanup(server.process.kill)
        return server

    def key(self, key):
        subprocess.run(["xdotool", "mousemove", "160", "120", "key", key], env={**os.environ, "DISPLAY": self.display}, check=True)

    def wait_for(self, server, text):
        end = time.monotonic() + 60
        while text not in server.said() and time.monotonic() < end:
            time.sleep(0.05)
        self.assertIn(text, server.said())

    def test_changes_no_byte_of_the_answers(self):
        plain, viewed = Server(self.folder, "plain"), self.viewed("viewed")
        self.addCleanup(plain.process.kill)
        for request in REQUESTS:
            self.assertEqual(plain.ask(request), viewed.ask(request), request)
        self.assertEqual(plain.end(), 0)
        self.assertEqual(viewed.end(), 0)
        self.assertNotIn("ended", viewed.said())

    def test_ends_alone_when_it_is_closed(self):
        server = self.viewed("closed")
        server.ask({"do": "curve"})
        self.key("F12")
        self.wait_for(server, "saved ")
        self.key("Escape")
        self.wait_for(server, "the view is closed; the microscope goes on")
        self.assertIn(b'"ok":true', server.ask({"do": "curve"}))
        self.assertEqual(server.end(), 0)

    def test_needs_a_display(self):
        for options, code, why in ((("--view",), 4, "cannot open a window"), (("--wall", "none.toml"), 2, "--view"),
                                   (("--view", "--wall", "none.toml"), 3, "none.toml")):
            server = Server(self.folder, "none", *options, display="")
            self.assertEqual(server.process.wait(timeout=60), code)
            self.assertIn(why, server.said())
            self.assertFalse(os.path.exists(server.path))


if __name__ == "__main__":
    unittest.main()
