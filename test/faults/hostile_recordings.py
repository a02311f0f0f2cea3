"""record_pair called with nonsense, by many and while the scene changes; recordings that are damaged, replayed."""

import os
import random
import re
import shutil
import threading
import time

import processes
from attacks import Failed, Group, expect, shortened
from bench import Bench
from request_checks import MEGABYTE, call, require_refused

group = Group("recordings", {})
A, B = "box_a", "box_b"
FILES = ("record.yaml", "poses.csv", "answers.csv", "a.obj", "b.obj")


def folder_of(arena, name=""):
    """Recordings stand beside the scene."""
    return os.path.join(arena.folder, "scene", name)


def record(arena, folder="", body_a=A, body_b=B, poses=20, timeout=60.0):
    return call(arena, "record_pair", timeout, folder=folder, body_a=body_a, body_b=body_b, poses=poses)


def recorded(arena, folder="", **request):
    """The folder of a recording that worked; a busy node is asked again."""
    deadline = time.monotonic() + 60.0 * arena.patience
    while True:
        response = record(arena, folder, **request)
        if response.success:
            return response.folder
        if time.monotonic() > deadline or not any(word in response.message for word in ("BUSY", "no answer yet", "not tracked")):
            raise Failed("no recording: " + response.message)
        time.sleep(0.2)


def replayed(arena, folder, seconds=60.0):
    """Status and what the tool prints."""
    return Bench(arena).run("distance_query", "--replay", folder, seconds=seconds)


def require_whole(arena, folder):
    status, text = replayed(arena, folder)
    expect(status == 0 and "bit for bit" in text, "a recording is not whole (%s): %s" % (status, shortened(text)))


def require_no_leftovers(arena):
    parts = [name for name in os.listdir(folder_of(arena)) if "part" in name]
    expect(not parts, "left behind: " + ", ".join(parts[:5]))


# Requests

def refused(label, *words, prepare=None, fast=False, **request):
    def act(arena):
        if prepare:
            prepare(arena)
        before = sorted(os.listdir(folder_of(arena)))
        response = record(arena, **request)
        require_refused(response, *words)
        expect(sorted(os.listdir(folder_of(arena))) == before, "something was written")
        require_no_leftovers(arena)
    group.add(label, act, deadline=60.0, fast=fast)


NAMES = {"empty": "", "unknown": "nobody", "megabyte": MEGABYTE, "pattern": "box_*", "with_nul": "box_a\0", "path": "../box_a",
         "group": "pair_of_boxes", "escapes": "\x1b[2J\n"}
for label, name in NAMES.items():
    refused("body_" + label, "body_a", body_a=name)
    refused("other_body_" + label, "body_b", body_b=name)
refused("body_twice", "body_b", body_b=A)
refused("pair_that_is_not_watched", "not watched", body_b="comb")
FOLDERS = {"absolute_elsewhere": "/tmp/recording_of_an_attack", "root": "/", "parent": "..", "here": ".", "above": "../recording",
           "below_and_above": "meshes/../../recording", "of_5000_letters": "f" * 5000, "of_300_letters": "f" * 300,
           "megabyte": MEGABYTE, "with_nul": "a\0b", "file_of_the_scene": "scene.yaml", "folder_of_the_scene": "meshes",
           "below_a_file": "scene.yaml/recording", "below_none": "none/recording", "ends_with_slash": "new/", "proc": "/proc/self/x",
           "dev_null": "/dev/null"}
for label, folder in FOLDERS.items():
    refused("folder_" + label, folder=folder, fast=label == "below_and_above")


def links(arena):
    for name, target in (("outward", "/tmp"), ("dangling", "/none/none"), ("round", "round"), ("taken", "meshes")):
        if not os.path.lexists(folder_of(arena, name)):
            os.symlink(target, folder_of(arena, name))


for label, folder in {"link_outward": "outward/recording_of_an_attack", "link_itself": "outward", "link_dangling": "dangling",
                      "link_round": "round", "below_a_link_round": "round/x", "link_to_a_folder": "taken"}.items():
    refused("folder_" + label, folder=folder, prepare=links)



@group.attack(deadline=60.0)
def any_number_of_poses(arena):
    for poses in (1, 2**31, 2**32 - 1, 0):
        folder = recorded(arena, poses=poses)
        require_whole(arena, folder)
        shutil.rmtree(folder)


