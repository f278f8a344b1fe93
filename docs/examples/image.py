# SPDX-License-Identifier: Apache-2.0
"""An image of gold under a cone, levelled, and how far a hurried scan is from the truth.

>>> import numpy as np
>>> import touchafm
>>> gold = touchafm.Contact.material("gold")
>>> for rate in (2.0, 40.0):
...     scan = touchafm.scan(gold, size=40e-9, pixels=64, rate=rate, tip="cone", tip_angle=0.3, seed=3)
...     roughness = np.std(touchafm.level(scan["Height"]))
...     error = np.std(scan["Height"] - scan.truth)
...     print(f"{rate:2.0f} lines/s: {scan.time:4.1f} s, Sq {roughness * 1e9:.2f} nm, wrong by {error * 1e9:.2f} nm rms")
 2 lines/s: 32.0 s, Sq 0.33 nm, wrong by 0.01 nm rms
40 lines/s:  1.6 s, Sq 0.29 nm, wrong by 0.13 nm rms
>>> scan.as_dict()["lines_with"]
{'blur': 64}
>>> scan["Error"].shape, scan.units["Error"]
((64, 64), 'N')
>>> scan.write("gold.gwy")
"""
