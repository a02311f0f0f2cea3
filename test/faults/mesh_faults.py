"""Hostile mesh files: given to a running node, to mesh_tool, and to a node as its scene."""

import itertools
import math
import os
import struct
import threading

import hostile_meshes
import processes
from attacks import Group, expect, shortened
from request_checks import ask, call, require_refused

node_group = Group("meshes", {})
tool_group = Group("mesh_tool", beside=True)
scene_group = Group("mesh_scenes")
counter = itertools.count()
writing = threading.Lock()

SECONDS = 45.0      # for refusing a mesh: an import may take 30 s
GROWTH_MB = 1600.0  # of the node and its import process, which may take 1.5 GB


def resource_of(arena, name):
    """The hostile file, written when its attack begins; beside the scene, where the node may read meshes."""
    with writing:
        if not hasattr(arena, "hostile_paths"):
            arena.hostile_paths = {mesh.name: mesh.path for mesh in hostile_meshes.write_hostile_meshes(
                arena.path("scene/meshes/hostile"))}
    return arena.hostile_paths[name]


def add_hostile(arena, name, expectation):
    body = "hostile_%d" % next(counter)
    response = call(arena, "add_body", SECONDS, name=body, frame_id="world", mesh_resource=resource_of(arena, name),
                    pose__orientation__w=1.0, pair_with=["box_b"])
    if response.success:
        try:
            expect(expectation != hostile_meshes.REFUSED, "it was accepted")
            ask(arena, body_a=body)
        finally:
            call(arena, "remove_body", name=body)
    else:
        expect(expectation != hostile_meshes.SERVED, "a valid mesh was refused: " + response.message)
        require_refused(response, name)


def inspect_hostile(arena, path, expectation):
    status, text, _ = processes.run([arena.program("mesh_tool"), "inspect", path], SECONDS * arena.patience,
                                    arena.environment, arena.address_space_gb, arena.path("tool.log"),
                                    largest_mb=GROWTH_MB * arena.memory_factor)
    expect(status is not None, "mesh_tool does not end, or takes more than an import may")
    expect(status in (0, 1), "mesh_tool ended with %d: %s" % (status, shortened(text[-200:])))
    if status == 0:
        expect(expectation != hostile_meshes.REFUSED, "mesh_tool accepted it")
    else:
        expect(expectation != hostile_meshes.SERVED, "mesh_tool refused it: " + shortened(text))
        expect(os.path.basename(path) in text, "the message does not name the file: " + shortened(text))


def register_hostile_meshes():
    for file_name, expectation, _ in hostile_meshes._WRITERS:
        node_group.add(file_name, lambda arena, name=file_name, expectation=expectation:
                       add_hostile(arena, name, expectation), deadline=SECONDS + 10.0, growth_mb=GROWTH_MB)
        tool_group.add(file_name, lambda arena, name=file_name, expectation=expectation:
                       inspect_hostile(arena, resource_of(arena, name), expectation), deadline=SECONDS + 10.0)


register_hostile_meshes()


# Well-formed files with hostile shapes

def obj(vertices, faces):
    return "".join("v %r %r %r\n" % vertex for vertex in vertices) + "".join(
        "f " + " ".join(str(index + 1) for index in face) + "\n" for face in faces)


BOX_FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def box(x, y, z, size=(1.0, 1.0, 1.0)):
    return [(x + i * size[0], y + j * size[1], z + k * size[2]) for i in (0, 1) for j in (0, 1) for k in (0, 1)]


def boxes(*corners, size=(1.0, 1.0, 1.0)):
    """Closed boxes in one file, their corners not shared."""
    vertices, faces = [], []
    for corner in corners:
        faces += [tuple(index + len(vertices) for index in face) for face in BOX_FACES]
        vertices += box(*corner, size=size)
    return obj(vertices, faces)


def fan(count):
    """Triangles that share one edge."""
    vertices = [(0.0, 0.0, 0.0), (0.0, 0.0, 1.0)]
    vertices += [(math.cos(6.28 * i / count), math.sin(6.28 * i / count), 0.5) for i in range(count)]
    return obj(vertices, [(0, 1, 2 + i) for i in range(count)])


def grid_stl(count):
    """A binary STL with 2 count^2 triangles."""
    facets = bytearray(80) + struct.pack("<I", 2 * count * count)
    for i in range(count):
        for j in range(count):
            corners = [(i, j, 0.0), (i + 1, j, 0.0), (i + 1, j + 1, 0.0), (i, j + 1, 0.0)]
            for a, b, c in ((0, 1, 2), (0, 2, 3)):
                facets += struct.pack("<12fH", 0, 0, 1, *corners[a], *corners[b], *corners[c], 0)
    return bytes(facets)


