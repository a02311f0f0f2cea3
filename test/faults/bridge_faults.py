"""The bridges for MoveIt and cob_twist_controller under hostile messages, definitions and rivals."""

import os
import random
import sys
import time

import processes
import ros_wire
import rospy
from arena import REPOSITORY
from attacks import Group, expect, shortened
from cloud_messages import bytes_class, start_rival
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Point, Pose
from shape_msgs.msg import Mesh, MeshTriangle, Plane, SolidPrimitive

sys.path.insert(0, os.path.join(REPOSITORY, "test", "ros", "bridges"))
import moveit_definitions  # noqa: E402

group = Group("bridges", {})
NAN, INF, HUGE = float("nan"), float("inf"), 2**32 - 1
BRIDGE = "moveit_bridge"
SCENE = moveit_definitions.PLANNING_SCENE


def pose(x=0.0, y=0.0, z=0.0, rotation=(0.0, 0.0, 0.0, 1.0)):
    made = Pose()
    made.position.x, made.position.y, made.position.z = x, y, z
    turn = made.orientation
    turn.x, turn.y, turn.z, turn.w = rotation
    return made


class Bridge:
    """A running bridge, what it says in /diagnostics, and a publisher of planning scenes."""

    def __init__(self, arena, program, remappings=()):
        self.arena = arena
        self.name = program.split(".")[0]
        self.log_path = arena.path("logs/%s.log" % self.name)
        self.status = {}
        self.reports = 0
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.keep, queue_size=100)
        with open(self.log_path, "wb") as log:
            self.process = processes.start([sys.executable, arena.program(program), "_check_period:=0", *remappings],
                                           arena.environment, log, arena.address_space_gb)

    def keep(self, message):
        for one in message.status:
            if one.name == self.name:
                self.status = {item.key: item.value for item in one.values}
                self.reports += 1

    def log(self):
        with open(self.log_path, errors="replace") as log:
            return log.read()

    def require_alive(self):
        expect(self.process.poll() is None, "the bridge ended: " + shortened(self.log()[-600:], 400))

    def until(self, condition, timeout, text, act=None):
        deadline = time.monotonic() + timeout * self.arena.patience
        while not condition():
            self.require_alive()
            expect(time.monotonic() < deadline, "%s; it says %s" % (text, shortened(self.status, 400)))
            if act:
                act()
            time.sleep(0.1)


def bridge(arena):
    """The bridge of this run; another one where it has ended."""
    found = getattr(arena, "moveit_bridge", None)
    if found is None or found.process.poll() is not None:
        found = arena.moveit_bridge = Bridge(arena, "moveit_bridge.py")
        if not hasattr(arena, "planning_scenes"):
            kind = moveit_definitions.message_classes()[SCENE]
            raw = bytes_class(SCENE, kind._md5sum, kind._full_text)
            arena.planning_scenes = rospy.Publisher("/monitored_planning_scene", raw, queue_size=100), raw
            close = arena.stop_node
            arena.stop_node = lambda: (processes.end_group(arena.moveit_bridge.process), close())[1]
        found.until(lambda: arena.planning_scenes[0].get_num_connections() > 0, 30.0, "it does not listen")
        found.until(lambda: found.reports > 0, 20.0, "it does not report")
    return found


def make(kind, **fields):
    return moveit_definitions.message_classes()["moveit_msgs/" + kind](**fields)


def collision_object(name, solids=None, frame="world", operation=0, at=None):
    item = make("CollisionObject", id=name, operation=operation)
    item.header.frame_id = frame
    item.pose = at or pose()
    for solid, place in solids if solids is not None else [(SolidPrimitive(type=2, dimensions=[0.5]), pose(0.0, 9.0, 0.0))]:
        item.primitives.append(solid)
        item.primitive_poses.append(place)
    return item


