# SPDX-License-Identifier: Apache-2.0
"""Contacts, laws, cycles, sweeps and tapping: the numbers, refusals and JSON of the command."""

import pickle
import statistics
import subprocess
import sys
import unittest

import numpy as np

import touchafm
from command import error_of, json_of, without_sources

MICA = {"tip_radius": 50e-9, "spring_constant": 0.1, "hamaker": 24.5e-21, "work_of_adhesion": 4.456e-3}


class Contact(unittest.TestCase):
    def test_has_the_papers_jump_to_contact(self):  # case Y01
        mica = touchafm.Contact(law="paper", **MICA)
        self.assertAlmostEqual(mica.figures.z_jtc / 2.397523487e-09, 1.0, delta=1e-9)
        self.assertEqual(touchafm.Contact.material("mica", law="paper").figures.z_jtc, mica.figures.z_jtc)

    def test_refuses_with_the_words_of_the_command(self):  # case Y05
        with self.assertRaises(ValueError) as refused:
            touchafm.Contact.material("mica", tip_radius=-1e-9)
        self.assertEqual(str(refused.exception), error_of("curve", "--material", "mica", "--tip-radius=-1nm"))
        with self.assertRaises(ValueError) as refused:
            touchafm.Contact.material("butter")
        self.assertEqual(str(refused.exception), error_of("curve", "--material", "butter"))
        with self.assertRaises(ValueError) as refused:
            touchafm.Contact.material("mica", law="hertz", hamaker=1e-20)
        expected = error_of("curve", "--material", "mica", "--model", "hertz", "--hamaker", "10zJ")
        self.assertEqual(str(refused.exception), expected)
        with self.assertRaises(ValueError) as refused:
            touchafm.Contact(tip_radius=1e-9)
        self.assertIn("--spring-constant", str(refused.exception))

    def test_refuses_what_is_no_number_and_unknown_names(self):
        for wrong in (float("nan"), float("inf"), 0.0, 1e300):
            with self.assertRaises(ValueError):
                touchafm.Contact.material("mica", tip_radius=wrong)
        for wrong in ("50nm", [1e-9, 2e-9], 1j):
            with self.assertRaisesRegex(TypeError, "tip_radius: give a number, not "):
                touchafm.Contact.material("mica", tip_radius=wrong)
        with self.assertRaisesRegex(ValueError, "tip_radius"):
            touchafm.Contact.material("mica", tip_radius=10**400)
        with self.assertRaises(TypeError):
            touchafm.Contact.material("mica", colour=3.0)
        with self.assertRaises(touchafm.FileError):
            touchafm.Contact(material="mica", material_files=["/nowhere.toml"])

    def test_knows_the_materials_of_the_command(self):
        self.assertEqual(touchafm.materials()[:3], ["mica", "gold", "si3n4"])
        self.assertIn("mlct-c", touchafm.probes())
        self.assertEqual(touchafm.Contact.material("mica", probe="mlct-c").spring_constant, 0.01)

    def test_cannot_be_changed(self):
        mica = touchafm.Contact.material("mica")
        with self.assertRaises(AttributeError):
            mica.tip_radius = 1e-9
        with self.assertRaises(ValueError):
            touchafm.cycle(mica).force[0] = 1.0

    def test_is_pickled_by_what_was_given(self):
        mica = touchafm.Contact.material("mica", tip_radius=20e-9, law="jkr")
        again = pickle.loads(pickle.dumps(mica))
        self.assertEqual(again.as_dict(), mica.as_dict())
        self.assertEqual(again.law, "jkr")


