# SPDX-License-Identifier: Apache-2.0
"""The production folders, in the order in which one may include the other: those of tests/architecture/include_rules.cmake."""

import pathlib
import re

_RULES = pathlib.Path(__file__).resolve().parent.parent / "tests" / "architecture" / "include_rules.cmake"


def production_folders():
    found = re.findall(r"^set\(arrows_(\w+)", _RULES.read_text(), re.MULTILINE)
    return list(dict.fromkeys(found))
