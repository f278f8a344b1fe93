# SPDX-License-Identifier: Apache-2.0
"""Every example of docs/examples prints what it says, and the Python of the pages runs."""

import doctest
import importlib.util
import os
import pathlib
import re
import shutil
import tempfile
import unittest

from command import touchafm as command

EXAMPLES = pathlib.Path(os.environ["EXAMPLES"])


class Pages(unittest.TestCase):
    """What readers copy from docs/python.md and docs/serve.md, one block after the other."""

    def test_run(self):
        # the file of docs/generate.md
        made = command("generate", "curve", "--radius", "5um", "--modulus", "3kPa", "--spring-constant", "0.05N/m", "--most-force", "1nN",
                       "--noise", "15pN", "--out", "gel.h5")
        self.assertEqual(made.returncode, 0, made.stderr)
        run = 0
        for page in ("python.md", "serve.md"):
            text = (EXAMPLES.parent / page).read_text(encoding="utf-8")
            names = {}
            for block in re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
                with self.subTest(page=page, block=block):
                    exec(compile(block, page, "exec"), names)
                run += 1
        self.assertGreaterEqual(run, 3)


def load_tests(loader, tests, pattern):
    del loader, pattern
    examples = sorted(EXAMPLES.glob("*.py"))
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
