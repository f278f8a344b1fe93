# SPDX-License-Identifier: Apache-2.0
"""No call keeps memory: each is repeated as often as its cost allows, and the process does not grow. Prints bytes for each call."""

import ctypes
import gc
import os
import pathlib
import tempfile
import unittest

import numpy as np

import touchafm
from study_test import write_study

MOST_KIB = 1024  # 10 bytes of each of 100,000 calls, 500 of each of 2,000
MICA = touchafm.Contact.material("mica")
STIFF = touchafm.Contact.material("mica", spring_constant=40.0, tip_radius=20e-9)
GEL = {"tip_radius": 5e-6, "modulus": 3e3, "spring_constant": 0.05, "most_force": 1e-9, "noise": 15e-12}
Z = np.linspace(1e-6, 0.0, 20)
SESSION = pathlib.Path(__file__).resolve().parent.parent / "formats" / "0.2.0" / "session-mica.afms"


def resident_kib():
    """Memory that the process holds, once what was freed is given back."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    with open("/proc/self/statm", encoding="ascii") as pages:
        return int(pages.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") // 1024


def grown_kib(call, count):
    for _ in range(max(count // 20, 20)):
        call()
    before = resident_kib()
    for _ in range(count):
        call()
    return resident_kib() - before


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
                grown = grown_kib(call, count)
                print(f"{name}: {count} calls, {grown} KiB more: {1024 * grown / count:.1f} bytes a call")
                self.assertLess(grown, MOST_KIB)

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

        def tapping():
            taken = touchafm.tapping(STIFF, free_amplitude=20e-9, resonance=300e3, quality_factor=400.0, at=16e-9)
            return taken.z, taken.phase, taken.as_dict()

        frequency = np.linspace(50e3, 90e3, 200)
        density = 1e-26 / ((1 - (frequency / 70e3) ** 2) ** 2 + (frequency / 70e3 / 50) ** 2)
        self.expect_no_growth({
            "scan": (150, scan),
            "tapping": (500, tapping),
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
            "study": (60, lambda: (touchafm.study(self.study).trials, touchafm.study(self.study).as_dict())),
            "a file that is not there": (5_000, lambda: refused(lambda: touchafm.read("/nowhere.tab"))),
        })

    def test_notices_a_small_leak(self):
        kept = []
        self.assertGreater(grown_kib(lambda: kept.append(bytearray(100)), 100_000), MOST_KIB)


if __name__ == "__main__":
    unittest.main()
