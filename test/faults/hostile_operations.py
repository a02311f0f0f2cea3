"""Batches of operations (apply_scene) and streams of moves (scene_moves) that the node must refuse, or bear."""

import itertools
import struct
import threading
import time

import ros_wire
import rospy
from attacks import Failed, Group, expect, shortened
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Point, Pose
from request_checks import LONGEST_MESSAGE, MEGABYTE, call
from shape_msgs.msg import Mesh, MeshTriangle, SolidPrimitive

group = Group("operations", {})
counter = itertools.count()
NAN, INF = float("nan"), float("inf")
ADD, MOVE, REMOVE, ATTACH, DETACH, ALLOW, DISALLOW, MARGIN = range(8)


def pose_at(x=0.0, y=0.0, z=0.0):
    pose = Pose()
    pose.position.x, pose.position.y, pose.position.z = x, y, z
    return pose


def operation(arena, kind, body, other="", **fields):
    message = arena.messages.SceneOperation(operation=kind, body=body, other=other)
    for name, value in fields.items():
        setattr(message, name, value)
    return message


def box(arena, body, size=0.1, **fields):
    fields.setdefault("frame_id", "world")
    fields.setdefault("pose", pose_at(0.0, 40.0))
    fields.setdefault("primitives", [SolidPrimitive(type=SolidPrimitive.BOX, dimensions=[size] * 3)])
    return operation(arena, ADD, body, **fields)


def tetrahedron(triangles=((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))):
    return Mesh(triangles=[MeshTriangle(vertex_indices=list(corners)) for corners in triangles],
                vertices=[Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)])


def mesh(arena, body, shape, **fields):
    return box(arena, body, primitives=[], meshes=[shape], **fields)


def apply(arena, operations, timeout=20.0):
    return call(arena, "apply_scene", timeout, operations=operations)


def state(arena):
    """The bodies and pairs that list_bodies has."""
    listed = arena.node.list_bodies()
    return ([(body.name, body.frame_id, str(body.pose), body.attached_to) for body in listed.bodies],
            [(pair.name, pair.enabled) for pair in listed.pairs])


def require_faults(response, faults):
    """Refused, with these faults alone: places in the batch, each with words that its message has."""
    expect(not response.success, "it was accepted")
    expect(response.message, "it was refused without a message")
    expect(len(response.message) <= LONGEST_MESSAGE, "the message has %d characters" % len(response.message))
    named = {fault.operation: fault.message for fault in response.faults}
    expect(sorted(named) == sorted(faults), "faults of operations %s instead of %s: %s" % (
        sorted(named)[:20], sorted(faults)[:20], shortened(response.message)))
    for place, word in faults.items():
        expect(word in named[place], "the fault does not name '%s': %s" % (word, shortened(named[place])))
        expect(len(named[place]) <= LONGEST_MESSAGE, "a fault has %d characters" % len(named[place]))


def refused(arena, operations, faults):
    """Nothing is changed by a batch with these faults."""
    before = state(arena)
    require_faults(apply(arena, operations), faults)
    expect(state(arena) == before, "list_bodies has changed")


def refuse(label, make, word, fast=False):
    """The last operation of a batch is wrong, and the fault has the word."""
    def act(arena):
        operations = make(arena)
        refused(arena, operations, {len(operations) - 1: word})
    group.add(label, act, fast=fast)


def held(arena, name, *then):
    """A box that is added and attached to box_a in the same batch, and what follows."""
    return [box(arena, name), operation(arena, ATTACH, name, "box_a"), *then]


refuse("parent_unknown", lambda arena: [operation(arena, ATTACH, "comb", "nobody")], "nobody", fast=True)
refuse("parent_empty", lambda arena: [operation(arena, ATTACH, "comb")], "neither a body nor a tf frame")
refuse("parent_of_a_megabyte", lambda arena: [operation(arena, ATTACH, "comb", MEGABYTE)], "neither a body nor a tf frame")
refuse("parent_with_nul", lambda arena: [operation(arena, ATTACH, "comb", "box_a\0")], "neither a body nor a tf frame")
refuse("attached_to_itself", lambda arena: [operation(arena, ATTACH, "comb", "comb")], "attached to itself")
refuse("cycle_of_two", lambda arena: [operation(arena, ATTACH, "comb", "blocks"), operation(arena, ATTACH, "blocks", "comb")],
       "a cycle", fast=True)
refuse("attached_twice", lambda arena: held(arena, "part", operation(arena, ATTACH, "part", "box_b")), "already")
refuse("detached_though_free", lambda arena: [operation(arena, DETACH, "comb")], "not attached")
refuse("moved_though_attached", lambda arena: held(arena, "part", operation(arena, MOVE, "part", pose=pose_at())), "detach it first")
refuse("parent_removed", lambda arena: [box(arena, "part"), box(arena, "lid"), operation(arena, ATTACH, "lid", "part"),
                                        operation(arena, REMOVE, "part")], "'lid' is attached")
