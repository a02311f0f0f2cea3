"""Bags that are cut, lie about what is in them, or hold what no robot sends, given to distance_bag."""

import bz2
import os
import random
import struct
import time

import genpy
import ros_wire
from attacks import Group, expect, shortened
from bag_bytes import BEGIN, Bag
from bench import Bench
from geometry_msgs.msg import TransformStamped
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

group = Group("bags", beside=True)
SCENE = """bodies:
  - {name: a, box: {size: [1, 1, 1]}}
  - {name: b, box: {size: [1, 1, 1]}}
pairs:
  - {between: [a, b]}
"""
NAN, INF = float("nan"), float("inf")
COUNT = 100  # stamps of the good bag
PLAY = ("distance_bag", "--bag", "x.bag", "--scene", "boxes.yaml", "--output", "d.csv")


def frame(child, seconds, x=0.0, parent="world", rotation=(0.0, 0.0, 0.0, 1.0)):
    message = TransformStamped(child_frame_id=child)
    nanoseconds = int(round((seconds - BEGIN) * 1e9))
    message.header.stamp = genpy.Time(BEGIN + nanoseconds // 10**9, nanoseconds % 10**9)
    message.header.frame_id = parent
    message.transform.translation.x = x
    turn = message.transform.rotation
    turn.x, turn.y, turn.z, turn.w = rotation
    return message


def motion(count=COUNT, **lies):
    """a stands still, b moves away from 1 m with 0.1 m/s."""
    bag = Bag(**lies)
    fixed, moving = bag.connect("/tf_static", TFMessage), bag.connect("/tf", TFMessage)
    bag.write(fixed, BEGIN, TFMessage([frame("a", BEGIN)]))
    for index in range(count):
        if index == count // 2:
            bag.chunk()
        bag.write(moving, BEGIN + 0.01 * index, TFMessage([frame("b", BEGIN + 0.01 * index, 2.0 + 0.001 * index)]))
    return bag


def bench_with(arena, bag):
    bench = Bench(arena)
    bench.write("boxes.yaml", SCENE)
    bench.write("x.bag", bag if isinstance(bag, bytes) else bag.to_bytes())
    return bench


def distances(bench):
    """Index of each stamp and its distance, of the rows that have one."""
    found = {}
    lines = bench.read("d.csv").decode().splitlines()
    columns = lines[0].split(",")
    for line in lines[1:]:
        row = dict(zip(columns, line.split(",")))
        if row["distance"]:
            found[round((float(row["stamp"]) - BEGIN) * 100)] = float(row["distance"])
    return found


def require_right(bench, count=COUNT):
    """No distance is wrong, and there are as many."""
    found = distances(bench)
    wrong = [(index, value) for index, value in found.items() if abs(value - (1.0 + 0.001 * index)) > 1e-6]
    expect(not wrong, "wrong distances: %s" % wrong[:3])
    expect(count is None or len(found) == count, "%d distances of %s" % (len(found), count))


def refuses(label, make, *words, seconds=20.0, **options):
    group.add(label, lambda arena: bench_with(arena, make()).refused(
        *PLAY, words=words, left_behind=("d.csv",), seconds=seconds), deadline=3.0 * seconds + 30.0, **options)


def reads(label, make, count=COUNT, words=(), **options):
    """It is played, with right distances, and says the words."""
    def act(arena):
        bench = bench_with(arena, make())
        text = bench.works(*PLAY, seconds=60.0)
        missing = [word for word in words if word not in text]
        expect(not missing, "it does not say %s: %s" % (", ".join(missing), shortened(text[-300:])))
        expect(len(text) < 20000, "it says %d characters" % len(text))
        require_right(bench, count)
    group.add(label, act, deadline=120.0, **options)


def refuses_or_reads(label, make, **options):
    """Either; what is read is right, and nothing is left behind."""
    def act(arena):
        bench = bench_with(arena, make())
        status, text = bench.run(*PLAY, seconds=60.0)
        expect(status in (0, 1), "it ended with %s: %s" % (status, shortened(text[-300:])))
        expect(text.strip(), "it says nothing")
        if status == 0:
            require_right(bench, None)
        left = [name for name in os.listdir(bench.folder) if name.endswith(".part")]
        expect(not left, "left behind: " + ", ".join(left))
    group.add(label, act, deadline=120.0, **options)


# Files

reads("good", motion, fast=True)
reads("compressed", lambda: motion(compression=b"bz2"))
for part in (0, 5, 13, 100, 4000, 5000):
    refuses("cut_after_%d_bytes" % part, lambda part=part: motion().to_bytes()[:part], "x.bag")
for part in (0.3, 0.6, 0.9, 0.999):
    refuses("cut_after_%g" % part, lambda part=part: motion().to_bytes()[:int(part * len(motion().to_bytes()))], "rosbag reindex")
refuses("binary", lambda: bytes(range(256)) * 100, "x.bag")
refuses("line_of_version_alone", lambda: b"#ROSBAG V2.0\n", "x.bag")
refuses("version_1", lambda: b"#ROSBAG V1.2\n" + bytes(5000), "x.bag")
refuses("version_9", lambda: b"#ROSBAG V9.9\n" + motion().to_bytes()[13:], "x.bag")
for label, path in {"missing": "none.bag", "a_folder": "/", "dev_zero": "/dev/zero", "own_memory": "/proc/self/mem"}.items():
    group.add("bag_is_" + label, lambda arena, path=path: bench_with(arena, b"").refused(
        "distance_bag", "--bag", path, *PLAY[3:], words=(path,), left_behind=("d.csv",)), deadline=60.0)

# The attacks below change what a bag says of itself.

HUGE = 2**32 - 1
LIES = {
    "conn_count": (0, 1, HUGE), "chunk_count": (0, 3, HUGE), "index_pos": (1, 4109, 2**63, 2**64 - 1),
    "chunk_pos": (0, 13, 2**63, 2**64 - 1), "info_count": (0, 1, HUGE), "index_count": (0, 2**31, HUGE),
    "index_offset": (0, 5, 2**20, 2**31, HUGE), "index_ver": (0, 2), "compression": (b"zip", b"", b"lz4"),
    "index_time": (b"\xff" * 8, bytes(8)), "stored": (b"", b"x" * 10, b"\xff" * 1000),
}
for lie, values in LIES.items():
    for number, value in enumerate(values):
        refuses("%s_%s" % (lie, number if isinstance(value, bytes) else value),
                lambda lie=lie, value=value: motion(**{lie: value}), "x.bag", fast=(lie, value) == ("index_offset", HUGE))
HARMLESS = {"chunk_size": (0, 1, 2**31, HUGE), "info_messages": (0, HUGE), "start_time": (bytes(8), b"\xff" * 8),
            "end_time": (bytes(8), b"\xff" * 8)}
for lie, values in HARMLESS.items():
    for number, value in enumerate(values):
        reads("%s_%s" % (lie, number if isinstance(value, bytes) else value), lambda lie=lie, value=value: motion(**{lie: value}))
refuses("bomb_of_half_a_gigabyte", lambda: motion(compression=b"bz2", stored=bz2.compress(bytes(2**29)), chunk_size=2**29),
        "x.bag", seconds=60.0)
refuses("bomb_that_says_4_gb", lambda: motion(compression=b"bz2", stored=bz2.compress(bytes(2**26)), chunk_size=HUGE),
        "x.bag", seconds=60.0)
refuses("message_that_says_2_gb", lambda: motion().to_bytes().replace(
    struct.pack("<I", len(ros_wire.serialized(TFMessage([frame("b", BEGIN)])))), struct.pack("<I", 2**31)), "x.bag")
for seed in range(12):
    refuses_or_reads("bytes_changed_%d" % seed, lambda seed=seed: changed(seed))


def changed(seed):
    """Some bytes of lengths, counts and places are others. (Those of transforms would be other distances.)"""
    source = random.Random(seed)
    bag = bytearray(motion(20, compression=b"bz2" if seed % 3 == 0 else b"none").to_bytes())
    marks = [place for word in (b"op=", b"conn=", b"count=", b"time=", b"ver=", b"chunk_pos=", b"size=", b"topic=")
             for place in range(len(bag)) if bag.startswith(word, place)]
    for _ in range(source.choice((1, 2, 5))):
        bag[max(13, source.choice(marks) + source.randrange(-10, 12))] = source.choice((0, 1, 127, 255))
    return bytes(bag)


# Topics and types

def on_topics(count, name="/other%d", kind=String, of_tf=True):
    """The good bag with further connections."""
    bag = motion()
    if not of_tf:
        bag = Bag()
    for index in range(count):
        bag.write(bag.connect(name % index if "%" in name else name, kind), BEGIN + 0.005, String("x") if kind is String else TFMessage())
    return bag


reads("ten_thousand_connections", lambda: on_topics(10000))
reads("ten_thousand_connections_of_one_topic", lambda: on_topics(10000, "/tf", TFMessage))
refuses("ten_thousand_topics_of_tf_elsewhere", lambda: on_topics(10000, "/elsewhere%d/tf", TFMessage, of_tf=False),
        "--tf-topic")
refuses("tf_of_another_type", lambda: on_topics(1, "/tf", String, of_tf=False), "std_msgs/String", "--tf-topic")


def with_connection(**changes):
    bag = Bag()
    number = bag.connect("/tf", TFMessage, **changes)
    bag.write(number, BEGIN, TFMessage([frame("a", BEGIN), frame("b", BEGIN, 2.0)]))
    return bag


refuses("topic_with_escapes", lambda: on_topics(1, "/tf\x1b[2J\n", TFMessage, of_tf=False), "--tf-topic")
refuses("topic_of_a_megabyte", lambda: on_topics(1, "/" + "t" * 2**20, TFMessage, of_tf=False), "x.bag")
refuses("md5sum_of_another_message", lambda: with_connection(md5sum=b"0" * 32), "tf2_msgs/TFMessage")
for field in ("topic", "type", "md5sum", "message_definition"):
    refuses_or_reads("connection_without_" + field, lambda field=field: with_connection(**{field: None}))
refuses_or_reads("definition_of_ten_megabytes", lambda: with_connection(message_definition=b"x" * 10**7))

# Messages

def with_messages(*bodies, count=COUNT):
    bag = motion(count)
    for index, body in enumerate(bodies):
        bag.write(1, BEGIN + 0.005 + 0.01 * index, body)
    return bag


def with_frames(*frames):
    return with_messages(TFMessage(list(frames)))


MESSAGES = {"empty": b"", "count_of_4e9": struct.pack("<I", HUGE), "count_of_60_million": struct.pack("<I", 60000000) + bytes(1000),
            "cut": ros_wire.serialized(TFMessage([frame("b", BEGIN)]))[:50],
            "name_of_4e9": struct.pack("<IIIII", 1, 0, BEGIN, 0, HUGE) + bytes(200)}
for label, body in MESSAGES.items():
    reads("message_" + label, lambda body=body: with_messages(body), words=("is none of tf",), fast=label == "count_of_4e9")
FRAMES = {
    "position_nan": frame("b", BEGIN + 0.105, NAN), "position_inf": frame("b", BEGIN + 0.105, INF),
    "rotation_nan": frame("b", BEGIN + 0.105, 2.0, rotation=(NAN, 0.0, 0.0, 1.0)),
    "rotation_0": frame("b", BEGIN + 0.105, 2.0, rotation=(0.0, 0.0, 0.0, 0.0)),
    "own_parent": frame("b", BEGIN + 0.105, 2.0, parent="b"), "no_parent": frame("b", BEGIN + 0.105, 2.0, parent=""),
    "no_name": frame("", BEGIN + 0.105, 2.0), "name_of_a_megabyte": frame("f" * 2**20, BEGIN + 0.105),
    "name_with_escapes": frame("b\x1b[2J\n", BEGIN + 0.105), "an_hour_ahead": frame("b", BEGIN + 3600.0, 50.0),
}
for label, message in FRAMES.items():
    reads("frame_with_" + label, lambda message=message: with_frames(message), words=("is refused",))
refuses_or_reads("frames_in_a_loop", lambda: with_frames(frame("world", BEGIN + 0.005, parent="b"), frame("a", BEGIN, parent="b")))
refuses_or_reads("frame_of_position_1e300", lambda: with_frames(frame("c", BEGIN + 0.005, 1e300)))


def thousands_of_frames(count, messages):
    bag = motion()
    for index in range(messages):
        bag.write(1, BEGIN + 0.005 + 0.1 * index, TFMessage([
            frame("f%d" % number, BEGIN + 0.005 + 0.1 * index, float(number)) for number in range(count)]))
    return bag


reads("five_thousand_frames", lambda: thousands_of_frames(5000, 5))
reads("fifty_thousand_frames", lambda: thousands_of_frames(50000, 2), words=("frames",))


@group.attack(deadline=120.0)
def frames_that_are_missing_among_thousands(arena):
    """The answer has the names of frames that the bag has, but not all."""
    bag = Bag()
    bag.write(bag.connect("/tf", TFMessage), BEGIN, TFMessage([frame("f%d" % index, BEGIN) for index in range(9000)]))
    bench_with(arena, bag).refused(*PLAY, words=("no pair has an answer",), left_behind=("d.csv",), seconds=60.0)


@group.attack(deadline=300.0)
def million_tiny_messages(arena):
    """Without a transform each, beside the good ones: faster than they were recorded."""
    bag = Bag()
    fixed, moving = bag.connect("/tf_static", TFMessage), bag.connect("/tf", TFMessage)
    bag.write(fixed, BEGIN, TFMessage([frame("a", BEGIN)]))
    nothing = bytes(4)
    for index in range(COUNT):
        bag.chunk()
        bag.write(moving, BEGIN + 0.01 * index, TFMessage([frame("b", BEGIN + 0.01 * index, 2.0 + 0.001 * index)]))
        for number in range(10000):
            bag.write(moving, BEGIN + 0.01 * index + 9e-7 * number, nothing)
    bench = bench_with(arena, bag)
    began = time.monotonic()
    bench.works(*PLAY, seconds=200.0)
    require_right(bench)
    expect(time.monotonic() - began < 200.0, "it took %.0f s" % (time.monotonic() - began))


@group.attack(deadline=120.0)
def bag_of_no_duration(arena):
    """All at one time, and at time 0."""
    for seconds in (BEGIN, bytes(8)):
        bag = Bag()
        number = bag.connect("/tf", TFMessage)
        for x in (2.0, 3.0, 4.0):
            bag.write(number, seconds, TFMessage([frame("a", BEGIN), frame("b", BEGIN, x)]))
        bench = bench_with(arena, bag)
        status, text = bench.run(*PLAY)
        expect(status in (0, 1) and text.strip(), "it ended with %s: %s" % (status, shortened(text[-200:])))
        if status == 0:
            expect(distances(bench) in ({0: 1.0}, {}), "the distances are %s" % distances(bench))


# The other files, and the outputs

for label, changes, words in (
        ("scene_missing", ("--scene", "none.yaml"), "none.yaml"), ("scene_is_a_folder", ("--scene", "/"), "/"),
        ("scene_is_dev_zero", ("--scene", "/dev/zero"), "/dev/zero"), ("scene_is_the_bag", ("--scene", "x.bag"), "x.bag"),
        ("output_in_no_folder", ("--output", "none/d.csv"), "none/d.csv"), ("output_is_the_bag", ("--output", "x.bag"), "x.bag"),
        ("output_is_the_scene", ("--output", "boxes.yaml"), "boxes.yaml"), ("output_is_a_folder", ("--output", "/"), "/"),
        ("niches_are_the_rows", ("--niches-output", "d.csv"), "d.csv"), ("output_is_full", ("--output", "/dev/full"), "/dev/full"),
        ("niches_are_full", ("--niches-output", "/dev/full"), "/dev/full"), ("start_nan", ("--start", "nan"), "start"),
        ("start_1e300", ("--start", "1e300"), "--start"), ("start_negative", ("--start", "-1"), "--start"),
        ("duration_nan", ("--duration", "nan"), "duration"), ("threads_1e9", ("--threads", "1000000000"), "threads"),
        ("pairs_of_none", ("--pairs", "x" * 100000), "--pairs"), ("tf_topic_of_none", ("--tf-topic", "/none"), "/none")):
    def act(arena, changes=changes, words=words):
        bench = bench_with(arena, motion())
        options = dict(zip(PLAY[1::2], PLAY[2::2]))
        options.update(dict(zip(changes[::2], changes[1::2])))
        before = bench.read("x.bag"), bench.read("boxes.yaml")
        bench.refused("distance_bag", *[word for option in options.items() for word in option], words=(words,),
                      left_behind=("d.csv",))
        expect((bench.read("x.bag"), bench.read("boxes.yaml")) == before, "an input has changed")
    group.add(label, act, deadline=60.0)


@group.attack(deadline=60.0)
def disk_that_fills_up(arena):
    bench = bench_with(arena, motion(3000))
    bench.refused(*PLAY, "--niches-output", "n.csv", file_bytes=100000, words=("d.csv",), left_behind=("d.csv", "n.csv"))
    expect(not [name for name in os.listdir(bench.folder) if name.endswith(".part")], "a part is left behind")
