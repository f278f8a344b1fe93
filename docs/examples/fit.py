# SPDX-License-Identifier: Apache-2.0
"""Young's modulus of a gel with its interval, from a curve whose truth is known.

>>> import touchafm
>>> curves, truth = touchafm.generate(tip_radius=5e-6, modulus=3e3, spring_constant=0.05, most_force=1e-9, noise=15e-12)
>>> fit = touchafm.fit(curves[0], model="paraboloid", tip_radius=5e-6)
>>> low, high = fit.E_interval
>>> print(f"E = {fit.E:.0f} Pa, 95 % within {low:.0f} to {high:.0f} Pa, {fit.flag}")
E = 2988 Pa, 95 % within 2961 to 3015 Pa, trusted
>>> low < truth["parameters"]["modulus_Pa"] < high
True

With the wrong radius the interval is as narrow, and wrong: it covers only the noise.

>>> wrong = touchafm.fit(curves[0], model="paraboloid", tip_radius=4e-6, uncertainties={"tip_radius": 0.2})
>>> wrong.E_interval[0] > truth["parameters"]["modulus_Pa"]
True
>>> print(f"{wrong.as_dict()['systematic']['modulus_Pa'] / wrong.E:.2f}")
0.10
"""
