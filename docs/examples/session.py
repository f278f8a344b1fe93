# SPDX-License-Identifier: Apache-2.0
"""What a hand felt: the forces and events of a recorded session.

`touchafm demo --model auto --out out` records one without a device, `touchafm view --record DIR` those of your own hand.

>>> import touchafm
>>> session = touchafm.session("out/session-mica.afms")
>>> for event in session.events:
...     print(f"{event['kind']} at Z = {event['z'] * 1e9:.2f} nm: {event['force_before'] * 1e9:.3f} nN before")
jump-to-contact at Z = 2.40 nm: -0.080 nN before
jump-off-contact at Z = 14.38 nm: -1.400 nN before
>>> session.parameters["tip_radius_m"], session.sources["tip_radius"]["source"]
(5e-08, 'Liu & Peng, Table 1')
>>> strongest = session.force.argmin()
>>> bool(session.in_contact[strongest]), bool(session.hand_force[strongest] < 0.0)  # the sample pulls the hand, too
(True, True)
>>> bool(abs(session.hand_force).max() <= 2.0)  # the limit of every device, N
True
"""
