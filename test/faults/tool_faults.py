"""Command lines and files that the tools must refuse, and outputs that cannot be written."""

import csv
import math
import os
import signal
import time

import processes
from attacks import Group, expect, shortened
from bench import GOOD, HEADER, Bench

group = Group("tools", beside=True)


def query(*changes, poses="poses.csv", output="out.csv"):
    return ("distance_query", "--mesh-a", "cube.obj", "--mesh-b", "cube.obj", "--poses", poses, "--output", output,
            "--cache", "off", *changes)


def clearance(*changes, motion="motion.csv", output="answer.csv"):
    return ("clearance_query", "--scene", "pair.yaml", "--motion", motion, "--body", "ball", "--output", output,
            "--cache", "off", *changes)


def refuse(name, command, fast=False, inputs=None, **expectation):
    def act(arena):
        bench = Bench(arena)
        for file_name, content in (inputs or {}).items():
            bench.write(file_name, content)
        bench.refused(*command, **expectation)
    group.add(name, act, deadline=60.0, fast=fast)


# Command lines

for tool in ("clearance_query", "distance_query", "mesh_tool", "simulate"):
    refuse(tool + "_without_arguments", (tool,), fast=True)
    refuse(tool + "_unknown_option", (tool, "--frobnicate"))
    refuse(tool + "_empty_arguments", (tool, "", "", ""))
    refuse(tool + "_argument_of_100_kb", (tool, "x" * 100000), fast=True)
OPTIONS = {"accuracy": ("perfect", ""), "cutoff": ("-1", "nan", "far"), "tolerance": ("-1", "nan"),
           "relative-tolerance": ("2", "nan"), "time-budget": ("-1", "nan"), "max-edge": ("0", "-1", "nan", "1e-9"),
           "least-prominence": ("-1", "nan"), "scale-a": ("0", "nan", "inf", "1e300"), "scale-b": ("0", "1e-300"),
           "seed": ("-1", "1e99", "abc")}
for option, values in OPTIONS.items():
    for value in values:
        refuse("distance_query_%s_%s" % (option, value or "empty"), query("--" + option, value), left_behind=("out.csv",))
CLEARANCE_OPTIONS = {"tolerance": ("0", "-1", "nan", "inf"), "threshold": ("-1", "nan", "inf"), "time-budget": ("0", "-1", "nan"),
                     "sample-limit": ("0", "-1", "1e99"), "threads": ("-1", "many"), "position": ("wing", "wing=0", "=1", "wing="),
                     "description": ("urdf", "urdf=", "urdf=none.urdf", "urdf=/", "urdf=/dev/zero")}
for option, values in CLEARANCE_OPTIONS.items():
    for value in values:
        refuse("clearance_query_%s_%s" % (option, value), clearance("--" + option, value), left_behind=("answer.csv",),
               fast=value == "urdf=/dev/zero")
for value in ("0", "-1", "nan", "1e-9"):
    refuse("refine_max_edge_" + value, ("mesh_tool", "refine", "cube.obj", "out.obj", "--max-edge", value),
           left_behind=("out.obj",))
for value in ("0", "nan", "1,2", "1,2,3,4", "inf", "1e300", "a,b,c"):
    refuse("mesh_tool_scale_" + value, ("mesh_tool", "repair", "cube.obj", "out.obj", "--scale", value),
           left_behind=("out.obj",))
for value in ("-1", "nan", "2"):
    refuse("mesh_tool_weld_tolerance_" + value, ("mesh_tool", "repair", "cube.obj", "out.obj", "--weld-tolerance", value),
           left_behind=("out.obj",))

# Inputs

POSES = {
    "empty": "", "wrong_header": "x,y,z\n1,2,3\n", "no_header": "0,2,0,0,0,0,0,1\n", "missing_column": HEADER + "0,2,0,0,0,0,1\n",
    "extra_column": HEADER + "0,2,0,0,0,0,0,1,9\n", "text": HEADER + "0,two,0,0,0,0,0,1\n",
    "empty_cell": HEADER + "0,,0,0,0,0,0,1\n", "cut": GOOD[:-6], "binary": bytes(range(256)) * 40,
    "zeros": bytes(100000), "nul": HEADER + "0,2\0,0,0,0,0,0,1\n", "line_of_10_mb": HEADER + "1" * 10**7,
    "hexadecimal": HEADER + "0,0x1g,0,0,0,0,0,1\n", "number_too_large": HEADER + "0,1e999,0,0,0,0,0,1\n",
    "utf16": GOOD.encode("utf-16"),
}
for label, content in POSES.items():
    refuse("poses_" + label, query(), inputs={"poses.csv": content}, words=("poses.csv",), left_behind=("out.csv",))
