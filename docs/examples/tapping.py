# SPDX-License-Identifier: Apache-2.0
"""The loop between the two states of a tapping tip: on the way down it jumps elsewhere than on the way up.

>>> import touchafm
>>> contact = touchafm.Contact(law="dmt", spring_constant=40.0, tip_radius=20e-9, hamaker=64e-21, work_of_adhesion=1e-3,
...                            reduced_modulus=1.5e9)
>>> tapping = touchafm.tapping(contact, free_amplitude=20e-9, resonance=300e3, quality_factor=400.0, contact_gap=0.165e-9)
>>> for jump in tapping.as_dict()["jumps"]:
...     print(f"{jump['branch']} at {jump['z_m'] * 1e9:.1f} nm")
approach at 16.5 nm
retract at 18.9 nm
"""
