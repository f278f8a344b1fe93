# SPDX-License-Identifier: Apache-2.0
"""Windows that show a served microscope: they change no byte of the answers, and their end does not end the microscope."""

import json
import os
import shutil
import socket
import subprocess
import tempfile
import time
import unittest

import numpy as np

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


class Windows(unittest.TestCase):
    """An X server without a window manager, and servers with windows on it."""

    @classmethod
    def setUpClass(cls):
        cls.frames = tempfile.mkdtemp()
        read, write = os.pipe()
        cls.xserver = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "800x600x24", "-fbdir", cls.frames],
                                       pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as number:
            cls.display = ":" + number.readline().strip()

    @classmethod
    def tearDownClass(cls):
        cls.xserver.terminate()
        cls.xserver.wait()
        shutil.rmtree(cls.frames)

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def viewed(self, name, *options):
        server = Server(self.folder, name, "--view", *options, display=self.display)
        self.addCleanup(server.process.kill)
        self.assertIsNone(server.process.poll(), server.said())
        return server

    def xdotool(self, *words):
        done = subprocess.run(["xdotool", *words], env={**os.environ, "DISPLAY": self.display}, capture_output=True, text=True,
                              check=True)
        return done.stdout

    def wait_for(self, holds, why):
        end = time.monotonic() + 60
        while not holds() and time.monotonic() < end:
            time.sleep(0.05)
        self.assertTrue(holds(), why())

    def wait_for_words(self, server, text):
        self.wait_for(lambda: text in server.said(), server.said)

    def screen(self):
        """The whole screen: rows by columns by blue, green and red."""
        with open(os.path.join(self.frames, "Xvfb_screen0"), "rb") as file:
            dump = file.read()
        words = [int(each) for each in np.frombuffer(dump, ">u4", 25)]  # of an X window dump
        size, width, height, row, colours = words[0], words[4], words[5], words[12], words[19]
        pixels = np.frombuffer(dump, np.uint8, height * row, size + 12 * colours).reshape(height, row)
        return pixels[:, : 4 * width].reshape(height, width, 4)[:, :, :3].astype(int)

    def still(self):
        """The screen once it has not changed for a second."""
        seen = [self.screen()]
        end = time.monotonic() + 60
        while len(seen) < 6 and time.monotonic() < end:
            time.sleep(0.2)
            now = self.screen()
            seen = seen + [now] if np.array_equal(now, seen[-1]) and now.max() > 100 else [now]
        self.assertEqual(len(seen), 6, "the picture does not come to rest")
        return seen[-1]


class View(Windows):
    def test_changes_no_byte_of_the_answers(self):
        plain, viewed = Server(self.folder, "plain"), self.viewed("viewed", "--size", "320x240")
        self.addCleanup(plain.process.kill)
        for request in REQUESTS:
            self.assertEqual(plain.ask(request), viewed.ask(request), request)
        self.assertEqual(plain.end(), 0)
        self.assertEqual(viewed.end(), 0)
        self.assertNotIn("ended", viewed.said())

    def test_ends_alone_when_it_is_closed(self):
        server = self.viewed("closed", "--size", "320x240")
        server.ask({"do": "curve"})
        self.xdotool("mousemove", "160", "120", "key", "F12")
        self.wait_for_words(server, "saved ")
        self.xdotool("mousemove", "160", "120", "key", "Escape")
        self.wait_for_words(server, "the view is closed; the microscope goes on")
        self.assertIn(b'"ok":true', server.ask({"do": "curve"}))
        self.assertEqual(server.end(), 0)

    def test_needs_a_display(self):
        for options, code, why in ((("--view",), 4, "cannot open a window"), (("--wall", "no-wall.toml"), 2, "--view"),
                                   (("--view", "--wall", "no-wall.toml"), 3, "no-wall.toml")):
            server = Server(self.folder, "none", *options, display="")
            self.assertEqual(server.process.wait(timeout=60), code)
            self.assertIn(why, server.said())
            self.assertFalse(os.path.exists(server.path))


def screen(name, lower_left, lower_right, upper_left):
    return (f'[[screen]]\nname = "{name}"\nlower_left = {lower_left}\nlower_right = {lower_right}\nupper_left = {upper_left}\n')


def output(name, of, rect, more='mode = "mono"\n'):
    return f'[[output]]\nname = "{name}"\nscreen = "{of}"\nrect = {rect}\n{more}'


VIEWER = '[[viewer]]\nname = "visitor"\nipd = "63 mm"\nsweet_spot = [0.0, 1.2, 2.0]\n'
WHOLE = screen("wall", [-1.6, 0.6, 0.0], [1.6, 0.6, 0.0], [-1.6, 1.8, 0.0])
LEFT_HALF = screen("west", [-1.6, 0.6, 0.0], [0.0, 0.6, 0.0], [-1.6, 1.8, 0.0])
RIGHT_HALF = screen("east", [0.0, 0.6, 0.0], [1.6, 0.6, 0.0], [0.0, 1.8, 0.0])
LEFT_PX, RIGHT_PX, BELOW_PX = [0, 0, 320, 240], [320, 0, 320, 240], [0, 240, 320, 240]
CORNER = (screen("left", [-1.0, 0.2, 1.0], [-1.0, 0.2, -1.0], [-1.0, 1.7, 1.0]) +
          screen("front", [-1.0, 0.2, -1.0], [1.0, 0.2, -1.0], [-1.0, 1.7, -1.0]) +
          screen("right", [1.0, 0.2, -1.0], [1.0, 0.2, 1.0], [1.0, 1.7, -1.0]))


