#!/usr/bin/env python3
"""Distances for cob_twist_controller: topics and services of cob_obstacle_distance.

rosrun concave_distance cob_bridge.py __ns:=arm _chain_base_link:=arm_base_link _links:="[arm_5_link]"
Publishes the pairs of registered links as cob_control_msgs/ObstacleDistances in the frame chain_base_link. See
doc/cob_bridge.md.
"""

import os
import sys
import threading
import time

import rospy
import tf2_ros
from concave_distance.msg import Distances, Niches
from concave_distance.srv import ListBodies

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

from bridge_problems import DiagnosticsPublisher, Problems, positive_parameter, prefix_parameter  # noqa: E402
from cob_messages import message_classes, registration_class  # noqa: E402
from message_definitions import WrongDefinition  # noqa: E402
from obstacle_distances import entries, entries_of_niches, links_of  # noqa: E402
from registered_obstacles import RegisteredObstacles  # noqa: E402
from rigid_transforms import transformed  # noqa: E402

_TRANSFORM_TIMEOUT = 0.1  # s
_LIST_PERIOD = 5.0  # s, at which bodies are listed where nothing says that they have changed


class CobBridge:
    def __init__(self):
        self._problems = Problems()
        self._largest_distance = positive_parameter("~largest_distance", 0.5)
        self._every_place = bool(rospy.get_param("~every_place", False))
        self._link_prefix = rospy.get_param("~link_prefix", "")
        # As cob_obstacle_distance: the parameter stands in the namespace of the chain.
        self._base = rospy.get_param("~chain_base_link", rospy.get_param("chain_base_link", ""))
        self._node = rospy.resolve_name(rospy.get_param("~distance_node", "concave_distance"))
        self._list_bodies = rospy.ServiceProxy(self._node + "/list_bodies", ListBodies)
        self._lock = threading.Lock()
        self._links = []    # registered, as the chain calls them
        self._bodies = {}   # what each body is attached to, by name
        self._revision = None
        self._next_list = 0.0
        self._link_of = {}
        self._counts = (0, 0)  # entries and pairs without a distance of the last message
        self._published = 0
        self._subscriber = None
        distances_class, self._distance_class = message_classes()
        self._buffer = tf2_ros.Buffer()
        self._listener = tf2_ros.TransformListener(self._buffer)
        self._publisher = rospy.Publisher("obstacle_distance", distances_class, queue_size=1)
        self._diagnostics = DiagnosticsPublisher()
        self._obstacles = RegisteredObstacles(
            "obstacle_distance/registerObstacle", self._node, prefix_parameter("~obstacle_prefix", "registered/"),
            self._problems, _LIST_PERIOD)
        for link in rospy.get_param("~links", []):
            self._add_link(link)
        made = registration_class()
        self._service = rospy.Service("obstacle_distance/registerLinkOfInterest", made,
                                      lambda request: made._response_class(*self._register(request.data)))

    def _register(self, link):
        if link in self._links:
            return True, "Element %s already registered." % link
        self._update_bodies()
        if not self._bodies:
            return False, "Failed to register element %s! The distance node '%s' has no bodies (yet)" % (link, self._node)
        if self._link_prefix + link not in self._bodies:
            return False, "Failed to register element %s! The distance node has no body '%s' (bodies: %s)" % (
                link, self._link_prefix + link, ", ".join(sorted(self._bodies)[:20]))
        self._add_link(link)
        return True, "Successfully registered element %s." % link

    def _add_link(self, link):
        with self._lock:
            self._links.append(link)
            self._update_links()
            if self._subscriber is None:  # Without a link the distance node has nothing to compute.
                topic, kind = ("niches", Niches) if self._every_place else ("distances", Distances)
                self._subscriber = rospy.Subscriber("%s/%s" % (self._node, topic), kind, self._publish, queue_size=1,
                                                    buff_size=1 << 24, tcp_nodelay=True)

    def _update_links(self):
        self._link_of = links_of(self._bodies, {self._link_prefix + link for link in self._links})

    def _update_bodies(self):
        try:
            answer = self._list_bodies()
        except (rospy.ServiceException, rospy.ROSException) as problem:
            self._problems.set("distance node", "'%s/list_bodies' does not answer; waiting (start the distance node, or "
                               "set ~distance_node): %s" % (self._node, problem), is_expected=True)
            return
        self._problems.clear("distance node")
        with self._lock:
            self._bodies = {body.name: body.attached_to for body in answer.bodies}
            self._base = self._base or answer.reference_frame
            self._update_links()
            names = {self._link_prefix + link for link in self._links}
        missing = sorted(names - set(self._bodies))
        if missing:
            self._problems.set("links", "the distance node has no bodies %s: nothing is published of them" %
                               ", ".join(missing))
        else:
            self._problems.clear("links")

    def run(self):
        next_report = 0.0
        while not rospy.is_shutdown():
            if time.monotonic() >= self._next_list:
                self._next_list = time.monotonic() + _LIST_PERIOD
                self._update_bodies()
            self._obstacles.update()
            if time.monotonic() >= next_report:
                next_report = time.monotonic() + 1.0
                self._report()
            time.sleep(0.05)

    def _publish(self, message):
        revision = getattr(message, "scene_revision", self._revision)
        if revision != self._revision:
            self._revision, self._next_list = revision, 0.0
        with self._lock:
            link_of = self._link_of
        read = entries_of_niches if self._every_place else entries
        found, unknown = read(message.pairs, link_of, self._largest_distance)
        known, answer = {}, self._publisher.data_class()
        for entry in found:
            try:
                answer.distances.append(self._distance(entry, known))
            except tf2_ros.TransformException as problem:
                unknown.append((entry.link, entry.obstacle, str(problem)))
        self._publisher.publish(answer)
        self._published += 1
        self._counts = (len(answer.distances), len(unknown))
        if unknown:
            self._problems.set("pairs without a distance", "; ".join("%s/%s: %s" % one for one in unknown[:5]))
        else:
            self._problems.clear("pairs without a distance")

    def _distance(self, entry, known):
        base_from_frame = self._transform(entry.frame, entry.stamp, known)
        base_from_link = self._transform(entry.link, entry.stamp, known)
        message = self._distance_class()
        message.header.frame_id, message.header.stamp = self._base, entry.stamp
        message.link_of_interest = entry.link[len(self._link_prefix):]
        message.obstacle_id, message.distance = self._obstacles.id_of(entry.obstacle), entry.distance
        for vector, point in ((message.frame_vector, base_from_link[0]),
                              (message.nearest_point_frame_vector, transformed(base_from_frame, entry.point_on_link)),
                              (message.nearest_point_obstacle_vector,
                               transformed(base_from_frame, entry.point_on_obstacle))):
            vector.x, vector.y, vector.z = point
        return message

    def _transform(self, frame, stamp, known):
        """Where a frame is in chain_base_link. known: what this message has looked up already."""
        key = (frame, stamp.to_nsec())
        if key not in known:
            at = self._buffer.lookup_transform(self._base, frame, stamp, rospy.Duration(_TRANSFORM_TIMEOUT)).transform
            known[key] = ((at.translation.x, at.translation.y, at.translation.z),
                          (at.rotation.x, at.rotation.y, at.rotation.z, at.rotation.w))
        return known[key]

    def _report(self):
        problems = dict(self._problems.texts)
        if not self._links:
            problems["links"] = "no link is registered (set ~links, or call registerLinkOfInterest)"
        values = [("chain_base_link", self._base), ("links", ", ".join(self._links)), ("messages", self._published),
                  ("distances in the last message", self._counts[0]),
                  ("pairs without a distance", self._counts[1])]
        self._diagnostics.publish("%d problems" % len(problems) if problems else "distances are published", problems,
                                  values)


def main():
    rospy.init_node("cob_bridge")
    try:
        bridge = CobBridge()
    except (ValueError, WrongDefinition) as problem:
        rospy.logfatal("%s", problem)
        return 1
    bridge.run()
    return 0


if __name__ == "__main__":
    sys.exit(main())
