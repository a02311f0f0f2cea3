"""Wrong scene files and robots: the node ends with file and line, or serves the rest."""

import itertools
import os
import xmlrpc.client

from attacks import Group, expect, shortened

group = Group("scenes")
counter = itertools.count()
PAIR = "  - {name: a, box: {size: [1, 1, 1]}}\n  - {name: b, box: {size: [1, 1, 1]}}\n"


def ends(arena, content, *words, path=None, seconds=20.0):
    """The node exits by itself with a status that is not 0, and its message has the words; the memory stays small."""
    path = path or arena.write("scene/wrong_%d.yaml" % next(counter), content)
    node = arena.start_node("scene_%d" % next(counter), {"scene_file": path})
    try:
        status = node.wait_for_end(seconds)
        expect(status is not None, "it runs on: " + shortened(node.log()[-300:]))
        expect(status > 0, "it ended with %d: %s" % (status, node.why_dead()))
        missing = [word for word in words + (os.path.basename(path),) if word not in node.log()]
        expect(not missing, "the message does not name %s: %s" % (", ".join(missing), shortened(node.log()[-300:])))
        expect(node.memory.peak_mb < 1000.0 * arena.memory_factor, "it took %.0f MB" % node.memory.peak_mb)
    finally:
        arena.stop_node()


def serves(arena, content, problems=(), parameters=None):
    """The node comes up and reports a problem with each of the words."""
    path = arena.write("scene/odd_%d.yaml" % next(counter), content)
    node = arena.start_node("scene_%d" % next(counter), dict({"scene_file": path}, **(parameters or {})))
    try:
        listed = node.wait_until_ready(30.0)
        reported = " ".join(problem.where + " " + problem.message for problem in listed.problems)
        missing = [word for word in problems if word not in reported]
        expect(not missing, "not reported: %s in %s" % (", ".join(missing), shortened(reported)))
        return listed
    finally:
        arena.stop_node()


BOMB = "x0: &x0 [a, a, a, a, a, a, a, a, a, a]\n" + "".join(
    "x%d: &x%d [%s]\n" % (level, level, ", ".join(["*x%d" % (level - 1)] * 10)) for level in range(1, 12))
WRONG = {
    "binary": bytes(range(256)) * 100, "zeros": bytes(10000), "ten_megabytes_of_text": "a" * 10**7,
    "ten_megabytes_of_keys": "".join("key_%d: 1\n" % index for index in range(10**6)),
    "deep_lists": "bodies: " + "[" * 100000, "deep_maps": "bodies: " + "{a: " * 50000,
    "deep_closed_lists": "bodies: " + "[" * 30000 + "]" * 30000, "deep_dashes": "- " * 100000,
    "alias_bomb": BOMB + "bodies:\n" + PAIR, "alias_bomb_as_bodies": BOMB + "bodies: *x11\n",
    "alias_of_itself": "bodies: &b [*b]\n", "alias_unknown": "bodies: *nothing\n", "unknown_key": "boddies:\n" + PAIR,
    "tab": "bodies:\n\t- {name: a}\n", "not_closed": "bodies: [{name: a", "list": "- a\n- b\n", "number": "17\n",
    "tag": "!!python/object/apply:os.system ['id']\n", "bodies_of_a_text": "bodies: many\n",
    "body_without_geometry": "bodies:\n  - {name: a}\n", "body_twice": "bodies:\n" + PAIR + PAIR,
    "body_with_a_pattern_as_name": "bodies:\n  - {name: 'a*', box: {size: [1, 1, 1]}}\n",
    "size_nan": "bodies:\n  - {name: a, box: {size: [.nan, 1, 1]}}\n",
    "pose_inf": "bodies:\n  - {name: a, box: {size: [1, 1, 1]}, pose: {xyz: [.inf, 0, 0]}}\n",
    "quaternion_of_zeros": "bodies:\n  - {name: a, box: {size: [1, 1, 1]}, pose: {quaternion: [0, 0, 0, 0]}}\n",
    "pair_unknown": "bodies:\n" + PAIR + "pairs:\n  - {between: [a, c]}\n",
    "pair_name_twice": "bodies:\n" + PAIR + "  - {name: c, box: {size: [1, 1, 1]}}\npairs:\n"
                       "  - {between: [a, b], name: x}\n  - {between: [a, c], name: x}\n",
    "pair_of_one": "bodies:\n" + PAIR + "pairs:\n  - {between: [a]}\n",
    "group_of_itself": "bodies:\n" + PAIR + "groups:\n  g: [g]\n",
    "key_twice": "bodies:\n" + PAIR + "bodies:\n" + PAIR, "cutoff_negative": "bodies:\n" + PAIR + "defaults: {cutoff: -1}\n",
    "seed_1e300": "bodies:\n" + PAIR + "defaults: {seed: 1e300}\n",
    "largest_niche_count_4e9": "bodies:\n" + PAIR + "defaults: {largest_niche_count: 99999999999999999999}\n",
    "two_documents": "bodies:\n" + PAIR + "---\nbodies:\n" + PAIR,
    "frame_with_blank": "bodies:\n  - {name: a, frame: 'a b', box: {size: [1, 1, 1]}}\n",
    "frame_slash": "bodies:\n  - {name: a, frame: /, box: {size: [1, 1, 1]}}\n",
}
for label, wrong in WRONG.items():
    group.add(label, lambda arena, content=wrong: ends(arena, content, seconds=60.0), deadline=90.0,
              fast=label == "alias_bomb")
