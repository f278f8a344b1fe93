# SPDX-License-Identifier: Apache-2.0
"""A curve of a file, analysed and compared with a model. Here the file is written first.

>>> import touchafm
>>> curves, _ = touchafm.generate("jkr", tip_radius=1e-6, modulus=1e6, work_of_adhesion=20e-3, spring_constant=1.0,
...                               most_force=200e-9, noise=300e-12)
>>> curves[0].write("sticky.h5", format="h5")

Any file that touchafm analyse reads will do.

>>> curve = touchafm.read("sticky.h5")[0]
>>> curve.metadata["spring_constant"], len(curve)
(1.0, 2000)
>>> analysis = touchafm.analyse(curve)
>>> print(f"adhesion {analysis.adhesion * 1e9:.1f} nN")
adhesion -94.7 nN
>>> fit = touchafm.fit(analysis, model="auto", tip_radius=1e-6)
>>> print(f"{fit.model}: E = {fit.E / 1e6:.2f} MPa, W = {fit.W * 1e3:.1f} mJ/m2")
jkr: E = 1.00 MPa, W = 20.0 mJ/m2
"""
