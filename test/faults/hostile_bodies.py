"""Bodies that the node must refuse to add."""

import itertools
import os
import time

from attacks import Group, expect
from request_checks import MEGABYTE, ask, call, require_refused, require_sound

group = Group("bodies", {})
counter = itertools.count()

HOOK = "package://concave_distance/meshes/demo/hook.stl"
NAN, INF = float("nan"), float("inf")
BOX = {"frame_id": "world", "pose__orientation__w": 1.0, "primitive": "box", "dimensions": [0.1, 0.1, 0.1],
       "pair_with": ["box_b"]}


def add(arena, timeout=20.0, replace=(), **fields):
    values = dict(BOX, name="added_%d" % next(counter))
    values.update(fields)
    response = call(arena, "add_body", timeout, replace, **values)
    if response.success:
        remove(arena, values["name"])
    return response


def remove(arena, name):
    response = call(arena, "remove_body", name=name)
    expect(response.success, "an added body cannot be removed: " + response.message)


def refuse(label, words, **fields):
    """Bodies that are refused with a message that contains one of the words."""
    fields.setdefault("fast", False)
    fast = fields.pop("fast")
    group.add(label, lambda arena: require_refused(add(arena, **fields), *words), fast=fast)


def answer(label, deadline=30.0, **fields):
    """Bodies that may be accepted, or refused with the reason; the node goes on."""
    group.add(label, lambda arena: require_sound(add(arena, **fields)), deadline=deadline)


NAMES = {"empty": "", "with_blank": "a b", "of_a_megabyte": MEGABYTE, "unicode": "b\u00f6x", "with_nul": "box\0x",
         "path": "../../etc", "digit_first": "1box", "slash_last": "box/", "newline": "box\nx", "pattern": "*",
         "in_use": "box_a"}
for key, text in NAMES.items():
    refuse("name_" + key, ("name",), name=text)
FRAMES = {"empty": "", "slash": "/", "with_blank": "a b", "with_nul": "world\0", "of_a_megabyte": MEGABYTE,
          "newline": "a\nb", "slashes": "//"}
for key, text in FRAMES.items():
    refuse("frame_" + key, ("frame",), frame_id=text)


@group.attack()
def frame_that_does_not_exist(arena):
    """The frame may come later: accepted, with a warning that names it."""
    mark = arena.node.log_length()
    values = dict(BOX, name="waits", frame_id="not_there_yet")
    response = call(arena, "add_body", **values)
    expect(response.success, "refused: " + response.message)
    try:
        arena.wait_until(lambda: "not_there_yet" in response.message or "not_there_yet" in arena.node.log(mark), 15.0,
                         "neither the response nor the log names the frame that is not there")
    finally:
        remove(arena, "waits")


for key, value in {"nan": NAN, "inf": INF, "minus_inf": -INF, "1e308": 1e308, "1e200": 1e200}.items():
    refuse("position_" + key, ("pose", "position", "reaches"), pose__position__x=value)
for key, value in {"nan": NAN, "inf": INF, "two": 2.0, "1e308": 1e308, "denormal": 5e-324}.items():
    refuse("quaternion_" + key, ("quaternion", "rotation", "orientation", "pose"), pose__orientation__w=value)


@group.attack(fast=True)
def quaternion_of_zeros(arena):
    """As in an empty message: the identity, or a refusal."""
    response = add(arena, pose__orientation__w=0.0)
    if not response.success:
        require_refused(response, "quaternion")


refuse("primitive_unknown", ("primitive",), primitive="teapot")
refuse("primitive_of_a_megabyte", ("primitive",), primitive=MEGABYTE)
refuse("neither_mesh_nor_primitive", ("mesh", "primitive"), primitive="")
refuse("mesh_and_primitive", ("mesh", "primitive"), mesh_resource=HOOK)
SIZES = {"zero": 0.0, "negative": -1.0, "nan": NAN, "inf": INF, "1e300": 1e300, "1e200": 1e200}
for key, value in SIZES.items():
    refuse("box_" + key, ("dimensions", "size", "box", "reaches"), dimensions=[value, 1.0, 1.0])
    refuse("sphere_" + key, ("dimensions", "radius", "sphere", "reaches"), primitive="sphere", dimensions=[value])
    refuse("cylinder_length_" + key, ("dimensions", "length", "cylinder", "reaches"), primitive="cylinder",
           dimensions=[0.1, value])


