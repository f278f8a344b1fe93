# SPDX-License-Identifier: Apache-2.0
"""as_dict() of every type of result is the JSON of the command, to the last digit: same keys, order and numbers."""

import json
import math
import os
import pathlib
import tempfile
import unittest

import numpy as np

import touchafm
from command import json_of, touchafm as command, whoever_gave_it
from study_test import write_study

GEL = {"modulus": 3e3, "tip_radius": 5 / 1e6, "spring_constant": 0.05, "most_force": 1 / 1e9, "noise": 15 / 1e12}
GEL_TYPED = "--modulus 3kPa --radius 5um --spring-constant 0.05N/m --most-force 1nN --noise 15pN"
STICKY_TYPED = ("--law jkr --radius 1um --modulus 1MPa --work-of-adhesion 20mJ/m2 --spring-constant 1N/m --most-force 200nN "
                "--noise 300pN")
STIFF = {"spring_constant": 40.0, "tip_radius": 20 / 1e9}
STIFF_TYPED = "--material mica --spring-constant 40N/m --tip-radius 20nm"
SWING = {"free_amplitude": 20 / 1e9, "resonance": 300e3, "quality_factor": 400.0}
SWING_TYPED = "--mode tapping --free-amplitude 20nm --resonance 300kHz --quality-factor 400"
SMALL = {"size": 40 / 1e9, "pixels": 12, "rate": 20.0, "seed": 5}
SMALL_TYPED = "--size 40nm --pixels 12 --rate 20Hz --seed 5"
DEGREES_17 = 17 / (180 / math.pi)  # as 17deg is read
GLASS_TYPED = "--modulus 50GPa --radius 5um --spring-constant 0.05N/m --sensitivity 60nm/V --most-force 1nN"


def mica(**given):
    return touchafm.Contact.material("mica", **given)


def gold(**given):
    return touchafm.Contact.material("gold", **given)


