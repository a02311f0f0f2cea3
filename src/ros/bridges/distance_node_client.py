"""A distance node as the bridge sees it: what it has, by get_scene; changes, by apply_scene; whether it was restarted."""

import dataclasses
import time

import rosgraph
import rospy
from concave_distance.srv import ApplyScene, GetScene

from distance_node_scene import listed_pairs, operation_message, read_scene
from scene_operations import ALLOW_CONTACT, plan

_LARGEST_BATCH = 10000  # operations of one call
_ATTEMPTS = 20


class DistanceNodeClient:
    def __init__(self, name, prefix, problems, check_period):
        self.scene = None  # NodeScene; None: not known
        self.revision = 0
        self.own_margins = {}  # of links that the bridge has padded, before that
        self._prefix = prefix
        self._problems = problems
        self._check_period = check_period
        self._get = rospy.ServiceProxy(name + "/get_scene", GetScene)
        self._apply = rospy.ServiceProxy(name + "/apply_scene", ApplyScene)
        self._uri = None
        self._next_check = 0.0
        self._next_attempt = 0.0
        self._refused = {}  # what was refused, by owner
        self._unwatched = set()  # pairs that may touch and that the node does not watch anyway
        self._brought = None  # `changes` of what was wanted when nothing was left to do; None: since then it has changed

    def update(self):
        """Looks whether the node is there and the same, and reads its scene where that is not known or due."""
        now = time.monotonic()
        uri = self._look_up()
        if uri != self._uri:
            self._uri, self.scene, self._brought = uri, None, None
            self.own_margins.clear()
            self._refused.clear()
            self._unwatched.clear()
        if uri is None or (self.scene is None and now < self._next_attempt):
            return
        if self.scene is None or (self._check_period and now >= self._next_check):
            self._next_check = now + self._check_period
            self._next_attempt = now + 1.0
            self._refused.clear()
            self._read()

    def _look_up(self):
        name = self._apply.resolved_name
        try:
            uri = rosgraph.Master(rospy.get_name()).lookupService(name)
        except Exception:  # The master's client has several.
            self._problems.set("distance node", "nobody offers '%s'; waiting (start the distance node, or set "
                               "~distance_node)" % name, is_expected=True)
            return None
        return uri

    def _read(self):
        known = self.scene
        try:
            answer = self._get(with_meshes=known is None)
        except (rospy.ServiceException, rospy.ROSException) as problem:
            self._lose("get_scene does not answer: %s" % problem)
            return
        if not answer.success:
            self._lose("get_scene: %s" % answer.message)
            return
        scene = read_scene(answer, self._prefix)
        on, off = listed_pairs(answer)
        if known is None:
            # The bridge owns, of pairs that were off before, those of its bodies that nothing holds.
            free = {name for name, body in scene.bodies.items() if not body.link}
            scene.off = frozenset(pair for pair in off if free & set(pair))
        else:
            scene.off = frozenset(pair for pair in known.off if pair not in on)
            if not set(scene.bodies) <= set(known.bodies):
                self.scene = None  # A body that this bridge has not added: its meshes are needed.
                self._next_attempt = 0.0
                return
            for name, body in scene.bodies.items():
                scene.bodies[name] = _remembered(known.bodies[name], body)
        if answer.revision != self.revision:
            self._unwatched.clear()  # Somebody else has changed the scene.
        self.scene, self.revision, self._brought = scene, answer.revision, None
        self._problems.clear("distance node")

    def _lose(self, text):
        self.scene = self._brought = None
        self._next_attempt = time.monotonic() + 1.0
        self._problems.set("distance node", text + "; trying again")

    def bring(self, changes, wanted_of):
        """Brings the node to what is wanted. What it refuses is left out by owner and becomes a problem.

        changes: a number that is another one when something else is wanted.
        wanted_of: from a NodeScene and margins to bodies, contacts and margins.
        """
        if self._brought == changes:
            return
        for _ in range(_ATTEMPTS):
            if self.scene is None:
                return
            bodies, contacts, margins = wanted_of(self.scene, self.own_margins)
            self._forget_changed(bodies)
            operations, after = plan(bodies, contacts - self._unwatched, margins, self.scene, frozenset(self._refused))
            if not operations:
                self._problems.keep(self._refused, _is_owner)
                self._brought = changes
                return
            if not self._send(operations, after, bodies):
                return

    def _forget_changed(self, bodies):
        """What was refused is tried again when something else is wanted."""
        wanted = {body.owner: body for body in bodies.values()}
        for owner, body in list(self._refused.items()):
            if body is not None and wanted.get(owner) != body:
                del self._refused[owner]

    def _send(self, operations, after, bodies):
        """Returns whether to go on: everything was applied, or what was refused is known."""
        wanted = {body.owner: body for body in bodies.values()}
        for begin in range(0, len(operations), _LARGEST_BATCH):
            batch = operations[begin:begin + _LARGEST_BATCH]
            try:
                answer = self._apply(operations=[operation_message(one) for one in batch])
            except (rospy.ServiceException, rospy.ROSException) as problem:
                self._lose("apply_scene does not answer: %s" % problem)
                return False
            if not answer.success:
                if begin:
                    self.scene = self._brought = None  # Some batches were applied.
                for fault in answer.faults:
                    self._note_fault(batch[fault.operation], fault.message, wanted)
                if not answer.faults:
                    self._lose("apply_scene: %s" % answer.message)
                return bool(answer.faults)
            self.revision = answer.revision
            if answer.message:
                rospy.loginfo("apply_scene remarks: %.500s", answer.message)
        changed = {one.body for one in operations if one.kind != ALLOW_CONTACT}
        self._unwatched = {pair for pair in self._unwatched if not changed & set(pair)}
        self.scene = after
        return True

    def _note_fault(self, operation, text, wanted):
        if operation.kind == ALLOW_CONTACT and "not a watched pair" in text:
            self._unwatched.add(tuple(sorted((operation.body, operation.other))))
            return
        self._refused[operation.owner] = wanted.get(operation.owner)
        self._problems.set(operation.owner, "refused: %s" % text)


def _remembered(known, body):
    """A body as the node has it, with what only the bridge knows: its shapes, and on which frame it was put where the
    node has that of what holds it now."""
    same_place = known.link == body.link and (known.is_left_behind or body.link and known.frame != body.link)
    place = known if same_place else body
    return dataclasses.replace(known, frame=place.frame, pose=place.pose, link=body.link, touch=body.touch,
                               margin=body.margin, is_left_behind=known.is_left_behind and not body.link)


def _is_owner(name):
    return name.startswith(("object ", "attached object ", "removal ", "allowed contact ", "padding "))
