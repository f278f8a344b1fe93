# SPDX-License-Identifier: Apache-2.0
"""Interfaces of other programs, answered by the virtual microscope: touchafm.compat.dtmicroscope."""
