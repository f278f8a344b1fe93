# SPDX-License-Identifier: Apache-2.0
"""Curves of files and arrays, their analysis and fits: the numbers, refusals and JSON of the command."""

import json
import os
import pathlib
import pickle
import shutil
import tempfile
import unittest

import numpy as np

import touchafm
from command import error_of, json_of, touchafm as command

GEL = {"tip_radius": 5e-6, "modulus": 3e3, "spring_constant": 0.05, "most_force": 1e-9, "noise": 15e-12}
GEL_COMMAND = ("--radius", "5um", "--modulus", "3kPa", "--spring-constant", "0.05N/m", "--most-force", "1nN", "--noise", "15pN")


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def made(self, name, *options):
        path = self.folder / name
        result = command("generate", "curve", *GEL_COMMAND, *options, "--out", str(path))
        self.assertEqual(result.returncode, 0, result.stderr)
        return path


class Reading(Files):
    def test_gives_every_curve_of_a_file(self):
        curves = touchafm.read(self.made("gels.h5", "--count", "3", "--points", "100"))
        self.assertEqual(len(curves), 3)
        self.assertEqual([len(curve) for curve in curves], [200, 200, 200])
        self.assertEqual(curves[0].metadata["spring_constant"], 0.05)
        self.assertEqual(int(curves[0].approach.sum()), 100)

    def test_takes_another_calibration(self):
        path = self.made("gel.tab")
        plain, stiff = touchafm.read(path)[0], touchafm.read(path, spring_constant=0.1)[0]
        np.testing.assert_allclose(stiff.force, 2.0 * plain.force, rtol=1e-12)
        for wrong in (0.0, -1.0, float("nan"), float("inf")):
            with self.assertRaises(ValueError):
                touchafm.read(path, spring_constant=wrong)

    def test_refuses_with_the_words_of_the_command(self):
        broken = self.folder / "broken.tab"
        broken.write_bytes(self.made("gel.tab").read_bytes()[:5000])
        for path in (self.folder / "nothing.tab", broken):
            with self.assertRaises(touchafm.FileError) as refused:
                touchafm.read(path)
            self.assertEqual(str(refused.exception), error_of("analyse", str(path)))
        self.assertTrue(issubclass(touchafm.FileError, OSError))

    def test_names_a_file_whose_name_is_no_utf8(self):
        path = os.fsencode(self.folder) + b"/gel\xff.tab"
        with self.assertRaisesRegex(touchafm.FileError, "no such file"):
            touchafm.read(path)
        shutil.copy(self.made("gel.tab"), path)
        self.assertIn("gel\ufffd.tab", repr(touchafm.read(path)[0]))

    def test_reads_an_image(self):
        path = self.folder / "mica.gwy"
        result = command("generate", "image", "--material", "mica", "--size", "40nm", "--pixels", "16", "--rate", "20Hz",
                         "--out", str(path))
        self.assertEqual(result.returncode, 0, result.stderr)
        image = touchafm.read_image(path)
        values, unit = image["channels"][image["chosen"]]
        self.assertEqual((values.shape, unit), ((16, 16), "m"))
        self.assertAlmostEqual(image["width"], 40e-9)