for label, path in {"missing": "none.csv", "folder": "/", "dev_zero": "/dev/zero", "own_memory": "/proc/self/mem"}.items():
    refuse("poses_are_" + label, query(poses=path), words=(path,), left_behind=("out.csv",))
for label, path in {"missing": "none.stl", "folder": "/", "dev_zero": "/dev/zero", "poses": "poses.csv"}.items():
    refuse("mesh_is_" + label, ("distance_query", "--mesh-a", path, "--mesh-b", "cube.obj", "--poses", "poses.csv",
                                "--output", "out.csv"), words=(path,), left_behind=("out.csv",))


for label in ("empty", "wrong_header", "no_header", "missing_column", "text", "binary", "cut"):
    refuse("motion_" + label, clearance(), inputs={"motion.csv": POSES[label]}, words=("motion.csv",), left_behind=("answer.csv",))
WAYPOINTS = {"nan": "1,nan,0,1,0,0,0,1", "inf": "1,0,inf,1,0,0,0,1", "1e19": "1,0,0,1e19,0,0,0,1", "earlier": "-1,0,0,1,0,0,0,1",
             "time_nan": "nan,0,0,1,0,0,0,1", "time_1e308": "1e308,0,0,1,0,0,0,1", "at_the_same_time": "0,0,0,1,0,0,0,1",
             "quaternion_2": "1,0,0,1,0,0,0,2", "zero_quaternion": "1,0,0,1,0,0,0,0"}
for label, line in WAYPOINTS.items():
    refuse("waypoint_" + label, clearance(), inputs={"motion.csv": HEADER + "0,2,0,1,0,0,0,1\n" + line + "\n"},
           words=("waypoint 1",), left_behind=("answer.csv",), fast=label == "earlier")
refuse("motion_of_joints_though_a_body_is_named", clearance(), inputs={"motion.csv": "t,wing\n0,1\n"}, words=("motion.csv",))
refuse("motion_of_a_body_that_is_none", clearance("--body", "nobody"))


def rows_of(bench, name="out.csv"):
    with open(bench.path(name), newline="") as file:
        return list(csv.DictReader(file))


def answered(arena, line, statuses):
    """One pose: a line with one of the statuses, and no infinite distance called ok."""
    bench = Bench(arena)
    bench.write("poses.csv", HEADER + line + "\n")
    status, text = bench.run(*query())
    expect(status in (0, 1), "it ended with %s: %s" % (status, shortened(text)))
    if status == 1:
        expect("poses.csv" in text, "the message does not name the file: " + shortened(text))
        return
    row = rows_of(bench)[0]
    expect(row["status"] in statuses, "status %s, distance %s" % (row["status"], row["distance"]))
    expect(row["status"] == "invalid_pose" or math.isfinite(float(row["distance"])), "%(status)s, %(distance)s" % row)


for label, line in {"nan": "0,nan,0,0,0,0,0,1", "inf": "0,inf,0,0,0,0,0,1", "zero_quaternion": "0,2,0,0,0,0,0,0",
                    "quaternion_2": "0,2,0,0,0,0,0,2"}.items():
    group.add("pose_" + label, lambda arena, line=line: answered(arena, line, ("invalid_pose",)))
for label, line in {"1e200": "0,1e200,0,0,0,0,0,1", "minus_1e308": "0,-1e308,1e308,0,0,0,0,1", "1e154": "0,1e154,0,0,0,0,0,1",
                    "denormal": "0,2,5e-324,0,0,0,0,1", "time_nan": "nan,2,0,0,0,0,0,1"}.items():
    group.add("pose_" + label, lambda arena, line=line: answered(arena, line, ("ok", "invalid_pose")), fast=label == "1e200")


@group.attack(deadline=60.0)
def motion_of_a_million_waypoints(arena):
    """Cut short by its budget: the bracket is right. The ball is never nearer to the plate than 0.7 m."""
    bench = Bench(arena)
    bench.write("motion.csv", HEADER + "".join("%d,%d,0,1,0,0,0,1\n" % (index, index % 3) for index in range(10**6)))
    bench.works(*clearance("--time-budget", "2"), seconds=50.0)
    row = rows_of(bench, "answer.csv")[0]
    expect(row["status"] in ("ok", "budget_exhausted"), row["status"])
    expect(0.0 <= float(row["lower_bound"]) <= 0.7 + 1e-9 <= float(row["distance"]) + 2e-9, "[%(lower_bound)s, %(distance)s]" % row)