refuse("move_of_a_body_that_tf_moves", lambda arena: [operation(arena, MOVE, "box_b", pose=pose_at())], "tf moves its frame", fast=True)
refuse("move_of_a_body_that_is_none", lambda arena: [operation(arena, MOVE, "nobody", pose=pose_at())], "nobody")
refuse("move_in_a_frame_that_is_none", lambda arena: [operation(arena, MOVE, "comb", frame_id="moon", pose=pose_at())], "moon")
refuse("name_in_use", lambda arena: [box(arena, "box_a")], "there is a body 'box_a'", fast=True)
refuse("name_twice_in_a_batch", lambda arena: [box(arena, "twin"), box(arena, "twin")], "there is a body 'twin'")
refuse("name_of_a_group", lambda arena: [box(arena, "pair_of_boxes")], "there is a group 'pair_of_boxes'", fast=True)
refuse("group_as_parent", lambda arena: [operation(arena, ATTACH, "comb", "pair_of_boxes")], "is a group")
refuse("group_is_moved", lambda arena: [operation(arena, MOVE, "pair_of_boxes", pose=pose_at())], "there is no body")
refuse("kind_unknown", lambda arena: [operation(arena, 8, "comb")], "the value is 8")
for key, value in {"nan": NAN, "inf": INF, "1e308": 1e308}.items():
    refuse("move_to_" + key, lambda arena, value=value: [operation(arena, MOVE, "comb", pose=pose_at(value))], "pose")
    refuse("add_at_" + key, lambda arena, value=value: [box(arena, "part", pose=pose_at(value))], "pose")
for key, value in {"nan": NAN, "negative": -1.0, "inf": INF, "1e308": 1e308}.items():
    refuse("margin_" + key, lambda arena, value=value: [operation(arena, MARGIN, "comb", margin=value)], "margin")
    refuse("size_" + key, lambda arena, value=value: [box(arena, "part", value)], "body 'part': ")
for key, text in {"empty": "", "blank": "a b", "of_a_megabyte": MEGABYTE, "nul": "a\0", "slash": "a//b", "pattern": "*"}.items():
    refuse("name_" + key, lambda arena, text=text: [box(arena, text)], "topic name")
for key, text in {"empty": "", "blank": "a b", "of_a_megabyte": MEGABYTE, "nul": "a\0"}.items():
    refuse("frame_" + key, lambda arena, text=text: [box(arena, "part", frame_id=text)], "frame")
for key, names in {"unknown": ["nobody"], "of_a_megabyte": [MEGABYTE], "itself": ["part"]}.items():
    refuse("pair_with_" + key, lambda arena, names=names: [box(arena, "part", pair_with=names)], "")
for key, text in {"stars": "*" * 1000 + "q", "of_a_megabyte": "*o" * 2**19 + "q"}.items():
    refuse("pattern_" + key, lambda arena, text=text: [operation(arena, ALLOW, text, "box_a")], "")

refuse("no_shape", lambda arena: [box(arena, "part", primitives=[])], "the body has none")
refuse("no_triangle", lambda arena: [mesh(arena, "part", tetrahedron(()))], "no triangle", fast=True)
refuse("triangles_of_no_area", lambda arena: [mesh(arena, "part", tetrahedron(((0, 0, 0), (1, 1, 2))))], "part")
refuse("vertex_out_of_range", lambda arena: [mesh(arena, "part", tetrahedron(((0, 1, 2**32 - 1),)))], "part")
refuse("poses_for_other_shapes", lambda arena: [box(arena, "part", primitive_poses=[pose_at()] * 3)], "3 poses for 1 primitives")


@group.attack(fast=True)
def vertex_nan(arena):
    shape = tetrahedron()
    shape.vertices[3].z = NAN
    refused(arena, [mesh(arena, "part", shape)], {0: "part"})


@group.attack(fast=True)
def one_wrong_among_two_hundred(arena):
    """All or none: the others are not applied."""
    operations = [box(arena, "some_%d" % index) for index in range(200)]
    operations[137] = operation(arena, MOVE, "box_b", pose=pose_at())
    refused(arena, operations, {137: "tf moves its frame"})


@group.attack(deadline=60.0)
def every_one_wrong_of_ten_thousand(arena):
    """A thousand faults are listed at most."""
    before = state(arena)
    response = apply(arena, [operation(arena, MOVE, "nobody_%d" % index) for index in range(10000)])
    expect(not response.success and len(response.faults) == 1000, "%d faults" % len(response.faults))
    expect("10000 of 10000" in response.message, shortened(response.message))
    expect(state(arena) == before, "list_bodies has changed")