class Law(unittest.TestCase):
    def setUp(self):
        self.law = touchafm.law("dmt", touchafm.Contact.material("mica"))

    def test_takes_any_array_and_gives_its_shape(self):  # case Y03
        z = np.linspace(-5e-9, 20e-9, 3000).astype(np.float32).reshape(30, 100)[::3, ::2]
        self.assertFalse(z.flags["C_CONTIGUOUS"])
        force = self.law.force(z, branch="attached")
        self.assertEqual(force.shape, z.shape)
        self.assertEqual(force.dtype, np.float64)
        np.testing.assert_array_equal(force, self.law.force(np.array(z, dtype=np.float64), branch="attached"))
        self.assertEqual(self.law.force(np.zeros((0, 3))).shape, (0, 3))

    def test_gives_no_force_where_there_is_no_height(self):
        force = self.law.force([1e-9, np.nan])
        self.assertEqual((force[0], np.isnan(force[1])), (self.law.force(1e-9), True))

    def test_refuses_what_numpy_would_make_numbers_of(self):
        for wrong in (None, "1e-9", ["1e-9"], [1e-9, None], 1j, np.array([1e-9j]), np.array([5], dtype="datetime64[s]"), [[1.0], [1.0, 2.0]]):
            with self.assertRaises(TypeError, msg=repr(wrong)):
                self.law.force(wrong)
        for right in (np.array([3e-9], dtype=object), np.arange(3, dtype=">f4"), np.array([True]), [np.float16(0.0)], 10**3):
            np.testing.assert_array_equal(self.law.force(right), self.law.force(np.asarray(right, dtype=float)))

    def test_names_a_law_with_a_zero_byte_in_full(self):
        with self.assertRaisesRegex(ValueError, "unknown model .*choose auto"):
            touchafm.law("dmt\0", self.law.contact)

    def test_is_pickled_with_its_contact(self):
        again = pickle.loads(pickle.dumps(self.law))
        self.assertEqual((again.name, again.force(3e-9), again.contact.as_dict()), ("dmt", self.law.force(3e-9), self.law.contact.as_dict()))

    def test_takes_a_masked_height_as_not_measured(self):
        heights = np.ma.array([1e-9, 2e-9, 3e-9], mask=[False, True, False])
        force = self.law.force(heights)
        np.testing.assert_array_equal(np.isnan(force), [False, True, False])
        self.assertEqual(force[2], self.law.force(3e-9))
        whole = np.ma.array([1, 2], mask=False)
        np.testing.assert_array_equal(self.law.force(whole), self.law.force([1.0, 2.0]))
        with self.assertRaises(ValueError):
            touchafm.Curve(z=np.ma.array(np.linspace(1e-6, 0.0, 9), mask=np.arange(9) == 4), force=np.zeros(9), approach=np.ones(9))

    def test_gives_a_float_for_a_float(self):
        self.assertIsInstance(self.law.force(3e-9), float)

    def test_ends_in_its_jumps(self):
        figures = self.law.figures
        self.assertEqual(self.law.force(figures.z_jtc), figures.force_before_jtc)
        self.assertEqual(self.law.force(figures.z_joc, branch="attached"), figures.force_before_joc)

    def test_refuses_other_branches_and_laws(self):
        for wrong in (lambda: self.law.force(1e-9, branch="middle"), lambda: touchafm.law("newton", self.law.contact),
                      lambda: touchafm.law("dynamic-dmt", self.law.contact)):
            with self.assertRaises(ValueError):
                wrong()

class Refused(unittest.TestCase):
    def test_numbers_of_medium_and_lever_are_checked_at_once(self):
        for given in ({"humidity": 40}, {"humidity": -0.1}, {"retardation": -1.0}, {"resonance": -5.0, "law": "dynamic-dmt"},
                      {"quality_factor": float("inf"), "law": "dynamic-dmt"}, {"temperature": 1e5, "law": "dynamic-dmt"}):
            with self.assertRaisesRegex(ValueError, "is not within", msg=given):
                touchafm.Contact.material("gold", **given)



class Cycle(unittest.TestCase):
    def test_is_the_json_of_the_command(self):
        for law in ("auto", "paper", "jkr", "maugis", "hao", "lj", "paper-rule", "dynamic-dmt"):
            with self.subTest(law):
                cycle = touchafm.cycle(touchafm.Contact.material("mica"), law)
                self.assertEqual(cycle.as_dict(), json_of("curve", "--material", "mica", "--model", law, "--json"))

    def test_is_the_json_of_the_command_with_other_numbers(self):
        contact = touchafm.Contact.material("gold", tip_radius=20e-9, humidity=0.07, reduced_modulus=1.5e9)
        cycle = touchafm.cycle(contact, z_from=40e-9, z_to=-3e-9, step=0.05e-9)
        expected = json_of("curve", "--material", "gold", "--tip-radius", "20nm", "--humidity", "7%", "--reduced-modulus",
                           "1.5GPa", "--from", "40nm", "--to=-3nm", "--step", "0.05nm", "--json")
        self.assertEqual(without_sources(cycle.as_dict()), without_sources(expected))

    def test_has_arrays_in_si(self):
        cycle = touchafm.cycle(touchafm.Contact.material("mica"), "paper")
        self.assertEqual(len(cycle), len(cycle.force))
        self.assertEqual(cycle.force.min(), cycle.pull_off.force)
        self.assertEqual(cycle.z[cycle.approach].min(), cycle.z.min())
        self.assertEqual([event.kind for event in cycle.events], ["jump-to-contact", "jump-off-contact"])
        area = -np.sum(0.5 * (cycle.force[1:] + cycle.force[:-1]) * np.diff(cycle.z))  # numpy renamed its own
        self.assertAlmostEqual(area / cycle.loop_energy, 1.0, delta=1e-3)

    def test_outlives_nothing_that_its_arrays_need(self):
        force = touchafm.cycle(touchafm.Contact.material("mica")).force
        self.assertTrue(np.isfinite(force).all())

    def test_refuses_with_the_words_of_the_command(self):
        mica = touchafm.Contact.material("mica")
        with self.assertRaises(ValueError) as refused:
            touchafm.cycle(mica, speed=1e-6)
        self.assertEqual(str(refused.exception), error_of("curve", "--material", "mica", "--speed", "1um/s"))
        with self.assertRaisesRegex(ValueError, "seed: -1 is outside 0 to 18446744073709551615"):
            touchafm.cycle(mica, "dynamic-dmt", seed=-1)
        for wrong in ({"step": 0.0}, {"step": float("nan")}, {"z_to": 1.0}, {"law": "newton"}, {"z_from": float("inf")}):
            with self.assertRaises(ValueError, msg=wrong):
                touchafm.cycle(mica, **wrong)


