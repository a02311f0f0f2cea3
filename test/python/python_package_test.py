#!/usr/bin/env python3
"""What the package says of itself: names, type hints and docstrings beside what the extension module has."""
import ast
import importlib
import inspect
import os
import subprocess
import sys
import unittest

import concave_distance as cd

FOLDER = os.path.dirname(cd.__file__)


def hints():
    with open(os.path.join(FOLDER, "__init__.pyi"), encoding="utf-8") as file:
        tree = ast.parse(file.read())
    return {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}


def members(node):
    return {part.name for part in node.body if isinstance(part, ast.FunctionDef)}


class Package(unittest.TestCase):
    def test_the_library_is_loaded_at_its_first_use_only(self):
        code = ("import sys, concave_distance; seen = [name for name in sys.modules if '_concave_distance' in name]; "
                "concave_distance.Status; print(seen, 'concave_distance._concave_distance' in sys.modules, "
                "hasattr(concave_distance, 'nothing'))")
        printed = subprocess.run([sys.executable, "-c", code], check=True, stdout=subprocess.PIPE).stdout.decode()
        self.assertEqual(printed.split(), ["[]", "True", "False"])

    def test_the_version_is_that_of_the_extension_module(self):
        self.assertRegex(cd.__version__, r"^[0-9]+\.[0-9]+\.[0-9]+$")
        self.assertEqual(cd.__version__, importlib.import_module("concave_distance._concave_distance").__version__)

    def test_every_name_has_hints_and_documentation(self):
        extension = importlib.import_module("concave_distance._concave_distance")
        public = {name for name in dir(extension) if not name.startswith("_")}
        self.assertEqual(public, set(cd.__all__))
        self.assertEqual(set(hints()), set(cd.__all__))
        self.assertTrue(os.path.exists(os.path.join(FOLDER, "py.typed")))
        for name in cd.__all__:
            self.assertTrue(inspect.getdoc(getattr(cd, name)), name)

    def test_hints_of_classes_have_their_members(self):
        for name, node in hints().items():
            thing = getattr(cd, name)
            if not isinstance(node, ast.ClassDef) or issubclass(thing, (int, Exception)):
                continue
            own = {key for key in vars(thing) if not key.startswith("_")}
            self.assertEqual(own, {key for key in members(node) if not key.startswith("_")}, name)

    def test_hints_of_enumerations_have_their_values(self):
        for name, node in hints().items():
            thing = getattr(cd, name)
            if isinstance(node, ast.ClassDef) and issubclass(thing, int):
                values = {part.targets[0].id: part.value.value for part in node.body if isinstance(part, ast.Assign)}
                self.assertEqual(values, {value.name: int(value) for value in thing})

    def test_hints_of_a_pair_have_every_parameter(self):
        made = next(part for part in hints()["PairTracker"].body if getattr(part, "name", "") == "__init__")
        keywords = [argument.arg for argument in made.args.kwonlyargs]
        self.assertEqual(keywords, ["name"] + [parameter["name"] for parameter in cd.parameters()])
        box = cd.make_box((1, 1, 1))
        defaults = {parameter["name"]: parameter["default"] for parameter in cd.parameters()}
        self.assertEqual(cd.PairTracker(box, box).parameters, defaults)
        self.assertEqual(cd.PairTracker(box, box, **defaults).parameters, defaults)


if __name__ == "__main__":
    unittest.main()