def diff(*objects, **fields):
    scene = make("PlanningScene", is_diff=True, name="hostile", **fields)
    scene.robot_state.is_diff = True
    scene.world.collision_objects = list(objects)
    return scene


def publish(arena, message):
    sender, kind = arena.planning_scenes
    sender.publish(kind(message if isinstance(message, bytes) else ros_wire.serialized(message)))


def bodies(arena):
    return [body.name for body in arena.node.list_bodies().bodies if body.name.startswith("moveit/")]


def require_served(arena, timeout=40.0):
    """A good object comes and goes, and the node goes on."""
    watched = bridge(arena)
    watched.until(lambda: "moveit/good" in bodies(arena), timeout, "a good object is not served",
                  lambda: publish(arena, diff(collision_object("good"))))
    watched.until(lambda: bodies(arena) == [], timeout, "what is removed stays: %s" % bodies(arena)[:5],
                  lambda: publish(arena, diff(collision_object("", [], operation=1))))
    arena.require_tracking()


def survives(label, make_messages, *words, deadline=120.0, **options):
    """The bridge lives, names what it does not serve, and serves what is right."""
    def act(arena):
        watched = bridge(arena)
        require_served(arena)
        messages = make_messages()
        for message in messages if isinstance(messages, list) else [messages]:
            publish(arena, message)
        for word in words:
            watched.until(lambda word=word: any(word in key + ": " + text for key, text in watched.status.items()), 20.0,
                          "it does not say '%s'" % word)
        expect(all(len(text) < 20000 for text in watched.status.values()), "a report is too long")
        clear = make("PlanningScene", is_diff=False)
        publish(arena, clear)
        require_served(arena)
    group.add(label, act, deadline=deadline, storms=False, **options)


# Messages that cannot be read, and definitions

def good_bytes():
    return ros_wire.serialized(diff(collision_object("good")))


for cut in (0, 1, 10, 60, 150):
    survives("message_cut_after_%d" % cut, lambda cut=cut: good_bytes()[:cut], "cannot be read")
survives("message_of_zeros", lambda: bytes(5000))
survives("message_of_ones", lambda: b"\xff" * 5000, "cannot be read")
survives("message_with_changed_bytes", lambda: [changed(seed) for seed in range(100)])


def changed(seed):
    source = random.Random(seed)
    body = bytearray(good_bytes())
    for _ in range(source.choice((1, 2, 5))):
        body[source.randrange(len(body))] = source.choice((0, 1, 127, 255))
    return bytes(body)


# Objects

def solid(kind, *dimensions):
    return SolidPrimitive(type=kind, dimensions=list(dimensions))


def with_shapes(**shapes):
    item = collision_object("bad", [])
    for name, value in shapes.items():
        setattr(item, name, value)
    return diff(item)


OBJECTS = {
    "box_nan": [(solid(1, NAN, 1, 1), pose())], "box_0": [(solid(1, 0, 1, 1), pose())], "sphere_1e300": [(solid(2, 1e300), pose())],
    "box_short": [(solid(1, 1), pose())], "type_77": [(solid(77, 1, 1, 1), pose())], "cone_1e-300": [(solid(4, 1e-300, 1e-300), pose())],
    "pose_nan": [(solid(2, 0.5), pose(NAN))], "pose_inf": [(solid(2, 0.5), pose(INF))], "pose_1e300": [(solid(2, 0.5), pose(1e300))],
    "rotation_nan": [(solid(2, 0.5), pose(rotation=(NAN, 0, 0, 1)))],
}
for label, solids in OBJECTS.items():
    survives("object_" + label, lambda solids=solids: diff(collision_object("bad", solids)), "'bad'")
for label, rotation in {"1e200": (1e200, 0, 0, 0), "1e308": (1.7e308,) * 4, "denormal": (0, 0, 0, 5e-324), "0": (0, 0, 0, 0)}.items():
    survives("rotation_" + label, lambda rotation=rotation: diff(collision_object("odd", None, at=pose(rotation=rotation))))
