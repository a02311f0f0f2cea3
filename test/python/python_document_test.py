#!/usr/bin/env python3
"""Runs what doc/python.md shows, block after block, and lets the examples be as short as it says."""
import os
import re
import tempfile
import unittest

PACKAGE = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
os.environ["MPLBACKEND"] = "Agg"


def text_of(*place):
    with open(os.path.join(PACKAGE, *place), encoding="utf-8") as file:
        return file.read()


class Page(unittest.TestCase):
    def test_its_blocks_run_one_after_the_other(self):
        blocks = re.findall(r"```python\n(.*?)```", text_of("doc", "python.md"), re.DOTALL)
        self.assertGreater(len(blocks), 3)
        self.assertLessEqual(len(blocks[0].splitlines()), 10)
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            for name in ("meshes", "urdf"):
                os.symlink(os.path.join(PACKAGE, name), os.path.join(folder, name))
            os.chdir(folder)
            try:
                names = {}
                for block in blocks:
                    exec(compile(block, "doc/python.md", "exec"), names)
                self.assertTrue(os.path.exists("niches.png"))
            finally:
                os.chdir(before)
        self.assertEqual(names["made"].jacobian.shape, (32, 7))
        self.assertTrue(names["used"].any())

    def test_a_filter_takes_twenty_lines(self):
        code = text_of("examples", "rows_of_robot.py").split('"""')[2]
        lines = [line for line in code.splitlines() if line.strip() and not line.strip().startswith("#")]
        self.assertLessEqual(len(lines), 20)


if __name__ == "__main__":
    unittest.main()