class Images(Files):
    CHANNELS = {"Modulus": (np.array([[1e3, np.nan, 3e3], [4e3, 5e3, 6e3]]), "Pa"), "A name, \u00b5": ([[1, 2, 3], [4, 5, 6]], "")}

    def test_are_read_as_they_were_written(self):
        touchafm.write_image(self.folder / "map.gwy", self.CHANNELS, width=3e-6, height=2e-6, metadata={"Tip": "R = 5 um"})
        image = touchafm.read_image(self.folder / "map.gwy", channel="Modulus")
        self.assertEqual(list(image["channels"]), list(self.CHANNELS))
        for name, (values, unit) in self.CHANNELS.items():
            np.testing.assert_array_equal(image["channels"][name][0], values)
            self.assertEqual(image["channels"][name][1], unit)
        self.assertEqual((image["width"], image["height"], image["metadata"]["Tip"]), (3e-6, 2e-6, "R = 5 um"))
        self.assertEqual(image["metadata"]["Software"], f"TouchAFM {touchafm.__version__}")
        touchafm.write_image(self.folder / "map.gsf", {"Modulus": self.CHANNELS["Modulus"]}, width=3e-6, height=2e-6)
        values, unit = touchafm.read_image(self.folder / "map.gsf", channel="Modulus")["channels"]["Modulus"]
        np.testing.assert_array_equal(values, self.CHANNELS["Modulus"][0])
        self.assertEqual(unit, "Pa")

    def test_are_refused_where_no_file_could_hold_them(self):
        heights = np.zeros((2, 3))
        for channels, words in (({}, "give one at least"), ({"Height": heights}, 'give an array and its SI unit, such as'),
                                ({"Height": (heights[0], "m")}, "two dimensions"), ({"Height": (heights, "m\0")}, "zero byte"),
                                ({"Height": (heights + np.inf, "m")}, "beyond 1e\\+100; mark"), ({"Height": (None, "m")}, "array"),
                                ({"a": (heights, "m"), "b": (heights.T, "m")}, r'channels\["b"\]: it has 2 x 3 pixels, those before 3 x 2')):
            with self.subTest(words), self.assertRaisesRegex((ValueError, TypeError), words):
                touchafm.write_image(self.folder / "no.gwy", channels, width=1e-6, height=1e-6)
        good = {"Height": (heights, "m")}
        for path, given, words in (("no.png", {}, ".gwy or .gsf"), ("no.gwy", {"width": -1.0}, "width: -1 m is not positive"),
                                   ("no.gwy", {"height": float("nan")}, "height: nan m")):
            with self.assertRaisesRegex(ValueError, words):
                touchafm.write_image(self.folder / path, good, **{"width": 1e-6, "height": 1e-6, **given})
        with self.assertRaisesRegex(ValueError, "holds one channel, not 2"):
            touchafm.write_image(self.folder / "no.gsf", self.CHANNELS, width=1e-6, height=1e-6)
        with self.assertRaises(touchafm.FileError):
            touchafm.write_image(self.folder / "nowhere" / "no.gwy", good, width=1e-6, height=1e-6)
        self.assertEqual(list(self.folder.glob("no.*")), [])


