# SPDX-License-Identifier: Apache-2.0
"""A lever that vibrates, by a constant drive or at a constant amplitude: the command's numbers."""

import unittest

import numpy as np

import touchafm
from command import error_of, json_of, without_sources


class Tapping(unittest.TestCase):
    SET_UP = {"law": "dmt", "spring_constant": 40.0, "tip_radius": 20e-9, "hamaker": 64e-21, "reduced_modulus": 1.5e9,
              "resonance": 300e3, "quality_factor": 400.0}
    COMMAND = ("curve", "--mode", "tapping", "--free-amplitude", "20nm", "--resonance", "300kHz", "--quality-factor", "400",
               "--model", "dmt", "--spring-constant", "40N/m", "--tip-radius", "20nm", "--hamaker", "64zJ", "--contact-gap",
               "0.165nm", "--reduced-modulus", "1.5GPa", "--json")

    FEW = {"z_from": 22e-9, "z_to": 14e-9, "step": 0.2e-9}  # a path with both jumps

    @classmethod
    def setUpClass(cls):
        cls.whole = cls.tapping()
        cls.at = cls.tapping(at=17.4 / 1e9)  # as a typed 17.4nm is read

    @classmethod
    def contact(cls):
        given = {key: value for key, value in cls.SET_UP.items() if key not in ("resonance", "quality_factor")}
        return touchafm.Contact(work_of_adhesion=1e-3, **given)

    @classmethod
    def tapping(cls, **given):
        return touchafm.tapping(cls.contact(), free_amplitude=20e-9, resonance=300e3, quality_factor=400.0,
                                contact_gap=0.165e-9, **given)

    def test_is_the_json_of_the_command(self):
        self.assertEqual(without_sources(self.whole.as_dict()), without_sources(json_of(*self.COMMAND)))
        self.assertGreater(self.whole.amplitude.max(), 19e-9)
        self.assertEqual(without_sources(self.at.as_dict()), without_sources(json_of(*self.COMMAND, "--at", "17.4nm")))

    def test_takes_a_drive_in_place_of_its_numbers(self):
        drive = touchafm.Drive(free_amplitude=20e-9, resonance=300e3, quality_factor=400.0, contact_gap=0.165e-9)
        self.assertEqual((drive.free_amplitude, drive.frequency), (20e-9, None))
        tapping, same = touchafm.tapping(self.contact(), drive, **self.FEW), self.tapping(**self.FEW)
        self.assertEqual(tapping.as_dict(), same.as_dict())
        self.assertEqual(tapping.folds, tapping.as_dict()["jumps"])
        self.assertEqual(len(tapping.folds), 2)
        self.assertEqual(tapping.states(17.4 / 1e9), self.at.as_dict()["states"])
        fast = tapping.curve(speed=1e-6, **self.FEW)
        self.assertEqual(fast.as_dict(), self.tapping(speed=1e-6, **self.FEW).as_dict())
        self.assertEqual(fast.folds, tapping.folds)
        self.assertNotEqual(fast.as_dict()["jumps"], tapping.folds)
        self.assertEqual(len(tapping.curve(z_from=20e-9, z_to=18e-9, step=1e-9)), 5)

    def test_has_the_jumps_of_a_whole_curve_beside_the_states_at_one_height(self):
        self.assertEqual(self.at.folds, self.whole.folds)

    def test_refuses_numbers_that_a_drive_has_too_and_none_at_all(self):
        drive = touchafm.Drive(free_amplitude=20e-9, frequency=310e3)
        for given in ({"free_amplitude": 1e-9}, {}):
            with self.assertRaisesRegex(ValueError, "free_amplitude"):
                touchafm.tapping(self.contact(), *((drive,) if given else ()), **given)
        mica = touchafm.Contact.material("mica")
        with self.assertRaisesRegex(ValueError, "free_amplitude"):
            touchafm.scan(mica, pixels=4, mode="tapping", drive=drive, free_amplitude=1e-9)

    def test_takes_an_image_by_a_drive(self):
        gold = touchafm.Contact.material("gold", spring_constant=40.0)
        numbers = {"free_amplitude": 20e-9, "resonance": 300e3, "quality_factor": 400.0}
        image = touchafm.scan(gold, size=20e-9, pixels=8, mode="tapping", drive=touchafm.Drive(**numbers, frequency=301e3))
        same = touchafm.scan(gold, size=20e-9, pixels=8, mode="tapping", drive=301e3, **numbers)
        np.testing.assert_array_equal(image["Phase"], same["Phase"])
        self.assertEqual(image.as_dict(), same.as_dict())

    def test_refuses_what_has_no_effect(self):
        with self.assertRaises(ValueError):
            self.tapping(at=17.4e-9, z_from=1e-8)
        with self.assertRaises(ValueError):
            self.tapping(method="guess")


class FrequencyShift(unittest.TestCase):
    COMMAND = ("curve", "--mode", "fm", "--material", "mica", "--model", "dmt", "--resonance", "30kHz", "--amplitude", "1nm")

    def shift(self, **given):
        return touchafm.frequency_shift(touchafm.Contact.material("mica"), amplitude=1 / 1e9, resonance=30e3, law="dmt", **given)

    def test_is_the_json_of_the_command(self):
        self.assertEqual(without_sources(self.shift().as_dict()), without_sources(json_of(*self.COMMAND, "--json")))
        at = self.shift(at=5 / 1e9)
        self.assertEqual(without_sources(at.as_dict()), without_sources(json_of(*self.COMMAND, "--at", "5nm", "--json")))
        self.assertEqual(len(at), 1)

    def test_is_that_of_the_gradient_far_away(self):
        far = self.shift(z_from=100e-9, z_to=50e-9)
        np.testing.assert_allclose(far.shift, far.small_amplitude_shift, rtol=1e-3)
        self.assertTrue((far.shift < 0.0).all())
        self.assertTrue((np.diff(far.z) < 0.0).all())

    def test_turns_where_the_sample_begins_to_repel(self):
        turns = self.shift().turns
        self.assertTrue(turns)
        self.assertLess(turns[0]["shift"], 0.0)

    def test_refuses_with_the_words_of_the_command(self):
        with self.assertRaises(ValueError) as refused:
            touchafm.frequency_shift(touchafm.Contact.material("mica"), amplitude=-1e-9, resonance=30e3)
        self.assertIn("amplitude -1 nm is not within", str(refused.exception))
        with self.assertRaises(ValueError) as refused:
            self.shift(at=5e-9, z_from=1e-8)
        self.assertEqual(str(refused.exception), error_of(*self.COMMAND, "--at", "5nm", "--from", "10nm", "--json"))


if __name__ == "__main__":
    unittest.main()
