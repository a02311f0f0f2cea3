#!/usr/bin/env python3
"""Starts the distance node on many robots, moves their joints, and prints its times and rates as a Markdown table.

    . build/devel/setup.bash; scripts/robot_table.py [--seconds 10] [--port 11399] [--search] [--json OUT] [URDF ...]

Default URDFs: those of Debian's dart-doc, including broken ones, and of this package; without collision geometry the
visual geometry is used. --search: meshes are searched beside the URDF (~mesh_search_path); without it, links in a
temporary folder make the packages of the URDFs known, for versions of the node without that parameter.
--node: distance_node of another build.
Columns: bodies, pairs and problems of list_bodies; seconds from the start of the node to the first `niches` message in
which every pair has a distance or a bound beyond its cutoff; messages per second of `niches` after it, with every joint
moving; resident memory at the end. Processor time of the node until the first distance, and per cycle, is given too,
for busy machines.
"""
import argparse
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import xml.etree.ElementTree as ElementTree

import rosgraph
import rospy
from concave_distance.msg import Niches, PairStatus
from concave_distance.srv import ListBodies

PACKAGE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
DART = "/usr/share/doc/dart/data"
DEADLINE = 120.0  # s, for the first distance
NOT_LOCATED = (PairStatus.MISSING_TRANSFORM, PairStatus.STALE_TRANSFORM)
# Packages named in the URDFs of dart-doc, and the folder of their meshes.
DART_PACKAGES = {"atlas_description/meshes_v3": DART + "/sdf/atlas", "herb_description": DART + "/urdf/wam",
                 "drchubo": DART + "/urdf/drchubo"}


def default_robots():
    found = []
    for folder in (DART, PACKAGE + "/urdf"):
        for path, _, files in os.walk(folder):
            found += [os.path.join(path, name) for name in files if name.endswith(".urdf")]
    return sorted(found)


def make_packages(folder):
    for name, meshes in DART_PACKAGES.items():
        package = os.path.join(folder, name.split("/")[0])
        if "/" in name:
            os.makedirs(package)
            os.symlink(meshes, os.path.join(folder, name))
        else:
            os.makedirs(package)
            for entry in os.listdir(meshes):
                if entry != "package.xml":
                    os.symlink(os.path.join(meshes, entry), os.path.join(package, entry))
        with open(os.path.join(package, "package.xml"), "w") as stream:
            stream.write("<package><name>%s</name><version>0.0.0</version><description/>"
                         "<maintainer email='a@b.c'>none</maintainer><license>none</license></package>"
                         % name.split("/")[0])


def root_link(text):
    try:
        tree = ElementTree.fromstring(text)
    except ElementTree.ParseError:
        return "world"
    children = {joint.find("child").get("link") for joint in tree.iter("joint") if joint.find("child") is not None}
    roots = [link.get("name") for link in tree.findall("link") if link.get("name") not in children]
    return roots[0] if roots else "world"


def resident(pid):
    try:
        with open("/proc/%d/status" % pid) as stream:
            for line in stream:
                if line.startswith("VmRSS"):
                    return int(line.split()[1]) / 1024.0
    except OSError:
        pass
    return float("nan")


def processor_seconds(pid):
    try:
        with open("/proc/%d/stat" % pid) as stream:
            fields = stream.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    except OSError:
        return float("nan")


def text_of(path):
    with open(path, errors="replace") as stream:
        return stream.read()


class Watch:
    """Counts the messages of `niches` after the first with a distance; solved pairs are those with a distance."""

    def __init__(self):
        self.first = None
        self.count = 0
        self.solved = 0
        self.lock = threading.Lock()
        self.subscriber = rospy.Subscriber("/robot_table/niches", rospy.AnyMsg, self.receive, queue_size=1000)

    def receive(self, message):
        now = time.time()
        with self.lock:
            if self.first is None:
                decoded = Niches()
                decoded.deserialize(message._buff)
                codes = [pair.nearest.status.code for pair in decoded.pairs]
                if codes and not any(code in NOT_LOCATED for code in codes):
                    self.first = now
                    self.solved = sum(1 for pair in decoded.pairs if pair.nearest.has_distance)
            else:
                self.count += 1

    def close(self):
        self.subscriber.unregister()


def start(program, *arguments, **options):
    return subprocess.Popen([program, *arguments], stdout=options.get("log", subprocess.DEVNULL),
                            stderr=subprocess.STDOUT, start_new_session=True, env=options.get("env"))


def stop(process):
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(20)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def ask(timeout):
    rospy.wait_for_service("/robot_table/list_bodies", timeout)
    return rospy.ServiceProxy("/robot_table/list_bodies", ListBodies)()