class Curves(Files):
    def test_are_written_and_read_back(self):
        curve = touchafm.generate(points=100, **GEL)[0][0]
        for ending in ("tab", "h5"):
            path = self.folder / f"curve.{ending}"
            curve.write(path, format=ending)
            again = touchafm.read(path)[0]
            np.testing.assert_allclose(again.force, curve.force, rtol=1e-9, atol=1e-20)
        with self.assertRaises(ValueError):
            curve.write(self.folder / "curve.doc", format="doc")
        curve.write(self.folder / "by-ending.tab")
        self.assertEqual((self.folder / "by-ending.tab").read_bytes(), (self.folder / "curve.tab").read_bytes())
        with self.assertRaisesRegex(ValueError, "curve.doc: name a file that ends in .h5"):
            curve.write(self.folder / "curve.doc")
        with self.assertRaises(OSError):
            curve.write("/nowhere/curve.tab", format="tab")

    def test_refuse_an_approach_that_is_none(self):
        z = np.linspace(1e-6, 0.0, 5)
        touchafm.Curve(z=z, force=z, approach=np.array([1, 1, 1, 0, 0], ">i2"))
        for approach in (np.full(5, 0.5), z, [1, 1, 2, 0, 0]):
            with self.assertRaisesRegex(ValueError, "approach: .* is neither True nor False"):
                touchafm.Curve(z=z, force=z, approach=approach)

    def test_are_refused_in_other_units_than_si(self):
        z = np.linspace(1e-6, 0.0, 5)
        approach = [True] * 3 + [False] * 2
        for z_given, force in ((z * 1e9, z * 0), (range(5), z * 0), (z, [0, 0, 20.5, 0, 0])):
            with self.assertRaisesRegex(ValueError, "point . at .* m with .* N is outside the range of a force microscope"):
                touchafm.Curve(z=z_given, force=force, approach=approach)

    def test_are_made_of_arrays(self):
        z = np.linspace(1e-6, 0.0, 50, dtype=np.float32)
        curve = touchafm.Curve(z=np.concatenate([z, z[::-1]]), force=np.zeros(100), approach=np.arange(100) < 50,
                               spring_constant=0.1, name="mine")
        self.assertEqual((len(curve), curve.name), (100, "mine"))
        with self.assertRaisesRegex(ValueError, r"their shapes are \(50,\), \(49,\) and \(50,\)"):
            touchafm.Curve(z=z, force=z[1:], approach=z > 0)
        with self.assertRaisesRegex(ValueError, r"\(50, 1\)"):
            touchafm.Curve(z=z[:, None], force=z, approach=z > 0)
        for no_numbers in ({"z": ["1"] * 50}, {"force": [None] * 50}, {"approach": ["a"] * 50}, {"force": z * 1j}):
            with self.assertRaises(TypeError, msg=no_numbers):
                touchafm.Curve(**{"z": z, "force": z, "approach": z > 0, **no_numbers})
        with self.assertRaises(ValueError):
            touchafm.Curve(z=z * np.nan, force=z, approach=z > 0)
        with self.assertRaises(ValueError):
            touchafm.Curve(z=z, force=z, approach=np.arange(50) > 10)

    def test_are_pickled_with_all_that_is_known_of_them(self):
        path = self.folder / "map.h5"
        result = command("generate", "map", *GEL_COMMAND, "--drift", "10nm/s", "--pixels", "2x1", "--points", "60", "--out", str(path))
        self.assertEqual(result.returncode, 0, result.stderr)
        mine = touchafm.Curve(z=[1e-9, 0.0], force=[0.0, 1e-9], approach=[1, 0])
        for curve in [*touchafm.read(path), mine]:
            again = pickle.loads(pickle.dumps(curve))
            self.assertEqual((again.name, again.metadata, again.remarks), (curve.name, curve.metadata, curve.remarks))
            for column in ("z", "force", "approach", "time"):
                np.testing.assert_array_equal(getattr(again, column), getattr(curve, column))
        with self.assertRaisesRegex(ValueError, "no pickled curve of this version"):
            touchafm.Curve.__new__(touchafm.Curve).__setstate__(mine.__getstate__()[:5])

    def test_give_back_their_modulus_in_nanites_coordinates(self):  # case S04; docs/examples/by_hand has nanite's own fit
        made, truth = touchafm.generate(tip_radius=5e-6, modulus=3e3, spring_constant=0.05, most_force=1e-9)
        self.assertAlmostEqual(truth["curves"][0]["reduced_modulus_Pa"], 4e3, delta=1e-9)
        path = self.folder / "exact.h5"
        made[0].write(path, format="h5")
        fit = touchafm.fit(touchafm.read(path)[0], model="paraboloid", tip_radius=5e-6, against="tip", white_noise=True)
        self.assertAlmostEqual(fit.E / 3e3, 1.0, delta=1e-6)

    def test_are_those_of_the_command_for_a_seed(self):
        made, truth = touchafm.generate("paraboloid", seed=7, points=100, **GEL)
        read = touchafm.read(self.made("gel.h5", "--seed", "7", "--points", "100"))
        np.testing.assert_allclose(made[0].force, read[0].force, rtol=1e-12)
        self.assertEqual(truth["parameters"]["modulus_Pa"], 3e3)
        for wrong in ({"points": 1}, {"points": -1}, {"count": 0}, {"count": -1}, {"seed": -1}, {"seed": 2**32}, {"base": "sliding"}, {"half_angle": 0.3}, {"noise": -1.0}):
            with self.assertRaises(ValueError, msg=wrong):
                touchafm.generate(**{**GEL, **wrong})


