# SPDX-License-Identifier: Apache-2.0
"""The calibration of a lever: the command's numbers, from arrays and files."""

import os
import tempfile
import unittest

import numpy as np

import touchafm
from command import error_of, json_of

RESONANCE, QUALITY, AREA, FLOOR = 70e3, 150.0, 1.2e-5, 1e-12


def spectrum():
    """A spectrum without scatter, V^2/Hz."""
    frequency = np.linspace(50e3, 90e3, 2000)
    ratio = frequency / RESONANCE
    lorentz = 2 * AREA / (np.pi * RESONANCE * QUALITY) / ((1 - ratio**2) ** 2 + (ratio / QUALITY) ** 2)
    return frequency, FLOOR + lorentz


class Lever(unittest.TestCase):
    def test_is_that_of_the_command(self):
        frequency, density = spectrum()
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "spectrum.txt")
            with open(file, "w", encoding="utf-8") as out:
                out.write("Hz V2/Hz\n" + "".join(f"{f!r} {d!r}\n" for f, d in zip(frequency.tolist(), density.tolist())))
            of_file = touchafm.lever(thermal=file, sensitivity=60e-9, averages=100)
            command = json_of("lever", "--thermal", file, "--sensitivity", "60nm/V", "--averages", "100", "--json")
        self.assertEqual(of_file.as_dict(), command)
        of_arrays = touchafm.lever(thermal=(frequency, density), unit="V", sensitivity=60e-9, averages=100)
        self.assertEqual(of_arrays.k, of_file.k)
        # case K06
        self.assertAlmostEqual(of_file.k, 0.8174 * 1.380649e-23 * 298.15 / (60e-9**2 * AREA), delta=1e-3 * of_file.k)
        self.assertAlmostEqual(of_file.resonance, RESONANCE, delta=1.0)
        self.assertAlmostEqual(of_file.quality_factor, QUALITY, delta=0.1)

    def test_has_a_shorter_form_for_a_spectrum(self):
        frequency, density = spectrum()
        lever = touchafm.lever.thermal(frequency, density, invols=60e-9, temperature=295.0, averages=100)
        longer = touchafm.lever(thermal=(frequency, density), unit="V", sensitivity=60e-9, temperature=295.0, averages=100)
        self.assertEqual(lever.as_dict(), longer.as_dict())
        in_metres = touchafm.lever.thermal(frequency, density * 60e-9**2, temperature=295.0)
        self.assertAlmostEqual(in_metres.k, lever.k, delta=1e-6 * lever.k)
        for wrong in ({"sensitivity": 1e-9}, {"unit": "m"}):
            with self.assertRaisesRegex(ValueError, "invols"):
                touchafm.lever.thermal(frequency, density, invols=60e-9, **wrong)
        with self.assertRaises(TypeError):
            touchafm.lever.thermal(frequency, density, invol=60e-9)

    def test_goes_without_a_spectrum(self):
        lever = touchafm.lever(sader=True, length=120e-6, width=30e-6, resonance=70e3, quality_factor=150.0)
        command = json_of("lever", "--sader", "--length", "120um", "--width", "30um", "--resonance", "70kHz",
                          "--quality-factor", "150", "--json")
        self.assertAlmostEqual(lever.k, command["sader"]["spring_constant_N_per_m"], delta=1e-9 * lever.k)
        self.assertIsNone(lever.k_interval)
        self.assertIn("N/m", repr(lever))

    def test_refuses_with_the_words_of_the_command(self):
        with self.assertRaises(ValueError) as refused:
            touchafm.lever()
        self.assertEqual(str(refused.exception), error_of("lever"))
        for given in ({"thermal": ([1.0], [1.0, 2.0])}, {"sader": True, "length": -1.0}, {"sader": True, "fluid": "honey"},
                      {"thermal": spectrum(), "unit": "nm"}):
            with self.assertRaises(ValueError):
                touchafm.lever(**given)
        with self.assertRaises(TypeError):
            touchafm.lever(sader=True, lenght=1e-4)

    def test_names_the_number_that_is_out_of_range(self):
        for given, words in (({"averages": 0}, "averages: 0 is not within 1 to 1e\\+09; leave it out"),
                             ({"averages": float("nan")}, "averages: nan"), ({"mode": 0}, "mode: 0 is not within 1 to 10"),
                             ({"bandwidth": -1.0}, "bandwidth: -1 is not within 0.001 to 1e\\+08"),
                             ({"low": 9e4, "high": 5e4}, "low, high: 90000 to 50000 Hz does not go up"),
                             ({"low": float("nan")}, "low, high: nan")):
            with self.assertRaisesRegex(ValueError, words):
                touchafm.lever(thermal=spectrum(), unit="V", sensitivity=60e-9, **given)

    def test_tells_faults_of_arrays_from_those_of_files(self):
        flat = (np.linspace(1e3, 2e3, 100), np.ones(100))
        curve = touchafm.generate(tip_radius=5e-6, modulus=3e6, spring_constant=0.05, most_force=1e-9, sensitivity=5e-8, bits=16)[0][0]
        with tempfile.TemporaryDirectory() as folder:
            names = [os.path.join(folder, name) for name in ("flat.txt", "curve.h5", "none.h5")]
            np.savetxt(names[0], np.transpose(flat), header="Hz m2/Hz", comments="")
            curve.write(names[1], format="h5")
            for given, fault in (({"thermal": flat}, touchafm.DataError), ({"thermal": ([1.0, 2.0], [-1.0, 1.0])}, touchafm.DataError),
                                 ({"thermal": flat, "unit": "V", "sensitivity_from": names[1]}, touchafm.DataError),
                                 ({"thermal": flat, "unit": "V", "sensitivity_from": names[2]}, touchafm.FileError),
                                 ({"thermal": names[0]}, touchafm.FileError)):
                with self.assertRaises(fault):
                    touchafm.lever(**given)


if __name__ == "__main__":
    unittest.main()