def measure(urdf, arguments, environment, log):
    text = text_of(urdf)
    rospy.set_param("/robot_description", text)
    for name in ("/robot_table", "/robot_mover"):
        try:
            rospy.delete_param(name)
        except KeyError:
            pass
    root = root_link(text)
    row = {"urdf": urdf, "seconds": None, "rate": None}
    mover = start(arguments.mover, "_motion:=sway", "_rate:=100", "_root_frame:=" + root, log=log)
    publisher = start("/usr/lib/robot_state_publisher/robot_state_publisher" if os.path.exists(
        "/usr/lib/robot_state_publisher/robot_state_publisher") else "rosrun",
        *([] if os.path.exists("/usr/lib/robot_state_publisher/robot_state_publisher")
          else ["robot_state_publisher", "robot_state_publisher"]), "_publish_frequency:=1000", log=log)
    watch = Watch()
    time.sleep(1.0)
    begin = time.time()
    options = ["__name:=robot_table", "_robot_description:=/robot_description", "_reference_frame:=" + root,
               "_cache:=off"]
    if "<collision" not in text:
        row["visual"] = True
        options.append("_geometry:=visual")
    if arguments.search:
        options.append("_mesh_search_path:=" + urdf)
    node = start(arguments.node, *options, log=log, env=environment)
    try:
        answer = None
        while time.time() - begin < DEADLINE and node.poll() is None:
            answer = ask(10.0)
            if answer.ready:
                break
            time.sleep(0.1)
        row["loaded"] = time.time() - begin
        row["bodies"], row["pairs"] = len(answer.bodies), len(answer.pairs)
        row["problems"] = len(answer.problems)
        row["problem"] = answer.problems[0].message if answer.problems else ""
        if answer.pairs:
            while watch.first is None and time.time() - begin < DEADLINE and node.poll() is None:
                time.sleep(0.05)
            if watch.first:
                row["seconds"] = watch.first - begin
                row["processor"] = processor_seconds(node.pid)
                time.sleep(arguments.seconds)
                with watch.lock:
                    row["rate"] = watch.count / (time.time() - watch.first)
                    row["solved"] = watch.solved
                    spent = processor_seconds(node.pid) - row["processor"]
                    row["cycle_ms"] = 1e3 * spent / watch.count if watch.count else None
            else:
                row["seconds"] = "more than %.0f" % DEADLINE
        row["memory"] = resident(node.pid)
        row["alive"] = node.poll() is None
    except (rospy.ROSException, rospy.ServiceException, AttributeError) as problem:
        row["error"] = str(problem)
    finally:
        watch.close()
        for process in (node, mover, publisher):
            stop(process)
    return row


def print_table(rows):
    print("| robot | bodies | pairs | problems | loaded, s | first distance, s (processor s) | cycles a second "
          "(processor ms a cycle) | MB |")
    print("|---|---|---|---|---|---|---|---|")
    for row in rows:
        def number(key, form):
            value = row.get(key)
            return value if isinstance(value, str) else "-" if value is None else form % value
        name = os.path.relpath(row["urdf"], DART) if row["urdf"].startswith(DART) else os.path.basename(row["urdf"])
        print("| %s | %s | %s | %s | %s | %s (%s) | %s (%s) | %s |" % (
            name + (" (visual)" if row.get("visual") else ""), row.get("bodies", "-"), row.get("pairs", "-"), row.get("problems", row.get("error", "-")),
            number("loaded", "%.1f"), number("seconds", "%.1f"), number("processor", "%.1f"),
            number("rate", "%.1f"), number("cycle_ms", "%.1f"), number("memory", "%.0f")))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("urdf", nargs="*")
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--port", type=int, default=11399)
    parser.add_argument("--search", action="store_true")
    parser.add_argument("--json")
    programs = PACKAGE + "/build/devel/lib/concave_distance/"
    parser.add_argument("--node", default=programs + "distance_node")
    parser.add_argument("--mover", default=programs + "robot_mover")
    arguments = parser.parse_args()
    os.environ["ROS_MASTER_URI"] = "http://localhost:%d" % arguments.port
    os.environ.setdefault("ROS_HOSTNAME", "localhost")
    folder = tempfile.mkdtemp(prefix="robot_table_")
    environment = dict(os.environ)
    if not arguments.search:
        make_packages(folder)
        environment["ROS_PACKAGE_PATH"] = folder + ":" + environment.get("ROS_PACKAGE_PATH", "")
    master = start("roscore", "-p", str(arguments.port))
    try:
        while not rosgraph.is_master_online():
            time.sleep(0.2)
        rospy.init_node("robot_table_script", disable_signals=True)
        rows = []
        with open(os.path.join(folder, "log"), "w") as log:
            for urdf in [os.path.abspath(path) for path in arguments.urdf] or default_robots():
                rows.append(measure(urdf, arguments, environment, log))
                print(rows[-1], file=sys.stderr, flush=True)
        print_table(rows)
        if arguments.json:
            with open(arguments.json, "w") as stream:
                json.dump(rows, stream, indent=1)
    finally:
        stop(master)
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main()