@group.attack(deadline=60.0)
def odd_names_that_are_allowed(arena):
    for name in (" ", "-rf", "~", "$(id)", "a b'c\"d", "\u00e4\u4e2d", "x.yaml", "...", "new\nline"):
        response = record(arena, folder=name)
        if response.success:
            expect(os.path.dirname(os.path.realpath(response.folder)) == os.path.realpath(folder_of(arena)),
                   "it was written to " + response.folder)
            require_whole(arena, response.folder)
            shutil.rmtree(response.folder)
        else:
            require_refused(response)
    require_no_leftovers(arena)


# Many at once, and a scene that changes

def at_once(arena, works, seconds=60.0):
    """Calls each function in a thread; the first problem that is no refusal."""
    problems, threads = [], []

    def run(work):
        try:
            work()
        except Exception as problem:
            problems.append(shortened(problem))
    for work in works:
        threads.append(threading.Thread(target=run, args=(work,), daemon=True))
        threads[-1].start()
    deadline = time.monotonic() + seconds * arena.patience
    for thread in threads:
        thread.join(max(0.0, deadline - time.monotonic()))
    expect(not any(thread.is_alive() for thread in threads), "calls hang")
    expect(not problems, "; ".join(problems[:3]))


@group.attack(deadline=150.0, storms=False)
def two_hundred_at_once(arena):
    """Of those with one name one is written; each that says so is whole, and nothing else is there."""
    shutil.rmtree(folder_of(arena, "same"), ignore_errors=True)
    before = set(os.listdir(folder_of(arena)))
    answers = []
    at_once(arena, [lambda index=index: answers.append(record(arena, "same" if index % 2 else "", timeout=120.0))
                    for index in range(200)], 120.0)
    written = [response.folder for response in answers if response.success]
    for response in answers:
        if not response.success:
            require_refused(response, "BUSY", "there already", "another recording")
    expect(written and len(set(written)) == len(written), "written: %s" % written)
    expect({os.path.basename(folder) for folder in written} == set(os.listdir(folder_of(arena))) - before, "other files are there")
    for folder in written[:5]:
        require_whole(arena, folder)
    for folder in written:
        shutil.rmtree(folder)
    arena.require_tracking()


def operation(arena, kind, body, **fields):
    made = arena.messages.SceneOperation(operation=getattr(arena.messages.SceneOperation, kind), body=body, **fields)
    made.pose.orientation.w = 1.0
    return made


def while_the_scene_changes(arena, change, body_b, seconds=8.0):
    """Records a pair while `change` edits the scene; each answer is a whole recording or a refusal."""
    ends = time.monotonic() + seconds
    counts = [0, 0]

    def edit():
        while time.monotonic() < ends:
            change()

    def ask():
        while time.monotonic() < ends:
            response = record(arena, body_b=body_b)
            counts[response.success] += 1
            if not response.success:
                require_refused(response)
                continue
            try:
                require_whole(arena, response.folder)
            finally:
                shutil.rmtree(response.folder)
    at_once(arena, [edit, ask, ask], seconds + 60.0)
    expect(sum(counts) > 0, "no answer came")
    require_no_leftovers(arena)


@group.attack(deadline=120.0, storms=False)
def while_a_pair_is_removed_and_added(arena):
    from shape_msgs.msg import SolidPrimitive
    from geometry_msgs.msg import Pose
    pose = Pose()
    pose.orientation.w = 1.0

    def change():
        size = random.uniform(0.2, 0.6)
        made = operation(arena, "ADD", "guest", frame_id="world")
        made.pose.position.x, made.pose.position.y = 1.5, 2.0
        made.primitives, made.primitive_poses = [SolidPrimitive(type=SolidPrimitive.BOX, dimensions=[size] * 3)], [pose]
        call(arena, "apply_scene", operations=[made])
        time.sleep(random.uniform(0.0, 0.3))
        call(arena, "remove_body", name="guest")
    while_the_scene_changes(arena, change, "guest")


@group.attack(deadline=120.0, storms=False)
def while_its_pair_is_switched(arena):
    def change():
        for enabled in (False, True):
            call(arena, "set_pair_enabled", pair="boxes", enabled=enabled)
            time.sleep(0.05)
    while_the_scene_changes(arena, change, B)


