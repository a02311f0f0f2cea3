"""Every launch file as a new user starts it, also with robots of other packages."""

import glob
import os
import re
import signal
import subprocess
import threading
import time
import xml.etree.ElementTree as ElementTree

import processes
import rospy
from arena import REPOSITORY
from attacks import Failed, Group, expect, shortened
from node_under_test import NODE, Node
from tf2_msgs.msg import TFMessage

group = Group("launch")
ROBOTS = "/usr/share/doc/dart/data"
# What moves or places a robot ends when there is none to be read; the distance node does not.
MAY_END = ("robot_state_publisher", "robot_mover")
DIED = ("has died", "cannot launch", "FATAL", "Traceback", "unrecognized", "Invalid")


def text_of(path):
    with open(path, errors="replace") as file:
        return file.read()


class Launched:
    """A launch file, run by roslaunch for the duration of the block."""

    def __init__(self, arena, file, *arguments):
        self.arena = arena
        self.log_path = arena.path("logs/launch_%s.log" % time.monotonic_ns())
        os.makedirs(os.path.dirname(self.log_path), exist_ok=True)
        whole_path = file if os.path.isabs(file) else os.path.join(arena.source, "launch", file)
        without_rviz = ["rviz:=false"] if 'arg name="rviz"' in text_of(whole_path) else []
        self.command = ["roslaunch", whole_path, *without_rviz, *arguments]

    def __enter__(self):
        self.arena.delete_parameter(NODE)
        with open(self.log_path, "wb") as log:
            self.process = processes.start(self.command, self.arena.environment, log)
        return self

    def __exit__(self, *_):
        processes.end_group(self.process, signal.SIGINT, 30.0 * self.arena.patience)
        for name in self.arena.master().getSystemState("/faults")[2][0]:
            for node in name[1]:
                if node != "/faults":
                    self.arena.forget(node)
        for parameter in ("/use_sim_time", "/robot_description"):
            if self.arena.master().hasParam("/faults", parameter)[2]:
                self.arena.delete_parameter(parameter)

    def log(self):
        with open(self.log_path, errors="replace") as log:
            return log.read()

    def require_up(self):
        wrong = [line for line in self.log().splitlines() if any(sign in line for sign in DIED)
                 and not any(name in line for name in MAY_END)]
        expect(not wrong, shortened(wrong[-1] if wrong else "", 300))
        expect(self.process.poll() is None, "roslaunch has ended: " + shortened(self.log()[-300:]))


def wait_for_distance(arena, launched, timeout):
    """A pair with a distance on ~distances."""
    found = threading.Event()
    subscriber = rospy.Subscriber(NODE + "/distances", arena.messages.Distances, lambda message: found.set()
                                  if any(pair.has_distance for pair in message.pairs) else None)
    try:
        deadline = time.monotonic() + timeout * arena.patience
        while not found.wait(0.1):
            launched.require_up()
            expect(time.monotonic() < deadline, "no distance after %.0f s: %s" % (timeout, shortened(launched.log()[-300:])))
    finally:
        subscriber.unregister()


def demo(arena, file, leftover):
    """A demo gives distances, also after a simulation that left /use_sim_time set."""
    arena.set_parameter("/use_sim_time", leftover)
    with Launched(arena, file) as launched:
        wait_for_distance(arena, launched, 60.0)
        launched.require_up()


OWN_SCENE = ('scene_file" value="$(find', 'arg name="scene"', "/launch/cell.launch")
WITHOUT_A_SCENE = []
for path in sorted(glob.glob(os.path.join(REPOSITORY, "launch", "*.launch"))):
    launch_file = os.path.basename(path)
    if any(sign in text_of(path) for sign in OWN_SCENE):
        group.add(launch_file, lambda arena, file=launch_file: demo(arena, file, False), deadline=120.0)
        group.add(launch_file + "_after_a_simulation", lambda arena, file=launch_file: demo(arena, file, True), deadline=120.0)
    else:
        WITHOUT_A_SCENE.append(launch_file)