for label, numbers in {"1e200": (1e200, 0, 0, 1), "1e308": (1.7e308, 1.7e308, 1.7e308, 0), "denormal": (5e-324, 0, 0, 1), "nan": (NAN, 0, 1, 0),
                       "0": (0, 0, 0, 1), "1e300_away": (0, 0, 1, 1e300)}.items():
    survives("plane_" + label, lambda numbers=numbers: with_shapes(planes=[Plane(coef=numbers)], plane_poses=[pose()]), "'bad'")
MESHES = {"without_vertices": ([], [[0, 0, 0]]), "with_index_of_4e9": ([Point()] * 3, [[0, 1, HUGE]]), "of_one_point": ([Point()] * 3, [[0, 1, 2]]),
          "nan": ([Point(NAN, 0, 0), Point(), Point(0, 1, 0)], [[0, 1, 2]]), "1e200": ([Point(1e200, 0, 0), Point(), Point(0, 1, 0)], [[0, 1, 2]])}
for label, (vertices, corners) in MESHES.items():
    survives("mesh_" + label, lambda vertices=vertices, corners=corners: with_shapes(
        meshes=[Mesh(vertices=vertices, triangles=[MeshTriangle(one) for one in corners])], mesh_poses=[pose()]), "'bad'")
NAMES = {"escapes": "\x1b[2J\n", "nul": "a\0b", "path": "../../x", "slashes": "/////", "unicode": "\u4e2d\u202e", "megabyte": "n" * 2**20,
         "of_a_link": "box_a", "pattern": "*?[", "blank": " ", "prefix": "moveit/good", "attached": "good_attached", "octomap": "<octomap>"}
for label, name in NAMES.items():
    survives("name_" + label, lambda name=name: diff(collision_object(name), collision_object("good")))
survives("names_that_become_one", lambda: diff(*(collision_object("a%sb" % one) for one in " -+*?!\u00e4\n")))
survives("id_that_is_no_utf8", lambda: good_bytes().replace(b"good", b"\xff\xfe\xc3("))
for operation in (-128, 4, 127):
    survives("operation_%d" % operation, lambda operation=operation: diff(collision_object("bad", operation=operation)), "operation")
survives("move_of_nothing", lambda: diff(collision_object("bad", [], operation=3)), "MOVE")
survives("frame_nowhere", lambda: diff(collision_object("bad", frame="nowhere")))
survives("frame_of_itself", lambda: [diff(collision_object("bad")), diff(collision_object("bad", frame="bad"))])


def attached(link="box_b", operation=0, solids=None, touch=(), name="held"):
    scene = diff()
    scene.robot_state.attached_collision_objects = [make(
        "AttachedCollisionObject", link_name=link, touch_links=list(touch),
        object=collision_object(name, solids, frame=link, operation=operation))]
    return scene


survives("attached_to_nothing", lambda: attached("nowhere"), "'held'")
survives("attached_to_no_link", lambda: attached(""), "'held'")
survives("attached_without_shapes", lambda: [attached(operation=operation, solids=[]) for operation in (0, 1, 2)], "'held'")
survives("attached_with_ten_thousand_touch_links", lambda: attached(touch=["link%d" % index for index in range(10000)]))
survives("attached_to_what_it_holds", lambda: [diff(collision_object("one")), attached("moveit/one", name="one")])


def matrix(names, rows, defaults=(), values=()):
    scene = diff()
    contacts = scene.allowed_collision_matrix
    contacts.entry_names, contacts.default_entry_names, contacts.default_entry_values = list(names), list(defaults), list(values)
    contacts.entry_values = [make("AllowedCollisionEntry", enabled=list(row)) for row in rows]
    return scene