@group.attack(deadline=120.0, storms=False)
def while_the_scene_is_loaded_again(arena):
    def change():
        call(arena, "reload", timeout=60.0)
        call(arena, "reset_tracking")
        time.sleep(0.1)
    while_the_scene_changes(arena, change, B)


# Damaged recordings

def damaged(label, damage, *words, seconds=60.0, fast=False):
    """A copy of a recording, changed by damage(folder), is refused, or replayed with other answers that are named."""
    def act(arena):
        good = getattr(arena, "recording", None)
        if good is None or not os.path.isdir(good):
            arena.recording = good = arena.path("good_recording")
            shutil.rmtree(good, ignore_errors=True)
            made = recorded(arena)
            shutil.copytree(made, good)
            shutil.rmtree(made)
            require_whole(arena, good)
        folder = arena.path("damaged/" + label)
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(good, folder)
        damage(folder)
        output = arena.path("logs/replay.txt")
        began = time.monotonic()
        status, text, peak = processes.run([arena.program("distance_query"), "--replay", folder], seconds * arena.patience,
                                           arena.environment, arena.address_space_gb, output,
                                           largest_mb=1500.0 * arena.memory_factor)
        shutil.rmtree(folder)
        expect(status is not None, "it was ended after %.1f s with %.0f MB" % (time.monotonic() - began, peak))
        expect(status in (1, 2, 3), "it ended with %d: %s" % (status, shortened(text[-300:])))
        expect(text.strip() and len(text) < 20000, "it says %d characters" % len(text))
        missing = [word for word in words if word not in text]
        expect(not missing, "it does not name %s: %s" % (", ".join(missing), shortened(text[-300:])))
    group.add("replay_" + label, act, deadline=seconds + 90.0, storms=False, fast=fast)


def path(folder, name):
    return os.path.join(folder, name)


def write(folder, name, content):
    if os.path.lexists(path(folder, name)):
        os.remove(path(folder, name))
    with open(path(folder, name), "wb") as file:
        file.write(content if isinstance(content, bytes) else content.encode())


def read(folder, name):
    with open(path(folder, name)) as file:
        return file.read()


def replace(name, pattern, by, count=1):
    """A damage: the first matches of a pattern in a file are others."""
    def damage(folder):
        text, made = re.subn(pattern, lambda match: match.expand(by) if isinstance(by, str) else by(match), read(folder, name),
                             count=count, flags=re.MULTILINE)
        expect(made, "the attack does not find %s in %s" % (pattern, name))
        write(folder, name, text)
    return damage


def made_of(name, make):
    """A damage: the file is what make(its text) returns."""
    return lambda folder: write(folder, name, make(read(folder, name)))


def linked(name, target):
    def damage(folder):
        os.remove(path(folder, name))
        os.symlink(target, path(folder, name))
    return damage


def no_file(name):
    def damage(folder):
        os.remove(path(folder, name))
        os.mkfifo(path(folder, name))
    return damage


