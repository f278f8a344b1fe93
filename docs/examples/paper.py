# SPDX-License-Identifier: Apache-2.0
"""Tables 1 and 2 of Liu & Peng: what the paper printed, and what its equations give.

>>> import touchafm
>>> tables = touchafm.paper_tables()
>>> for material, row in tables["table1"].items():
...     jump = row["Z_jtc_m"]
...     print(f"{material:6} Z_jtc {jump['exact'] * 1e9:.3f} nm, printed {jump['printed'] * 1e9:.3f} nm")
mica   Z_jtc 2.398 nm, printed 2.397 nm
gold   Z_jtc 4.072 nm, printed 4.071 nm
si3n4  Z_jtc 2.500 nm, printed 2.501 nm
>>> for material, row in tables["table2"].items():
...     print(f"{material:6} F_ad {row['F_ad_N']['exact'] * 1e9:.4f} nN")
mica   F_ad 1.3999 nN
gold   F_ad 9.9997 nN
si3n4  F_ad 0.6000 nN

The same from a contact: the law of the paper for numbers of one's own.

>>> mica = touchafm.Contact(law="paper", tip_radius=50e-9, spring_constant=0.1, hamaker=24.5e-21, work_of_adhesion=4.456e-3)
>>> f"{mica.figures.z_jtc:.9e} m"
'2.397523487e-09 m'
"""