class Robot(threading.Thread):
    """Publishes the frames of a URDF with every joint at zero, its root at world."""

    def __init__(self, text):
        super().__init__(daemon=True)
        self.links = []
        self.running = True
        try:
            root = ElementTree.fromstring(text)
        except ElementTree.ParseError:
            root = ElementTree.Element("robot")
        children = set()
        for joint in root.iter("joint"):
            if joint.find("parent") is None or joint.find("child") is None:
                continue
            origin = joint.find("origin")
            xyz = [float(x) for x in (origin.get("xyz") if origin is not None and origin.get("xyz") else "0 0 0").split()]
            parent, child = joint.find("parent").get("link"), joint.find("child").get("link")
            children.add(child)
            self.links.append((parent, child, xyz))
        self.links += [("world", link.get("name"), [0.0, 0.0, 0.0]) for link in root.findall("link")
                       if link.get("name") not in children and link.get("name") != "world"]
        self.publisher = rospy.Publisher("/tf", TFMessage, queue_size=10)
        self.start()

    def run(self):
        import frames
        while self.running:
            now = rospy.Time.now()
            self.publisher.publish(TFMessage([frames.transform(parent, child, now, *xyz)
                                              for parent, child, xyz in self.links]))
            time.sleep(0.05)


def started_by(arena, launched):
    """The node that roslaunch started, with the interface of node_under_test."""
    node = Node.__new__(Node)
    node.arena, node.name, node.process, node.require_alive = arena, NODE, launched.process, launched.require_up
    return node


def robot(arena, file, text, whole, *arguments):
    """The launch file serves a robot: its distances, or the reason if it is broken. text: the URDF that is loaded
    and whose frames are published; None: the launch file does both."""
    arena.set_parameter("/use_sim_time", False)
    frames = Robot(text or "")
    if text is not None:
        arena.set_parameter("/robot_description", text)
    try:
        with Launched(arena, file, *arguments) as launched:
            node = started_by(arena, launched)
            deadline = time.monotonic() + 60.0 * arena.patience
            listed = None
            while listed is None or not (listed.ready or listed.message):
                launched.require_up()
                expect(time.monotonic() < deadline, "no answer: " + shortened(launched.log()[-300:]))
                try:
                    listed = node.list_bodies()
                except Failed:
                    time.sleep(0.2)
                if listed is not None and not listed.ready and time.monotonic() < deadline:
                    listed = None if "loading" in listed.message or "prepar" in listed.message else listed
            if whole:
                expect(listed.ready and listed.pairs, "no pairs: %s %s" % (listed.message, shortened(listed.problems)))
            if listed.pairs:
                wait_for_distance(arena, launched, 60.0)
            else:
                expect(listed.problems or listed.message or listed.notes or len(listed.bodies) < 2,
                       "no pairs, and no reason")
            launched.require_up()
    finally:
        frames.running = False


def with_meshes_found(path):
    """A URDF of another package, with absolute mesh paths, because that package is not installed as a ROS package."""
    def found(match):
        name = match.group(1)
        local = os.path.join(os.path.dirname(path), name)
        if name.startswith("package://"):
            rest = name[len("package://"):].partition("/")[2]
            folders = [os.path.dirname(path), *glob.glob(ROBOTS + "/*"), *glob.glob(ROBOTS + "/*/*")]
            local = next((os.path.join(folder, rest) for folder in folders if os.path.isfile(os.path.join(folder, rest))),
                         name)
        return 'filename="%s"' % ("file://" + local.replace(" ", "%20") if os.path.isfile(local) else name)
    return re.sub(r'filename="([^"]*)"', found, text_of(path))


def waits_for(arena, file, words):
    """Without what it follows the node goes on and says what it waits for."""
    arena.set_parameter("/use_sim_time", False)
    with Launched(arena, file) as launched:
        deadline = time.monotonic() + 40.0 * arena.patience
        while words not in launched.log().partition("NODES")[2]:
            launched.require_up()
            expect(time.monotonic() < deadline, "it does not say what it waits for")
            time.sleep(0.1)
        launched.require_up()


def refuses(arena, file, text, words):
    """A scene that is made for one robot says which name another has not."""
    arena.set_parameter("/robot_description", text)
    with Launched(arena, file) as launched:
        deadline = time.monotonic() + 40.0 * arena.patience
        while words not in launched.log():
            expect(time.monotonic() < deadline, "it does not say what is not known: " + shortened(launched.log()[-300:]))
            time.sleep(0.1)


