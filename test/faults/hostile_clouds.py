"""Clouds and maps that lie, flood, or come as another type."""

import random
import struct
import time

import genpy
import processes
import rospy
from arena import SCENE
from attacks import Group, expect, shortened
from cloud_messages import (CLOUD, FLOAT64, OCTOMAP, OCTOMAP_MD5, OCTOMAP_TEXT, ONE_CELL, cloud, cloud_bytes,
                            octomap_bytes, start_rival)
from diagnostic_msgs.msg import DiagnosticArray
from sensor_msgs.msg import PointCloud2, PointField

CLOUDS = SCENE + """\
  - {between: [box_a, camera], name: seen}
  - {between: [box_a, fine], name: seen_fine}
  - {between: [box_a, map], name: mapped}
clouds:
  - {name: camera, topic: /seen, frame: world, voxel_size: 0.125, rate: 50, stale_after: 3}
  - {name: fine, topic: /seen_finely, frame: world, voxel_size: 0.0001, rate: 50, stale_after: 3}
  - {name: map, topic: /mapped, frame: world, stale_after: .inf}
"""
group = Group("clouds", {"scene": CLOUDS})
NAN, INF = float("nan"), float("inf")
POINT = (3.0625, 0.0625, 0.0625)  # in the voxel from 3.0 to 3.125; box_a reaches to 0.5
GAP = 2.5
ROUNDING = 1e-9


class Watch:
    """What the node says of its clouds: the last message of each pair, the values in /diagnostics."""

    def __init__(self, arena):
        self.pairs, self.values = {}, {}
        rospy.Subscriber(arena.node.name + "/distances", arena.messages.Distances, self.receive, queue_size=10)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.diagnose, queue_size=10)

    def receive(self, message):
        self.pairs = {pair.pair: pair for pair in message.pairs}

    def diagnose(self, message):
        for status in message.status:
            if status.name.endswith("clouds"):
                self.values = {item.key: item.value for item in status.values}

    def distance(self, pair):
        found = self.pairs.get(pair)
        return found.distance if found is not None and found.has_distance else None

    def refused(self, name):
        return int(self.values.get(name + " refused", "-1")), self.values.get(name + " last refusal", "")


def watch(arena):
    if getattr(arena, "cloud_watch", None) is None:
        arena.cloud_watch = Watch(arena)
    return arena.cloud_watch


def publisher(topic, kind):
    """One publisher for each topic, kept."""
    if topic not in publisher.kept:
        publisher.kept[topic] = rospy.Publisher(topic, kind, queue_size=10)
        deadline = time.monotonic() + 10.0
        while publisher.kept[topic].get_num_connections() == 0 and time.monotonic() < deadline:
            time.sleep(0.02)
    return publisher.kept[topic]


publisher.kept = {}


def see(message):
    """Shows the camera's cloud a message, or bytes."""
    publisher("/seen", CLOUD).publish(CLOUD(message if isinstance(message, bytes) else cloud_bytes(message)))


def show_map(body):
    publisher("/mapped", OCTOMAP).publish(OCTOMAP(body))


def until(arena, condition, send, timeout, text):
    """Sends every 0.1 s until the condition holds."""
    deadline = time.monotonic() + timeout * arena.patience
    while not condition():
        arena.node.require_alive()
        expect(time.monotonic() < deadline, text() if callable(text) else text)
        send()
        time.sleep(0.1)


def require_served(arena, timeout=15.0):
    """The right distance to a good cloud comes, and box_b is followed."""
    look = watch(arena)
    look.pairs = {}
    until(arena, lambda: look.distance("seen") is not None and abs(look.distance("seen") - GAP) <= ROUNDING,
          lambda: see(cloud([POINT])), timeout,
          lambda: "no right distance to a good cloud: %s; %s" % (look.pairs.get("seen"), look.values))
    arena.require_tracking()


def refused(arena, send, *words, name="camera"):
    """The message is refused with the words, nothing that it says is served, and good ones are served again."""
    look = watch(arena)
    require_served(arena)
    until(arena, lambda: look.refused(name)[0] >= 0, lambda: None, 10.0, "no diagnostics of the clouds")
    before = look.refused(name)[0]
    seen = []
    send()

    def done():
        if look.distance("seen") is not None:
            seen.append(look.distance("seen"))
        return look.refused(name)[0] > before
    until(arena, done, lambda: None, 15.0, lambda: "it was not refused: " + shortened(look.values, 400))
    text = look.refused(name)[1]
    missing = [word for word in words if word not in text]
    expect(not missing, "the refusal does not name %s: %s" % (", ".join(missing), shortened(text)))
    expect(len(text) < 2000, "the refusal has %d characters" % len(text))
    expect(all(abs(distance - GAP) <= ROUNDING for distance in seen), "it was served: %s" % seen)
    require_served(arena)


