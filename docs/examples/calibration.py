# SPDX-License-Identifier: Apache-2.0
"""The spring constant of a lever by its thermal noise, from a spectrum that a simulated microscope records.

>>> import touchafm
>>> from touchafm import serve
>>> afm = serve.start(seed=11)
>>> frequency, density = afm.thermal(points=4000, averages=200)
>>> true = afm.truth()["contact"]["spring_constant_N_per_m"]
>>> afm.close()
>>> lever = touchafm.lever(thermal=(frequency, density), averages=200)
>>> low, high = lever.k_interval
>>> print(f"k = {lever.k:.4f} N/m, 95 % within {low:.4f} to {high:.4f} N/m, in truth {true:.4f} N/m")
k = 0.0999 N/m, 95 % within 0.0996 to 0.1002 N/m, in truth 0.1000 N/m
>>> print(f"resonance {lever.resonance / 1e3:.2f} kHz, Q {lever.quality_factor:.1f}")
resonance 12.01 kHz, Q 2.5
"""
