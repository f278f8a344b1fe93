# SPDX-License-Identifier: Apache-2.0
"""A map of a cell's stiffness whose truth is known, fitted at every pixel.

>>> import numpy as np
>>> import touchafm
>>> import touchafm.maps
>>> curves, truth = touchafm.generate_map(tip_radius=5e-6, modulus=3e3, second_modulus=20e3, field="step", pixels=(6, 4), size=8e-6,
...                                       spring_constant=0.05, most_force=1e-9, noise=15e-12, points=200, seed=5)
>>> found = touchafm.maps.fit(curves, model="paraboloid", tip_radius=5e-6)
>>> found.E.shape  # row 0 at the top
(4, 6)
>>> print(np.round(found.E[0] / 1e3))  # kPa
[ 3.  3.  3. 20. 20. 20.]
>>> bool((found.flag == "trusted").all())
True
"""