class Maps(Files):
    FIELD = {"field": "islands", "second_modulus": 20e3, "pixels": (5, 4), "size": 8e-6, "points": 60, "seed": 3}

    def test_names_modulus_and_work_of_adhesion_as_a_fit_does(self):
        numbers = {"tip_radius": 1e-6, "spring_constant": 1.0, "most_force": 200e-9, "noise": 20e-12, "points": 100}
        made, truth = touchafm.generate("jkr", E=1e6, W=5e-2, n=2, **numbers)
        same, same_truth = touchafm.generate("jkr", modulus=1e6, work_of_adhesion=5e-2, count=2, **numbers)
        self.assertEqual(truth, same_truth)
        np.testing.assert_array_equal(made[1].force, same[1].force)
        for twice in ({"E": 1e6, "modulus": 1e6}, {"E": 1e6, "n": 1, "count": 1}):
            with self.assertRaisesRegex(ValueError, "leave one out"):
                touchafm.generate("jkr", W=5e-2, **twice, **numbers)

    def test_are_those_of_the_command_for_a_seed(self):
        made, truth = touchafm.generate_map(**self.FIELD, **GEL)
        path = self.folder / "cells.h5"
        result = command("generate", "map", *GEL_COMMAND, "--field", "islands", "--second-modulus", "20kPa", "--pixels", "5x4",
                         "--size", "8um", "--points", "60", "--seed", "3", "--out", str(path))
        self.assertEqual(result.returncode, 0, result.stderr)
        read = touchafm.read(path)
        self.assertEqual(len(made), 20)
        for mine, file in zip(made, read):
            self.assertEqual(mine.metadata["pixel"], file.metadata["pixel"])
            np.testing.assert_allclose(mine.force, file.force, rtol=1e-9, atol=1e-20)
        with open(f"{path}.truth.json", encoding="utf-8") as file:
            written = json.load(file)
        self.assertEqual([each["modulus_Pa"] for each in truth["curves"]], [each["modulus_Pa"] for each in written["curves"]])
        self.assertEqual(len({each["modulus_Pa"] for each in truth["curves"]}), 2)

    def test_refuses_what_the_command_refuses(self):
        for wrong in ({"pixels": (0, 4)}, {"pixels": (513, 1)}, {"size": 1.0}, {"field": "sea"}, {"second_modulus": -1.0},
                      {"second_work_of_adhesion": 1e-3}):
            with self.assertRaises(ValueError, msg=wrong):
                touchafm.generate_map(**{**self.FIELD, **GEL, **wrong})


