#!/usr/bin/env python3
"""Imports of the package as users do them, each in a new interpreter: with the library, with messages, with neither.

  python_import_test.py Imports|ImportsWithMessages|ImportsAfterSetup

CONCAVE_DISTANCE_SPACE names the devel space or installed prefix.
"""
import os
import subprocess
import sys
import unittest

SPACE = os.environ["CONCAVE_DISTANCE_SPACE"]
LIBRARY = "import concave_distance as cd; print(cd.PairTracker(cd.make_box((1, 1, 1)), cd.make_box((1, 1, 1)))"
LIBRARY += ".solve([3.0, 0, 0, 0, 0, 0, 1]).rows['distance'][0]); "
MESSAGES = "from concave_distance.msg import Distances; from concave_distance.srv import GetDistance; "
MESSAGES += "import concave_distance.cfg.ConcaveDistanceConfig; print(Distances()._type, GetDistance._type); "
TYPES = "concave_distance/Distances concave_distance/GetDistance"


def without(*modules):
    """Code after which these modules cannot be imported."""
    return "import sys; sys.modules.update(dict.fromkeys({!r})); ".format(modules)


class Imports(unittest.TestCase):
    def run_code(self, code, setup=None):
        command = [sys.executable, "-B", "-c", code + "print(concave_distance.__file__)"]
        environment = None
        if setup:
            command = ["sh", "-c", '. "$0" && exec "$@"', setup] + command
            environment = {"PATH": "/usr/bin:/bin", "HOME": os.environ.get("HOME", "/")}
        done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=250)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        *lines, file = done.stdout.decode().splitlines()
        self.assertEqual(os.path.realpath(file), os.path.realpath(self.package_file()))
        return lines

    @staticmethod
    def package_file():
        return os.path.join(SPACE, "lib", "python3", "dist-packages", "concave_distance", "__init__.py")

    def test_the_library_needs_nothing_of_ros(self):
        code = without("genpy", "rospy", "roslib", "std_msgs", "geometry_msgs") + LIBRARY + "import concave_distance; "
        self.assertEqual(self.run_code(code), ["2.0"])


class ImportsWithMessages(Imports):
    def test_messages_need_nothing_of_the_library(self):
        code = without("concave_distance._concave_distance", "numpy") + MESSAGES
        self.assertEqual(self.run_code(code), [TYPES])

    def test_both_together_in_any_order(self):
        self.assertEqual(self.run_code(MESSAGES + LIBRARY), [TYPES, "2.0"])
        self.assertEqual(self.run_code(LIBRARY + MESSAGES), ["2.0", TYPES])


class ImportsAfterSetup(ImportsWithMessages):
    def test_the_setup_file_is_enough(self):
        setup = os.path.join(SPACE, "setup.sh")
        self.assertEqual(self.run_code(MESSAGES + LIBRARY, setup), [TYPES, "2.0"])


if __name__ == "__main__":
    unittest.main()
