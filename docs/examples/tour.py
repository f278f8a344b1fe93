# SPDX-License-Identifier: Apache-2.0
"""Every part of the module in a line or two.

>>> import numpy as np
>>> import touchafm as t

A cycle of a contact, the law as an array, and a sweep on all cores:

>>> c = t.Contact.material("mica", tip_radius=50e-9, spring_constant=0.1)
>>> print(f"{t.cycle(c, law='dmt').pull_off.force * 1e9:.2f} nN")
-1.40 nN
>>> law = t.law("jkr", c)
>>> law.force(np.linspace(1e-9, 9e-9, 500), branch="attached").shape
(500,)
>>> s = t.sweep(c, "dmt", tip_radius=np.geomspace(5e-9, 5e-6, 60))
>>> s.z_joc.shape
(60,)

Curves whose truth is known, written and read like any other file:

>>> x, truth = t.generate("jkr", E=1e6, W=5e-2, noise=20e-12, n=100, seed=1)
>>> len(x), truth["parameters"]["modulus_Pa"]
(100, 1000000.0)
>>> gel, _ = t.generate(E=3e3, tip_radius=5e-6, spring_constant=0.05, most_force=1e-9, noise=15e-12)
>>> gel[0].write("curve.h5")
>>> k = t.read("curve.h5")[0]
>>> k.z.shape, k.force.shape, k.metadata["spring_constant"]
((2000,), (2000,), 0.05)

A fit, and a map of fits as an image and as a table:

>>> r = t.fit(k, model="sphere", tip_radius=5e-6, poisson=0.5)
>>> print(f"{r.E:.0f} Pa, {r.E_interval[0]:.0f} to {r.E_interval[1]:.0f} Pa, {r.flag}")
3002 Pa, 2975 to 3029 Pa, trusted
>>> m, _ = t.generate_map("cone", E=3e3, second_modulus=20e3, field="step", half_angle=0.31, pixels=(4, 2), size=8e-6,
...                       spring_constant=0.05, most_force=1e-9, noise=15e-12, points=200)
>>> e = t.fit_map(m, model="cone", half_angle=0.31)
>>> e.image("E").save("E.gwy")
>>> e.table.to_csv("E.csv")
>>> list(t.read_image("E.gwy")["channels"])
['E']

Tapping: the states at one height, the jumps of a slow curve, a fast curve, and an image:

>>> d = t.Drive(free_amplitude=20e-9, resonance=300e3, quality_factor=400, contact_gap=0.165e-9)
>>> hard = t.Contact.material("mica", tip_radius=20e-9, spring_constant=40.0, hamaker=64e-21, reduced_modulus=1.5e9)
>>> a = t.tapping(hard, d, law="dmt")
>>> [(state["state"], state["stable"]) for state in a.states(z=17.4e-9)]
[('attractive', True), ('attractive', False), ('repulsive', True)]
>>> [f"{fold['branch']} at {fold['z_m'] * 1e9:.1f} nm" for fold in a.folds]
['approach at 16.5 nm', 'retract at 18.9 nm']
>>> a.curve(speed=1e-6).phase.shape
(801,)
>>> img = t.scan(hard, size=40e-9, pixels=32, mode="tapping", drive=d, seed=3)
>>> img["Phase"].shape
(32, 32)
>>> bars = t.scan(t.surface("gratings", size=500e-9), pixels=64)
>>> bars["Height"].shape
(64, 64)

An instrument, and the calibration of its lever:

>>> with t.serve.connect() as afm:
...     height = afm.approach()["z_m"]
...     image = afm.scan(lines=64)
...     freq, psd = afm.thermal(points=4000, averages=200)
>>> image["Height"].shape
(64, 64)
>>> lv = t.lever.thermal(freq, psd / 60e-9**2, invols=60e-9, temperature=298.15)
>>> print(f"{lv.k:.2f} N/m, {lv.k_interval[0] < lv.k < lv.k_interval[1]}")
0.10 N/m, True
"""
