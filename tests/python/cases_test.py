# SPDX-License-Identifier: Apache-2.0
"""Cases of an instrument's calibration and of tapping that were computed elsewhere, by a program of its own."""

import unittest

import numpy as np

import touchafm

STIFFNESS, TEMPERATURE, RESONANCE, QUALITY = 0.1, 298.15, 12e3, 2.5
VIRTUAL_RMS = 1.834361242e-10  # of the first mode, by an optical lever that was calibrated under an end load, m
FREQUENCY = np.linspace(100.0, 40e3, 2000)


def density(frequency, variance):
    """One-sided spectrum of an oscillator with this variance."""
    w0, w = 2.0 * np.pi * RESONANCE, 2.0 * np.pi * frequency
    return 4.0 * variance * w0**3 / QUALITY / ((w0**2 - w**2) ** 2 + (w0 * w / QUALITY) ** 2)


def calibrated(sensitivity=1.0, **given):
    """A lever by that noise, recorded in volts of 50 nm each, or in metres."""
    volts = sensitivity != 1.0
    spectrum = density(FREQUENCY, VIRTUAL_RMS**2) / (50e-9 if volts else 1.0) ** 2
    if volts:
        given["sensitivity"] = sensitivity
    return touchafm.lever(thermal=(FREQUENCY, spectrum), unit="V" if volts else "m", averages=1e6, temperature=TEMPERATURE, **given)


class ThermalTune(unittest.TestCase):
    def test_finds_the_stiffness_of_the_noise(self):  # case F01
        lever = calibrated()
        self.assertAlmostEqual(lever.k / STIFFNESS, 1.0, delta=1e-4)
        self.assertAlmostEqual(lever.as_dict()["noise"]["deflection_m"] / 2.028892553e-10, 1.0, delta=1e-4)

    def test_without_its_factor_is_a_fifth_too_stiff(self):  # case F02
        self.assertAlmostEqual(calibrated(mode_factor=1.0).k / 0.1223343348, 1.0, delta=1e-4)
        self.assertAlmostEqual(calibrated().as_dict()["thermal"]["uncorrected_N_per_m"] / 0.1223343348, 1.0, delta=1e-4)

    def test_corrects_a_sensitivity_of_a_soft_sample(self):  # case F03
        lever = calibrated(sensitivity=55e-9, contact_stiffness=1.0)
        self.assertAlmostEqual(lever.as_dict()["sensitivity_of_a_rigid_contact_m_per_V"] / 50e-9, 1.0, delta=1e-6)
        self.assertAlmostEqual(lever.k / STIFFNESS, 1.0, delta=1e-5)
        self.assertAlmostEqual(calibrated(sensitivity=55e-9).k / STIFFNESS - 1.0, -0.173553719, delta=1e-5)

    def test_of_a_wrong_sensitivity_is_wrong_in_force_by_its_inverse(self):  # case F04
        force = calibrated(sensitivity=55e-9).k * 55e-9
        self.assertAlmostEqual(force / (STIFFNESS * 50e-9) - 1.0, -0.09090909091, delta=1e-5)

    def test_has_the_spectrum_of_the_case(self):  # case F05
        variance = 1.380649e-23 * TEMPERATURE / STIFFNESS
        self.assertAlmostEqual(density(0.0, variance) / 8.7352827e-25, 1.0, delta=1e-3)
        self.assertAlmostEqual(density(RESONANCE, variance) / 5.459551687e-24, 1.0, delta=1e-3)
        lever = calibrated()
        self.assertAlmostEqual(lever.resonance / RESONANCE, 1.0, delta=1e-6)
        self.assertAlmostEqual(lever.quality_factor / QUALITY, 1.0, delta=1e-6)


class SteadyState(unittest.TestCase):
    def test_has_the_amplitude_phase_and_forces_of_the_case(self):  # cases F10 and F11
        contact = touchafm.Contact(law="dmt", spring_constant=2.0, tip_radius=10e-9, hamaker=64e-21, work_of_adhesion=1e-3,
                                   reduced_modulus=1e9)
        for height, amplitude, phase, peak, mean in ((16e-9, 17.81399269, 63.00937172, 8.530116726, 0.4494849858),
                                                     (10e-9, 12.07482339, 37.27634775, 11.00776734, 0.792360495)):
            tapping = touchafm.tapping(contact, free_amplitude=20e-9, resonance=300e3, quality_factor=20.0, contact_gap=0.165e-9,
                                       method="direct", at=height)
            for state in tapping.as_dict()["states"]:
                with self.subTest(height=height, start=state["start"]):
                    self.assertAlmostEqual(state["amplitude_m"] * 1e9 / amplitude, 1.0, delta=5e-3)
                    self.assertAlmostEqual(state["phase_deg"], phase, delta=0.3)
                    self.assertAlmostEqual(state["peak_force_N"] * 1e9 / peak, 1.0, delta=0.02)
                    self.assertAlmostEqual(state["mean_force_N"] * 1e9 / mean, 1.0, delta=0.02)


if __name__ == "__main__":
    unittest.main()
