# SPDX-License-Identifier: Apache-2.0
"""The type stub names what the module has, and no more; everything has a docstring."""

import ast
import os
import pathlib
import re
import unittest

import touchafm


def public(names):
    return {name for name in names if not name.startswith("_")}


class Stub(unittest.TestCase):
    def setUp(self):
        with open(os.environ["STUB"], encoding="utf-8") as file:
            self.body = ast.parse(file.read()).body
        self.classes = {node.name: node for node in self.body if isinstance(node, ast.ClassDef)}
        self.functions = {node.name: node for node in self.body if isinstance(node, ast.FunctionDef)}

    def test_has_every_name_of_the_module(self):
        self.assertEqual(set(self.classes) | set(self.functions), set(touchafm.__all__))

    def test_has_every_member_of_every_class(self):
        for name, node in self.classes.items():
            if name == "FileError":
                continue
            stubbed = public(each.name for each in node.body if isinstance(each, ast.FunctionDef))
            self.assertEqual(stubbed, public(vars(getattr(touchafm, name))), name)

    def test_has_the_arguments_of_every_function(self):
        for name, node in self.functions.items():
            signature = getattr(touchafm, name).__doc__.splitlines()[0]
            for argument in [*node.args.args, *node.args.kwonlyargs]:
                if f"{argument.arg}:" in signature:
                    continue
                self.assertIn("**kwargs", signature, (name, argument.arg))  # a number among others

    def test_says_which_classes_only_functions_make(self):
        for name, node in self.classes.items():
            made = {"FileError", "Contact", "Curve"}
            initialiser = next((each for each in node.body if getattr(each, "name", "") == "__init__"), None)
            never = isinstance(getattr(initialiser, "returns", None), ast.Name) and initialiser.returns.id == "NoReturn"
            self.assertEqual(never, name not in made, name)
            if name not in made:
                with self.assertRaises(TypeError):
                    getattr(touchafm, name)()
            if name != "FileError":
                with self.assertRaises(TypeError):
                    type("Other", (getattr(touchafm, name),), {})

    def test_finds_a_docstring_everywhere(self):
        for name in touchafm.__all__:
            member = getattr(touchafm, name)
            self.assertTrue(member.__doc__, name)
            for each in public(vars(member)) if isinstance(member, type) and name != "FileError" else ():
                self.assertTrue(getattr(member, each).__doc__, (name, each))

    def test_names_the_sources_of_what_is_computed(self):
        documents = pathlib.Path(os.environ["EXAMPLES"]).parent
        for name in ("analyse", "cycle", "fit", "frequency_shift", "generate", "generate_map", "law", "lever", "scan", "sweep", "tapping"):
            named = re.findall(r"docs/(\w+\.md)", getattr(touchafm, name).__doc__)
            self.assertTrue(named, name)
            for document in named:
                self.assertTrue((documents / document).is_file(), (name, document))


if __name__ == "__main__":
    unittest.main()