class Fits(Files):
    def test_are_the_json_of_the_command(self):
        gel = self.made("gel.h5", "--noise-memory", "0.9")
        sticky = self.made("sticky.h5", "--law", "jkr", "--work-of-adhesion", "0.1mJ/m2")
        for path, model in ((gel, "sphere"), (gel, "paraboloid"), (sticky, "jkr"), (sticky, "auto")):
            with self.subTest(model):
                expected = json_of("analyse", str(path), "--fit", model, "--radius", "5um", "--uncertainty",
                                   "spring-constant=7%", "--json")
                analysis = touchafm.analyse(touchafm.read(path)[0])
                fit = touchafm.fit(analysis, model=model, tip_radius=5e-6, uncertainties={"spring_constant": 0.07})
                self.assertEqual(fit.as_dict(), expected.pop("fit"))
                self.assertEqual(analysis.as_dict(), expected)
                self.assertEqual(fit.E, fit.as_dict()["modulus_Pa"])

    def test_have_the_bootstrap_of_the_command(self):
        sticky = self.made("sticky.h5", "--law", "jkr", "--work-of-adhesion", "0.1mJ/m2")
        for path, model in ((self.made("gel.h5"), "sphere"), (sticky, "jkr")):
            with self.subTest(model):
                expected = json_of("analyse", str(path), "--fit", model, "--radius", "5um", "--bootstrap", "--json")["fit"]
                curve = touchafm.read(path)[0]
                fit = touchafm.fit(curve, model=model, tip_radius=5e-6, bootstrap=True)
                self.assertEqual(fit.as_dict(), expected)
                found = expected["bootstrap"]
                self.assertEqual(list(fit.E_bootstrap_interval), found["modulus_95_percent_Pa"])
                if model == "jkr":
                    self.assertEqual(list(fit.W_bootstrap_interval), found["work_95_percent_J_per_m2"])
                else:
                    self.assertIsNone(fit.W_bootstrap_interval)
                self.assertIsNone(touchafm.fit(curve, model=model, tip_radius=5e-6).E_bootstrap_interval)
                with self.assertRaisesRegex(ValueError, "--bootstrap draws forces at known heights"):
                    touchafm.fit(curve, model="sphere", tip_radius=5e-6, bootstrap=True, against="tip")

    def test_hold_the_truth_in_their_interval(self):
        curves, truth = touchafm.generate(count=20, **GEL)
        held = 0
        for curve in curves:
            low, high = touchafm.fit(curve, model="paraboloid", tip_radius=5e-6).E_interval
            held += low < truth["parameters"]["modulus_Pa"] < high
        self.assertGreaterEqual(held, 16)  # of 20 with a chance of 0.95 each: fewer in one of 400 runs of other seeds

    def test_refuse_with_the_words_of_the_command(self):
        path = self.made("gel.h5")
        curve = touchafm.read(path)[0]
        for given, options in (({}, ()), ({"tip_radius": 5e-6, "layer": 1e-6}, ("--radius", "5um", "--layer", "1um"))):
            with self.assertRaises(ValueError) as refused:
                touchafm.fit(curve, model="sphere", **given)
            self.assertEqual(str(refused.exception), error_of("analyse", str(path), "--fit", "sphere", *options))
        for wrong in ({"tip_radius": 1.0}, {"tip_radius": float("nan")}, {"tip_radius": 5e-6, "poisson": 0.7}):
            with self.assertRaises(ValueError, msg=wrong):
                touchafm.fit(curve, model="sphere", **wrong)
        with self.assertRaises(ValueError):
            touchafm.fit(curve, model="cube")
        with self.assertRaisesRegex(TypeError, "curve: give a Curve or its Analysis, not str"):
            touchafm.fit("gel.h5", model="sphere", tip_radius=5e-6)
        with self.assertRaisesRegex(ValueError, "contact_point: an Analysis has its own"):
            touchafm.fit(touchafm.analyse(curve), model="sphere", tip_radius=5e-6, contact_point="fit-polynomial")
        with self.assertRaises(TypeError):
            touchafm.fit(curve, model="sphere", radius=5e-6)
        flat = touchafm.Curve(z=np.linspace(1e-6, 0, 100), force=np.zeros(100), approach=np.ones(100))
        # no file is at fault; programs that catch wrong numbers catch it
        for given in (flat, touchafm.Curve(z=flat.z, force=flat.force, approach=flat.approach, spring_constant=0.1),
                      touchafm.analyse(flat)):
            with self.assertRaisesRegex(touchafm.DataError, "cannot fit curve: "):
                touchafm.fit(given, model="sphere", tip_radius=5e-6)
        with self.assertRaisesRegex(touchafm.DataError, "finds no contact point"):
            touchafm.analyse(flat, contact_point="fit-polynomial")
        self.assertTrue(issubclass(touchafm.DataError, ValueError))


class Sessions(Files):
    def test_give_what_the_hand_felt(self):
        corpus = pathlib.Path(__file__).parent.parent / "fuzz" / "corpus" / "session"
        session = touchafm.session(corpus / "friction-and-scan.afms")
        self.assertEqual(len(session.time), len(session))
        self.assertEqual(len(session.hand_force), len(session))
        self.assertTrue(np.isfinite(session.force).all())
        session = touchafm.session(corpus.parent.parent.parent / "formats" / "0.2.0" / "session-mica.afms")
        self.assertEqual(list(session.event_kind), ["jump-to-contact", "jump-off-contact"])
        self.assertEqual(session.parameters["tip_radius_m"], 50e-9)
        self.assertEqual(session.sources["tip_radius"]["source"], "Liu & Peng, Table 1")
        self.assertEqual(session.sources["law"]["value"], "dmt")
        for name in ("kind", "time", "z", "force_before", "force_after"):  # the same events as arrays
            column = getattr(session, f"event_{name}")
            np.testing.assert_array_equal(column, [event[name] for event in session.events])
            with self.assertRaises(ValueError):
                column[0] = column[0]
        with self.assertRaises(touchafm.FileError):
            touchafm.session(corpus / "count-too-large.afms")


if __name__ == "__main__":
    unittest.main()