# The module's call, and what is typed for the same after "touchafm".
CONTACTS = [
    (lambda: mica(), "curve --material mica"),
    (lambda: mica(law="jkr", tip_radius=7 / 1e9), "curve --material mica --model jkr --tip-radius 7nm"),
    (lambda: gold(probe="mlct-c", humidity=0.3), "curve --material gold --probe mlct-c --humidity 30%"),
    (lambda: touchafm.Contact(law="dmt", tip_radius=2 / 1e9, spring_constant=3.0, hamaker=50 / 1e21, work_of_adhesion=30 / 1e3,
                              reduced_modulus=7e9),
     "curve --model dmt --tip-radius 2nm --spring-constant 3N/m --hamaker 50zJ --work-of-adhesion 30mJ/m2 --reduced-modulus 7GPa"),
]
CYCLES = [
    *((lambda law=law: touchafm.cycle(mica(), law), f"curve --material mica --model {law}")
      for law in ("auto", "paper", "paper-rule", "hertz", "dmt", "jkr", "maugis", "hao", "lj", "dynamic-dmt")),
    (lambda: touchafm.cycle(gold(), z_from=40 / 1e9, z_to=-3 / 1e9, step=0.05 / 1e9),
     "curve --material gold --from 40nm --to=-3nm --step 0.05nm"),
    (lambda: touchafm.cycle(gold(), "dynamic-jkr", speed=2 / 1e6, seed=9), "curve --material gold --model dynamic-jkr --speed 2um/s --seed 9"),
]
SWEEPS = [
    (lambda: touchafm.sweep(mica(), "dmt", spring_constant=np.linspace(0.05, 0.25, 5)),
     "curve --material mica --model dmt --sweep spring-constant=0.05N/m:0.25N/m:5"),
    (lambda: touchafm.sweep(gold(), "maugis", tip_radius=np.array([5.0, 10.0]) / 1e9, work_of_adhesion=np.array([50.0, 100.0, 150.0]) / 1e3),
     "curve --material gold --model maugis --sweep tip-radius=5nm:10nm:2 --sweep work-of-adhesion=50mJ/m2:150mJ/m2:3"),
]
FITS = [
    ("gel", {"model": "paraboloid", "tip_radius": 5 / 1e6}, "--fit paraboloid --radius 5um"),
    ("gel", {"model": "sphere", "tip_radius": 5 / 1e6, "tilt": True, "uncertainties": {"spring_constant": 0.07, "tip_radius": 0.05}},
     "--fit sphere --radius 5um --tilt --uncertainty spring-constant=7% --uncertainty radius=5%"),
    ("gel", {"model": "cone", "half_angle": DEGREES_17, "white_noise": True}, "--fit cone --half-angle 17deg --white-noise"),
    ("gel", {"model": "layer-exact-sphere", "tip_radius": 5 / 1e6, "layer": 8 / 1e6, "poisson": 0.45, "base": "sliding"},
     "--fit layer-exact-sphere --radius 5um --layer 8um --poisson 0.45 --base sliding"),
    ("gel", {"model": "paraboloid", "tip_radius": 5 / 1e6, "against": "tip", "most_force": 0.5 / 1e9},
     "--fit paraboloid --radius 5um --against tip --most-force 0.5nN"),
    ("gel", {"model": "paraboloid", "tip_radius": 5 / 1e6, "bootstrap": True}, "--fit paraboloid --radius 5um --bootstrap"),
    ("sticky", {"model": "auto", "tip_radius": 1 / 1e6}, "--fit auto --radius 1um"),
    ("sticky", {"model": "jkr", "tip_radius": 1 / 1e6, "contact_point": "fit-polynomial"},
     "--fit jkr --radius 1um --contact-point fit-polynomial"),
]
TAPPINGS = [
    (lambda: touchafm.tapping(mica(**STIFF), **SWING), f"curve {STIFF_TYPED} {SWING_TYPED}"),
    (lambda: touchafm.tapping(mica(**STIFF), at=16 / 1e9, **SWING), f"curve {STIFF_TYPED} {SWING_TYPED} --at 16nm"),
    (lambda: touchafm.tapping(mica(**STIFF), drive=299e3, viscosity=100.0, z_from=24 / 1e9, z_to=12 / 1e9, step=0.5 / 1e9, law="dmt", **SWING),
     f"curve {STIFF_TYPED} {SWING_TYPED} --drive 299kHz --viscosity 100Pa*s --from 24nm --to 12nm --step 0.5nm --model dmt"),
    (lambda: touchafm.tapping(mica(**STIFF), at=16 / 1e9, method="direct", **{**SWING, "quality_factor": 20.0}),
     f"curve {STIFF_TYPED} {SWING_TYPED.replace('400', '20')} --at 16nm --method direct"),
]
SHIFTS = [
    (lambda: touchafm.frequency_shift(mica(), amplitude=1 / 1e9, resonance=30e3, law="dmt"),
     "curve --mode fm --material mica --model dmt --resonance 30kHz --amplitude 1nm"),
    (lambda: touchafm.frequency_shift(gold(), amplitude=0.3 / 1e9, resonance=30e3, law="dmt", at=5 / 1e9),
     "curve --mode fm --material gold --model dmt --resonance 30kHz --amplitude 0.3nm --at 5nm"),
]
SCANS = [
    (lambda: touchafm.scan(mica(), **SMALL), f"scan --material mica {SMALL_TYPED}"),
    (lambda: touchafm.scan(gold(tip_radius=8 / 1e9), tip="cone", tip_angle=DEGREES_17, noise=50 / 1e12, direction="up", show_truth=True,
                           feedback=False, **SMALL),
     f"scan --material gold --tip-radius 8nm --tip cone --tip-angle 17deg --noise 50pm --direction up --show-truth --no-feedback {SMALL_TYPED}"),
    (lambda: touchafm.scan(mica(spring_constant=40.0), mode="tapping", amplitude_setpoint=14 / 1e9, **SWING, **SMALL),
     f"scan --material mica --spring-constant 40N/m {SWING_TYPED} --setpoint 14nm {SMALL_TYPED}"),
]
SADER = {"length": 120 / 1e6, "width": 30 / 1e6, "resonance": 70e3, "quality_factor": 150.0}
LEVERS = [
    (lambda: touchafm.lever(sader=True, **SADER), "lever --sader --length 120um --width 30um --resonance 70kHz --quality-factor 150"),
    (lambda: touchafm.lever(thermal="volts.txt", sensitivity=60 / 1e9, averages=100.0), "lever --thermal volts.txt --sensitivity 60nm/V --averages 100"),
    (lambda: touchafm.lever(sensitivity_from="glass.h5"), "lever --sensitivity-from glass.h5"),
]


