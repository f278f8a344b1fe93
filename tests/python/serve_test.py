# SPDX-License-Identifier: Apache-2.0
"""The client of a simulated microscope, on a server of its own."""

import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np

import touchafm
from touchafm import serve


INTERRUPTED = """
import os, signal
from touchafm import serve
with serve.start() as afm:
    afm.set(lines=1000)
    afm.approach()
    try:
        afm.scan(on_line=lambda line: os.killpg(0, signal.SIGINT) if line["line"] == 3 else None)
    except KeyboardInterrupt:
        print(afm.get()["lines"])
"""


class Serve(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.afm = serve.start(seed=7, out=self.folder.name)
        self.addCleanup(self.afm.close)

    def test_has_the_curve_of_the_library(self):
        curve = self.afm.curve(z_from=20e-9, z_to=-5e-9, points=251)
        cycle = touchafm.cycle(touchafm.Contact.material("mica"), z_from=20e-9, z_to=-5e-9, step=1e-10)
        self.assertEqual(len(curve["z"]), len(cycle))
        np.testing.assert_allclose(curve["force"], cycle.force, atol=1e-15)
        np.testing.assert_array_equal(curve["approach"], cycle.approach)

    def test_takes_a_cycle_height_by_height(self):
        self.afm.set(flat=True)
        cycle = touchafm.cycle(touchafm.Contact.material("mica"), z_from=100e-9, z_to=-20e-9, step=1e-9)
        heights = np.concatenate([np.arange(100, -21, -1), np.arange(-20, 101)]) * 1e-9
        forces = [self.afm.set_z(z)["force_N"] for z in heights]
        down = cycle.approach & np.isin(np.round(cycle.z * 1e12), np.round(heights * 1e12))
        np.testing.assert_allclose(forces[:121], cycle.force[down][:121], atol=1e-13)
        self.assertLess(min(forces[121:]), 1.5 * min(forces[:121]))

    def test_connects_to_a_server_of_its_own_without_a_path(self):
        with serve.connect() as afm:
            afm.approach()
            self.assertEqual(afm.scan(lines=3, pixels=4)["Height"].shape, (3, 4))
            self.assertEqual(afm.get()["lines"], 3)
            with self.assertRaises(serve.Refused):
                afm.scan(line=3)

    def test_scans_and_saves(self):
        self.afm.set(pixels=16, size_m=np.float64(20e-9))
        self.assertTrue(self.afm.approach()["engaged"])
        rows = []
        image = self.afm.scan(on_line=lambda line: rows.append(line["line"]))
        self.assertEqual(rows, list(range(16)))
        self.assertEqual(image["Height"].shape, (16, 16))
        self.assertFalse(np.isnan(image["Lateral force (retrace)"]).any())
        self.afm.save("image.gwy")
        saved = touchafm.read_image(os.path.join(self.folder.name, "image.gwy"))
        np.testing.assert_allclose(saved["channels"]["Height"][0], image["Height"], atol=1e-15)

    def test_scans_with_a_swing(self):
        self.afm.set(mode="tapping", law="dmt", spring_constant_N_per_m=40.0, quality_factor=400.0, resonance_Hz=300e3, pixels=8)
        self.afm.approach()
        image = self.afm.scan()
        self.assertEqual(image["Phase"].shape, (8, 8))
        self.assertFalse(np.isnan(image["Peak force (retrace)"]).any())
        self.assertNotIn("Lateral force", image)
        self.assertEqual(self.afm.truth()["state_flips"], 0)

    def test_stops_a_scan(self):
        self.afm.set(pixels=128, lines=1000)
        self.afm.approach()
        rows = []

        def enough(line):
            rows.append(line["line"])
            return len(rows) < 10

        image = self.afm.scan(on_line=enough)
        self.assertFalse(np.isnan(image["Height"][9]).any())
        self.assertLess(len(rows), 1000)
        self.assertTrue(np.isnan(image["Height"][len(rows):]).all())
        self.assertEqual(self.afm.get()["lines"], 1000)  # the next answer is that of the next request

    def test_counts_the_heights_of_a_tapping_curve_and_ends_it(self):
        counts = []
        curve = self.afm.tapping_curve(points=5, on_progress=lambda done, of: counts.append((done, of)))
        self.assertEqual(counts, [(done, 9) for done in range(1, 10)])
        np.testing.assert_array_equal(self.afm.tapping_curve(points=5)["amplitude"], curve["amplitude"])
        # a curve of minutes: pressed into the sample, for a swing that is integrated directly
        with self.assertRaisesRegex(serve.Refused, "the tapping curve was ended after [1-9][0-9]* of 199999 heights"):
            self.afm.tapping_curve(points=100_000, z_to=-20e-9, on_progress=lambda done, of: done < 2)
        self.assertEqual(self.afm.get()["lines"], 0)  # the next answer is that of the next request

    def test_answers_the_next_request_after_one_whose_wait_was_interrupted(self):
        self.afm.set(pixels=64, lines=1000)
        self.afm.approach()

        def interrupt(line):
            if line["line"] == 3:
                raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            self.afm.scan(on_line=interrupt)
        self.assertEqual(self.afm.get()["lines"], 1000)
        self.assertEqual(self.afm.curve(points=7)["z"].shape, (17,))  # and two of a jump, on one branch or both

    def test_outlives_ctrl_c_of_its_script(self):
        done = subprocess.run([sys.executable, "-c", INTERRUPTED], start_new_session=True, capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stdout), (0, "1000\n"), done.stderr)

    def test_calibrates_the_lever(self):
        frequency, density = self.afm.thermal(averages=200)
        lever = touchafm.lever(thermal=(frequency, density), averages=200, temperature=self.afm.get()["temperature_K"])
        truth = self.afm.get()["spring_constant_N_per_m"]
        self.assertAlmostEqual(lever.k, truth, delta=0.02 * truth)
        self.assertLess(lever.k_interval[0], truth)
        self.assertGreater(lever.k_interval[1], truth)

    def test_packs_its_arrays_without_changing_a_number(self):
        packed = self.afm.request("curve", points=5)["z_m"]
        numbers = self.afm.request("curve", points=5, arrays=None)["z_m"]
        self.assertIsInstance(packed, np.ndarray)
        self.assertIsInstance(numbers, list)
        np.testing.assert_array_equal(packed, numbers)

    def test_says_why_it_refuses(self):
        with self.assertRaisesRegex(serve.Refused, "approach"):
            self.afm.scan()
        with self.assertRaisesRegex(ValueError, "no setting \"colour\""):
            self.afm.set(colour=3)
        with self.assertRaisesRegex(ValueError, "set: one of the numbers is not finite"):
            self.afm.set(setpoint_N=float("nan"))
        self.assertEqual(self.afm.get()["material"], "mica")

    def test_times_its_curves(self):  # case S06
        begin = time.monotonic()
        for _ in range(100):
            self.afm.curve(points=500)
        print(f"1000 curves of 2 x 500 points: {10 * (time.monotonic() - begin):.1f} s")

    def test_removes_its_socket_when_it_is_interrupted(self):
        path = os.path.join(self.folder.name, "afm.sock")
        server = subprocess.Popen([os.environ["TOUCHAFM"], "serve", "--socket", path], stderr=subprocess.PIPE, text=True)
        self.assertIn("listens on", server.stderr.readline())
        self.assertEqual(os.stat(path).st_mode & 0o777, 0o600)
        server.send_signal(signal.SIGINT)
        with server.stderr:
            self.assertEqual(server.wait(timeout=10), 1)
        self.assertFalse(os.path.exists(path))

    def test_says_that_a_server_has_left(self):
        self.afm.quit()
        none = os.path.join(self.folder.name, "none")
        with self.assertRaisesRegex(FileNotFoundError, f"cannot connect to {none}: No such file.*touchafm serve --socket"):
            serve.connect(none)
        with self.assertRaisesRegex(OSError, "cannot connect to n{200}: .*too long"):
            serve.connect("n" * 200)

    def test_says_why_a_server_hangs_up(self):
        with self.assertRaisesRegex(serve.Refused, "more than 1 MiB"):
            self.afm.request("hello", seed="7" * (2 << 20))
        with self.assertRaisesRegex(ConnectionError, "the server left while it was asked to"):
            self.afm.get()
        self.afm.close()
        with self.assertRaisesRegex(ConnectionError, "cannot get: this client is closed"):
            self.afm.get()

    def test_waits_for_the_client_before(self):
        path = os.path.join(self.afm._folder, "socket")
        with serve.connect(path, timeout=0.5) as second:
            with self.assertRaisesRegex(TimeoutError, "no answer to hello within 0.5 s: .*another client"):
                second.get()
        self.assertEqual(self.afm.get()["material"], "mica")

    def test_starts_where_temporary_files_have_long_paths(self):
        folder = os.path.join(self.folder.name, "a" * 100)
        os.mkdir(folder)
        script = "from touchafm import serve\nwith serve.start() as afm: print(afm.get()['pixels'])"
        done = subprocess.run([sys.executable, "-c", script], env={**os.environ, "TMPDIR": folder}, capture_output=True, text=True, check=False)
        self.assertEqual((done.stdout, done.stderr), ("64\n", ""))
        self.assertEqual(os.listdir(folder), [])

    def test_makes_the_folder_of_its_results(self):
        folder = os.path.join(self.folder.name, "new", "results")
        with serve.start(out=folder) as afm:
            afm.curve(points=20)
            afm.save("curve.tab")
        self.assertEqual(os.listdir(folder), ["curve.tab"])

    def test_says_why_a_server_does_not_start(self):
        blocked = os.path.join(self.folder.name, "file")
        with open(blocked, "w", encoding="utf-8"):
            pass
        with self.assertRaisesRegex(serve.Refused, "cannot make this folder: Not a directory"):
            serve.start(out=os.path.join(blocked, "none"))
        with self.assertRaisesRegex(serve.Refused, "--seed: \"-1\" is negative"):
            serve.start(seed=-1)


if __name__ == "__main__":
    unittest.main()
