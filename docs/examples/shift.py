# SPDX-License-Identifier: Apache-2.0
"""The frequency shift of a lever whose amplitude is kept, and how the amplitude matters (Giessibl 1997).

>>> import touchafm
>>> mica = touchafm.Contact.material("mica")
>>> for amplitude in (0.1e-9, 1e-9, 5e-9):
...     there = touchafm.frequency_shift(mica, amplitude=amplitude, resonance=30e3, law="dmt", at=10e-9)
...     print(f"A = {amplitude * 1e9:.1f} nm: {there.shift[0]:6.1f} Hz, by the gradient {there.small_amplitude_shift[0]:.1f} Hz")
A = 0.1 nm:  -61.3 Hz, by the gradient -61.2 Hz
A = 1.0 nm:  -62.2 Hz, by the gradient -61.2 Hz
A = 5.0 nm:  -94.3 Hz, by the gradient -61.2 Hz
"""
