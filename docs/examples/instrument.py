# SPDX-License-Identifier: Apache-2.0
"""A microscope that other programs control, and the truth that it knows (docs/serve.md).

A blunt tip feels more adhesion. The script presses too hard, and sees it in the next curve:

>>> from touchafm import serve
>>> afm = serve.start(seed=7)
>>> afm.set(material="mica", law="dmt", blunting_force_N=2e-9, blunting_m_per_N=5.0)
>>> pull_off = lambda: -afm.curve(points=200)["force"].min() * 1e9
>>> print(f"{pull_off():.2f} nN at {afm.truth()['tip_radius_m'] * 1e9:.0f} nm")
1.40 nN at 50 nm
>>> pressed = afm.curve(z_from=50e-9, z_to=-60e-9, points=200)["force"].max()
>>> print(f"{pull_off():.2f} nN at {afm.truth()['tip_radius_m'] * 1e9:.0f} nm, after a push of {pressed * 1e9:.1f} nN")
1.96 nN at 70 nm, after a push of 6.0 nN
>>> afm.close()
"""
