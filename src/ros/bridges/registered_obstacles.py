"""Obstacles that publishers of cob_obstacle_distance register: moveit_msgs/CollisionObject, by the publisher's definition.

In: messages of a topic. Out: bodies of the distance node whose names begin with a prefix.
"""

import collections

import rospy

from distance_node_client import DistanceNodeClient
from message_definitions import WrongDefinition, classes_from, field_faults
from planning_scene_messages import OBJECT, NEEDED, WANTED, SceneReader
from planning_scene_state import PlanningSceneState
from planning_scene_values import SceneMessage
from scene_operations import Names, wanted_bodies

_PLANE_SIZE = 20.0  # m


class RegisteredObstacles:
    def __init__(self, topic, distance_node, prefix, problems, check_period):
        self._state = PlanningSceneState()
        self._names = Names(prefix)
        self._problems = problems
        self._node = DistanceNodeClient(distance_node, prefix, problems, check_period)
        self._queue = collections.deque(maxlen=1000)
        self._ids = {}  # of obstacles by their bodies' names
        self._header = self._class = self._reader = None
        self._subscriber = rospy.Subscriber(topic, rospy.AnyMsg, self._queue.append, buff_size=1 << 24)

    def id_of(self, body):
        """What an obstacle was registered as, or the body's name."""
        return self._ids.get(body, body)

    def update(self):
        while self._queue:
            self._use(self._queue.popleft())
        if self._state.changes == 0:
            return
        self._node.update()
        self._node.bring(self._state.changes, lambda scene, own: (
            wanted_bodies(self._state, scene, self._names, _PLANE_SIZE), set(), {}))
        texts = {"registered " + name: text for name, text in self._state.refused.items()}
        self._problems.keep(texts, lambda name: name.startswith("registered "))
        for name, text in texts.items():
            self._problems.set(name, text)

    def _use(self, message):
        header = message._connection_header
        if header is not self._header:
            self._header, self._class = header, None
            try:
                if header.get("type") != OBJECT:
                    raise WrongDefinition("it is a %s, not a %s" % (header.get("type"), OBJECT))
                classes = classes_from(OBJECT, header.get("message_definition", ""), header.get("md5sum"))
                needed = field_faults(classes, NEEDED)
                if needed:
                    raise WrongDefinition("; ".join(text for _, _, text in needed))
            except WrongDefinition as problem:
                self._problems.set("registerObstacle", "a message from %s is of no use: %s" % (
                    header.get("callerid"), problem))
                return
            self._class, self._reader = classes[OBJECT], SceneReader(field_faults(classes, WANTED))
            self._problems.clear("registerObstacle")
        if self._class is None:
            return
        try:
            item = self._reader.read_object(self._class().deserialize(message._buff))
        except Exception as problem:  # Whatever a broken message makes the generated code raise.
            self._problems.set("registerObstacle", "a message from %s cannot be read: %s" % (
                header.get("callerid"), problem))
            return
        self._state.use(SceneMessage(objects=(item,)))
        self._ids = {self._names.body(name): name for name in self._state.world}
