# SPDX-License-Identifier: Apache-2.0
"""Every example of docs/examples prints what it says."""

import doctest
import importlib.util
import os
import pathlib
import tempfile
import unittest


def load_tests(loader, tests, pattern):
    del loader, pattern
    examples = sorted(pathlib.Path(os.environ["EXAMPLES"]).glob("*.py"))
    assert len(examples) >= 5, examples
    os.chdir(tempfile.mkdtemp())
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
