# SPDX-License-Identifier: Apache-2.0
"""Every example of docs/examples prints what it says."""

import doctest
import importlib.util
import os
import pathlib
import shutil
import tempfile
import unittest


def load_tests(loader, tests, pattern):
    del loader, pattern
    examples = sorted(pathlib.Path(os.environ["EXAMPLES"]).glob("*.py"))
    assert len(examples) >= 10, examples
    os.chdir(tempfile.mkdtemp())
    tests_folder = pathlib.Path(__file__).parent.parent
    os.mkdir("out")  # as touchafm demo --out out leaves it
    shutil.copy(tests_folder / "formats" / "0.2.0" / "session-mica.afms", "out")
    for example in examples:
        spec = importlib.util.spec_from_file_location(example.stem, example)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        case = doctest.DocTestSuite(module)
        assert case.countTestCases() == 1, example
        tests.addTests(case)
    return tests


if __name__ == "__main__":
    unittest.main()
