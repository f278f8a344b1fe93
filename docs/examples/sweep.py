# SPDX-License-Identifier: Apache-2.0
"""A law as an array, and the pull-off from soft to stiff levers.

>>> import numpy as np
>>> import touchafm
>>> mica = touchafm.Contact.material("mica")
>>> law = touchafm.law("dmt", mica)
>>> law.force(np.array([5e-9, 10e-9])).shape
(2,)
>>> law.force(5e-9) < 0.0
True
>>> stiffness = np.geomspace(0.05, 50.0, 4)
>>> sweep = touchafm.sweep(mica, "dmt", spring_constant=stiffness)
>>> for k, z in zip(stiffness, sweep.pull_off_z):
...     print(f"{k:6.2f} N/m: " + ("no jump" if np.isnan(z) else f"off at {z * 1e9:.2f} nm"))
  0.05 N/m: off at 28.38 nm
  0.50 N/m: off at 3.18 nm
  5.00 N/m: off at 0.66 nm
 50.00 N/m: no jump
"""