survives("matrix_without_rows", lambda: matrix(["box_a", "box_b"], []), "names")
survives("matrix_with_short_rows", lambda: matrix(["box_a", "box_b"], [[True], []]), "another length")
survives("matrix_of_one_name_thrice", lambda: matrix(["box_a"] * 3, [[True] * 3] * 3))
survives("matrix_of_odd_names", lambda: matrix(["", "\x1b", "box_a\0"], [[True] * 3] * 3, ["", "*"], [True, True]))
survives("defaults_without_values", lambda: matrix(["box_a"], [[True]], ["box_a"], []), "default names")
survives("paddings_and_scales", lambda: diff(
    link_padding=[make("LinkPadding", link_name="box_a", padding=value) for value in (NAN, -1.0, INF)],
    link_scale=[make("LinkScale", link_name="box_a", scale=value) for value in (NAN, 0.0, 1e300)]), "link_padding", "link_scale")


# Many

def grid(count, shift=0.0):
    return diff(*(collision_object("o%d" % index, [(solid(1, 0.1, 0.1, 0.1), pose(index % 50 + shift, 20.0 + index // 50, 5.0))])
                  for index in range(count)))


@group.attack(deadline=300.0, growth_mb=1600.0, silence=30.0, storms=False)
def two_thousand_objects(arena):
    """Once moved they are watched against each other, too: as many pairs as the node's limit, in one long cycle."""
    watched = bridge(arena)
    require_served(arena)
    publish(arena, grid(2000))
    watched.until(lambda: len(bodies(arena)) == 2000, 120.0, "they are not served")
    publish(arena, grid(2000, 0.25))
    publish(arena, diff(collision_object("last")))
    watched.until(lambda: "moveit/last" in bodies(arena), 120.0, "the last is not served")
    publish(arena, make("PlanningScene", is_diff=False))
    watched.until(lambda: bodies(arena) == [], 120.0, "they stay")
    arena.require_tracking(60.0)
    require_served(arena)


@group.attack(deadline=240.0, storms=False)
def thousand_diffs_a_second(arena):
    watched = bridge(arena)
    require_served(arena)
    for index in range(3000):
        publish(arena, diff(collision_object("flood%d" % (index % 7), [(solid(2, 0.5), pose(0.0, 9.0 + 0.001 * index, 0.0))])))
        time.sleep(0.001)
    watched.until(lambda: len(bodies(arena)) == 7, 60.0, "the flood is not served", lambda: publish(arena, diff(*(
        collision_object("flood%d" % index) for index in range(7)))))
    publish(arena, make("PlanningScene", is_diff=False))
    require_served(arena)


DEFINITIONS = {
    "another_type": ("std_msgs/String", "992ce8a1687cec8c8bd883ec73ca41d1", "string data\n", "remap"),
    "no_definition": (SCENE, "0" * 32, "", "definition"),
    "code": (SCENE, "1" * 32, "string name = __import__('os').system('touch /tmp/attacked')\n", "neither a field nor a constant"),
    "two_megabytes": (SCENE, "2" * 32, "string name\n" * 200000, "characters"),
    "no_world": (SCENE, "3" * 32, "string name\nbool is_diff\n", "definition"),
    "itself": (SCENE, "4" * 32, "moveit_msgs/PlanningScene world\n", "definition"),
}


def rival(arena, type_name, md5sum, text, word):
    """Another publisher of the topic; while it is there and afterwards the good one is served."""
    watched = bridge(arena)
    require_served(arena)
    process = start_rival(arena, "/monitored_planning_scene", type_name, md5sum, text, b"\0" * 64)
    try:
        watched.until(lambda: any(word in text for text in watched.status.values()) or word in watched.log(), 40.0,
                      "it does not say '%s'" % word)
    finally:
        processes.end_group(process)
    require_served(arena)
    expect(not os.path.exists("/tmp/attacked"), "the text of a definition was run")


for label, arguments in DEFINITIONS.items():
    group.add("definition_of_" + label, lambda arena, arguments=arguments: rival(arena, *arguments), deadline=180.0, storms=False)
