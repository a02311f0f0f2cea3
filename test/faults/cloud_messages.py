"""Clouds and maps as bytes, so that every count in them may lie, and publishers of such bytes."""

import struct
import sys

import genpy
import processes
import ros_wire
import rospy
from arena import REPOSITORY
from sensor_msgs.msg import PointCloud2, PointField

OCTOMAP_TEXT = ("Header header\nbool binary\nstring id\nfloat64 resolution\nint8[] data\n" + "=" * 80 +
                "\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n")
OCTOMAP_MD5 = "9a45536b45c5e409cd49f04bb2d9999f"
FLOAT32, FLOAT64 = PointField.FLOAT32, PointField.FLOAT64
# An octomap of one occupied leaf of 16 levels: each node has one child, the first.
ONE_CELL = b"\x03\x00" * 15 + b"\x02\x00"


def bytes_class(type_name, md5sum, text):
    """A class of messages that are bytes, under the name of another type."""
    class Bytes(genpy.Message):
        _type, _md5sum, _full_text = type_name, md5sum, text
        __slots__, _slot_types = ["data"], ["uint8[]"]

        def __init__(self, data=b""):
            self.data = data

        def serialize(self, buffer):
            buffer.write(self.data)
    return Bytes


CLOUD = bytes_class(PointCloud2._type, PointCloud2._md5sum, PointCloud2._full_text)
OCTOMAP = bytes_class("octomap_msgs/Octomap", OCTOMAP_MD5, OCTOMAP_TEXT)


def cloud(points, stamp=None, frame="world", big_endian=False, kind=FLOAT32, **fields):
    """A PointCloud2 of points; `fields` replace those of the message."""
    code = "d" if kind == FLOAT64 else "f"
    size = struct.calcsize(code)
    message = PointCloud2(height=1, width=len(points), point_step=3 * size, row_step=3 * size * len(points),
                          is_bigendian=big_endian)
    message.header.frame_id = frame
    message.header.stamp = rospy.Time.now() if stamp is None else stamp
    message.fields = [PointField(name, i * size, kind, 1) for i, name in enumerate("xyz")]
    numbers = [number for point in points for number in point]
    message.data = struct.pack((">" if big_endian else "<") + "%d%s" % (len(numbers), code), *numbers)
    for name, value in fields.items():
        setattr(message, name, value)
    return message


def cloud_bytes(message, replace=()):
    """Its bytes, with pairs of bytes of equal length replaced."""
    body = ros_wire.serialized(message)
    for old, new in replace:
        if len(old) != len(new) or body.count(old) != 1:
            raise ValueError("cannot replace %r by %r" % (old, new))
        body = body.replace(old, new)
    return body


def octomap_bytes(data=ONE_CELL, name=b"OcTree", resolution=0.1, binary=1, frame=b"world", data_count=None):
    now = rospy.Time.now()
    return (struct.pack("<III", 0, now.secs, now.nsecs) + struct.pack("<I", len(frame)) + frame +
            struct.pack("<BI", binary, len(name)) + name + struct.pack("<d", resolution) +
            struct.pack("<I", len(data) if data_count is None else data_count) + data)


SENDER = """
import sys, time
sys.path[:0] = [sys.argv[1]]
import rospy
from cloud_messages import bytes_class
rospy.init_node("rival", anonymous=True, disable_signals=True)
kind = bytes_class(sys.argv[3], sys.argv[4], open(sys.argv[5]).read())
body = open(sys.argv[6], "rb").read()
sender = rospy.Publisher(sys.argv[2], kind, queue_size=10)
while True:
    sender.publish(kind(body))
    time.sleep(0.05)
"""


def start_rival(arena, topic, type_name, md5sum, text, body):
    """A publisher of another process that sends bytes as a type until it is ended."""
    command = [sys.executable, arena.write("rival/sender.py", SENDER), REPOSITORY + "/test/faults", topic, type_name, md5sum,
               arena.write("rival/definition", text), arena.write("rival/body", body)]
    with open(arena.path("logs/rival.log"), "wb") as log:
        return processes.start(command, arena.environment, log)