@group.attack()
def poses_from_windows(arena):
    """Lines that end with CR LF, and none at the end."""
    bench = Bench(arena)
    bench.write("poses.csv", GOOD.replace("\n", "\r\n").rstrip())
    status, text = bench.run(*query())
    expect(status == 0 and len(rows_of(bench)) == 2 or status == 1 and "poses.csv" in text, "%s: %s" % (status, text))


def fifo(arena, tool_line, name):
    """A pipe without a writer is refused; the tool does not wait."""
    bench = Bench(arena)
    os.mkfifo(bench.path(name))
    bench.refused(*tool_line, words=(name,))


group.add("poses_are_a_fifo", lambda arena: fifo(arena, query(poses="pipe.csv"), "pipe.csv"), deadline=60.0)
group.add("motion_is_a_fifo", lambda arena: fifo(arena, clearance(motion="pipe.csv"), "pipe.csv"), deadline=60.0)
group.add("description_is_a_fifo", lambda arena: fifo(arena, clearance("--description", "urdf=pipe.urdf"), "pipe.urdf"),
          deadline=60.0, fast=True)
group.add("mesh_is_a_fifo", lambda arena: fifo(arena, ("mesh_tool", "inspect", "pipe.stl"), "pipe.stl"), deadline=60.0)
group.add("scene_is_a_fifo", lambda arena: fifo(arena, ("simulate", "pipe.yaml", "--output", "o.csv"), "pipe.yaml"), deadline=60.0)

# Outputs

SIMULATED = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "config",
                         "bouncing_ball.yaml")
WRITERS = {
    "clearance_query": lambda path: clearance(output=path),
    "clearance_query_pairs": lambda path: clearance("--pairs-output", path),
    "clearance_query_niches": lambda path: clearance("--niches-output", path),
    "distance_query": lambda path: query(output=path),
    "distance_query_niches": lambda path: query("--niches-output", path),
    "mesh_tool_repair": lambda path: ("mesh_tool", "repair", "cube.obj", path),
    "mesh_tool_refine": lambda path: ("mesh_tool", "refine", "cube.obj", path, "--max-edge", "0.05"),
    "mesh_tool_convert": lambda path: ("mesh_tool", "convert", "cube.obj", path),
    "thesis_tool_hull": lambda path: ("thesis_tool", "hull", "cube.obj", path),
    "thesis_tool_partition": lambda path: ("thesis_tool", "partition", "cube.obj", path),
    "thesis_tool_tree": lambda path: ("thesis_tool", "tree", "cube.obj", path),
    "simulate": lambda path: ("simulate", SIMULATED, "--duration", "0.5", "--output", path),
    "simulate_contacts": lambda path: ("simulate", SIMULATED, "--duration", "2", "--output", "main.csv", "--contacts", path),
    "simulate_niches": lambda path: ("simulate", SIMULATED, "--duration", "0.5", "--output", "main.csv", "--niches", path),
}


def output_name(writer):
    if writer == "thesis_tool_tree":
        return "result.yaml"
    return "result." + ("obj" if writer.startswith(("mesh_tool", "thesis_tool")) else "csv")


def full_device(arena, writer):
    """A link, with the right ending, to the device that is always full."""
    bench = Bench(arena)
    os.symlink("/dev/full", bench.path(output_name(writer)))
    bench.refused(*WRITERS[writer](output_name(writer)), words=(output_name(writer),), seconds=60.0)


def disk_full_midway(arena, writer):
    """The disk is full after 20 bytes: no incomplete file stays."""
    bench = Bench(arena)
    command = WRITERS[writer](output_name(writer))
    others = [name for name in ("out.csv", "main.csv", "answer.csv") if name in command]  # may fail first
    bench.refused(*command, words=() if others else (output_name(writer),), left_behind=[output_name(writer)] + others,
                  file_bytes=20, seconds=60.0)


def folder_that_is_missing(arena, writer):
    Bench(arena).refused(*WRITERS[writer]("none/" + output_name(writer)), words=("none/" + output_name(writer),),
                         seconds=60.0)