SHAPES = {
    "coordinates_1e300.obj": lambda: boxes((0.0, 0.0, 0.0), size=(1e300,) * 3),
    "coordinates_1e-300.obj": lambda: boxes((0.0, 0.0, 0.0), size=(1e-300,) * 3),
    "far_away_1e200.obj": lambda: boxes((1e200, 0.0, 0.0)),
    "far_away_1e15.obj": lambda: boxes((1e15, 0.0, 0.0)),
    "one_corner_at_1e300.obj": lambda: boxes((0.0, 0.0, 0.0)) + "v 1e300 0 0\nf 1 2 9\n",
    "all_in_one_point.obj": lambda: obj([(1.0, 1.0, 1.0)] * 300, [(i, i + 1, i + 2) for i in range(298)]),
    "all_on_a_line.obj": lambda: obj([(0.1 * i, 0.0, 0.0) for i in range(300)], [(i, i + 1, i + 2) for i in range(298)]),
    "needles.obj": lambda: obj([(0.0, 1e-14 * i, 1e6 * (i % 2)) for i in range(300)],
                               [(i, i + 1, i + 2) for i in range(298)]),
    "thousand_triangles_on_an_edge.obj": lambda: fan(1000),
    "the_same_triangle_100000_times.obj": lambda: obj([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)],
                                                      [(0, 1, 2)] * 100000),
    "half_a_million_triangles.stl": lambda: grid_stl(500),
    "ten_thousand_shells.obj": lambda: boxes(*((2.0 * (i % 100), 2.0 * (i // 100), 0.0) for i in range(10000))),
}


def served_soundly(arena, name, content):
    """Refused with the file's name, or served with distances that are numbers."""
    path = arena.write("scene/meshes/shapes/" + name, content())
    body = "shape_%d" % next(counter)
    response = call(arena, "add_body", 60.0, name=body, frame_id="world", mesh_resource=path, pose__orientation__w=1.0,
                    pair_with=["box_b"])
    if not response.success:
        require_refused(response, name)
        return
    try:
        answer = ask(arena, body_a=body, pose_b__pose__position__x=50.0, timeout=30.0)
        expect(not answer.success or math.isfinite(answer.result.nearest.distance), "the distance is no number")
    finally:
        call(arena, "remove_body", name=body)


for shape, written in SHAPES.items():
    node_group.add(shape, lambda arena, name=shape, content=written: served_soundly(arena, name, content), deadline=90.0,
                   growth_mb=1200.0)

STACKS = {
    "two_boxes_with_a_common_face": [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)],
    "three_boxes_in_a_row": [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2.0, 0.0, 0.0)],
    "eight_boxes_in_a_block": [(i, j, k) for i in (0.0, 1.0) for j in (0.0, 1.0) for k in (0.0, 1.0)],
    "two_boxes_that_overlap": [(0.0, 0.0, 0.0), (0.5, 0.25, 0.25)],
    "two_boxes_that_are_the_same": [(0.0, 0.0, 0.0), (0.0, 0.0, 0.0)],
    "two_boxes_with_a_common_edge": [(0.0, 0.0, 0.0), (1.0, 1.0, 0.0)],
}


def inside_is_penetrating(arena, name, corners):
    """A small cube in the middle of each of the boxes penetrates, at every level with a proof and in both orders."""
    path = arena.write("scene/meshes/stacks/%s.obj" % name, boxes(*corners))
    body, cube = "stack_%d" % next(counter), "cube_%d" % next(counter)
    fields = {"frame_id": "world", "pose__orientation__w": 1.0, "pair_with": ["box_b"]}
    response = call(arena, "add_body", name=body, mesh_resource=path, **fields)
    expect(response.success, response.message)
    response = call(arena, "add_body", name=cube, primitive="box", dimensions=[0.1] * 3, **fields)
    expect(response.success, response.message)
    penetrating = arena.messages.PairStatus.PENETRATING
    try:
        for corner in corners:
            x, y, z = (coordinate + 0.5 for coordinate in corner)
            for level in (3, 4):
                place = {"position__x": x, "position__y": y, "position__z": z}
                for order, moved in (((body, cube), "pose_b"), ((cube, body), "pose_a")):
                    answer = ask(arena, body_a=order[0], body_b=order[1], accuracy=level,
                                 **dict({"pose_b__pose__position__x": 0.0},
                                        **{moved + "__pose__" + key: value for key, value in place.items()}))
                    nearest = answer.result.nearest
                    expect(nearest.status.code == penetrating, "%s at level %d: status %d, distance %.3f, lower bound %.3f "
                           "for a cube inside" % (order, level, nearest.status.code, nearest.distance,
                                                  nearest.lower_bound))
    finally:
        call(arena, "remove_body", name=body)
        call(arena, "remove_body", name=cube)


for stack, places in STACKS.items():
    node_group.add(stack, lambda arena, name=stack, corners=places: inside_is_penetrating(arena, name, corners),
                   fast=stack.startswith("two_boxes_with_a_common_face"))


# A scene with all of them

@scene_group.attack(deadline=240.0)
def scene_of_every_hostile_mesh(arena):
    """The node comes up, serves the rest and reports every file that it refused."""
    resource_of(arena, "empty.dae")
    bodies = ["  - {name: box_%s, box: {size: [1, 1, 1]}}" % letter for letter in "ab"]
    expected = []
    for index, (name, expectation, _) in enumerate(hostile_meshes._WRITERS):
        bodies.append("  - {name: hostile_%d, frame: world, mesh: meshes/hostile/%s}" % (index, name))
        if expectation == hostile_meshes.REFUSED:
            expected.append(name)
    scene = arena.write("scene/hostile.yaml", "bodies:\n" + "\n".join(bodies) +
                        "\npairs:\n  - {between: [box_a, box_b], name: boxes}\n")
    node = arena.start_node("hostile_scene", {"scene_file": scene})
    try:
        listed = node.wait_until_ready(200.0)
        reported = " ".join(problem.where + " " + problem.message for problem in listed.problems)
        silent = [name for name in expected if name not in reported]
        expect(not silent, "not reported: " + ", ".join(silent))
        arena.listen()
        arena.require_tracking()
    finally:
        arena.stop_node()
