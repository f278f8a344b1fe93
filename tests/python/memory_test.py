# SPDX-License-Identifier: Apache-2.0
"""No call keeps memory: each is repeated as often as its cost allows, and the process does not grow. Prints bytes for each call."""

import ctypes
import gc
import os
import pathlib
import sys
import tempfile
import time
import unittest

import numpy as np

import touchafm
from study_test import write_study

MOST_BYTES = 16384  # of all calls together: of caches and of threads that end
MICA = touchafm.Contact.material("mica")
STIFF = touchafm.Contact.material("mica", spring_constant=40.0, tip_radius=20e-9)
GEL = {"tip_radius": 5e-6, "modulus": 3e3, "spring_constant": 0.05, "most_force": 1e-9, "noise": 15e-12}
Z = np.linspace(1e-6, 0.0, 20)
SESSION = pathlib.Path(__file__).resolve().parent.parent / "formats" / "0.2.0" / "session-mica.afms"


class Mallinfo(ctypes.Structure):
    _fields_ = [(name, ctypes.c_size_t) for name in ("arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks",
                                                     "fordblks", "keepcost")]


LIBC = ctypes.CDLL(None)
LIBC.mallinfo2.restype = Mallinfo


def held():
    """What the process holds: bytes that were allocated and not freed, without Python's small objects, and the number of those."""
    gc.collect()
    info = LIBC.mallinfo2()
    return info.uordblks + info.hblkhd, sys.getallocatedblocks()


def grown(call, count):
    """Bytes and small objects that the calls keep, once caches are full."""
    for _ in range(max(count // 20, min(count, 10))):
        call()
    bytes_before, objects_before = held()
    for _ in range(count):
        call()
    bytes_after, objects_after = held()
    return bytes_after - bytes_before, objects_after - objects_before


def refused(call):
    """An argument or a file that is refused leaves nothing either."""
    try:
        call()
    except (ValueError, OSError):
        return
    raise AssertionError("it was not refused")


class Memory(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.file, cls.study = os.path.join(folder.name, "gel.tab"), os.path.join(folder.name, "class")
        cls.curve = touchafm.generate(points=100, **GEL)[0][0]
        cls.curve.write(cls.file, format="tab")
        cls.image, cls.written = os.path.join(folder.name, "mica.gwy"), os.path.join(folder.name, "zero.gwy")
        touchafm.scan(MICA, pixels=8).write(cls.image)
        write_study(cls.study)

    def expect_no_growth(self, calls):
        for name, (count, call) in calls.items():
            with self.subTest(name):
                begin = time.process_time()
                for _ in range(3):  # a cache fills once, a leak grows again
                    more, objects = grown(call, count)
                    if more < MOST_BYTES and objects < max(count // 2, 20):
                        break
                taken = time.process_time() - begin
                print(f"{name}: {count} calls, {more} bytes and {objects} objects more, {taken:.1f} s of processor time")
                self.assertLess(more, MOST_BYTES)
                self.assertLess(objects, max(count // 2, 20))

    def test_of_contacts_laws_and_cycles(self):
        def cycle():
            result = touchafm.cycle(MICA, step=5e-9)
            return result.z, result.force, result.approach, result.events, result.figures

        self.expect_no_growth({
            "Contact": (100_000, lambda: touchafm.Contact(law="paper", spring_constant=0.1, tip_radius=5e-8, hamaker=2e-20,
                                                          work_of_adhesion=4e-3)),
            "Contact.as_dict": (20_000, MICA.as_dict),
            "Law.force": (100_000, lambda law=touchafm.law("dmt", MICA): (law.force(Z), law.force(1e-9), law.figures)),
            "law": (1_000, lambda: touchafm.law("jkr", MICA)),
            "cycle": (3_000, cycle),
            "Cycle.as_dict": (20_000, touchafm.cycle(MICA).as_dict),
            "sweep": (1_000, lambda: touchafm.sweep(MICA, "paper", tip_radius=[1e-8, 2e-8]).pull_off_force),
            "a refused contact": (3_000, lambda: refused(lambda: touchafm.Contact.material("mica", tip_radius=-1.0))),
        })

    def test_of_curves_and_fits(self):
        def curve():
            made = touchafm.Curve(z=Z, force=Z, approach=Z > -1.0, spring_constant=0.1)
            return made.z, made.force, made.approach, made.metadata, made.time

        def fit():
            found = touchafm.fit(self.curve, model="paraboloid", tip_radius=5e-6)
            return found.force, found.doubts, found.as_dict()

        self.expect_no_growth({
            "Curve": (100_000, curve),
            "analyse": (1_000, lambda: touchafm.analyse(self.curve).as_dict()),
            "fit": (1_000, fit),
            "generate": (2_000, lambda: touchafm.generate(points=50, **GEL)),
            "a refused fit": (3_000, lambda: refused(lambda: touchafm.fit(self.curve, model="cube"))),
        })

    def test_of_images_and_swings(self):
        def scan():
            taken = touchafm.scan(MICA, pixels=8)
            return taken.channels, taken.units, taken.as_dict(), taken.truth

        def tapping(**path):
            taken = touchafm.tapping(STIFF, free_amplitude=20e-9, resonance=300e3, quality_factor=400.0, **path)
            return taken.z, taken.phase, taken.as_dict()

        frequency = np.linspace(50e3, 90e3, 200)
        density = 1e-26 / ((1 - (frequency / 70e3) ** 2) ** 2 + (frequency / 70e3 / 50) ** 2)
        self.expect_no_growth({
            "scan": (150, scan),
            "tapping": (100, lambda: tapping(z_from=24e-9, z_to=20e-9, step=1e-9)),
            "states of tapping": (5, lambda: tapping(at=16e-9)),
            "frequency_shift": (500, lambda: touchafm.frequency_shift(MICA, amplitude=1e-9, resonance=3e4, law="dmt", at=5e-9).shift),
            "lever": (500, lambda: touchafm.lever(thermal=(frequency, density)).as_dict()),
            "level": (100_000, lambda values=np.zeros((4, 4)): touchafm.level(values)),
        })

    def test_of_files(self):
        def session():
            felt = touchafm.session(SESSION)
            return felt.force, felt.in_contact, felt.events, felt.event_kind, felt.parameters

        self.expect_no_growth({
            "read": (2_000, lambda: touchafm.read(self.file)[0].force),
            "read_image": (300, lambda: touchafm.read_image(self.image)),
            "write_image": (2_000, lambda: touchafm.write_image(self.written, {"Height": (np.zeros((4, 4)), "m")}, width=1e-6, height=1e-6)),
            "session": (300, session),
            "study": (200, lambda: (touchafm.study(self.study).trials, touchafm.study(self.study).as_dict())),
            "a file that is not there": (5_000, lambda: refused(lambda: touchafm.read("/nowhere.tab"))),
        })

    def test_notices_a_small_leak(self):
        kept = []
        self.assertGreater(grown(lambda: kept.append(bytearray(100)), 1000)[1], 500)
        more, _ = grown(lambda: kept.append(bytearray(2000)), 100)  # of malloc
        self.assertGreater(more, 2000 * 100 * 0.9)


if __name__ == "__main__":
    unittest.main()