# They follow a publisher and serve no robot themselves.
for launch_file in ("cob_bridge.launch", "moveit_bridge.launch"):
    WITHOUT_A_SCENE.remove(launch_file)
    group.add(launch_file + "_alone", lambda arena, file=launch_file: waits_for(arena, file, "; waiting"), deadline=60.0)
# The groups of its scene name links of the demo's robot.
WITHOUT_A_SCENE.remove("groups_on_machines.launch")
group.add("groups_on_machines.launch_with_the_kr5", lambda arena: refuses(
    arena, "groups_on_machines.launch", text_of(os.path.join(REPOSITORY, "urdf/kr5.urdf")),
    "'wam1' is not a body, link or group"), deadline=60.0)
group.add("groups_on_machines.launch_without_a_robot", lambda arena: waits_for(
    arena, "groups_on_machines.launch", "robot_description"), deadline=60.0)
for launch_file in WITHOUT_A_SCENE:
    group.add(launch_file + "_with_a_robot", lambda arena, file=launch_file: robot(
        arena, file, text_of(os.path.join(REPOSITORY, "test/ros/rostest/two_links.urdf")), True), deadline=120.0)
    group.add(launch_file + "_with_the_kr5", lambda arena, file=launch_file: robot(
        arena, file, text_of(os.path.join(REPOSITORY, "urdf/kr5.urdf")), True), deadline=120.0)
    group.add(launch_file + "_without_a_robot", lambda arena, file=launch_file: waits_for(
        arena, file, "robot_description"), deadline=60.0)


for path in sorted(glob.glob(ROBOTS + "/**/*.urdf", recursive=True)):
    whole_robot = "/test/" not in path and "ground" not in path and not path.endswith("atlas_v3.urdf")  # a link is missing
    group.add("robot_" + os.path.relpath(path, ROBOTS).replace("/", "_").replace(" ", "_"),
              lambda arena, path=path, whole=whole_robot: robot(arena, "distance_node.launch", with_meshes_found(path),
                                                                  whole),
              deadline=150.0)
    if "own_robot.launch" in WITHOUT_A_SCENE:
        group.add("own_robot_" + os.path.relpath(path, ROBOTS).replace("/", "_").replace(" ", "_"),
                  lambda arena, path=path, whole=whole_robot: robot(arena, "own_robot.launch", None, whole, "urdf:=" + path),
                  deadline=150.0)


MANAGER = """<launch>
  <node pkg="nodelet" type="nodelet" name="manager" args="manager" output="screen">%s</node>
  <include file="$(find concave_distance)/launch/distance_node.launch">
    <arg name="manager" value="manager"/>
    <arg name="scene_file" value="%s"/>
  </include>
</launch>
"""


@group.attack(deadline=150.0)
def nodelet_under_attack(arena):
    """Hostile requests, a hostile mesh and a hostile stamp leave the nodelet and its manager alive."""
    import frames
    import genpy
    import mesh_faults
    from request_checks import ask, call, require_refused
    file = arena.write("nodelet.launch", MANAGER % (
        # The manager itself is not built with the sanitizer.
        '<env name="LD_PRELOAD" value="%s"/>' % subprocess.check_output(
            ["gcc", "-print-file-name=libasan.so"], text=True).strip() if arena.sanitized else "", arena.scene_file))
    arena.set_parameter("/use_sim_time", False)
    with Launched(arena, file) as launched:
        wait_for_distance(arena, launched, 60.0)
        arena.running_node = started_by(arena, launched)
        try:
            for name in ("node_instances_itself.dae", "accessor_with_huge_stride.dae", "a_fifo.stl"):
                require_refused(call(arena, "add_body", 60.0, name="hostile", frame_id="world", pose__orientation__w=1.0,
                                     mesh_resource=mesh_faults.resource_of(arena, name)), name)
            publisher = rospy.Publisher("/tf", TFMessage, queue_size=10)
            time.sleep(1.0)
            for stamp in (genpy.Time(2**32 - 1, 999999999), genpy.Time(2**31, 0), rospy.Time.now() + rospy.Duration(1000)):
                publisher.publish(TFMessage([frames.transform("world", "box_b", stamp, 40.0)]))
            require_refused(ask(arena, body_a="nobody"), "body")
            wait_for_distance(arena, launched, 60.0)
            launched.require_up()
        finally:
            arena.running_node = None