def tiny(arena, right_distance, **fields):
    """An extremely thin body: refused, or its distance to box_b is right."""
    name = "tiny_%d" % next(counter)
    response = call(arena, "add_body", **dict(BOX, name=name, **fields))
    if not response.success:
        require_refused(response)
        return
    try:
        answer = ask(arena, body_a=name)
        expect(answer.success and abs(answer.result.nearest.distance - right_distance) < 2e-3,
               "a distance of %r instead of %r" % (answer.result.nearest.distance, right_distance))
    finally:
        remove(arena, name)


for key, value in {"1e-300": 1e-300, "denormal": 5e-324}.items():
    group.add("box_" + key, lambda arena, value=value: tiny(arena, 1.5, dimensions=[value, 1.0, 1.0]))
    group.add("sphere_" + key, lambda arena, value=value: tiny(arena, 1.5, primitive="sphere", dimensions=[value]))
    group.add("cylinder_length_" + key, lambda arena, value=value: tiny(
        arena, 1.4, primitive="cylinder", dimensions=[0.1, value]))
    group.add("mesh_scale_" + key, lambda arena, value=value: require_sound(add(
        arena, primitive="", dimensions=[], mesh_resource=HOOK, scale__x=value, scale__y=1.0, scale__z=1.0)))
refuse("capsule_radius_nan", ("dimensions", "radius"), primitive="capsule", dimensions=[NAN, 0.1])
refuse("capsule_length_negative", ("dimensions", "length"), primitive="capsule", dimensions=[0.1, -0.1])
refuse("box_without_dimensions", ("dimensions",), dimensions=[], fast=True)
refuse("box_of_two_dimensions", ("dimensions",), dimensions=[1.0, 1.0])
refuse("sphere_of_four_dimensions", ("dimensions",), primitive="sphere", dimensions=[1.0] * 4)
refuse("box_of_100000_dimensions", ("dimensions",), dimensions=[1.0] * 100000)
answer("box_needle", dimensions=[1e-9, 1e-9, 1e6])
answer("cylinder_sheet", primitive="cylinder", dimensions=[1e3, 1e-9])
for key, value in {"negative": -1.0, "nan": NAN}.items():
    refuse("max_edge_length_" + key, ("max_edge_length",), max_edge_length=value)
    refuse("chord_error_" + key, ("chord_error", "chord error"), primitive="sphere", dimensions=[0.1],
           chord_error=value)
for key, value in {"2_mm_on_a_metre": 0.002, "1e-9": 1e-9, "denormal": 5e-324, "1e300": 1e300}.items():
    answer("max_edge_length_" + key, dimensions=[1.0, 1.0, 1.0], max_edge_length=value, deadline=20.0)
for key, value in {"1e-9": 1e-9, "denormal": 5e-324, "1e300": 1e300, "inf": INF}.items():
    answer("chord_error_" + key, primitive="sphere", dimensions=[1.0], chord_error=value, deadline=20.0)
PARTNERS = {"unknown": ["nobody"], "empty_name": [""], "of_a_megabyte": [MEGABYTE], "with_nul": ["box_b\0"]}
for key, partners in PARTNERS.items():
    refuse("pair_with_" + key, ("pair_with", "body"), pair_with=partners)
refuse("pair_with_itself", ("pair_with",), name="itself", pair_with=["itself"])
answer("pair_with_100000_times_the_same", pair_with=["box_b"] * 100000)
for key, value in {"negative": -1.0, "nan": NAN}.items():
    refuse("warning_distance_" + key, ("warning_distance",), has_warning_distance=True, warning_distance=value)
    refuse("warning_hysteresis_" + key, ("warning",), has_warning_distance=True, warning_hysteresis=value)
answer("colour_nan", color__r=NAN, color__a=1.0)
answer("colour_1e30", color__g=1e30, color__a=-1.0)

# Files

for key, value in {"nan": NAN, "inf": INF, "zero": 0.0, "1e300": 1e300}.items():
    refuse("scale_" + key, ("scale", "size", "finite", "mesh"), primitive="", dimensions=[], mesh_resource=HOOK,
           scale__x=value, scale__y=1.0, scale__z=1.0)
