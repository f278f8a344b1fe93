# SPDX-License-Identifier: Apache-2.0
"""Curves whose truth is known, read and fitted by nanite.

Needs nanite (Debian has no package of it), so that no test of TouchAFM runs it: `python3 -m doctest nanite_beside.py` by hand does.
Last run with nanite 4.2.0 and afmformats 0.18.7 on 29 November 2026.

>>> import nanite
>>> import touchafm
>>> def by_nanite(file, **start):
...     curve = nanite.load_group(file)[0]
...     curve.apply_preprocessing(["compute_tip_position"])
...     parameters = curve.get_initial_fit_parameters(model_key="hertz_para")
...     parameters["R"].value, parameters["nu"].value = 5e-6, 0.5
...     for name, value in start.items():
...         parameters[name].value = value
...     curve.fit_model(model_key="hertz_para", params_initial=parameters, weight_cp=0)
...     return curve.fit_properties["params_fitted"]["E"].value

Without noise nanite finds the modulus that made the curve, wherever it starts:

>>> gel = {"tip_radius": 5e-6, "modulus": 3e3, "spring_constant": 0.05, "most_force": 1e-9}
>>> curves, truth = touchafm.generate(**gel)
>>> curves[0].write("exact.h5", format="h5")
>>> truth["curves"][0]["reduced_modulus_Pa"]
4000.0
>>> print(f"{by_nanite('exact.h5', E=100.0):.3f} Pa")
3000.000 Pa

With noise it finds what TouchAFM finds in nanite's coordinates, against the tip position and without whitening:

>>> curves, truth = touchafm.generate(noise=15e-12, **gel)
>>> curves[0].write("noisy.h5", format="h5")
>>> ours = touchafm.fit(curves[0], model="paraboloid", tip_radius=5e-6, against="tip", white_noise=True)
>>> print(f"nanite {by_nanite('noisy.h5'):.2f} Pa, TouchAFM {ours.E:.2f} Pa")
nanite 2986.84 Pa, TouchAFM 2986.84 Pa
"""