for label, place in {"missing": "/no/such/scene.yaml", "folder": "/tmp", "dev_zero": "/dev/zero", "dev_full": "/dev/full",
                     "own_memory": "/proc/self/mem"}.items():
    group.add("file_is_" + label, lambda arena, place=place: ends(arena, "", path=place), deadline=90.0)


@group.attack(deadline=90.0)
def file_is_a_fifo(arena):
    path = arena.path("scene/fifo.yaml")
    if not os.path.exists(path):
        os.mkfifo(path)
    ends(arena, "", path=path)


@group.attack(deadline=90.0)
def empty(arena):
    """An empty file: the node ends with an error, or serves no bodies."""
    path = arena.write("scene/empty.yaml", "")
    node = arena.start_node("scene_empty", {"scene_file": path})
    try:
        if node.wait_for_end(3.0) is None:
            expect(not node.wait_until_ready().bodies, "it has bodies")
        else:
            expect(node.process.poll() > 0, "it ended: " + node.why_dead())
    finally:
        arena.stop_node()


@group.attack(deadline=90.0)
def meshes_that_are_missing(arena):
    listed = serves(arena, "bodies:\n" + PAIR + "  - {name: c, mesh: none.stl}\n  - {name: d, mesh: package://none/d.stl}\n",
                    ("none.stl", "package://none/d.stl"))
    expect(len(listed.bodies) == 2, "%d bodies" % len(listed.bodies))


@group.attack(deadline=90.0)
def hundred_groups_of_groups(arena):
    groups = "".join("  g%d: [%s]\n" % (index, ", ".join(["g%d" % (index - 1)] * 10) if index else "a, b")
                     for index in range(100))
    serves(arena, "bodies:\n" + PAIR + "groups:\n" + groups + "pairs:\n  - {between: [g99, g99]}\n")


@group.attack(deadline=120.0)
def two_thousand_bodies_without_pairs(arena):
    """The node comes up and stays small."""
    bodies = "".join("  - {name: b%d, box: {size: [1, 1, 1]}}\n" % index for index in range(2000))
    path = arena.write("scene/many.yaml", "bodies:\n" + bodies + "pairs: []\n")
    node = arena.start_node("scene_many", {"scene_file": path})
    try:
        listed = node.wait_until_ready(90.0)
        expect(len(listed.bodies) == 2000, "%d bodies" % len(listed.bodies))
        expect(node.memory.peak_mb < 1000.0 * arena.memory_factor, "it took %.0f MB" % node.memory.peak_mb)
    finally:
        arena.stop_node()


@group.attack(deadline=120.0)
def eighty_bodies_with_every_pair(arena):
    """3160 pairs: the node comes up, and tracks the motion of two of the bodies."""
    bodies = "".join("  - {name: b%d, frame: world, pose: {xyz: [%d, 5, 0]}, box: {size: [1, 1, 1]}}\n" % (
        index, 2 * index) for index in range(78))
    boxes = "".join("  - {name: box_%s, box: {size: [1, 1, 1]}}\n" % letter for letter in "ab")
    path = arena.write("scene/pairs.yaml", "bodies:\n" + boxes + bodies + "pairs:\n  - {between: [box_a, box_b], "
                       "name: boxes}\n  - {between: ['*', '*']}\n")
    node = arena.start_node("scene_pairs", {"scene_file": path})
    try:
        node.wait_until_ready(60.0)
        arena.listen()
        arena.require_tracking(60.0)
    finally:
        arena.stop_node()


URDFS = {
    "empty": "", "text": "robot", "binary": xmlrpc.client.Binary(bytes(range(256))), "not_closed": "<robot name='r'><link name='a'>",
    "deep": "<robot name='r'>" + "<link name='a'>" * 20000, "no_links": "<robot name='r'/>",
    "loop": "<robot name='r'><link name='a'/><link name='b'/><joint name='x' type='fixed'><parent link='a'/>"
            "<child link='b'/></joint><joint name='y' type='fixed'><parent link='b'/><child link='a'/></joint></robot>",
    "mesh_outside": "<robot name='r'><link name='a'><collision><geometry><mesh filename='/dev/zero'/></geometry>"
                    "</collision></link></robot>",
    "scale_nan": "<robot name='r'><link name='a'><collision><geometry><mesh filename='package://concave_distance/meshes/"
                 "demo/hook.stl' scale='nan 1 1'/></geometry></collision></link></robot>",
    "box_inf": "<robot name='r'><link name='a'><collision><geometry><box size='inf 1 1'/></geometry></collision></link>"
               "</robot>",
    "origin_nan": "<robot name='r'><link name='a'><collision><origin xyz='nan 0 0'/><geometry><box size='1 1 1'/>"
                  "</geometry></collision></link></robot>",
    "entities": "<!DOCTYPE x [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;'>]><robot name='&b;'/>",
    "long_names": "<robot name='r'><link name='" + "n" * 10**6 + "'/></robot>",
}


def robot(arena, text):
    """A wrong robot is reported: the node serves the rest, or waits and says why."""
    arena.set_parameter("/hostile_robot", text)
    node = arena.start_node("scene_robot_%d" % next(counter), {"robot_description": "/hostile_robot", "scene_file": ""})
    try:
        arena.wait_until(lambda: node.list_bodies().ready or node.list_bodies().message, 30.0, "neither ready nor a reason")
        listed = node.list_bodies()
        expect(listed.ready or listed.message, "not ready, and no reason")
        expect(not listed.bodies, "it has bodies")
    finally:
        arena.stop_node()
        arena.delete_parameter("/hostile_robot")


for label, urdf in URDFS.items():
    group.add("robot_" + label, lambda arena, urdf=urdf: robot(arena, urdf), deadline=90.0)