@group.attack(deadline=60.0)
def a_chain_of_two_thousand_attached(arena):
    """Each is attached to the one before; the first moves, and all are taken away again."""
    count = 2000
    names = ["chain_%d" % index for index in range(count)]
    response = apply(arena, [box(arena, name, without_pairs=True) for name in names], 60.0)
    expect(response.success, shortened(response.message))
    try:
        chain = [operation(arena, ATTACH, later, earlier) for earlier, later in zip(names, names[1:])]
        response = apply(arena, chain, 60.0)
        expect(response.success, shortened(response.message))
        refused(arena, [operation(arena, ATTACH, names[0], names[-1])], {0: "a cycle"})
        response = apply(arena, [operation(arena, MOVE, names[0], pose=pose_at(1.0, 40.0))], 60.0)
        expect(response.success, shortened(response.message))
        last = next(body for body in arena.node.list_bodies().bodies if body.name == names[-1])
        expect(abs(last.pose.position.x - 1.0) < 1e-9, "the last one is at x = %g" % last.pose.position.x)
    finally:
        response = apply(arena, [operation(arena, REMOVE, name) for name in reversed(names)], 60.0)
    expect(response.success, shortened(response.message))


@group.attack(deadline=60.0, growth_mb=400.0)
def more_operations_than_a_batch_takes(arena):
    before = state(arena)
    response = apply(arena, [operation(arena, REMOVE, "x")] * 200000, 60.0)
    expect(not response.success and "200000 operations" in response.message, shortened(response.message))
    expect(state(arena) == before, "list_bodies has changed")


