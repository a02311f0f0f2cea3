#!/usr/bin/env python3
"""MoveIt's planning scene in a distance node: objects, attached objects, allowed contacts, paddings, the octomap.

rosrun concave_distance moveit_bridge.py _distance_node:=concave_distance
Follows monitored_planning_scene, asks get_planning_scene where it starts late or messages are lost, and brings the
distance node to the same scene by apply_scene. What it cannot serve is named in /diagnostics. See doc/moveit_bridge.md.
"""

import os
import sys
import threading
import time

import rospy

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

from bridge_problems import DiagnosticsPublisher, Problems, positive_parameter, prefix_parameter  # noqa: E402
from distance_node_client import DistanceNodeClient  # noqa: E402
from octomap_relay import OctomapRelay  # noqa: E402
from planning_scene_source import PlanningSceneSource  # noqa: E402
from scene_operations import Names, padding_without_body, wanted_bodies, wanted_contacts, wanted_margins  # noqa: E402


class MoveItBridge:
    def __init__(self):
        prefix = prefix_parameter("~prefix", "moveit/")
        self._plane_size = positive_parameter("~plane_size", 20.0)
        check_period = positive_parameter("~check_period", 10.0, or_zero=True)
        self._names = Names(prefix, rospy.get_param("~link_prefix", ""))
        self._problems = Problems()
        self._woken = threading.Event()
        self._octomap = OctomapRelay()
        self._source = PlanningSceneSource(self._problems, self._woken.set, self._octomap.use, check_period)
        self._node = DistanceNodeClient(rospy.get_param("~distance_node", "concave_distance"), prefix, self._problems,
                                        check_period)
        self._diagnostics = DiagnosticsPublisher()

    def run(self):
        next_report = 0.0
        while not rospy.is_shutdown():
            self._woken.clear()
            self._source.update()
            self._node.update()
            if self._source.is_known:
                self._node.bring(self._source.state.changes, self._wanted)
                self._report_refused()
            if time.monotonic() >= next_report:
                next_report = time.monotonic() + 1.0
                self._report()
            self._woken.wait(0.5)

    def _wanted(self, scene, own_margins):
        state = self._source.state
        bodies = wanted_bodies(state, scene, self._names, self._plane_size)
        return (bodies, wanted_contacts(state, self._names, bodies, scene.others),
                wanted_margins(state, self._names, scene, own_margins))

    def _report_refused(self):
        state = self._source.state
        texts = {"planning scene, %s" % name: reason for name, reason in state.refused.items()}
        for link, scale in state.scale.items():
            if scale != 1.0:
                texts["planning scene, link_scale of '%s'" % link] = (
                    "it is %g, but scales are not served: distances are those of the link at its own size" % scale)
        if self._node.scene:
            for link, body in padding_without_body(state, self._names, self._node.scene).items():
                texts["planning scene, link_padding of '%s'" % link] = (
                    "the distance node has no body '%s', so nothing is padded (its names may begin with ~link_prefix, "
                    "and a link without geometry is no body)" % body)
        if self._octomap.problem():
            texts["planning scene, octomap"] = self._octomap.problem()
        self._problems.keep(texts, lambda name: name.startswith("planning scene, "))
        for name, text in texts.items():
            self._problems.set(name, text)

    def _report(self):
        state, scene = self._source.state, self._node.scene
        values = [("scene", state.name), ("planning frame", state.planning_frame),
                  ("messages", self._source.received), ("whole scenes asked for", self._source.asked),
                  ("objects", len(state.world)), ("attached objects", len(state.attached)),
                  ("octomap", self._octomap.text), ("bodies served", len(scene.bodies) if scene else 0),
                  ("contacts allowed", len(scene.off) if scene else 0),
                  ("links with padding", sum(1 for value in state.padding.values() if value > 0.0)),
                  ("revision of the distance node", self._node.revision)]
        problems = self._problems.texts
        message = "%d problems" % len(problems) if problems else "the planning scene is served"
        self._diagnostics.publish(message, problems, values)


def main():
    rospy.init_node("moveit_bridge")
    try:
        bridge = MoveItBridge()
    except ValueError as problem:
        rospy.logfatal("%s", problem)
        return 1
    bridge.run()
    return 0


if __name__ == "__main__":
    sys.exit(main())