def refuses(label, make, *words, **options):
    group.add(label, lambda arena: refused(arena, lambda: see(make()), *words), deadline=60.0, **options)


def refuses_map(label, make, *words, **options):
    group.add("map_" + label, lambda arena: refused(arena, lambda: show_map(make()), *words, name="map"), deadline=60.0,
              **options)


def finds(label, make, distance, **options):
    """The cloud is served with this distance; None: it is infinitely far."""
    def act(arena):
        look = watch(arena)
        require_served(arena)

        def done():
            found = look.distance("seen")
            if distance is None:  # Far pairs are counted, not listed.
                return "boxes" in look.pairs and found is None and look.values.get("camera occupied voxels") == "0"
            return found is not None and abs(found - distance) <= ROUNDING
        until(arena, done, lambda: see(make()), 15.0,
              lambda: "it is not served so: %s; %s" % (look.pairs.get("seen"), shortened(look.values, 400)))
        require_served(arena)
    group.add(label, act, deadline=60.0, **options)


def number(value):
    return struct.pack("<I", value)


# Counts that lie: of the message on the wire, and of what it says of its rows.

for label, count in {"4e9": 2**32 - 1, "2e9": 2**31, "60_million": 60000000}.items():
    refuses("data_count_of_" + label, lambda count=count: cloud_bytes(
        cloud([POINT] * 7), [(number(12 * 7) + cloud([POINT] * 7).data[:4], number(count) + cloud([POINT]).data[:4])]),
        "bytes", growth_mb=100.0, fast=label == "4e9")
    refuses("field_count_of_" + label, lambda count=count: cloud_bytes(
        cloud([POINT]), [(number(3) + number(1) + b"x", number(count) + number(1) + b"x")]), "bytes", growth_mb=100.0)
    refuses("name_of_a_field_of_" + label, lambda count=count: cloud_bytes(
        cloud([POINT]), [(number(1) + b"x", number(count) + b"x")]), growth_mb=100.0)
    refuses("frame_name_of_" + label, lambda count=count: cloud_bytes(
        cloud([POINT]), [(number(5) + b"world", number(count) + b"world")]), growth_mb=100.0)
    refuses_map("data_count_of_" + label, lambda count=count: octomap_bytes(data_count=count), "cut", growth_mb=100.0,
                fast=label == "4e9")
for cut in (0, 3, 12, 30, 60, 100):
    refuses("cut_after_%d_bytes" % cut, lambda cut=cut: cloud_bytes(cloud([POINT]))[:cut])
    refuses_map("cut_after_%d_bytes" % cut, lambda cut=cut: octomap_bytes()[:min(cut, 70)])
HUGE = 2**32 - 1
SIZES = {"width": dict(width=HUGE), "height": dict(height=HUGE), "both": dict(width=HUGE, height=HUGE),
         "point_step_0": dict(point_step=0), "point_step": dict(point_step=HUGE), "row_step_0": dict(row_step=0),
         "row_step": dict(row_step=HUGE), "all": dict(width=HUGE, height=HUGE, row_step=HUGE, point_step=HUGE),
         "product_that_wraps": dict(width=2**16, height=2**16, row_step=0, point_step=2**16), "two_rows": dict(height=2)}
for label, fields in SIZES.items():
    refuses("size_" + label, lambda fields=fields: cloud([POINT], **fields))
FIELDS = {"datatype_0": PointField("x", 0, 0, 1), "datatype_255": PointField("x", 0, 255, 1),
          "integers": PointField("x", 0, PointField.INT32, 1), "double_beyond_the_point": PointField("x", 8, FLOAT64, 1),
          "offset_4e9": PointField("x", HUGE, 7, 1), "offset_that_wraps": PointField("x", HUGE - 3, 7, 1),
          "count_4e9": PointField("x", 0, 7, HUGE), "no_name": PointField("", 0, 7, 1), "X": PointField("X", 0, 7, 1),
          "megabyte_of_name": PointField("n" * 2**20, 0, 7, 1)}
for label, field in FIELDS.items():
    refuses("field_" + label, lambda field=field: cloud([POINT], fields=[field] + cloud([POINT]).fields[1:]), "fields")
refuses("fields_100000", lambda: cloud([POINT], fields=[PointField("f%d" % i, 0, 7, 1) for i in range(100000)]), "fields")

# Values