for writing in WRITERS:
    program = "thesis_tool" if writing.startswith("thesis_tool") else None
    group.add(writing + "_to_a_full_device", lambda arena, writing=writing: full_device(arena, writing), deadline=90.0,
              fast=writing == "mesh_tool_repair", program=program)
    group.add(writing + "_to_a_disk_that_fills_up", lambda arena, writing=writing: disk_full_midway(arena, writing),
              deadline=90.0, program=program)
    group.add(writing + "_to_a_folder_that_is_missing", lambda arena, writing=writing: folder_that_is_missing(
        arena, writing), deadline=90.0, program=program)


def untouched(arena, name, command):
    """The output would overwrite an input: refused, and the input is unchanged."""
    bench = Bench(arena)
    os.symlink("poses.csv", bench.path("link.csv"))
    os.link(bench.path("poses.csv"), bench.path("hard.csv"))
    os.makedirs(bench.path("folder"))
    before = bench.read(name)
    bench.refused(*command)
    expect(bench.read(name) == before, name + " was overwritten")


for label, output in {"": "poses.csv", "_by_a_link": "link.csv", "_by_a_hard_link": "hard.csv",
                      "_by_another_path": "folder/../poses.csv"}.items():
    group.add("output_is_its_own_poses" + label, lambda arena, output=output: untouched(
        arena, "poses.csv", query(output=output)), fast=not label)
for label in ("motion.csv", "pair.yaml"):
    group.add("output_is_its_own_" + label.split(".")[0], lambda arena, label=label: untouched(
        arena, label, clearance(output=label)))
group.add("output_is_the_mesh", lambda arena: untouched(arena, "cube.obj", query(output="cube.obj")))
group.add("niches_output_is_the_poses", lambda arena: untouched(
    arena, "poses.csv", query("--niches-output", "poses.csv")))
refuse("both_outputs_are_the_same", query("--niches-output", "out.csv"))
refuse("both_outputs_are_the_same_by_another_path", query("--niches-output", "./out.csv"))


@group.attack(deadline=60.0)
def simulation_over_its_own_scene(arena):
    bench = Bench(arena)
    with open(SIMULATED, "rb") as file:
        bench.write("scene.yaml", file.read())
    before = bench.read("scene.yaml")
    bench.refused("simulate", "scene.yaml", "--duration", "0.01", "--output", "scene.yaml")
    expect(bench.read("scene.yaml") == before, "the scene was overwritten")


refuse("simulation_with_one_file_for_two_outputs",
       ("simulate", SIMULATED, "--duration", "0.01", "--output", "a.csv", "--contacts", "a.csv"))


@group.attack(deadline=60.0)
def repair_of_a_file_into_itself(arena):
    """Refused, or done; the file is a mesh afterwards either way."""
    bench = Bench(arena)
    status, text = bench.run("mesh_tool", "repair", "cube.obj", "cube.obj")
    expect(status in (0, 1, 2), "it ended with %s: %s" % (status, shortened(text)))
    expect("closed: 1" in bench.works("mesh_tool", "inspect", "cube.obj"), "the mesh is not closed any more")


# Standard output

def print_to_full_device(arena, *command):
    with open("/dev/full", "wb") as full:
        status, _ = Bench(arena).run(*command, stdout=full)
    expect(status not in (0, None), "printing to a full device ends with status %s" % status)


group.add("inspect_printed_to_a_full_device", lambda arena: print_to_full_device(arena, "mesh_tool", "inspect", "cube.obj"),
          fast=True)
group.add("simulation_printed_to_a_full_device", lambda arena: print_to_full_device(
    arena, "simulate", SIMULATED, "--duration", "0.1", "--output", "o.csv"), deadline=60.0)


@group.attack()
def printed_into_a_closed_pipe(arena):
    """The tool ends by SIGPIPE or with an error."""
    for command in (("mesh_tool", "inspect", "cube.obj"), ("distance_query", "--help"), ("mesh_tool", "--help")):
        reading, writing = os.pipe()
        os.close(reading)
        with os.fdopen(writing, "wb") as closed:
            status, text = Bench(arena).run(*command, stdout=closed)
        expect(status in (-signal.SIGPIPE, 1, 2), "%s ended with %s: %s" % (command[0], status, shortened(text)))


@group.attack(deadline=60.0)
def sigint_in_the_middle(arena):
    """A simulation of a million seconds ends within seconds."""
    bench = Bench(arena)
    process = processes.start([arena.program("simulate"), SIMULATED, "--duration", "1e6", "--output", bench.path("o.csv")],
                              arena.environment)
    time.sleep(1.0)
    seconds = processes.end_group(process, signal.SIGINT, 10.0 * arena.patience)
    expect(seconds is not None, "it had to be killed")
