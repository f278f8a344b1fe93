# SPDX-License-Identifier: Apache-2.0
"""Twenty curves whose truth is known, beside what the fit finds in them.

>>> import numpy as np
>>> import touchafm
>>> curves, truth = touchafm.generate("jkr", tip_radius=1e-6, modulus=1e6, work_of_adhesion=20e-3, spring_constant=1.0,
...                                   most_force=200e-9, noise=300e-12, count=20, seed=4)
>>> fits = [touchafm.fit(curve, model="jkr", tip_radius=1e-6) for curve in curves]
>>> found = np.array([fit.E for fit in fits])
>>> true = truth["parameters"]["modulus_Pa"]
>>> print(f"{found.mean() / 1e6:.4f} +- {found.std() / 1e6:.4f} MPa, in truth {true / 1e6:.4f} MPa")
0.9999 +- 0.0005 MPa, in truth 1.0000 MPa
>>> inside = sum(fit.E_interval[0] <= true <= fit.E_interval[1] for fit in fits)
>>> inside >= 17  # of 20 intervals of 95 %
True
>>> pull_off = -touchafm.analyse(curves[0]).adhesion
>>> print(f"pull-off {pull_off * 1e9:.1f} nN, in truth {truth['curves'][0]['pull_off_N'] * 1e9:.1f} nN")
pull-off 94.6 nN, in truth 94.2 nN
"""