finds("points_nan_and_inf", lambda: cloud([POINT, (NAN, 0, 0), (0, INF, 0), (0, 0, -INF), (NAN, NAN, NAN)]), GAP)
finds("points_all_nan", lambda: cloud([(NAN, NAN, NAN)] * 1000), None)
finds("big_endian", lambda: cloud([POINT], big_endian=True), GAP)
finds("big_endian_doubles", lambda: cloud([POINT], big_endian=True, kind=FLOAT64), GAP)
finds("endianness_of_255", lambda: cloud([POINT], big_endian=True, is_bigendian=255), GAP)
finds("without_points", lambda: cloud([]), None)
finds("without_anything", lambda: cloud([], fields=[], point_step=0, row_step=0), None)
finds("width_0_height_4e9", lambda: cloud([], height=HUGE, row_step=HUGE, point_step=HUGE), None)
finds("denormal_points", lambda: cloud([POINT, (5e-324, 100.0, 0.0)], kind=FLOAT64), GAP)
for far in (1e6, 1e30, 1e300):
    refuses("a_point_at_%g" % far, lambda far=far: cloud([POINT, (far, 0.0, 0.0)], kind=FLOAT64), "range")
refuses("wrong_frame", lambda: cloud([POINT], frame="nowhere"), "nowhere")
refuses("no_frame", lambda: cloud([POINT], frame=""), "frame_id")
refuses("frame_of_a_megabyte", lambda: cloud([POINT], frame="f" * 2**20))
refuses("frame_with_a_newline", lambda: cloud([POINT], frame="wor\nld\x1b[2J"))
refuses("million_voxels", lambda: cloud([(0.125 * (i % 100) + 5.0, 0.125 * (i // 100 % 100), 0.125 * (i // 10000))
                                         for i in range(1000000)]), "voxels", growth_mb=400.0, silence=20.0, storms=False)


@group.attack(deadline=60.0)
def a_point_outside_of_the_finest_grid(arena):
    """At 0.1 mm the grid ends after 105 m; what is beyond may not be left out in silence."""
    look = watch(arena)
    send = publisher("/seen_finely", CLOUD)
    until(arena, lambda: "range" in look.refused("fine")[1],
          lambda: send.publish(CLOUD(cloud_bytes(cloud([(200.0, 0.0, 0.0)])))), 15.0,
          lambda: "it was not refused: " + shortened(look.values, 400))
    expect(look.distance("seen_fine") is None, "it has a distance")


# Stamps

def never_old(arena, stamp):
    """A cloud of another time gives no distance with status OK that a present one would not have."""
    look = watch(arena)
    require_served(arena)
    near = cloud([(1.0625, 0.0625, 0.0625)], stamp=stamp)
    for _ in range(10):
        see(near)
        time.sleep(0.05)
        found = look.distance("seen")
        expect(found is None or abs(found - GAP) <= ROUNDING, "a cloud stamped %s is served with %s" % (stamp.to_sec(), found))
    require_served(arena)


STAMPS = {"an_hour_ago": lambda: rospy.Time.now() - rospy.Duration(3600), "in_an_hour": lambda: rospy.Time.now() +
          rospy.Duration(3600), "4e9": lambda: genpy.Time(HUGE, 999999999), "one_ns": lambda: genpy.Time(0, 1)}
for label, stamp in STAMPS.items():
    group.add("stamp_" + label, lambda arena, stamp=stamp: never_old(arena, stamp()), deadline=60.0)
finds("stamp_zero_means_now", lambda: cloud([POINT], stamp=genpy.Time()), GAP)

# Floods

def flood(arena, bodies, seconds, per_second):
    """Sends at this rate; the boxes are followed rightly meanwhile, and a good cloud afterwards."""
    require_served(arena)
    arena.listener.forget()
    ends = time.monotonic() + seconds
    sent = 0
    began = time.monotonic()
    while time.monotonic() < ends:
        see(bodies[sent % len(bodies)])
        sent += 1
        time.sleep(max(0.0, began + sent / per_second - time.monotonic()))
    expect(arena.listener.wrong is None, str(arena.listener.wrong))
    require_served(arena, 30.0)


@group.attack(deadline=90.0)
def thousand_messages_a_second(arena):
    flood(arena, [cloud_bytes(cloud([POINT], stamp=genpy.Time()))] * 2, 5.0, 1000.0)


@group.attack(deadline=90.0)
def thousand_wrong_messages_a_second(arena):
    """The log does not grow with them."""
    mark = arena.node.log_length()
    flood(arena, [cloud_bytes(cloud([POINT], width=HUGE, stamp=genpy.Time())), b"", b"x" * 50], 5.0, 1000.0)
    expect(arena.node.log_length() - mark < 200000, "the log has grown by %d bytes" % (arena.node.log_length() - mark))


@group.attack(deadline=120.0, growth_mb=600.0)
def million_points_at_a_time(arena):
    source = random.Random(5)
    numbers = struct.pack("<3000000f", *(source.uniform(3.0, 4.0) for _ in range(3000000)))
    big = cloud_bytes(cloud([POINT], width=1000000, row_step=12000000, data=numbers, stamp=genpy.Time()))
    flood(arena, [big], 5.0, 10.0)


@group.attack(deadline=120.0, growth_mb=1500.0, storms=False)
def other_cells_every_time(arena):
    """Each cloud has 20,000 voxels that the last one had not."""
    bodies = []
    for shift in range(5):
        numbers = [number for i in range(20000) for number in (
            0.25 * (i % 100) + 3.0 + 0.125 * shift, 0.25 * (i // 100 % 20), 0.25 * (i // 2000) + 0.0625)]
        bodies.append(cloud_bytes(cloud([POINT], width=20000, row_step=240000, stamp=genpy.Time(),
                                        data=struct.pack("<60000f", *numbers))))
    flood(arena, bodies, 10.0, 50.0)


# Other types on the topic: roscpp connects to publishers of the first one's type alone

CLOUD_TEXT = PointCloud2._full_text
TYPES = {
    "a_string": ("std_msgs/String", "992ce8a1687cec8c8bd883ec73ca41d1", "string data\n", b"\x03\0\0\0abc"),
    "a_map": ("octomap_msgs/Octomap", OCTOMAP_MD5, OCTOMAP_TEXT, b"short"),
    "a_cloud_of_another_md5": ("sensor_msgs/PointCloud2", "0" * 32, CLOUD_TEXT, b"x" * 100),
    "a_cloud_without_definition": ("sensor_msgs/PointCloud2", PointCloud2._md5sum, "", b"x" * 100),
    "an_odd_name": ("no_package/No\x07Type", "1" * 32, "", b""),
    "a_megabyte_of_definition": ("octomap_msgs/Octomap", "3" * 32, "string id\n" * 100000, b""),
}


def beside_a_rival(arena, *arguments):
    """While another type is on the topic, and afterwards, a good cloud has its distance and no other one comes."""
    look = watch(arena)
    require_served(arena)
    process = start_rival(arena, "/seen", *arguments)
    try:
        ends = time.monotonic() + 6.0
        while time.monotonic() < ends:
            see(cloud([POINT]))
            time.sleep(0.05)
            found = look.distance("seen")
            expect(found is None or abs(found - GAP) <= ROUNDING, "the distance is %s" % found)
    finally:
        processes.end_group(process)
    require_served(arena)


for label, arguments in TYPES.items():
    group.add("beside_" + label, lambda arena, arguments=arguments: beside_a_rival(arena, *arguments), deadline=90.0)

# Maps

def tree(levels, bits=b"\x03\x00", leaf=b"\x02\x00"):
    return bits * levels + leaf


MAPS = {"resolution_nan": dict(resolution=NAN), "resolution_0": dict(resolution=0.0), "resolution_inf": dict(resolution=INF),
        "resolution_negative": dict(resolution=-0.1), "resolution_1e308": dict(resolution=1.7e308),
        "resolution_1e160": dict(resolution=1e160), "resolution_1e-200": dict(resolution=1e-200),
        "resolution_denormal": dict(resolution=5e-324), "too_deep": dict(data=tree(16)), "very_deep": dict(data=tree(100000)),
        "cut_tree": dict(data=ONE_CELL[:-1]), "tree_with_a_tail": dict(data=ONE_CELL + b"\0"),
        "full_where_binary": dict(binary=0), "whole_space": dict(data=b"\xaa\xaa"), "unknown_tree": dict(name=b"Tree"),
        "id_of_a_megabyte": dict(name=b"i" * 2**20), "id_with_newlines": dict(name=b"a\nb\x1b[2J"),
        "wrong_frame": dict(frame=b"nowhere"), "no_frame": dict(frame=b""),
        "color_tree_of_zeros": dict(name=b"ColorOcTree", binary=0, data=bytes(5))}
for label, changes in MAPS.items():
    refuses_map(label, lambda changes=changes: octomap_bytes(**changes))


@group.attack(deadline=60.0)
def map_of_one_cell(arena):
    """The corner of liboctomap's space: 3,276.8 m away from the origin along each axis."""
    look = watch(arena)
    expected = 3**0.5 * (3276.7 - 0.5)
    until(arena, lambda: look.distance("mapped") is not None and abs(look.distance("mapped") - expected) < 1e-6,
          lambda: show_map(octomap_bytes()), 15.0, lambda: "wrong: %s" % look.pairs.get("mapped"))
    require_served(arena)


@group.attack(deadline=60.0)
def random_maps(arena):
    source = random.Random(9)
    require_served(arena)
    for _ in range(300):
        data = bytes(source.choice((0, 1, 2, 3, 0xaa, 0xff, source.randrange(256))) for _ in range(source.randrange(64)))
        show_map(octomap_bytes(data=data, binary=source.randrange(2), name=source.choice((b"OcTree", b"ColorOcTree"))))
        time.sleep(0.01)
    require_served(arena)
    map_of_one_cell(arena)
