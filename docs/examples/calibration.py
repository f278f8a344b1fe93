# SPDX-License-Identifier: Apache-2.0
"""The spring constant of a lever by its thermal noise, from a spectrum that a simulated microscope records.

>>> import touchafm
>>> from touchafm import serve
>>> afm = serve.start(seed=11)
>>> afm.set(material="mica")
>>> spectrum = afm.thermal(points=4000, averages=200)
>>> true = afm.truth()["contact"]["spring_constant_N_per_m"]
>>> afm.close()
>>> lever = touchafm.lever(thermal=(spectrum["frequency"], spectrum["density"]), averages=200)
>>> low, high = lever.k_interval
>>> print(f"k = {lever.k:.4f} N/m, 95 % within {low:.4f} to {high:.4f} N/m, in truth {true:.4f} N/m")
>>> print(f"resonance {lever.resonance / 1e3:.2f} kHz, Q {lever.quality_factor:.1f}")
"""
