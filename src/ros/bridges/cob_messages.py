"""The messages that cob_twist_controller takes: the classes of cob_control_msgs and cob_srvs where they are installed,
else made here from the same fields, with the same names and md5sums."""

import hashlib
import importlib
import struct

import genpy

from message_definitions import WrongDefinition, classes_from, field_faults

DISTANCES, DISTANCE = "cob_control_msgs/ObstacleDistances", "cob_control_msgs/ObstacleDistance"
_LINE = "\n" + "=" * 80 + "\n"
DEFINITION = _LINE.join(("ObstacleDistance[] distances\n", "MSG: " + DISTANCE + """
Header header
string link_of_interest
string obstacle_id
float64 distance
geometry_msgs/Vector3 frame_vector
geometry_msgs/Vector3 nearest_point_frame_vector
geometry_msgs/Vector3 nearest_point_obstacle_vector
""", """MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
""", """MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
"""))
_FIELDS = tuple((DISTANCE, name, kind, "nothing can be published") for name, kind in (
    ("header", "std_msgs/Header"), ("link_of_interest", "string"), ("obstacle_id", "string"), ("distance", "float64"),
    ("frame_vector", "geometry_msgs/Vector3"), ("nearest_point_frame_vector", "geometry_msgs/Vector3"),
    ("nearest_point_obstacle_vector", "geometry_msgs/Vector3")))


def message_classes(load=importlib.import_module):
    """ObstacleDistances and ObstacleDistance. Raises WrongDefinition where those installed have other fields."""
    try:
        module = load("cob_control_msgs.msg")
        classes = {DISTANCES: module.ObstacleDistances, DISTANCE: module.ObstacleDistance}
    except ImportError:
        classes = classes_from(DISTANCES, DEFINITION)
    faults = field_faults(classes, ((DISTANCES, "distances", DISTANCE + "[]", "nothing can be published"),) + _FIELDS)
    if faults:
        raise WrongDefinition("; ".join(text for _, _, text in faults))
    return classes[DISTANCES], classes[DISTANCE]


def registration_class(load=importlib.import_module):
    """The class of cob_srvs/SetString."""
    try:
        return load("cob_srvs.srv").SetString
    except ImportError:
        return _made_set_string()


def _made_set_string():
    md5 = hashlib.md5(b"string databool success\nstring message").hexdigest()

    def read_string(text, at):
        (length,) = struct.unpack_from("<I", text, at)
        return text[at + 4:at + 4 + length].decode("utf-8", "replace"), at + 4 + length

    def write_string(buffer, text):
        encoded = text.encode("utf-8")
        buffer.write(struct.pack("<I", len(encoded)) + encoded)

    class SetStringRequest(genpy.Message):
        _type, _md5sum, _full_text = "cob_srvs/SetStringRequest", md5, "string data\n"
        __slots__, _slot_types = ["data"], ["string"]

        def __init__(self, data=""):
            self.data = data

        def serialize(self, buffer):
            write_string(buffer, self.data)

        def deserialize(self, text):
            self.data, _ = read_string(text, 0)
            return self

    class SetStringResponse(genpy.Message):
        _type, _md5sum, _full_text = "cob_srvs/SetStringResponse", md5, "bool success\nstring message\n"
        __slots__, _slot_types = ["success", "message"], ["bool", "string"]

        def __init__(self, success=False, message=""):
            self.success, self.message = success, message

        def serialize(self, buffer):
            buffer.write(struct.pack("<B", self.success))
            write_string(buffer, self.message)

        def deserialize(self, text):
            self.success = text[0] != 0
            self.message, _ = read_string(text, 1)
            return self

    class SetString(object):
        _type, _md5sum = "cob_srvs/SetString", md5
        _request_class, _response_class = SetStringRequest, SetStringResponse

    return SetString