for name in FILES:
    label = name.replace(".", "_")
    damaged(label + "_missing", lambda folder, name=name: os.remove(path(folder, name)), name)
    damaged(label + "_empty", made_of(name, lambda _: ""), name)
    damaged(label + "_half", made_of(name, lambda text: text[:len(text) // 2]), name if "yaml" not in name else "")
    damaged(label + "_binary", made_of(name, lambda _: bytes(range(256)) * 100), name)
    damaged(label + "_zeros", made_of(name, lambda _: bytes(10**6)), name)
    damaged(label + "_dev_zero", linked(name, "/dev/zero"), name, fast=name == "answers.csv")
    damaged(label + "_fifo", no_file(name), name)
    damaged(label + "_folder", linked(name, "/"), name)
    damaged(label + "_600_mb", lambda folder, name=name: os.truncate(path(folder, name), 600 * 10**6), name)
damaged("not_a_folder", lambda folder: (shutil.rmtree(folder), open(folder, "w").close(), os.remove(folder), os.mkdir(folder)), "record.yaml")
FACTS = {
    "format_2": (r"^format: 1", "format: 2"), "format_missing": (r"^format: 1\n", ""), "poses_0": (r"^poses: \d+", "poses: 0"),
    "poses_1e18": (r"^poses: \d+", "poses: 1000000000000000000"), "answered_more": (r"^answered: \d+", "answered: 1000"),
    "answered_negative": (r"^answered: \d+", "answered: -1"), "answered_less": (r"^answered: \d+", "answered: 3"),
    "vertices_1e9": (r"vertices: \d+", "vertices: 1000000000"), "triangles_less": (r"triangles: \d+", "triangles: 11"),
    "margin_nan": (r"margin: \S+", "margin: .nan"), "margin_inf": (r"margin: \S+", "margin: .inf"),
    "margin_huge": (r"margin: \S+", "margin: 1e300"), "key_twice": (r"^poses: (\d+)", r"poses: \1\nposes: \1"),
    "key_unknown": (r"^format: 1", "format: 1\nfromat: 1"), "alias_of_itself": (r"^a:$", "a: &a [*a]\nc:"),
    "deep": (r"^pair: .*$", "pair: " + "[" * 100000),
    "grid_edge_1e-9": (r"max_edge_length: [^,}]+", "max_edge_length: 1e-9"),
    "grid_edge_0": (r"max_edge_length: [^,}]+", "max_edge_length: 0"),
    "grid_of_1e9_nodes": (r"max_edge_length: [^,}]+, search_node_limit: \d+, largest_node_count: \d+",
                          "max_edge_length: 1e-5, search_node_limit: 1000000000, largest_node_count: 1000000000"),
    "tolerance_nan": (r"^settings:\n", "settings:\n  absolute_tolerance: .nan\n"),
    "setting_unknown": (r"^settings:\n", "settings:\n  speed: 3\n"),
}
for label, (pattern, by) in FACTS.items():
    damaged("facts_" + label, replace("record.yaml", pattern, by), seconds=90.0)
POSES = {"nan": r"\1,nan,", "inf": r"\1,inf,", "1e308": r"\1,1e308,", "text": r"\1,here,", "empty": r"\1,,"}
for label, by in POSES.items():
    damaged("pose_" + label, replace("poses.csv", r"^([-0-9.e]+),[^,]+,", by))
damaged("poses_that_are_no_rotation", replace("poses.csv", r"^(([^,\n]+,){4})[^,]+", r"\g<1>7"))
damaged("poses_that_go_back", made_of("poses.csv", lambda text: "\n".join(
    [text.splitlines()[0]] + text.splitlines()[:0:-1]) + "\n"), "poses.csv", "time")
damaged("poses_without_header", made_of("poses.csv", lambda text: text.partition("\n")[2]), "poses.csv")
damaged("answers_of_other_digits", replace("answers.csv", r"^(0,)([^,]+)", r"\g<1>17"), "answers.csv:2", "17")
damaged("answers_twice", made_of("answers.csv", lambda text: text + text.partition("\n")[2]), "answers.csv")
damaged("answers_index_1e300", replace("answers.csv", r"^1,", "1e300,"), "answers.csv")
damaged("answers_cell_of_a_megabyte", replace("answers.csv", r"^1,", lambda _: "1" * 10**6 + "x,"), "answers.csv")
damaged("answers_of_tiny_cells", made_of("answers.csv", lambda _: "index\n" + "0\n" * 60000000), "answers.csv", seconds=120.0)
damaged("answers_of_empty_cells", made_of("answers.csv", lambda text: text.partition("\n")[0] + "\n" + (
    "0" + "," * text.partition("\n")[0].count(",") + "\n") * 8000000), "answers.csv", seconds=120.0)
damaged("answers_of_commas", made_of("answers.csv", lambda _: "index" + "," * 10**8 + "\n"), "answers.csv", seconds=120.0)
damaged("mesh_of_another_kind", made_of("a.obj", lambda _: "solid x\nendsolid x\n"), "a.obj")
damaged("mesh_with_nan", replace("a.obj", r"^v \S+", "v nan"), "a.obj")
damaged("mesh_with_index_1e18", replace("a.obj", r"^f \S+", "f 1000000000000000000"), "a.obj")
damaged("mesh_of_1e300", replace("a.obj", r"^v \S+", "v 1e300"), "a.obj")
