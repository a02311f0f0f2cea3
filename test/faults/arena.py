"""The environment of the attacks: a master, a scratch folder with a scene, a node, moving frames."""

import os
import socket
import sys
import time

import processes
import ros_wire
from attacks import Failed, expect

REPOSITORY = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

SCENE = """\
metric_memory_limit_mb: 64
bodies:
  - {name: box_a, box: {size: [1, 1, 1]}}
  - {name: box_b, box: {size: [1, 1, 1]}}
  - {name: ball, sphere: {radius: 0.5}, chord_error: 0.01}
  - {name: blocks, frame: world, pose: {xyz: [0, 3, 10]}, mesh: meshes/two_blocks.obj}
  - {name: hook, mesh: meshes/hook.stl}
  - {name: comb, frame: world, pose: {xyz: [0, -3, 0]}, mesh: meshes/comb.stl}
groups: {pair_of_boxes: [box_a, box_b]}
pairs:
  - {between: [box_a, box_b], name: boxes, warning_distance: 0.6}
  - {between: [box_a, ball], name: box_ball}
  - {between: [ball, blocks], name: ball_blocks, cutoff: 2.0}
  - {between: [hook, comb], name: hook_comb}
"""


def free_port():
    with socket.socket() as listener:
        listener.bind(("localhost", 0))
        return listener.getsockname()[1]


def source_of(build):
    """The source folder of the build, whose launch files, meshes and scenes are used."""
    try:
        with open(os.path.join(build, "CMakeCache.txt")) as cache:
            return next(line.partition("=")[2].strip() for line in cache if line.startswith("CMAKE_HOME_DIRECTORY:"))
    except (OSError, StopIteration):
        return REPOSITORY