RESOURCES = {
    "dev_zero": "file:///dev/zero", "dev_random": "/dev/urandom", "stdin": "/dev/stdin", "tty": "/dev/tty",
    "passwd": "/etc/passwd", "shadow": "file:///etc/shadow", "own_memory": "/proc/self/mem", "kcore": "/proc/kcore",
    "kernel_messages": "/proc/kmsg", "package_upwards": "package://../../etc/passwd",
    "package_path_upwards": "package://concave_distance/../../../../../../etc/passwd",
    "package_unknown": "package://no_such_package/a.stl", "package_empty": "package://", "package_only":
    "package://concave_distance", "http": "http://localhost:1/a.stl", "ftp": "ftp://localhost/a.stl",
    "folder": "/tmp", "root": "/", "relative": "hook.stl", "file_only": "file://", "file_nul": "file:///tmp/a\0.stl",
    "percent_nul": "file:///etc/passwd%00.stl", "blank": " ", "name_of_a_megabyte": "/" + MEGABYTE,
    "percent": "file:///%zz%", "upwards": "file:///../../../../dev/zero", "scheme": "exec://touch/x",
    "package_url": "package://concave_distance/meshes/../../../../../../../dev/zero",
}
for key, resource in RESOURCES.items():
    refuse("mesh_" + key, (), primitive="", dimensions=[], mesh_resource=resource)


def refused_file(arena, path, *words):
    require_refused(add(arena, primitive="", dimensions=[], mesh_resource=path), *words)


@group.attack(deadline=15.0)
def mesh_that_is_a_fifo(arena):
    path = arena.path("scene/meshes/fifo.stl")
    if not os.path.exists(path):
        os.mkfifo(path)
    refused_file(arena, path)


@group.attack()
def mesh_that_is_a_folder_beside_the_scene(arena):
    os.makedirs(arena.path("scene/meshes/folder.stl"), exist_ok=True)
    refused_file(arena, arena.path("scene/meshes/folder.stl"), "folder.stl")


@group.attack()
def mesh_that_is_a_link_to_itself(arena):
    path = arena.path("scene/meshes/loop.stl")
    if not os.path.islink(path):
        os.symlink("loop.stl", path)
    refused_file(arena, path, "loop.stl")


def link_to(arena, name, target):
    path = arena.path("scene/meshes/" + name)
    if not os.path.islink(path):
        os.symlink(target, path)
    return path


@group.attack(deadline=15.0)
def mesh_that_is_a_link_to_dev_zero(arena):
    refused_file(arena, link_to(arena, "zero.stl", "/dev/zero"))


@group.attack(deadline=15.0)
def mesh_that_is_a_link_out_of_the_scene(arena):
    outside = arena.write("outside/mesh.stl", open(arena.path("scene/meshes/hook.stl"), "rb").read())
    refused_file(arena, link_to(arena, "outside.stl", outside))


@group.attack(deadline=15.0)
def mesh_outside_of_the_roots_tells_nothing(arena):
    """A valid mesh, another file, a secret file and a missing one: the same refusal."""
    good = arena.write("outside/mesh.stl", open(arena.path("scene/meshes/hook.stl"), "rb").read())
    texts = set()
    for path in (good, arena.path("outside/none.stl"), "/etc/shadow", "/etc/passwd", "/root/.bashrc", "/root/none"):
        response = add(arena, name="stranger", primitive="", dimensions=[], mesh_resource=path)
        expect(not response.success, path + " was read")
        texts.add(response.message.replace(path, "PATH"))
    expect(len(texts) == 1, "different refusals: " + " / ".join(sorted(texts)))


@group.attack(deadline=15.0)
def good_mesh_beside_the_scene(arena):
    """Allowed files still work."""
    response = add(arena, primitive="", dimensions=[], mesh_resource=arena.path("scene/meshes/hook.stl"))
    expect(response.success, response.message)
    response = add(arena, primitive="", dimensions=[], mesh_resource=HOOK)
    expect(response.success, response.message)


def add_and_remove(arena, count):
    """Each call is fast, and removing frees the memory."""
    slowest = 0.0
    names = ["many_%d" % index for index in range(count)]
    for index, name in enumerate(names):
        began = time.monotonic()
        response = call(arena, "add_body", **dict(BOX, name=name, pose__position__x=float(index)))
        slowest = max(slowest, time.monotonic() - began)
        expect(response.success, response.message)
    for name in names:
        remove(arena, name)
    expect(slowest <= 2.0 * arena.patience, "an add_body took %.1f s" % slowest)


@group.attack(deadline=60.0, growth_mb=200.0)
def fifty_boxes(arena):
    add_and_remove(arena, 50)


@group.attack(deadline=120.0, growth_mb=200.0, storms=False)
def thousand_boxes(arena):
    """Too long for a storm: its bodies would be there most of the time."""
    add_and_remove(arena, 1000)
