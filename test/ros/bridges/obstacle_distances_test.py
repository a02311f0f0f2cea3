#!/usr/bin/env python3
"""Entries for cob_twist_controller from pairs of a distance node, and the classes of its messages."""
import io
import math
import types
import unittest

import plain_scene  # noqa: F401 (finds the bridge's modules)
from cob_messages import message_classes, registration_class
from message_definitions import WrongDefinition
from obstacle_distances import entries, entries_of_niches, links_of


def place(x):
    return types.SimpleNamespace(x=x, y=0.0, z=0.0)


def pair(a, b, distance=0.25, code=0, lower_bound=None, **fields):
    has = {"has_distance": True, "has_points": True}
    has.update(fields)
    return types.SimpleNamespace(
        body_a=a, body_b=b, distance=distance, point_a=place(1.0), point_b=place(2.0),
        has_lower_bound=lower_bound is not None, lower_bound=lower_bound,
        status=types.SimpleNamespace(code=code, message="" if code == 0 else "a reason"),
        header=types.SimpleNamespace(frame_id="world", stamp=7.0), **has)


def shown(found):
    return [(one.link, one.obstacle, one.distance, one.point_on_link[0], one.point_on_obstacle[0]) for one in found]


class Entries(unittest.TestCase):
    def test_a_link_may_be_either_body(self):
        found, _ = entries([pair("arm", "box"), pair("box", "arm"), pair("box", "table")], {"arm": "arm"}, 1.0)
        self.assertEqual(shown(found), [("arm", "box", 0.25, 1.0, 2.0), ("arm", "box", 0.25, 2.0, 1.0)])
        self.assertEqual((found[0].frame, found[0].stamp), ("world", 7.0))

    def test_two_links_are_each_others_obstacle(self):
        found, _ = entries([pair("arm", "hand")], {"arm": "arm", "hand": "hand"}, 1.0)
        self.assertEqual(shown(found), [("arm", "hand", 0.25, 1.0, 2.0), ("hand", "arm", 0.25, 2.0, 1.0)])

    def test_what_is_attached_is_the_link(self):
        bodies = {"arm": "", "tool": "arm", "cup": "tool", "box": "", "ring": "ring"}
        link_of = links_of(bodies, {"arm"})
        self.assertEqual(link_of, {"arm": "arm", "tool": "arm", "cup": "arm"})
        found, _ = entries([pair("cup", "box"), pair("cup", "arm")], link_of, 1.0)
        self.assertEqual(shown(found), [("arm", "box", 0.25, 1.0, 2.0)])

    def test_what_is_not_proven_counts_with_its_lower_bound(self):
        for code, distance in ((0, 0.25), (3, 0.125), (10, 0.125), (11, 0.125), (1, 0.25)):
            found, _ = entries([pair("arm", "box", code=code, lower_bound=0.125)], {"arm": "arm"}, 1.0)
            self.assertEqual(found[0].distance, distance, code)

    def test_pairs_without_a_distance_are_named(self):
        found, unknown = entries([pair("arm", "box", code=5, has_distance=False), pair("arm", "ball", has_points=False),
                                  pair("box", "ball", has_distance=False)], {"arm": "arm"}, 1.0)
        self.assertEqual((found, unknown), ([], [("arm", "box", "a reason"), ("arm", "ball", "status 0")]))

    def test_far_pairs_and_points_that_are_no_numbers_are_left_out(self):
        odd = pair("arm", "odd")
        odd.point_b = place(math.nan)
        self.assertEqual(entries([pair("arm", "box", 1.5), odd], {"arm": "arm"}, 1.0), ([], []))

    def test_every_niche_has_an_entry(self):
        def niche(distance):
            return types.SimpleNamespace(distance=distance, point_a=place(3.0), point_b=place(4.0))
        both = types.SimpleNamespace(nearest=pair("box", "arm"), niches=[niche(0.25), niche(0.5), niche(2.0)])
        found, _ = entries_of_niches([both], {"arm": "arm"}, 1.0)
        self.assertEqual(shown(found), [("arm", "box", 0.25, 2.0, 1.0), ("arm", "box", 0.5, 4.0, 3.0)])


class Classes(unittest.TestCase):
    @staticmethod
    def missing(name):
        raise ImportError(name)

    def test_md5sums_are_those_of_cob(self):
        distances, distance = message_classes(self.missing)
        self.assertEqual((distances._type, distances._md5sum),
                         ("cob_control_msgs/ObstacleDistances", "58f6b8a2511da851588441c695d51807"))
        self.assertEqual(distance._type, "cob_control_msgs/ObstacleDistance")
        service = registration_class(self.missing)
        self.assertEqual((service._type, service._md5sum), ("cob_srvs/SetString", "546971982e3fbbd5a41e60fb6432e357"))

    def test_requests_and_answers_go_over_the_wire(self):
        service = registration_class(self.missing)
        for message in (service._request_class("link \u00e4"), service._response_class(True, "done")):
            buffer = io.BytesIO()
            message.serialize(buffer)
            read = type(message)().deserialize(buffer.getvalue())
            self.assertEqual([getattr(read, slot) for slot in read.__slots__],
                             [getattr(message, slot) for slot in message.__slots__])

    def test_installed_classes_are_used_unless_their_fields_differ(self):
        made = message_classes(self.missing)
        module = types.SimpleNamespace(ObstacleDistances=made[0], ObstacleDistance=made[1])
        self.assertIs(message_classes(lambda name: module)[0], made[0])
        odd = type("ObstacleDistance", (), {"__slots__": ["header", "link_of_interest", "distance"],
                                            "_slot_types": ["std_msgs/Header", "string", "float32"]})
        with self.assertRaises(WrongDefinition) as caught:
            message_classes(lambda name: types.SimpleNamespace(ObstacleDistances=made[0], ObstacleDistance=odd))
        self.assertIn("no field 'obstacle_id'", str(caught.exception))
        self.assertIn("'distance' as float32, not float64", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
