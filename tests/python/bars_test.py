# SPDX-License-Identifier: Apache-2.0
"""A thousand curves and a thousand images through the socket, twice with the same bytes, and what a curve costs next to the library and
a law next to numpy. Prints times, and ratios of processor time, medians of five; judges bytes only."""

import hashlib
import json
import os
import statistics
import time
import unittest

import numpy as np

import touchafm
from touchafm import serve

CURVES = IMAGES = 1000
POINTS = 500  # of each branch


def running_ns(task):
    with open(f"{task}/schedstat", encoding="ascii") as text:
        return int(text.read().split()[0])


def processor_s(server=None):
    """Processor time of this process and of a server."""
    if server is None:
        return time.process_time()
    tasks = f"/proc/{server}/task"
    return time.process_time() + sum(running_ns(f"{tasks}/{each}") for each in os.listdir(tasks)) * 1e-9


def seconds(work, count, server=None):
    begin = processor_s(server)
    for _ in range(count):
        work()
    return (processor_s(server) - begin) / count


def ratio(work, anchor, count, server=None):
    """Time of work over that of its anchor, taken by turns, and the time of the anchor."""
    work()
    anchor()
    pairs = [(seconds(work, count, server), seconds(anchor, count)) for _ in range(5)]
    return statistics.median(each / beside for each, beside in pairs), statistics.median(beside for _, beside in pairs)


def answers(afm, request, count):
    """Digest of all answers, as bytes, and the time that they take."""
    digest, begin = hashlib.sha256(), time.perf_counter()
    for _ in range(count):
        afm._socket.sendall(request)
        line = b'"line":'
        while b'"line":' in line[:40]:
            line = afm._answers.readline()
            digest.update(line)
        assert b'"ok":true' in line[:40], line
    return digest.hexdigest(), time.perf_counter() - begin


class Served(unittest.TestCase):
    def twice(self, what, request, count):
        digests = []
        for _ in range(2):
            with serve.start(seed=7) as afm:
                afm.set(force_noise_N=2e-11, noise_m=1e-11)
                afm.approach()
                begin = processor_s(afm._server.pid)
                digest, taken = answers(afm, request, count)
                digests.append(digest)
                worked = processor_s(afm._server.pid) - begin
            print(f"{count} {what}: {taken:.1f} s, of which {worked:.1f} s of processor time")
        self.assertEqual(*digests)

    def test_curves_are_the_same_bytes_twice(self):
        self.twice(f"curves of 2 x {POINTS} points", b'{"do": "curve", "points": %d}\n' % POINTS, CURVES)

    def test_images_are_the_same_bytes_twice(self):
        self.twice("images of 64 x 64 pixels", b'{"do": "scan"}\n', IMAGES)

    def test_curves_cost_little_more_than_in_the_library(self):
        mica = touchafm.Contact.material("mica")
        step = (20e-9 + 5e-9) / (POINTS - 1)
        with serve.start(seed=7) as afm:
            request = b'{"do": "curve", "z_from_m": 2e-8, "z_to_m": -5e-9, "points": %d}\n' % POINTS

            def packed():
                return afm.curve(z_from=2e-8, z_to=-5e-9, points=POINTS)

            def text():
                afm._socket.sendall(request)
                return afm._answers.readline()

            def numbers():
                answer = json.loads(text())
                return np.array(answer["z_m"]), np.array(answer["force_N"])

            for served in (packed, text, numbers):
                times, library = ratio(served, lambda: touchafm.cycle(mica, z_from=20e-9, z_to=-5e-9, step=step), 100, afm._server.pid)
                print(f"a curve, {served.__name__}: {times:.2f} times the library's {1e3 * library:.2f} ms")


class Law(unittest.TestCase):
    def test_costs_no_more_than_numpy(self):
        mica = touchafm.Contact.material("mica")
        law = touchafm.law("dmt", mica)
        radius, hamaker, modulus = mica.tip_radius, mica.hamaker, mica.reduced_modulus
        pull_off = 2.0 * np.pi * radius * mica.work_of_adhesion
        gap = np.sqrt(hamaker * radius / (6.0 * pull_off))
        heights = np.random.default_rng(1).uniform(-2e-9, 20e-9, 1_000_000)

        def by_numpy():  # the force on a tip at these heights, without a lever
            depth = np.maximum(gap - heights, 0.0)
            return np.where(heights > gap, -hamaker * radius / (6.0 * heights**2),
                            4.0 / 3.0 * modulus * np.sqrt(radius) * depth**1.5 - pull_off)

        for branch in ("free", "attached"):
            times, numpy = ratio(lambda: law.force(heights, branch=branch), by_numpy, 3)
            print(f"{branch} branch at 1e6 heights: {times:.2f} times numpy's {1e3 * numpy:.1f} ms")


if __name__ == "__main__":
    unittest.main()
