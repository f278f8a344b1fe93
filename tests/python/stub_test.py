# SPDX-License-Identifier: Apache-2.0
"""The type stub names what the module has, and no more; everything has a docstring."""

import ast
import inspect
import os
import pathlib
import re
import unittest

import touchafm
import touchafm.maps
import touchafm.serve
from touchafm.compat import dtmicroscope

# A unit, or the word for a number that has none.
UNIT = re.compile(r"(?<![\w/])(SI|m|N|J|Pa|Hz|s|K|V|rad|N/m|J/m2|m/V|m/s|1/s|degrees|lines per second)(?![\w/])|parameter|factor|[Qq]uality")
ERROR = re.compile(r"ValueError|DataError|FileError|OSError|Refused")
ERRORS = {"DataError", "FileError"}


def public(names):
    return {name for name in names if not name.startswith("_")}


class Stub(unittest.TestCase):
    def setUp(self):
        with open(os.environ["STUB"], encoding="utf-8") as file:
            self.body = ast.parse(file.read()).body
        classes = {node.name: node for node in self.body if isinstance(node, ast.ClassDef)}
        self.classes = {name: node for name, node in classes.items() if public([name])}
        self.functions = {node.name: node for node in self.body if isinstance(node, ast.FunctionDef)}
        for node in self.body:  # an object that is called as a function
            if isinstance(node, ast.AnnAssign) and public([node.target.id]) and isinstance(node.annotation, ast.Name):
                for each in classes.get(node.annotation.id, node).__dict__.get("body", ()):
                    name = node.target.id if each.name == "__call__" else f"{node.target.id}.{each.name}"
                    self.functions[name] = each

    def member(self, name):
        of, _, inner = name.partition(".")
        return getattr(getattr(touchafm, of), inner) if inner else getattr(touchafm, of)

    def test_has_every_name_of_the_module(self):
        functions = {name for name in self.functions if "." not in name}
        # An import hands a name on only under the same name (PEP 484).
        modules = {each.name for node in self.body if isinstance(node, ast.ImportFrom) and node.level
                   for each in node.names if each.asname == each.name}
        aliases = {node.targets[0].id: ast.unparse(node.value) for node in self.body if isinstance(node, ast.Assign)}
        aliases = {name: value for name, value in aliases.items() if public([name])}
        self.assertEqual(set(self.classes) | functions | set(aliases), set(touchafm.__all__))
        for name, value in aliases.items():
            module, _, member = value.partition(".")
            self.assertIn(module, modules)
            self.assertIs(getattr(touchafm, name), getattr(getattr(touchafm, module), member))

    def test_has_every_member_of_every_class(self):
        for name, node in self.classes.items():
            if name in ERRORS:
                continue
            stubbed = public(each.name for each in node.body if isinstance(each, ast.FunctionDef))
            self.assertEqual(stubbed, public(vars(getattr(touchafm, name))), name)

    def test_has_the_arguments_of_every_function(self):
        for name, node in self.functions.items():
            if "." in name:
                given = [each.arg for each in [*node.args.args, *node.args.kwonlyargs] if each.arg != "self"]
                named = inspect.signature(self.member(name)).parameters
                self.assertEqual([*given, node.args.kwarg.arg], list(named), name)
                continue
            signature = self.member(name).__doc__.splitlines()[0]
            for argument in [*node.args.args, *node.args.kwonlyargs]:
                if argument.arg == "self":
                    continue
                if f"{argument.arg}:" in signature:
                    continue
                self.assertIn("**kwargs", signature, (name, argument.arg))  # a number among others

    def test_says_which_classes_only_functions_make(self):
        for name, node in self.classes.items():
            made = ERRORS | {"Contact", "Curve", "Drive"}
            initialiser = next((each for each in node.body if getattr(each, "name", "") == "__init__"), None)
            never = isinstance(getattr(initialiser, "returns", None), ast.Name) and initialiser.returns.id == "NoReturn"
            self.assertEqual(never, name not in made, name)
            if name not in made:
                with self.assertRaises(TypeError):
                    getattr(touchafm, name)()
            if name not in ERRORS:
                with self.assertRaises(TypeError):
                    type("Other", (getattr(touchafm, name),), {})

    def test_finds_a_docstring_everywhere(self):
        for name in touchafm.__all__:
            member = getattr(touchafm, name)
            self.assertTrue(member.__doc__, name)
            for each in public(vars(member)) if isinstance(member, type) and name not in ERRORS else ():
                self.assertTrue(getattr(member, each).__doc__, (name, each))

    def described(self):
        """Every callable of the stub: its name, its arguments and their types, its docstring without the signature."""
        nodes = [(name, node, self.member(name)) for name, node in self.functions.items()]
        for name, node in self.classes.items():
            for each in (each for each in node.body if isinstance(each, ast.FunctionDef)):
                made = each.name == "__init__" and getattr(each.returns, "id", "") != "NoReturn"
                if made or (public([each.name]) and not any(getattr(of, "id", "") == "property" for of in each.decorator_list)):
                    nodes.append((f"{name}.{each.name}", each, getattr(getattr(touchafm, name), each.name)))
        for name, node, member in nodes:
            types = {each.arg: ast.unparse(each.annotation) for each in [*node.args.args, *node.args.kwonlyargs] if each.annotation}
            yield name, types, "\n".join(member.__doc__.splitlines()[1:])

    def test_gives_the_unit_of_every_number(self):
        for name, node in self.classes.items():
            for each in (each for each in node.body if isinstance(each, ast.FunctionDef)):
                kept = any(getattr(of, "id", "") == "property" for of in each.decorator_list)
                if kept and re.search("float|_Floats", ast.unparse(each.returns)):
                    self.assertRegex(getattr(getattr(touchafm, name), each.name).__doc__, UNIT, (name, each.name))
        for name, types, text in self.described():
            for argument in (argument for argument, of in types.items() if "float" in of):
                self.assertIn(argument, text, (name, argument))
                self.assertRegex(text, UNIT, name)

    def test_gives_the_errors_of_every_function(self):
        cannot_fail = {"materials", "probes", "paper_tables", "Contact.material"}
        for name, _, text in self.described():
            if name not in cannot_fail and not name.endswith(".as_dict"):
                self.assertRegex(text, ERROR, name)

    def test_describes_the_modules_that_are_python(self):
        for module in (touchafm.serve, touchafm.maps, dtmicroscope):
            self.assertRegex(module.__doc__, "SI|in m|Pa", module.__name__)
            for name in module.__all__:
                member = getattr(module, name)
                self.assertTrue(member.__doc__, name)
                functions = {name: member} if inspect.isfunction(member) else {
                    f"{name}.{each}": getattr(member, each) for each in public(vars(member)) if inspect.isfunction(getattr(member, each))}
                for each, function in functions.items():
                    self.assertTrue(function.__doc__, each)
                    types = {key: str(of.annotation) for key, of in inspect.signature(function).parameters.items() if key != "self"}
                    self.assertNotIn(str(inspect.Parameter.empty), types.values(), each)
                    if any("float" in of for of in types.values()):
                        self.assertRegex(function.__doc__, UNIT, each)

    def test_names_the_sources_of_what_is_computed(self):
        documents = pathlib.Path(os.environ["EXAMPLES"]).parent
        for name in ("analyse", "cycle", "fit", "frequency_shift", "generate", "generate_map", "law", "lever", "scan", "sweep", "tapping"):
            named = re.findall(r"docs/(\w+\.md)", getattr(touchafm, name).__doc__)
            self.assertTrue(named, name)
            for document in named:
                self.assertTrue((documents / document).is_file(), (name, document))


if __name__ == "__main__":
    unittest.main()
