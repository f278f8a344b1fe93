# SPDX-License-Identifier: Apache-2.0
"""The lines with which a module for laboratories was asked for run unchanged, with files of the names that they have."""

import os
import pathlib
import shutil
import tempfile
import unittest

import numpy as np

import touchafm

# The lines with which a module for labs was asked for, unchanged.
ASKED = """
c = t.Contact.material("mica", tip_radius=50e-9, spring_constant=0.1)
t.cycle(c, law="dmt").pull_off.force
law = t.law("jkr", c); f = law.force(np.linspace(1e-9, 9e-9, 500), branch="attached")
s = t.sweep(c, "dmt", tip_radius=np.geomspace(5e-9, 5e-6, 60)); s.z_joc
k = t.read("curve.jpk-force")[0]; k.z, k.force, k.metadata["spring_constant"]
r = t.fit(k, model="sphere", tip_radius=5e-6, poisson=0.5); r.E, r.E_interval, r.flag
m = t.read("cells.jpk-qi-data"); e = t.fit_map(m, model="cone", half_angle=0.31)
e.image("E").save("E.gwy"); e.table.to_csv("E.csv")
d = t.Drive(free_amplitude=20e-9, resonance=300e3, quality_factor=400)
a = t.tapping(c, d, law="dmt"); a.states(z=17.4e-9); a.folds; a.curve(speed=1e-6).phase
img = t.scan(t.surface("gratings", size=500e-9), mode="tapping", drive=d, seed=3); img["Phase"]
lv = t.lever.thermal(freq, psd, invols=60e-9, temperature=295.0); lv.k, lv.k_interval
x, truth = t.generate("jkr", E=1e6, W=5e-2, noise=20e-12, n=100, seed=1)
with t.serve.connect() as afm: afm.approach(); afm.scan(lines=64)
"""


class Asked(unittest.TestCase):
    def test_runs_as_it_is_printed(self):
        self.addCleanup(os.chdir, os.getcwd())
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        os.chdir(folder.name)
        corpus = pathlib.Path(__file__).parent.parent / "fuzz" / "corpus" / "curve_files"
        shutil.copy(corpus / "adhesive.jpk-force", "curve.jpk-force")
        shutil.copy(corpus / "pixels.jpk-qi-data", "cells.jpk-qi-data")
        with touchafm.serve.connect() as afm:
            freq, psd = afm.thermal(points=4000, averages=200)
        names = {"np": np, "t": touchafm, "freq": freq, "psd": psd / 60e-9**2}  # V^2/Hz
        for line in ASKED.strip().splitlines():
            with self.subTest(line):
                exec(line, names)
        self.assertEqual(names["img"]["Phase"].shape, (256, 256))
        self.assertLess(abs(names["lv"].k / 0.1 - 1.0), 0.05)
        self.assertEqual((len(names["x"]), len(names["truth"]["curves"])), (100, 100))
        fit = touchafm.fit(names["x"][0], model="jkr", tip_radius=names["truth"]["parameters"]["radius_m"])
        self.assertLess(fit.E_interval[0], 1e6)
        self.assertGreater(fit.E_interval[1], 1e6)


if __name__ == "__main__":
    unittest.main()
