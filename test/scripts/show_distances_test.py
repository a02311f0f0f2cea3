#!/usr/bin/env python3
"""What show_distances.py prints of messages, without a master: rospy and the messages are stood in for."""
import contextlib
import io
import os
import sys
import types
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
sys.dont_write_bytecode = True


class Seconds(float):
    """A time or a duration of rospy."""

    def __sub__(self, other):
        return Seconds(float(self) - float(other))

    def to_sec(self):
        return float(self)


messages = types.ModuleType("concave_distance.msg")
messages.NicheChange = types.SimpleNamespace(BIRTH=0, DEATH=1, MERGE=2)
messages.Niches = object
messages.PairStatus = types.SimpleNamespace(PENETRATING=2)
sys.modules.update({"rospy": types.ModuleType("rospy"), "concave_distance": types.ModuleType("concave_distance"),
                    "concave_distance.msg": messages})
import show_distances  # noqa: E402


def message(stamp, *distances):
    pairs = [types.SimpleNamespace(changes=[], niches=[], nearest=types.SimpleNamespace(
        pair="a/b", has_distance=1, distance=distance, status=types.SimpleNamespace(code=0)))
        for distance in distances]
    return types.SimpleNamespace(header=types.SimpleNamespace(stamp=Seconds(stamp)), pairs=pairs)


class ShowDistances(unittest.TestCase):
    def beginnings(self, *shown):
        printer = show_distances.Printer(2.0, 1)
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            for one in shown:
                printer.show(one)
        return [line.split(" s ")[0].strip() for line in output.getvalue().splitlines()]

    def test_times_are_seconds_since_the_first_message(self):
        self.assertEqual(self.beginnings(message(1700075452.92, 0.5), message(1700075453.42, 0.5),
                                         message(1700175452.92, 0.5)), ["0.00", "0.50", "100000.00"])

    def test_a_clock_that_jumps_back_starts_again(self):
        self.assertEqual(self.beginnings(message(900.0, 0.5), message(10.0, 0.5), message(12.0, 0.5)),
                         ["0.00", "0.00", "2.00"])


if __name__ == "__main__":
    unittest.main()
