#!/usr/bin/env python3
"""What a soak's rows have to show, and what its listeners take for a lost id, without a master: rospy and the messages are
stood in for."""
import os
import sys
import types
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts", "soak"))
sys.dont_write_bytecode = True

BIRTH, DEATH = 0, 1


class Anything(types.ModuleType):
    def __getattr__(self, name):
        return object


messages = types.ModuleType("concave_distance.msg")
messages.NicheChange = types.SimpleNamespace(BIRTH=BIRTH, DEATH=DEATH, MERGE=2)
messages.PairNiches = object
sys.modules.update({name: Anything(name) for name in (
    "rospy", "concave_distance", "diagnostic_msgs", "diagnostic_msgs.msg", "rosgraph_msgs", "rosgraph_msgs.msg")})
sys.modules["concave_distance.msg"] = messages
from listeners import Ids  # noqa: E402
from verdict import verdict  # noqa: E402

GOOD = {"node_mb": "500.0", "bridge_mb": "80.0", "guard_mb": "20.0", "cycles": 3000, "late": 1, "failed": 0,
        "messages": 3000, "compared": 50, "different": 0, "largest_difference": "1e-15", "lists": 2, "lists_different": 0,
        "failed_comparisons": 0, "ids": 100, "ids_lost": 0, "edits": 60, "refused": 0, "nonsense": 9, "taken": 0, "lost": 0,
        "errors": 0, "restarts": 0, "bags_mb": "900"}


def failed(rows):
    return [line.split(":")[0] for line, is_right in verdict(rows) if not is_right]


def changed(count, place, **fields):
    rows = [dict(GOOD) for _ in range(count)]
    rows[place].update(fields)
    return rows


class Verdict(unittest.TestCase):
    def test_a_good_run(self):
        self.assertEqual(failed([GOOD] * 180), [])
        self.assertEqual(failed([GOOD]), [])

    def test_each_demand(self):
        for demand, fields in (("answers", {"different": 1}), ("lists of niches", {"lists_different": 1}),
                               ("ids", {"ids_lost": 1}), ("requests", {"refused": 1}), ("requests", {"taken": 1}),
                               ("late", {"failed": 1}), ("late", {"late": 1000}), ("messages", {"messages": 0}),
                               ("bags", {"bags_mb": "2000"}), ("errors in rosout", {"errors": 1})):
            self.assertEqual(failed(changed(180, 90, **fields)), [demand], fields)
        self.assertEqual(failed(changed(180, -1, restarts=1)), ["errors in rosout"])
        self.assertEqual(failed([dict(GOOD, compared=0)] * 180), ["answers"])
        self.assertEqual(failed([dict(GOOD, failed_comparisons=1)] * 40 + [GOOD] * 140), ["comparisons without a sample"])

    def test_memory_is_judged_after_the_first_third(self):
        for program in ("node", "bridge", "guard"):
            more = {program + "_mb": "%.1f" % (1.06 * float(GOOD[program + "_mb"]))}
            self.assertEqual(failed(changed(180, 179, **more)), ["memory of the " + program])
            self.assertEqual(failed(changed(180, 119, **more)), [], "it was as much before")
            self.assertEqual(failed(changed(180, 10, **more)), [])
            self.assertEqual(failed(changed(3, 2, **more)), [], "a short run")
            self.assertEqual(failed([dict(GOOD, **{program + "_mb": "0.0"})] * 180), ["memory of the " + program])

    def test_late_up_to_a_thousandth(self):
        self.assertEqual(failed([dict(GOOD, late=3)] * 180), [])
        self.assertEqual(failed([dict(GOOD, late=4)] * 180), ["late"])


def niche(number, x=0.0):
    return types.SimpleNamespace(id=number, point_a=types.SimpleNamespace(x=9.0 * number, y=0.0, z=0.0),
                                 point_b=types.SimpleNamespace(x=x, y=0.0, z=0.0))


def message(cycle, niches, born=(), gone=()):
    changes = [types.SimpleNamespace(kind=BIRTH, id=number) for number in born]
    changes += [types.SimpleNamespace(kind=DEATH, id=number) for number in gone]
    return types.SimpleNamespace(cycle=cycle, niches=niches, changes=changes)


class LostIds(unittest.TestCase):
    @staticmethod
    def follow(*followed):
        ids = Ids("b")
        for one in followed:
            ids.follow(one)
        return ids.take()

    def test_niches_that_live_and_die(self):
        self.assertEqual(self.follow(message(1, [niche(1)], born=[1]), message(2, [niche(1, 0.01), niche(2, 1.0)], born=[2]),
                                     message(3, [niche(2, 1.0)], gone=[1])), (2, 0))

    def test_an_id_after_its_end(self):
        self.assertEqual(self.follow(message(1, [niche(1)]), message(2, [], gone=[1]), message(3, [niche(1)])), (0, 1))

    def test_a_niche_that_gets_another_id(self):
        self.assertEqual(self.follow(message(1, [niche(1)]), message(2, [niche(2, 1e-4)], born=[2], gone=[1])), (1, 1))
        self.assertEqual(self.follow(message(1, [niche(1)]), message(2, [niche(2, 0.1)], born=[2], gone=[1])), (1, 0))
        self.assertEqual(self.follow(message(1, [niche(1)]), message(3, [niche(2, 1e-4)], born=[2], gone=[1])), (1, 0),
                         "a message was lost between")


if __name__ == "__main__":
    unittest.main()
