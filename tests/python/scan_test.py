# SPDX-License-Identifier: Apache-2.0
"""Images of the virtual microscope: the command's numbers, channels and refusals."""

import os
import tempfile
import unittest

import numpy as np

import touchafm
from command import error_of, json_of

MICA = touchafm.Contact.material("mica")
SMALL = {"size": 40 / 1e9, "pixels": 24, "rate": 20.0, "seed": 5}  # 40 / 1e9: as a typed 40nm is read
SMALL_COMMAND = ("--size", "40nm", "--pixels", "24", "--rate", "20Hz", "--seed", "5")


def without_sources(report):
    """What was typed has another source than what a program gives."""
    metadata = {key: text for key, text in report["metadata"].items() if not key.startswith("Source of ")}
    return {**report, "metadata": metadata}


class Scan(unittest.TestCase):
    def test_is_the_json_of_the_command(self):
        scan = touchafm.scan(MICA, **SMALL)
        self.assertEqual(scan.as_dict(), json_of("scan", "--material", "mica", *SMALL_COMMAND, "--json"))
        coned = touchafm.scan(MICA, tip="cone", tip_angle=0.3, noise=50e-12, direction="up", show_truth=True,
                              feedback=False, **SMALL)
        command = json_of("scan", "--material", "mica", "--tip", "cone", "--tip-angle", f"{np.degrees(0.3)}deg", "--noise",
                          "50pm", "--direction", "up", "--show-truth", "--no-feedback", *SMALL_COMMAND, "--json")
        self.assertEqual([each["name"] for each in coned.as_dict()["channels"]], [each["name"] for each in command["channels"]])
        self.assertEqual(coned.as_dict()["metadata"]["Slow direction"], "up")
        self.assertEqual(coned.as_dict()["settings"]["noise_m"], command["settings"]["noise_m"])

    def test_takes_images_in_tapping_mode(self):
        tapped = {"mode": "tapping", "free_amplitude": 20 / 1e9, "resonance": 300e3, "quality_factor": 400.0}
        stiff = touchafm.Contact.material("mica", spring_constant=40.0)
        command = ("scan", "--material", "mica", "--spring-constant", "40N/m", "--mode", "tapping", "--free-amplitude", "20nm",
                   "--resonance", "300kHz", "--quality-factor", "400", *SMALL_COMMAND, "--json")
        self.assertEqual(without_sources(touchafm.scan(stiff, **tapped, **SMALL).as_dict()), without_sources(json_of(*command)))
        low = touchafm.scan(stiff, amplitude_setpoint=12e-9, **tapped, **SMALL)
        self.assertAlmostEqual(low.as_dict()["tapping"]["setpoint_ratio"], 0.6)
        self.assertIn("Phase (retrace)", low.channels)
        for given in ({"mode": "fm"}, {"mode": "tapping"}, {**tapped, "adhesion": 1e-9}, {**tapped, "quality_factor": 0.3}):
            with self.assertRaises(ValueError):
                touchafm.scan(stiff, **given, **SMALL)
        with self.assertRaises(TypeError):
            touchafm.scan(stiff, free_amplitude=20e-9, **SMALL)  # of no mode but tapping

    def test_has_the_channels_of_its_file(self):
        scan = touchafm.scan(MICA, **SMALL)
        height = scan["Height"]
        self.assertEqual(height.shape, (24, 24))
        self.assertIs(height.dtype.type, np.float64)
        self.assertEqual(scan.units["Height"], "m")
        figures = scan.as_dict()["channels"][0]
        self.assertEqual((height.min(), height.max()), (figures["min"], figures["max"]))
        with self.assertRaises(ValueError):
            height[0, 0] = 1.0
        with self.assertRaises(KeyError):
            scan["Colour"]
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "mica.gwy")
            scan.write(file)
            read = touchafm.read_image(file)
        self.assertEqual(set(read["channels"]), set(scan.channels))
        np.testing.assert_array_equal(read["channels"]["Height"][0], height)
        del scan
        self.assertTrue(np.isfinite(height).all())  # it keeps the image alive

    def test_shows_its_truth_when_it_is_slow(self):
        scan = touchafm.scan(MICA, size=30e-9, pixels=16, rate=0.01, loop_rate=20e3)
        rms = np.std(scan["Height"] - scan.truth)
        self.assertLess(rms, 0.02 * np.std(scan.truth))
        self.assertGreater(np.std(scan.truth), 0.0)

    def test_takes_a_sample_of_ones_own(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "mica.gwy")
            touchafm.scan(MICA, **SMALL).write(file)
            own = touchafm.scan(sample=file, level="none", pixels=16, tip="sphere")
            command = json_of("scan", "--sample", file, "--level", "none", "--pixels", "16", "--tip", "sphere", "--json")
        self.assertEqual(own.as_dict(), command)

    def test_takes_the_whole_numbers_of_numpy(self):
        scan = touchafm.scan(MICA, **{**SMALL, "pixels": np.int64(4), "seed": np.uint32(5)})
        self.assertEqual(scan.as_dict(), touchafm.scan(MICA, **{**SMALL, "pixels": 4}).as_dict())
        curves, _ = touchafm.generate(E=3e3, n=np.int32(2), points=np.int16(60), seed=np.int64(3))
        self.assertEqual([len(each) for each in curves], [120, 120])
        with self.assertRaisesRegex(ValueError, "pixels: -4 is outside"):
            touchafm.scan(MICA, pixels=np.int64(-4))

    def test_takes_a_surface_in_place_of_a_contact(self):
        surface = touchafm.surface("gratings", size=500 / 1e9)
        self.assertEqual((surface.sample, surface.size, touchafm.surface("own.gwy").size), ("gratings", 500 / 1e9, None))
        scan = touchafm.scan(surface, pixels=32)
        self.assertEqual(scan.as_dict(), json_of("scan", "--sample", "gratings", "--size", "500nm", "--pixels", "32", "--json"))
        self.assertEqual(scan.as_dict(), touchafm.scan(MICA, sample="gratings", size=500 / 1e9, pixels=32).as_dict())
        narrow = touchafm.scan(surface, size=100e-9, pixels=4)
        self.assertEqual(narrow.width, 100e-9)
        for given in ({"sample": "gratings"}, {"level": "plane"}):
            with self.assertRaises(ValueError, msg=given):
                touchafm.scan(surface, pixels=4, **given)
        for wrong in ("gratings", np.zeros((4, 4)), None):
            with self.assertRaises((TypeError, ValueError)):
                touchafm.scan(wrong, pixels=4)
        with self.assertRaisesRegex(touchafm.FileError, "nowhere"):
            touchafm.scan(touchafm.surface("/nowhere.gwy"))

    def test_prefers_a_file_with_the_name_of_the_gratings(self):
        self.addCleanup(os.chdir, os.getcwd())
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            with open("gratings", "w", encoding="ascii") as file:
                file.write("no image")
            with self.assertRaisesRegex(touchafm.FileError, "neither a glTF model nor an image"):
                touchafm.scan(sample="gratings")

    def test_refuses_with_the_words_of_the_command(self):
        for given, typed in (({}, ()), ({"rate": -1.0}, ("--rate=-1Hz",)), ({"size": 1.0}, ("--size", "1000mm"))):
            contact = MICA if given else touchafm.Contact(tip_radius=1e-8, spring_constant=0.1, hamaker=1e-20,
                                                          work_of_adhesion=1e-3, law="paper")
            with self.assertRaises(ValueError) as refused:
                touchafm.scan(contact, **given)
            if not given:
                self.assertEqual(str(refused.exception), error_of("scan", "--json"))
            self.assertIn(typed[0][:6] if typed else "--material", str(refused.exception))
        for given in ({"tip": "needle"}, {"direction": "left"}, {"pixels": 1}, {"pixels": -1}, {"seed": -1}, {"seed": 2**32}, {"level": "plane"}, {"tip_angle": 2.0}):
            with self.assertRaises(ValueError):
                touchafm.scan(MICA, **given)
        with self.assertRaises(TypeError):
            touchafm.scan(MICA, feedback=0.0)  # a switch
        with self.assertRaises(TypeError):
            touchafm.scan(MICA, colour=1.0)
        with self.assertRaises(TypeError):
            touchafm.scan(MICA, spring_constant=1.0)  # a number of the contact
        with self.assertRaises(touchafm.FileError):
            touchafm.scan(sample="/nowhere.gwy")


class Level(unittest.TestCase):
    def test_takes_the_tilt_away(self):
        rows, columns = np.mgrid[0:20, 0:30]
        relief = 1e-9 * np.sin(columns / 3.0)
        levelled = touchafm.level(relief + 1e-10 * columns - 3e-10 * rows)
        np.testing.assert_allclose(levelled - levelled.mean(), touchafm.level(relief) - relief.mean(), atol=1e-20)
        with self.assertRaises(ValueError):
            touchafm.level(np.zeros(5))
        with self.assertRaises(ValueError):
            touchafm.level(relief, "surface")


if __name__ == "__main__":
    unittest.main()