class Sweep(unittest.TestCase):
    def test_is_the_json_of_the_command(self):
        mica = touchafm.Contact.material("mica")
        sweep = touchafm.sweep(mica, "dmt", spring_constant=np.linspace(0.05, 0.25, 5))
        expected = json_of("curve", "--material", "mica", "--model", "dmt", "--sweep", "spring-constant=0.05N/m:0.25N/m:5",
                           "--json")
        self.assertEqual(sweep.as_dict(), expected)

    def test_has_the_shape_of_its_grid(self):
        sweep = touchafm.sweep(touchafm.Contact.material("mica"), tip_radius=[1e-8, 2e-8], spring_constant=[0.1, 0.2, 0.4])
        self.assertEqual(sweep.pull_off_force.shape, (2, 3))
        self.assertEqual(len(sweep.laws), 6)
        single = touchafm.cycle(touchafm.Contact.material("mica", tip_radius=2e-8, spring_constant=0.4))
        self.assertEqual(sweep.pull_off_z[1, 2], single.pull_off.z)

    def test_refuses_what_it_cannot_vary(self):
        mica = touchafm.Contact.material("mica")
        for wrong in ({}, {"tip_radius": []}, {"tip_radius": [-1.0]}, {"temperature": [300.0]}, {"tip_radius": [float("nan")]}):
            with self.assertRaises(ValueError, msg=wrong):
                touchafm.sweep(mica, **wrong)
        with self.assertRaises(TypeError):
            touchafm.sweep(mica, colour=[1.0])
        for no_numbers in (None, ["5nm"], [1j], [[1e-9], [1e-9, 2e-9]]):
            with self.assertRaisesRegex(TypeError, "tip_radius: give numbers, not "):
                touchafm.sweep(mica, tip_radius=no_numbers)


class Paper(unittest.TestCase):
    def test_has_tables_1_and_2(self):
        tables = touchafm.paper_tables()
        self.assertEqual(tables["table1"]["mica"]["Z_jtc_m"]["exact"], touchafm.Contact.material("mica", law="paper").figures.z_jtc)
        self.assertEqual(sorted(tables), ["table1", "table2"])


OPEN = """
import os, time
def opened():
    links = (os.path.join("/proc/self/fd", fd) for fd in os.listdir("/proc/self/fd"))
    return sorted(os.readlink(link) for link in links if os.path.islink(link) and not os.readlink(link).startswith("/proc/"))
import numpy, numpy.typing, concurrent.futures, json, socket, subprocess, tempfile
before, threads, begin = opened(), os.listdir("/proc/self/task"), time.perf_counter()
import touchafm
end = time.perf_counter()
import touchafm.maps, touchafm.serve, touchafm.compat.dtmicroscope
assert opened() == before, (before, opened())
assert os.listdir("/proc/self/task") == threads
assert "DISPLAY" not in os.environ and "WAYLAND_DISPLAY" not in os.environ
print(end - begin)
"""
NUMPY = "import time; begin = time.perf_counter(); import numpy; print(time.perf_counter() - begin)"


def printed_s(script):
    """Median of five runs of a script that prints a time."""
    times = [float(subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True).stdout) for _ in range(5)]
    return statistics.median(times)


class Import(unittest.TestCase):
    def test_opens_no_file_socket_or_window_and_starts_no_thread(self):
        subprocess.run([sys.executable, "-c", OPEN], check=True, stdout=subprocess.DEVNULL)

    def test_is_compared_with_that_of_numpy(self):
        mine, numpys = printed_s(OPEN), printed_s(NUMPY)
        print(f"import touchafm: {1e3 * mine:.0f} ms beside numpy's {1e3 * numpys:.0f} ms, {mine / numpys:.2f} times (bar: 150 ms)")

    def test_loads_no_window_system(self):
        with open("/proc/self/maps", encoding="utf-8") as maps:
            loaded = maps.read()
        for library in ("libvulkan", "libglfw", "libX11", "libxcb", "libhdf5"):
            self.assertNotIn(library, loaded)


if __name__ == "__main__":
    unittest.main()
