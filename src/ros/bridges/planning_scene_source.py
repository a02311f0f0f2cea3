"""Follows monitored_planning_scene, and asks get_planning_scene for the whole scene where messages may be missing.

The classes of the messages come from the definition that the publisher sends when it connects; nothing of MoveIt is
needed. Kept: the state, the messages that wait, the class of the last connection.
"""

import collections
import dataclasses
import threading
import time

import rosgraph
import rospy

import octomap_relay
from message_definitions import WrongDefinition, classes_from, field_faults, planning_scene_service
from planning_scene_messages import NEEDED, SCENE, WANTED, SceneReader
from planning_scene_state import PlanningSceneState

TOPIC, SERVICE = "monitored_planning_scene", "get_planning_scene"
_LONGEST_QUEUE = 1000
# All of PlanningSceneComponents but joint values (2); the octomap (32) is large, so that it is asked for once.
_COMPONENTS, _OCTOMAP = 1023 & ~2 & ~32, 32


class PlanningSceneSource:
    def __init__(self, problems, wake, use_octomap, check_period):
        """wake: called from the thread of a connection when a message waits. use_octomap: called with each octomap and
        the class of its inner message. check_period: s, 0: ask only when messages may be missing."""
        self.state = PlanningSceneState()
        self.received = self.asked = 0
        self.is_known = False
        self._problems = problems
        self._wake = wake
        self._use_octomap = use_octomap
        self._check_period = check_period
        self._lock = threading.Lock()
        self._queue = collections.deque()
        self._overflowed = False
        self._header = None  # of the newest connection
        self._classes = self._reader = None
        self._knows_octomap = False
        self._next_question = None  # monotonic time; None: no connection yet
        self._subscriber = rospy.Subscriber(TOPIC, rospy.AnyMsg, self._receive, buff_size=1 << 24, tcp_nodelay=True)

    def _receive(self, message):
        with self._lock:
            if len(self._queue) >= _LONGEST_QUEUE:
                self._queue.clear()
                self._overflowed = True
            self._queue.append((message._connection_header, message._buff))
        self._wake()

    def update(self):
        """Takes over what has come, then asks for the whole scene where that is due."""
        self._look_at_connections()
        with self._lock:
            waiting, self._queue = self._queue, collections.deque()
            overflowed, self._overflowed = self._overflowed, False
        if overflowed:
            self._ask_soon()
        for header, text in waiting:
            self._use(header, text)
        if self._next_question is not None and self._classes and time.monotonic() >= self._next_question:
            self._ask()

    def _ask_soon(self):
        self._next_question = time.monotonic()

    def _look_at_connections(self):
        # rospy has the definition from the moment of connecting, not only with the first message.
        headers = [one.header for one in list(getattr(self._subscriber.impl, "connections", ()))
                   if getattr(one, "header", None)]
        if not headers:
            self._problems.set(TOPIC, "nobody publishes '%s'; waiting (start MoveIt's move_group, or remap the topic)" %
                               self._subscriber.resolved_name, is_expected=True)
            return
        self._problems.clear(TOPIC)
        for header in headers:
            self._take_definition(header)

    def _take_definition(self, header):
        if header is self._header or "message_definition" not in header:
            return
        self._header, self._classes, self._reader = header, None, None
        caller = header.get("callerid", "a publisher")
        try:
            if header.get("type") != SCENE:
                raise WrongDefinition("'%s' is of type %s, not %s; remap the topic" % (
                    self._subscriber.resolved_name, header.get("type"), SCENE))
            classes = classes_from(SCENE, header["message_definition"], header.get("md5sum"))
            needed = field_faults(classes, NEEDED)
            if needed:
                raise WrongDefinition("; ".join(text for _, _, text in needed))
        except WrongDefinition as problem:
            self._problems.set("definition", "from %s: %s" % (caller, problem))
            return
        self._problems.clear("definition")
        faults = field_faults(classes, WANTED)
        self._problems.keep([_field_name(one) for one in faults], lambda name: name.startswith("field "))
        for one in faults:
            self._problems.set(_field_name(one), "from %s: %s; the rest is served" % (caller, one[2]))
        self._classes, self._reader = classes, SceneReader(faults)
        self._knows_octomap = False
        self._ask_soon()  # What was there before this connection is not known.

    def _use(self, header, text):
        self._take_definition(header)
        if header is not self._header or not self._classes:
            return
        self.received += 1
        try:
            message = self._classes[SCENE]().deserialize(text)
            value = self._reader.read(message)
        except Exception as problem:  # Whatever a broken message makes the generated code raise.
            self._problems.set("message", "one from %s cannot be read: %s; the whole scene is asked for" % (
                header.get("callerid"), problem))
            self._ask_soon()
            return
        self._take_over(value, message)
        self.is_known = self.is_known or not value.is_diff

    def _take_over(self, value, message):
        self.state.use(value)
        if value.octomap is not None or not value.is_diff and self._reader.has_octomap:
            self._use_octomap(message.world.octomap, self._classes[octomap_relay.TYPE])

    def _ask(self):
        name = rospy.resolve_name(SERVICE)
        period = self._check_period or 10.0
        try:
            rosgraph.Master(rospy.get_name()).lookupService(name)
        except Exception:  # The master's client has several.
            self._problems.set(SERVICE, "nobody offers '%s': what the scene had before '%s' connected is not known; "
                               "waiting" % (name, self._subscriber.resolved_name), is_expected=True)
            self.is_known = self.is_known or self.received > 0
            self._next_question = time.monotonic() + 1.0
            return
        try:
            # Messages that come from now on wait, and are taken over after the answer.
            ask = rospy.ServiceProxy(name, planning_scene_service(self._classes[SCENE]))
            scene = ask(_COMPONENTS if self._knows_octomap else _COMPONENTS | _OCTOMAP).scene
            value = dataclasses.replace(self._reader.read(scene), is_diff=False)
        except Exception as problem:
            self._problems.set(SERVICE, "'%s' does not answer: %s; asking again in %g s (topic and service have to be "
                               "of one version of MoveIt)" % (name, problem, period))
            self._next_question = time.monotonic() + period
            return
        if self._knows_octomap:
            self.state.use(dataclasses.replace(value, octomap=self.state.octomap))
        else:
            self._take_over(value, scene)
        self.asked += 1
        self.is_known = self._knows_octomap = True
        self._problems.clear(SERVICE)
        self._problems.clear("message")
        self._next_question = time.monotonic() + self._check_period if self._check_period else None


def _field_name(fault):
    return "field %s.%s" % fault[:2]