class Arena:
    """The master, the scratch folder and the programs under attack."""

    def __init__(self, build, folder, port=None, sanitized=False):
        self.build = os.path.abspath(build)
        self.source = source_of(self.build)
        self.folder = os.path.abspath(folder)
        self.sanitized = sanitized
        self.patience = 6.0 if sanitized else 1.0  # factor of every deadline
        self.memory_factor = 4.0 if sanitized else 1.0
        self.address_space_gb = None if sanitized else 6.0  # sanitizers reserve terabytes of addresses
        self.largest_mb = 3000.0 * (2.0 if sanitized else 1.0)
        self.repeated_calls = 0  # connections that were closed unanswered by a node that lives
        self.running_node = None
        self.player = None
        self.listener = None
        os.makedirs(os.path.join(self.folder, "scene", "meshes"), exist_ok=True)
        self.scene_file = self.write("scene/scene.yaml", SCENE)
        self.link("meshes/demo/hook.stl", "scene/meshes/hook.stl")
        self.link("meshes/demo/comb.stl", "scene/meshes/comb.stl")
        self.link("test/ros/rostest/meshes/two_blocks.obj", "scene/meshes/two_blocks.obj")
        self.environment = self.set_environment(port or free_port())
        self.master_process = processes.start(
            ["rosmaster", "--core", "-p", self.environment["ROS_MASTER_URI"].rpartition(":")[2]],
            self.environment)
        self.wait_for_master()

    def set_environment(self, port):
        os.environ.update({
            "ROS_MASTER_URI": "http://localhost:%d" % port,
            "ROS_HOSTNAME": "localhost",
            "ROS_PACKAGE_PATH": os.pathsep.join([self.source, "/usr/share"]),
            "ROS_LOG_DIR": os.path.join(self.folder, "ros_logs"),
            "ROS_HOME": os.path.join(self.folder, "ros_home"),
            "PYTHONUNBUFFERED": "1",
            "ASAN_OPTIONS": "detect_leaks=0:quarantine_size_mb=16:malloc_context_size=12:allocator_may_return_null=1"
                            ":suppressions=%s/test/faults/asan_suppressions.txt" % REPOSITORY,
            "UBSAN_OPTIONS": "print_stacktrace=1",
        })
        os.environ.pop("ROS_IP", None)
        messages = os.path.join(self.build, "devel", "lib", "python3", "dist-packages")
        for variable, first, default in (("CMAKE_PREFIX_PATH", os.path.join(self.build, "devel"), "/usr"),
                                         ("PYTHONPATH", messages, "")):
            os.environ[variable] = os.pathsep.join([first, os.environ.get(variable) or default]).rstrip(os.pathsep)
        if messages not in sys.path:
            sys.path.insert(0, messages)
        return dict(os.environ)

    def wait_for_master(self):
        deadline = time.monotonic() + 30.0
        while True:
            try:
                self.master().getPid("/faults")
                return
            except OSError:
                expect(time.monotonic() < deadline, "no rosmaster after 30 s")
                time.sleep(0.05)

    def join_ros(self):
        """Makes this process a ROS node and loads the message classes."""
        import rospy
        rospy.init_node("faults", disable_signals=True, log_level=rospy.FATAL)
        import concave_distance.msg
        import concave_distance.srv
        import frames
        self.messages = concave_distance.msg
        self.services = concave_distance.srv
        self.player = frames.FramePlayer()
        self.frames = frames

    # Files and programs

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        path = self.path(name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return path

    def link(self, source, name):
        if not os.path.lexists(self.path(name)):
            with open(os.path.join(REPOSITORY, source), "rb") as file:
                self.write(name, file.read())

    def program(self, name):
        return os.path.join(self.build, "devel", "lib", "concave_distance", name)

    # Master

    def master(self):
        return ros_wire.xmlrpc_proxy(self.environment["ROS_MASTER_URI"])

    def set_parameter(self, name, value):
        self.master().setParam("/faults", name, value)

    def set_parameters(self, namespace, parameters):
        self.delete_parameter(namespace)
        for name, value in parameters.items():
            self.set_parameter(namespace + "/" + name, value)

    def delete_parameter(self, name):
        self.master().deleteParam("/faults", name)

    def forget(self, name):
        """Unregisters a killed node from the master."""
        master = self.master()
        _, _, (publishers, subscribers, services) = master.getSystemState("/faults")
        code, _, uri = master.lookupNode("/faults", name)
        if code != 1:
            return
        for topic, nodes in publishers:
            if name in nodes:
                master.unregisterPublisher(name, topic, uri)
        for topic, nodes in subscribers:
            if name in nodes:
                master.unregisterSubscriber(name, topic, uri)
        for service, nodes in services:
            if name in nodes:
                master.unregisterService(name, service, master.lookupService(name, service)[2])

    # The node and its services

    @property
    def node(self):
        if self.running_node is None:
            raise Failed("no node runs")
        return self.running_node

    def start_node(self, log_name, parameters=None, **options):
        from node_under_test import Node
        values = {"scene_file": self.scene_file, "robot_description": "", "rate": 50.0}
        values.update(parameters or {})
        self.running_node = Node(self, values, log_name, **options)
        return self.running_node

    def stop_node(self):
        if self.listener:
            self.listener.close()
            self.listener = None
        if self.running_node:
            node, self.running_node = self.running_node, None
            return node.stop()
        return None

    def listen(self):
        self.listener = self.frames.DistanceListener(self.node.name, self.messages.Distances, self.messages.PairStatus)
        return self.listener

    def require_tracking(self, timeout=15.0):
        """The node follows the motion: a right distance arrives."""
        self.node.require_alive()
        expect(self.listener.wait_until_right(timeout * self.patience),
               "no right distance on ~distances within %.0f s: %s" % (timeout, self.listener.seen()))

    def wait_until(self, condition, timeout, text):
        deadline = time.monotonic() + timeout * self.patience
        while not condition():
            self.node.require_alive()
            if time.monotonic() > deadline:
                raise Failed("%s (after %.0f s)" % (text, timeout))
            time.sleep(0.02)

    def close(self):
        self.stop_node()
        if self.player:
            self.player.running = False
        processes.end_group(self.master_process)
