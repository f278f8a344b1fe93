# SPDX-License-Identifier: Apache-2.0
"""The fits of a map are those of each curve alone, and the maps that the command writes."""

import pathlib
import tempfile
import unittest

import numpy as np

import touchafm
import touchafm.maps
from command import touchafm as command

CELLS = {"tip_radius": 5e-6, "modulus": 3e3, "spring_constant": 0.05, "most_force": 1e-9, "noise": 15e-12, "field": "step",
         "second_modulus": 20e3, "pixels": (5, 4), "size": 8e-6, "points": 200, "seed": 3}
FIT = {"model": "paraboloid", "tip_radius": 5e-6}


class Maps(unittest.TestCase):
    def setUp(self):
        self.curves, self.truth = touchafm.generate_map(**CELLS)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_have_what_a_fit_of_each_curve_finds(self):
        found = touchafm.maps.fit(self.curves, threads=3, **FIT)
        self.assertEqual(found.E.shape, (4, 5))
        self.assertEqual(found.reasons, {})
        for curve, fit in zip(self.curves, found.fits):
            alone = touchafm.fit(curve, **FIT)
            column, row = curve.metadata["pixel"]
            at = 3 - row, column
            self.assertEqual(fit.as_dict(), alone.as_dict())
            self.assertEqual((found.E[at], found.contact_point[at], found.depth[at], found.flag[at]),
                             (alone.E, alone.contact_point, alone.depth, alone.flag))
            np.testing.assert_equal(found.adhesion[at], np.nan if (pull := touchafm.analyse(curve).adhesion) is None else pull)
        self.assertTrue(np.isnan(found.W).all())
        true = np.array([each["modulus_Pa"] for each in self.truth["curves"]]).reshape(4, 5)[::-1]
        self.assertLess(np.abs(found.E / true - 1).max(), 0.1)
        for same in ((each for each in self.curves), np.array(self.curves, dtype=object)):
            np.testing.assert_array_equal(touchafm.fit_map(same, **FIT).E, found.E)

    def test_are_those_of_the_command(self):
        made = command("generate", "map", "--radius", "5um", "--modulus", "3kPa", "--spring-constant", "0.05N/m", "--most-force",
                       "1nN", "--noise", "15pN", "--field", "step", "--second-modulus", "20kPa", "--pixels", "5x4", "--size", "8um",
                       "--points", "200", "--seed", "3", "--out", str(self.folder / "cells.h5"))
        self.assertEqual(made.returncode, 0, made.stderr)
        fitted = command("analyse", str(self.folder / "cells.h5"), "--fit", "paraboloid", "--radius", "5um", "--out",
                         str(self.folder / "out"))
        self.assertEqual(fitted.returncode, 0, fitted.stderr)
        channels = touchafm.read_image(self.folder / "out" / "cells.gwy")["channels"]
        found = touchafm.maps.fit(touchafm.read(self.folder / "cells.h5"), **FIT)
        np.testing.assert_array_equal(found.E, channels["Modulus"][0])
        of_command = touchafm.read_image(self.folder / "out" / "cells.gwy")
        self.assertEqual((found.width, found.height), (of_command["width"], of_command["height"]))
        np.testing.assert_array_equal(found.contact_point, channels["Contact height"][0])
        np.testing.assert_array_equal(found.flag == "trusted", channels["Trust"][0] == channels["Trust"][0].max())

    def test_become_images_and_a_table(self):
        found = touchafm.fit_map([*self.curves[:7], *self.curves[8:]], **FIT)
        found.image("E").save(self.folder / "E.gwy")
        image = touchafm.read_image(self.folder / "E.gwy")
        np.testing.assert_array_equal(image["channels"]["E"][0], found.E)
        self.assertEqual((image["channels"]["E"][1], image["width"]), ("Pa", found.width))
        with self.assertRaisesRegex(ValueError, "choose E, contact_point"):
            found.image("e")
        found.table.to_csv(self.folder / "map.csv")
        rows = (self.folder / "map.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(len(rows), 21)
        read = [line.split(",") for line in rows[1:]]
        heads = rows[0].split(",")
        self.assertEqual(heads[:3], ["row", "column", "E_Pa"])
        missing = np.isnan(found.E)
        for row in read:
            at = int(row[0]), int(row[1])
            self.assertEqual(float(row[2]) if row[2] else None, None if missing[at] else found.E[at])
            self.assertEqual(row[heads.index("flag")], found.flag[at])

    def test_leave_out_a_curve_that_nothing_fits_and_say_why(self):
        found = touchafm.maps.fit([*self.curves[:7], *self.curves[8:]], **FIT)
        self.assertEqual(np.isnan(found.E).sum(), 1, "a pixel without a curve")
        shallow = touchafm.maps.fit(self.curves, model="paraboloid", tip_radius=5e-6, most_depth=1e-10)
        self.assertGreater(len(shallow.reasons), 0)
        for number, reason in shallow.reasons.items():
            column, row = self.curves[number].metadata["pixel"]
            self.assertIsNone(shallow.fits[number])
            self.assertTrue(reason)
            self.assertTrue(np.isnan(shallow.E[3 - row, column]))
            self.assertEqual(shallow.flag[3 - row, column], "")
        self.assertEqual(np.isnan(shallow.E).sum(), len(shallow.reasons))

    def test_refuse_what_is_no_map(self):
        alone, _ = touchafm.generate(tip_radius=5e-6, modulus=3e3, spring_constant=0.05, most_force=1e-9)
        for curves in ([], alone, [*self.curves, *alone]):
            with self.assertRaises(ValueError):
                touchafm.maps.fit(curves, **FIT)
        for wrong in ({"model": "cube"}, {"model": "paraboloid"}):
            with self.assertRaises(ValueError, msg=wrong):
                touchafm.maps.fit(self.curves, **wrong)
        for no_curves in (alone[0], "cells.h5", [*self.curves, "cells.h5"], np.zeros(3)):
            with self.assertRaisesRegex(TypeError, "curves: give "):
                touchafm.maps.fit(no_curves, **FIT)
        with self.assertRaises(TypeError):
            touchafm.maps.fit(self.curves, **FIT, hue=1.0)
        for number in ({"bootstrap": 1000}, {"tilt": 0.1}, {"white_noise": 1}):  # these are switches
            with self.assertRaises(TypeError, msg=number):
                touchafm.fit(self.curves[0], **FIT, **number)


if __name__ == "__main__":
    unittest.main()