class Wall(Windows):
    """--wall FILE means what it means to touchafm view: a window for each output, at its place, with its part of the scene."""

    def wall(self, name, text):
        path = os.path.join(self.folder, name + ".toml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def shown(self, name, text, requests=()):
        """A server with the windows of a wall, after these requests, and what the screen then shows."""
        server = self.viewed(name, "--wall", self.wall(name, text))
        for request in requests:
            self.assertIn(b'"ok":true', server.ask(request))
        return server, self.still()

    def expect_windows(self, places):
        for name, (x, y, width, height) in places.items():
            def said(name=name):
                return self.xdotool("search", "--onlyvisible", "--name", f"^TouchAFM, {name}$", "getwindowgeometry")
            self.wait_for(lambda: f"Position: {x},{y} " in said() and f"Geometry: {width}x{height}\n" in said(), said)  # noqa: B023

    def test_of_two_windows_shows_what_one_of_their_size_shows(self):
        one, whole = self.shown("one", WHOLE + output("all", "wall", [0, 0, 640, 240]) + VIEWER, REQUESTS[:5])
        self.assertEqual(one.end(), 0)
        two, halves = self.shown("two", LEFT_HALF + RIGHT_HALF + output("one", "west", LEFT_PX) + output("other", "east", RIGHT_PX) +
                                 VIEWER, REQUESTS[:5])
        self.expect_windows({"one": LEFT_PX, "other": RIGHT_PX})
        for part in (np.s_[:240, :320], np.s_[:240, 320:640]):
            self.assertGreater(np.ptp(whole[part]), 100, "a picture, not one colour")
            differ = (np.abs(whole[part] - halves[part]).max(axis=2) > 24).mean()
            self.assertLess(differ, 0.02)
        self.assertFalse(halves[240:].any(), "nothing beside the windows")
        self.assertEqual(two.end(), 0)

    def test_of_a_pair_of_projectors_has_the_picture_of_each_eye(self):
        def eye(side):
            return f'mode = "dual"\neye = "{side}"\n'
        server, seen = self.shown("pair", WHOLE + output("l", "wall", LEFT_PX, eye("left")) + output("r", "wall", RIGHT_PX, eye("right")) +
                                  VIEWER, REQUESTS[:3])
        left, right = seen[:240, :320], seen[:240, 320:640]
        self.assertGreater(np.abs(left - right).max(), 40, "two eyes")
        self.assertGreater(np.corrcoef(left.ravel(), right.ravel())[0, 1], 0.8, "of one scene")
        self.assertEqual(server.end(), 0)

    def test_of_several_screens_goes_around_the_corner_and_opens_again_there(self):
        places = {"left": LEFT_PX, "front": RIGHT_PX, "right": BELOW_PX}
        text = CORNER + "".join(output(name, name, rect) for name, rect in places.items()) + VIEWER.replace("2.0]", "0.6]")
        server, before = self.shown("corner", text, REQUESTS[:5])
        self.expect_windows(places)
        for x, y, width, height in places.values():
            self.assertGreater(np.ptp(before[y:y + height, x:x + width]), 60)
        # the image, in false colours, came after the curve, though that one still moved
        self.assertGreater(((before[:, :, 2] - before[:, :, 0]) > 100)[:240, :320].mean(), 0.02)
        plain = Server(self.folder, "plain")
        self.addCleanup(plain.process.kill)
        for request in REQUESTS[:5]:
            plain.ask(request)
        for request in REQUESTS[5:]:  # with a sample that the wall lacks
            self.assertEqual(plain.ask(request), server.ask(request), request)
        self.wait_for(lambda: server.said().count("drawing ") == 2, server.said)
        after = self.still()
        self.expect_windows(places)
        self.assertGreater(np.abs(after - before)[:240, 320:640].max(), 60, "another sample")
        self.assertEqual(plain.ask({"do": "curve"}), server.ask({"do": "curve"}))
        again = self.still()
        self.assertLess((np.abs(again - after).max(axis=2) > 24)[:240, :320].mean(), 0.02, "the first curve is drawn, too")
        self.assertEqual(plain.end(), 0)
        self.assertEqual(server.end(), 0)
        self.assertNotIn("ended", server.said())

    def test_of_several_machines_is_shown_in_one_window_or_refused(self):
        text = WHOLE + '[[node]]\nname = "far"\nhost = "10.0.0.2"\n' + output("away", "wall", LEFT_PX, 'mode = "mono"\nnode = "far"\n') + VIEWER
        file = self.wall("machines", text)
        server = Server(self.folder, "refused", "--view", "--wall", file, display=self.display)
        self.assertEqual(server.process.wait(timeout=60), 2)
        self.assertIn("the wall has outputs on other machines: add --size to show it in one window", server.said())
        self.assertFalse(os.path.exists(server.path))
        server = self.viewed("one-window", "--wall", file, "--size", "320x240")
        self.assertGreater(np.ptp(self.still()[:240, :320]), 100)
        self.assertEqual(server.end(), 0)


if __name__ == "__main__":
    unittest.main()