def of_triangles(arena, count):
    """The request that adds one mesh of so many triangles, as bytes: the message classes would take minutes."""
    marker = MeshTriangle(vertex_indices=[0x7a7a7a7a] * 3)
    shape = tetrahedron()
    shape.triangles = [marker]
    request = ros_wire.serialized(arena.services.ApplySceneRequest(operations=[mesh(arena, "vast", shape)]))
    head, tail = request.split(struct.pack("<I", 1) + ros_wire.serialized(marker))
    four = b"".join(ros_wire.serialized(triangle) for triangle in tetrahedron().triangles)
    return head + struct.pack("<I", count) + four * (count // 4) + tail


@group.attack(deadline=120.0, growth_mb=700.0, storms=False)
def ten_million_triangles(arena):
    """120 MB of request, really sent; the message and its copy are all that the node takes."""
    before = state(arena)
    service = arena.services.ApplyScene
    answer = ros_wire.call_bytes(arena.node.service_uri("apply_scene"), arena.node.name + "/apply_scene", service._md5sum,
                                 of_triangles(arena, 10**7), 60.0 * arena.patience)
    response = service._response_class()
    response.deserialize(answer)
    require_faults(response, {0: "10000000 triangles"})
    expect(state(arena) == before, "list_bodies has changed")


@group.attack(deadline=120.0)
def hundred_new_bodies_a_batch_for_a_while(arena):
    """Added and removed again: memory does not grow with the number of bodies that ever were."""
    for round_ in range(30):
        names = ["wave_%d_%d" % (round_, index) for index in range(100)]
        response = apply(arena, [box(arena, name, 0.1 + 0.001 * round_) for name in names])
        expect(response.success, shortened(response.message))
        response = apply(arena, [operation(arena, REMOVE, name) for name in names])
        expect(response.success, shortened(response.message))
    arena.require_tracking()


# Streams

class Stream:
    """Publishes on scene_moves; `drum` is a box that may be moved."""

    def __init__(self, arena):
        self.arena = arena
        self.publisher = rospy.Publisher(arena.node.name + "/scene_moves", arena.messages.SceneMoves, queue_size=10)
        self.refused, self.last_refusal = None, ""
        self.diagnostics = rospy.Subscriber("/diagnostics", DiagnosticArray, self.read, queue_size=10)
        arena.wait_until(lambda: self.publisher.get_num_connections() > 0, 10.0, "the node does not subscribe to scene_moves")

    def __enter__(self):
        response = apply(self.arena, [box(self.arena, "drum", without_pairs=True)])
        expect(response.success, shortened(response.message))
        return self

    def __exit__(self, *_):
        self.publisher.unregister()
        self.diagnostics.unregister()
        if self.arena.node.alive():
            apply(self.arena, [operation(self.arena, REMOVE, "drum")])

    def read(self, message):
        for status in message.status:
            values = {value.key: value.value for value in status.values}
            if "moves refused since the start" in values:
                self.refused, self.last_refusal = int(values["moves refused since the start"]), values["last refusal"]

    def send(self, bodies, poses, frame=""):
        message = self.arena.messages.SceneMoves(bodies=bodies, poses=poses)
        message.header.frame_id = frame
        self.publisher.publish(message)

    def place(self):
        return next(body.pose.position.x for body in self.arena.node.list_bodies().bodies if body.name == "drum")

    def require_follows(self, x):
        """The node applies a move that comes after all others."""
        def arrived():
            self.send(["drum"], [pose_at(x, 40.0)])
            return abs(self.place() - x) < 1e-9
        self.arena.wait_until(arrived, 15.0, "drum does not come to x = %g" % x)


MOVES = {
    "nobody": (["nobody"], [pose_at()], "", "nobody"), "tf_moves": (["box_b"], [pose_at()], "", "tf moves its frame"),
    "nan": (["drum"], [pose_at(NAN)], "", "position"), "inf": (["drum"], [pose_at(0.0, INF)], "", "position"),
    "no_pose": (["drum"], [], "", "1 bodies and 0 poses"), "no_body": ([], [pose_at()], "", "0 bodies and 1 poses"),
    "frame_unknown": (["drum"], [pose_at()], "moon", "moon"), "frame_of_a_megabyte": (["drum"], [pose_at()], MEGABYTE, "frame"),
    "name_of_a_megabyte": ([MEGABYTE], [pose_at()], "", "no body"), "name_with_nul": (["drum\0"], [pose_at()], "", "no body"),
    "group": (["pair_of_boxes"], [pose_at()], "", "no body"),
    "hundred_thousand": (["drum"] * 100000, [pose_at()] * 100000, "", "100000 operations"),
}


def stream_of(arena, bodies, poses, frame, word):
    """The move is dropped, counted and named in the diagnostics; the next one is applied."""
    with Stream(arena) as stream:
        arena.wait_until(lambda: stream.refused is not None, 15.0, "no diagnostics come")
        before = stream.refused
        mark = arena.node.log_length()
        stream.send(bodies, poses, frame)
        arena.wait_until(lambda: stream.refused > before and word in stream.last_refusal, 15.0,
                         "the diagnostics do not name '%s': %s" % (word, shortened(stream.last_refusal)))
        expect(len(arena.node.log(mark)) < 10 * LONGEST_MESSAGE, "the log grew by %d bytes" % len(arena.node.log(mark)))
        expect(abs(stream.place()) < 1e-9, "drum was moved")
        stream.require_follows(2.0)


for key, (bodies, poses, frame, word) in MOVES.items():
    group.add("moves_" + key, lambda arena, bodies=bodies, poses=poses, frame=frame, word=word: stream_of(
        arena, bodies, poses, frame, word), storms=False, fast=key in ("tf_moves", "nan"))


@group.attack(deadline=90.0, storms=False)
def moves_faster_than_the_node(arena):
    """Eight publishers of 500 moves a message, as fast as they can: old ones are dropped, others are served."""
    ends = time.monotonic() + 6.0
    names = ["swarm_%d" % index for index in range(500)]
    response = apply(arena, [box(arena, name, without_pairs=True) for name in names])
    expect(response.success, shortened(response.message))
    try:
        with Stream(arena) as stream:
            problems = []

            def flood(lane):
                try:
                    while time.monotonic() < ends:
                        stream.send(names, [pose_at(0.001 * lane, 40.0 + index) for index in range(len(names))])
                except Exception as problem:
                    problems.append(problem)
            threads = [threading.Thread(target=flood, args=(lane,), daemon=True) for lane in range(8)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join(30.0 * arena.patience)
            if problems:
                raise Failed("a publisher failed: %s" % problems[0])
            stream.require_follows(3.0)
            arena.require_tracking()
    finally:
        apply(arena, [operation(arena, REMOVE, name) for name in names])


@group.attack(deadline=90.0, storms=False)
def batches_faster_than_the_node(arena):
    """Sixteen clients send batches of moves; each is answered, with revisions that ascend for each client."""
    name = "shared_%d" % next(counter)
    response = apply(arena, [box(arena, name)])
    expect(response.success, shortened(response.message))
    ends = time.monotonic() + 4.0
    problems = []

    def work(lane):
        last = 0
        try:
            while time.monotonic() < ends:
                answer = apply(arena, [operation(arena, MOVE, name, pose=pose_at(0.01 * lane, 40.0))] * 50, 60.0)
                expect(answer.success, shortened(answer.message))
                expect(answer.revision > last, "revision %d after %d" % (answer.revision, last))
                last = answer.revision
        except Exception as problem:
            problems.append(problem)
    threads = [threading.Thread(target=work, args=(lane,), daemon=True) for lane in range(16)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(70.0 * arena.patience)
    apply(arena, [operation(arena, REMOVE, name)])
    if problems:
        raise Failed(str(problems[0]))
    arena.require_tracking()
