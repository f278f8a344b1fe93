# SPDX-License-Identifier: Apache-2.0
"""DTMicroscope's method names, answered by the virtual microscope."""

import doctest
import math
import unittest

import numpy as np

import touchafm
from touchafm.compat import dtmicroscope

SMALL = {"size": 40e-9, "pixels": 24, "seed": 5}


def load_tests(loader, tests, pattern):
    del loader, pattern
    tests.addTests(doctest.DocTestSuite(dtmicroscope))
    return tests


class DTMicroscope(unittest.TestCase):
    def setUp(self):
        self.afm = dtmicroscope.AFM_Microscope(rate=10.0, **SMALL)
        self.afm.setup_microscope("gold")

    def test_has_the_images_of_the_library(self):
        scan = touchafm.scan(touchafm.Contact.material("gold"), rate=10.0, **SMALL)
        image = self.afm.get_scan()
        self.assertEqual(image.shape, (3, 24, 24))
        np.testing.assert_array_equal(image[0], scan["Height"])
        np.testing.assert_array_equal(self.afm.scan_ar, image)
        np.testing.assert_array_equal(self.afm.get_scan(["Error"], trace="backward")[0], scan["Error (retrace)"])
        info = dict(self.afm.get_dataset_info())
        self.assertEqual(info["channels"], ["Height", "Error", "Lateral force", "Force"])
        self.assertEqual(info["units"], ["m", "N", "N", "N"])
        self.assertEqual([info["channels"][each] for each in info["scans"]], ["Height", "Error", "Lateral force"])
        self.assertEqual(info["spectra"], [3])

    def test_takes_lines_and_paths_of_them(self):
        heights = self.afm.get_scan(["Height"])
        np.testing.assert_array_equal(np.stack(list(self.afm.scanning_emulator(channels=["Height"])), axis=1), heights)
        columns = list(self.afm.scanning_emulator(direction="vertical", channels=["Height"]))
        np.testing.assert_array_equal(np.stack(columns, axis=2), heights)
        y = self.afm.y_coords[5]
        np.testing.assert_array_equal(self.afm.scan_individual_line(coord=y, channels=["Height"]), heights[:, 5])
        x = self.afm.x_coords[7]
        np.testing.assert_array_equal(
            self.afm.scan_individual_line("vertical", coord=x, channels=["Height"]), heights[:, :, 7])
        path = self.afm.scan_arbitrary_path([[self.afm.x_min, y], [x, y], [x, self.afm.y_min]], channels=["Height"])
        np.testing.assert_array_equal(path, np.concatenate([heights[:, 5, :8], heights[:, 5:, 7]], axis=1))

    def test_has_the_curve_of_the_library(self):
        z, force = self.afm.get_spectrum(location=(5e-9, -5e-9))
        cycle = touchafm.cycle(touchafm.Contact.material("gold"))
        np.testing.assert_array_equal(z, cycle.z)
        np.testing.assert_array_equal(force, cycle.force)
        self.assertEqual((self.afm.x, self.afm.y), (5e-9, -5e-9))

    def test_stays_inside_its_image(self):
        self.assertTrue(self.afm.go_to(3e-9, -2e-9))
        with self.assertWarnsRegex(UserWarning, "outside the image"):
            self.afm.go_to(1.0, -1.0)
        self.assertEqual((self.afm.x, self.afm.y), (self.afm.x_max, self.afm.y_min))

    def test_has_artefacts_of_a_real_tip_and_feedback(self):
        heights = self.afm.get_scan(["Height"])
        blunt = self.afm.get_scan(["Height"], [{"effect": "real_tip", "kwargs": {"tip_radius": 200e-9, "tip": "sphere"}}])
        self.assertLess(np.ptp(blunt), np.ptp(heights))
        double = self.afm.get_scan(
            ["Height"], [{"effect": "tip_doubling", "kwargs": {"second_apex_distance": 5e-9, "second_apex_height": 0.1e-9}}])
        self.assertGreater(np.abs(double - heights).max(), 1e-11)
        slow = self.afm.get_scan(["Height"], [{"effect": "real_PID", "kwargs": {"integral_gain": 20.0}}], scan_rate=40.0)
        self.assertLess(np.ptp(slow), np.ptp(heights))
        self.assertEqual(self.afm.scan_rate, 40.0)

    def test_says_what_it_does_not_know(self):
        with self.assertWarnsRegex(UserWarning, "no channel \"Phase\""):
            self.assertEqual(self.afm.get_scan(["Height", "Phase"]).shape, (1, 24, 24))
        for wrong, words in ((lambda: self.afm.get_scan(direction="vertical"), "along x"),
                             (lambda: self.afm.get_scan(modification={"effect": "real_tip"}), "a list"),
                             (lambda: self.afm.get_scan(modification=[{"effect": "rain"}]), "real_tip"),
                             (lambda: self.afm.get_scan(modification=[{"effect": "real_tip", "kwargs": {"r_tip": 0.05}}]),
                              "tip_radius"),
                             (lambda: self.afm.scan_arbitrary_path([[0.0, 0.0]]), "two or more"),
                             (lambda: self.afm.scan_individual_line("up"), "vertical"),
                             (lambda: self.afm.get_spectrum(channel="Height"), "Force"),
                             (lambda: dtmicroscope.AFM_Microscope().get_spectrum(), "setup_microscope"),
                             (lambda: dtmicroscope.AFM_Microscope().get_scan(), "setup_microscope"),
                             (lambda: dtmicroscope.AFM_Microscope().get_dataset_info(), "setup_microscope"),
                             (lambda: dtmicroscope.AFM_Microscope().go_to(0.0, 0.0), "setup_microscope"),
                             (lambda: dtmicroscope.AFM_Microscope().scan_arbitrary_path([[0.0, 0.0], [1e-9, 0.0]]), "setup_microscope"),
                             (lambda: self.afm.get_scan(trace="backwards"), "backward"),
                             (lambda: self.afm.go_to(math.nan, 0.0), "no place"),
                             (lambda: self.afm.scan_individual_line(coord=math.nan), "no place"),
                             (lambda: self.afm.scan_arbitrary_path([[0.0, 0.0], [math.inf, 0.0]]), "not finite"),
                             (lambda: self.afm.setup_microscope("cheese"), "cheese")):
            with self.assertRaisesRegex(ValueError, words):
                wrong()
        with self.assertRaises(TypeError):
            self.afm.get_scan("Height")

    def test_is_as_before_after_a_refusal(self):
        before = self.afm.get_scan()
        for wrong in (lambda: self.afm.setup_microscope("cheese"), lambda: self.afm.get_scan(scan_rate=-1.0)):
            with self.assertRaises(ValueError):
                wrong()
        np.testing.assert_array_equal(self.afm.get_scan(), before)
        self.assertEqual((self.afm.data_source, self.afm.scan_rate), ("gold", 10.0))


if __name__ == "__main__":
    unittest.main()