class Results(unittest.TestCase):
    maxDiff = None
    seen = set()

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.addClassCleanup(os.chdir, os.getcwd())
        volts = pathlib.Path(__file__).resolve().parent.parent / "fuzz" / "corpus" / "spectrum" / "volts.txt"
        os.chdir(folder.name)
        pathlib.Path("volts.txt").write_bytes(volts.read_bytes())
        for name, typed in (("gel", GEL_TYPED), ("sticky", STICKY_TYPED), ("glass", GLASS_TYPED)):
            made = command("generate", "curve", *typed.split(), "--points", "300", "--out", f"{name}.h5")
            assert made.returncode == 0, made.stderr

    @classmethod
    def tearDownClass(cls):
        every = {name for name in touchafm.__all__ if hasattr(getattr(touchafm, name), "as_dict")}
        assert every == cls.seen, every ^ cls.seen  # no type of result without a row

    def expect(self, result, command_json):
        self.seen.add(type(result).__name__)
        mine, theirs = whoever_gave_it(result.as_dict()), whoever_gave_it(command_json)
        self.assertEqual(mine, theirs)
        self.assertEqual(json.dumps(mine), json.dumps(theirs))

    def expect_rows(self, rows):
        for call, typed in rows:
            with self.subTest(typed):
                self.expect(call(), json_of(*typed.split(), "--json"))

    def test_of_a_contact(self):
        for call, typed in CONTACTS:
            with self.subTest(typed):
                contact = call()
                curve, mine = json_of(*typed.split(), "--json"), contact.as_dict()
                curve["parameters"] = {key: curve["parameters"][key] for key in mine["parameters"]}  # without the path of a cycle
                self.expect(contact, {key: curve[key] for key in mine})

    def test_of_a_cycle(self):
        self.expect_rows(CYCLES)

    def test_of_a_sweep(self):
        self.expect_rows(SWEEPS)

    def test_of_an_analysis_and_a_fit(self):
        for name, given, typed in FITS:
            with self.subTest(typed):
                whole = json_of("analyse", f"{name}.h5", *typed.split(), "--json")
                analysis = touchafm.analyse(touchafm.read(f"{name}.h5")[0], contact_point=given.get("contact_point"))
                fit = touchafm.fit(analysis, **{key: value for key, value in given.items() if key != "contact_point"})
                self.expect(fit, whole.pop("fit"))
                self.expect(analysis, whole)

    def test_of_a_swing(self):
        self.expect_rows(TAPPINGS)

    def test_of_a_frequency_shift(self):
        self.expect_rows(SHIFTS)

    def test_of_a_scan(self):
        self.expect_rows(SCANS)

    def test_of_a_lever(self):
        self.expect_rows(LEVERS)

    def test_of_a_study(self):
        write_study("class")
        self.assertEqual(command("study", "class", "--out", "report").returncode, 0)
        self.expect(touchafm.study("class"), json.loads(pathlib.Path("report", "study.json").read_text(encoding="utf-8")))

    def test_of_what_is_a_dict_already(self):
        def written(*typed):
            made = command(*typed)
            self.assertEqual(made.returncode, 0, made.stderr)

        written("generate", "curve", *GEL_TYPED.split(), "--points", "50", "--count", "2", "--seed", "4", "--out", "two.h5")
        _, truth = touchafm.generate(points=50, count=2, seed=4, **GEL)
        self.assertEqual(truth, json.loads(pathlib.Path("two.h5.truth.json").read_text(encoding="utf-8")))
        written("generate", "curve", "--law", "jkr", "--modulus", "1MPa", "--work-of-adhesion", "50mJ/m2", "--points", "50", "--out", "usual.h5")
        _, truth = touchafm.generate("jkr", E=1e6, W=50 / 1e3, points=50)
        self.assertEqual(truth, json.loads(pathlib.Path("usual.h5.truth.json").read_text(encoding="utf-8")))
        written("generate", "map", *GEL_TYPED.split(), "--points", "50", "--pixels", "3x2", "--field", "islands", "--second-modulus",
                "9kPa", "--out", "map.h5")
        _, truth = touchafm.generate_map(points=50, pixels=(3, 2), field="islands", second_modulus=9e3, **GEL)
        self.assertEqual(truth, json.loads(pathlib.Path("map.h5.truth.json").read_text(encoding="utf-8")))
        written("paper", "--out", "paper")
        paper = json.loads(pathlib.Path("paper", "paper.json").read_text(encoding="utf-8"))
        tables = touchafm.paper_tables()
        self.assertEqual(tables, {key: paper[key] for key in tables})

    def test_of_a_session(self):
        file = pathlib.Path(__file__).resolve().parent.parent / "formats" / "0.2.0" / "session-mica.afms"
        session, replay = touchafm.session(file), json_of("replay", str(file), "--json")
        self.assertEqual(session.parameters, replay["parameters"])
        self.assertEqual(session.sources, replay["sources"])
        self.assertEqual((session.material, session.rate, session.complete), (replay["material"], replay["rate_Hz"], replay["complete"]))
        self.assertEqual(len(session), replay["ticks"])


if __name__ == "__main__":
    unittest.main()
