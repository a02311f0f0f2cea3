"""Message and service classes made from definitions that come with a connection, so that no package of theirs is needed.

In: a type, the definition that its publisher sends, its md5sum. Out: classes by type, and every field that is missing or
of another type, in words.
"""

import functools
import hashlib
import re
import struct

import genmsg
import genpy
import genpy.dynamic


class WrongDefinition(Exception):
    """Why a definition cannot be used at all."""


def classes_from(type_name, definition, md5sum=None):
    """Classes by type of a definition and all that it names.

    Raises WrongDefinition where the text cannot be read or is not that of the md5sum that comes with it.
    """
    checked = _without_comments(type_name, definition)
    try:
        classes = _generated(type_name, checked)
    except Exception as problem:  # The generator lets errors of several modules through.
        raise WrongDefinition("the definition of %s cannot be read: %s" % (type_name, problem))
    made = classes[type_name]._md5sum
    if md5sum not in (None, "*", made):
        raise WrongDefinition("the definition of %s has md5sum %s, but its connection says %s; rebuild the publisher" % (
            type_name, made, md5sum))
    return classes


_LARGEST_TEXT = 1000000  # characters
_NAME = r"[A-Za-z][A-Za-z0-9_]*"
_LINES = re.compile(r"|".join((
    r"={80}", r"MSG: NAME/NAME", r"NAME(/NAME)?(\[[0-9]*\])?\s+NAME",
    r"NAME\s+NAME\s*=\s*([-+]?[0-9][0-9A-Fa-fxXeE.+-]*|True|False)")).replace("NAME", _NAME))


def _without_comments(type_name, definition):
    """The lines of a definition that count. The generator writes names and constants into Python code as they are, so
    that a publisher could have any code run: lines that are nothing but a field, a number, a type or a rule pass."""
    if len(definition) > _LARGEST_TEXT:
        raise WrongDefinition("the definition of %s has %d characters (at most %d are read)" % (
            type_name, len(definition), _LARGEST_TEXT))
    kept = []
    for number, line in enumerate(definition.split("\n"), 1):
        line = line.split("#")[0].strip()
        if line and not _LINES.fullmatch(line):
            raise WrongDefinition("line %d of the definition of %s is '%.100s', which is neither a field nor a constant "
                                  "that is a number" % (number, type_name, line))
        kept += [line] if line else []
    return "\n".join(kept) + "\n"


@functools.lru_cache(maxsize=8)
def _generated(type_name, definition):
    """It takes a second; publishers come again with the same definition."""
    return genpy.dynamic.generate_dynamic(type_name, definition)


def field_faults(classes, fields):
    """What is missing or different, as (type, field, sentence).

    fields: rows of type, field, type of the field, what follows where it is missing.
    """
    faults = []
    for type_name, field, field_type, consequence in fields:
        if type_name not in classes:
            continue  # The field that would hold it is reported.
        slots = dict(zip(classes[type_name].__slots__, classes[type_name]._slot_types))
        if field not in slots:
            faults.append((type_name, field, "%s has no field '%s' (%s): %s" % (
                type_name, field, field_type, consequence)))
        elif slots[field] != field_type:
            faults.append((type_name, field, "%s has field '%s' as %s, not %s: %s" % (
                type_name, field, slots[field], field_type, consequence)))
    return faults


def text_md5(type_name, definition):
    """The md5sum of a message that names no other one, and the text it is made of."""
    context = genmsg.MsgContext.create_default()
    spec = genmsg.msg_loader.load_msg_from_string(context, definition, type_name)
    text = genmsg.gentools.compute_md5_text(context, spec)
    return hashlib.md5(text.encode()).hexdigest(), text


# PlanningSceneComponents: names and bits; 0 asks for all of them.
_COMPONENTS = "".join("uint32 %s=%d\n" % (name, 1 << bit) for bit, name in enumerate((
    "SCENE_SETTINGS", "ROBOT_STATE", "ROBOT_STATE_ATTACHED_OBJECTS", "WORLD_OBJECT_NAMES", "WORLD_OBJECT_GEOMETRY",
    "OCTOMAP", "TRANSFORMS", "ALLOWED_COLLISION_MATRIX", "LINK_PADDING_AND_SCALING", "OBJECT_COLORS"))
) + "uint32 components\n"


def planning_scene_service(scene_class):
    """The class of moveit_msgs/GetPlanningScene for the PlanningScene class of a publisher: a service sends no
    definition, so that request and response are written by hand around it."""
    components_md5, _ = text_md5("moveit_msgs/PlanningSceneComponents", _COMPONENTS)

    class Request(genpy.Message):
        _type = "moveit_msgs/GetPlanningSceneRequest"
        _full_text = "PlanningSceneComponents components\n"
        __slots__ = ["components"]
        _slot_types = ["uint32"]

        def __init__(self, components=0):
            self.components = components

        def serialize(self, buffer):
            buffer.write(struct.pack("<I", self.components))

        def deserialize(self, text):
            (self.components,) = struct.unpack("<I", text[:4])
            return self

    class Response(genpy.Message):
        _type = "moveit_msgs/GetPlanningSceneResponse"
        _full_text = "PlanningScene scene\n"
        __slots__ = ["scene"]
        _slot_types = ["moveit_msgs/PlanningScene"]

        def __init__(self, scene=None):
            self.scene = scene or scene_class()

        def serialize(self, buffer):
            self.scene.serialize(buffer)

        def deserialize(self, text):
            self.scene = scene_class()
            self.scene.deserialize(text)
            return self

    text = "%s components%s scene" % (components_md5, scene_class._md5sum)
    Request._md5sum = Response._md5sum = hashlib.md5(text.encode()).hexdigest()

    class GetPlanningScene(object):
        _type = "moveit_msgs/GetPlanningScene"
        _md5sum = Request._md5sum
        _request_class = Request
        _response_class = Response

    return GetPlanningScene
