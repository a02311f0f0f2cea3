#!/usr/bin/env python3
"""The program distance_bag, as a user runs it, on bags that the tests write. DISTANCE_BAG names it."""
import csv
import io
import math
import os
import re
import signal
import struct
import subprocess
import sys
import tempfile
import traceback
import unittest

import genpy
import rosbag
from geometry_msgs.msg import TransformStamped
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.realpath(os.environ["DISTANCE_BAG"])))
import distance_bag  # noqa: E402

BEGIN = 1700000000  # s
BOXES = """bodies:
  - {name: a, box: {size: [1, 1, 1]}}
  - {name: b, box: {size: [1, 1, 1]}}
pairs:
  - {between: [a, b]}
"""


def at(ms):
    return genpy.Time(BEGIN + ms // 1000, ms % 1000 * 10**6)


def text_of(ms):
    return "%d.%03d000000" % (BEGIN + ms // 1000, ms % 1000)


def transform(child, x, stamp, parent="world"):
    made = TransformStamped()
    made.header.stamp, made.header.frame_id, made.child_frame_id = stamp, parent, child
    made.transform.translation.x, made.transform.rotation.w = x, 1.0
    return made


class DistanceBag(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.put("boxes.yaml", BOXES)

    def path(self, name):
        return os.path.join(self.folder, name)

    def put(self, name, content):
        with open(self.path(name), "wb" if isinstance(content, bytes) else "w") as stream:
            stream.write(content)

    def content(self, name):
        with open(self.path(name), "rb") as stream:
            return stream.read()

    def write(self, name, messages, compression="none"):
        """messages: (topic, [transforms] or a message, milliseconds of the recording)."""
        with rosbag.Bag(self.path(name), "w", compression=compression, chunk_threshold=4096) as bag:
            for topic, message, ms in messages:
                bag.write(topic, TFMessage(message) if isinstance(message, list) else message, at(ms))

    def motion(self, count=100, begin=2.0):
        """a stands at 0; b moves from `begin` on with 0.1 m/s, at 100 Hz: its distance is 1 + 0.1 t."""
        return [("/tf_static", [transform("a", 0.0, at(0))], 0)] + [
            ("/tf", [transform("b", begin + 0.001 * i, at(10 * i))], 10 * i) for i in range(count)]

    def run_bag(self, arguments, *status):
        with tempfile.TemporaryFile() as log:
            program = os.fork()  # its imports, half a second, are made already
            if program == 0:
                self.be_program(arguments.split(), log)
            ended = os.waitpid(program, 0)[1]
            log.seek(0)
            self.log = log.read().decode()
        self.assertIn(ended, [one << 8 for one in status or (0,)], self.log)
        self.assertNotIn("Traceback", self.log)

    def be_program(self, arguments, log):
        os.dup2(log.fileno(), 1)
        os.dup2(log.fileno(), 2)
        os.chdir(self.folder)
        sys.argv = ["distance_bag"] + arguments
        status = 1
        try:
            status = distance_bag.main()
        except SystemExit as end:
            status = end.code or 0
        except BaseException:
            traceback.print_exc()
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)

    def run_boxes(self, arguments, *status):
        self.run_bag("--scene boxes.yaml --output d.csv " + arguments, *status)

    def rows(self, name="d.csv"):
        return list(csv.DictReader(io.StringIO(self.content(name).decode())))

    def answers(self):
        return [row for row in self.rows() if row["distance"]]

    def stamps(self, pair="a/b"):
        return [row["stamp"] for row in self.answers() if row["pair"] == pair]

    def expect_distances(self, expected, rounding=1e-12):
        found = [float(row["distance"]) for row in self.answers()]
        self.assertEqual(len(found), len(expected), self.log)
        for one, other in zip(found, expected):
            self.assertAlmostEqual(one, other, delta=rounding)

    def expect_fault(self, arguments, *texts):
        """It ends with an error, nothing is written, and it says this."""
        self.run_boxes(arguments, 1)
        for text in texts:
            self.assertIn(text, self.log)
        self.assertEqual([name for name in os.listdir(self.folder) if "d.csv" in name], [])

    # Answers

    def test_answers_every_stamp_in_order_with_the_closed_form(self):
        self.write("run.bag", self.motion())
        self.run_boxes("--bag run.bag --niches-output n.csv")
        self.expect_distances([1.0 + 0.001 * i for i in range(100)])
        rows = self.rows()
        for i, row in enumerate(rows):
            self.assertEqual([row[name] for name in ("time", "stamp", "pair", "body_a", "body_b", "status", "message")],
                             [text_of(10 * i), text_of(10 * i), "a/b", "a", "b", "ok", ""])
            self.assertAlmostEqual(float(row["lower_bound"]), 1.0 + 0.001 * i, delta=1e-12)
            self.assertAlmostEqual(float(row["ax"]), 0.5, delta=1e-12)
            self.assertAlmostEqual(float(row["bx"]), 1.5 + 0.001 * i, delta=1e-12)
            self.assertAlmostEqual(float(row["nx"]), 1.0, delta=1e-12)
            self.assertEqual([row["niche_count"], row["niche"]], ["1", rows[0]["niche"]], "it lives on")
            if i == 0:
                self.assertEqual(row["closing_speed"], "")
            else:
                self.assertAlmostEqual(float(row["closing_speed"]), -0.1, delta=1e-9)
        niches = self.rows("n.csv")
        self.assertEqual(len(niches), 100)
        self.assertEqual([niches[7][name] for name in ("niche", "distance", "kind", "outward", "visible")],
                         [rows[7]["niche"], rows[7]["distance"], "patch", "outward", "1"])
        self.assertIn("real-time factor", self.log)
        self.assertIn("100 stamps, 100 rows, 100 distances", self.log)

    def test_writes_the_same_bytes_each_time_for_any_threads_and_compression(self):
        for compression in ("none", "bz2", "lz4"):
            self.write(compression + ".bag", self.motion(), compression)
        self.run_boxes("--bag none.bag --niches-output n.csv --threads 1")
        expected = self.content("d.csv"), self.content("n.csv")
        for further in ("none.bag", "none.bag --threads 3", "bz2.bag", "lz4.bag --threads 2"):
            self.run_boxes("--niches-output n.csv --bag " + further)
            self.assertEqual((self.content("d.csv"), self.content("n.csv")), expected, further)

    def test_interpolates_publishers_of_different_rates(self):
        # Positions and angles are linear in time: b is at 2 + 0.1 t, a at 0.3 t and turned by t about x.
        messages, expected = [("/tf", [transform("c", 0.0, at(0))], 0)], []
        for ms in range(1001):
            if ms % 10 == 3:
                messages.append(("/tf", [transform("a", 3e-4 * ms, at(ms))], ms))
            if ms % 300 == 50:
                messages.append(("/tf", [transform("b", 2.0 + 1e-4 * ms, at(ms))], ms))
                turned = transform("c", 0.0, at(ms), "a")
                turned.transform.rotation.x, turned.transform.rotation.w = math.sin(5e-4 * ms), math.cos(5e-4 * ms)
                messages.append(("/tf", [turned], ms))
            if (ms % 10 == 3 or ms % 300 == 50) and 50 <= ms <= 950:
                expected.append(ms)
        self.put("turned.yaml", BOXES.replace("{name: a,", "{name: a, frame: c,"))
        self.write("run.bag", messages[1:])
        self.run_boxes("--bag run.bag")
        self.assertEqual(self.stamps(), [text_of(ms) for ms in expected])
        self.expect_distances([1.0 - 2e-4 * ms for ms in expected], 1e-9)
        self.assertEqual(self.rows()[0]["status"], "missing_transform", "before b is known")
        # A corner of the turned box is in the x-z plane of its niche; its face stays at right angles to x.
        self.run_bag("--scene turned.yaml --output d.csv --bag run.bag")
        self.expect_distances([1.0 - 2e-4 * ms for ms in expected], 1e-9)

    def test_answers_the_stamps_of_many_publishers_also_the_last_ones(self):
        bodies, pairs, messages = "bodies:\n  - {name: a, frame: world, box: {size: [1, 1, 1]}}\n", "pairs:\n", []
        for box in range(9):
            bodies += "  - {name: b%d, box: {size: [1, 1, 1]}}\n" % box
            pairs += "  - {between: [a, b%d]}\n" % box
        self.put("many.yaml", bodies + pairs)
        for ms in range(500):
            if ms % 20 < 9:
                messages.append(("/tf", [transform("b%d" % (ms % 20), 2.0 + 1e-3 * ms, at(ms))], ms))
        self.write("run.bag", messages)
        self.run_bag("--scene many.yaml --bag run.bag --output d.csv")
        for box in range(9):
            self.assertEqual(self.stamps("a/b%d" % box), [text_of(ms) for ms in range(box, 500, 20)])
        self.expect_distances([1.0 + 1e-3 * ms for ms in range(500) if ms % 20 < 9], 1e-9)

    def test_plays_several_bags_as_one(self):
        robot = [("/tf", [transform("a", 0.001 * i, at(10 * i))], 10 * i) for i in range(50)]
        part = [("/tf", [transform("b", 2.0 + 0.002 * i, at(10 * i + 5))], 10 * i + 5) for i in range(50)]
        self.write("robot.bag", robot)
        self.write("object.bag", part)
        self.write("both.bag", sorted(robot + part, key=lambda message: message[2]))
        self.run_boxes("--bag both.bag")
        expected = self.content("d.csv")
        self.assertEqual(len(self.answers()), 98, "from b's first stamp to a's last")
        self.run_boxes("--bag robot.bag --bag object.bag")
        self.assertEqual(self.content("d.csv"), expected)

    def test_plays_a_part_with_the_static_transforms_from_before(self):
        self.write("run.bag", self.motion())
        self.run_boxes("--bag run.bag --start 0.25 --duration 0.5")
        self.assertEqual(self.stamps(), [text_of(ms) for ms in range(250, 751, 10)])
        self.assertAlmostEqual(float(self.answers()[0]["distance"]), 1.025, delta=1e-12)

    def test_takes_topics_in_a_namespace(self):
        self.write("run.bag", [("/cell/tf_static", [transform("a", 0.0, at(0))], 0),
                               ("/cell/tf", [transform("b", 2.0, at(10))], 10), ("/tf", [transform("b", 3.0, at(20))], 20)])
        self.run_boxes("--bag run.bag --tf-topic /cell/tf --tf-static-topic cell/tf_static")
        self.assertEqual(self.stamps(), [text_of(10)])

    def test_says_from_when_on_a_pair_has_no_answer(self):
        messages = []
        for i in range(400):
            messages.append(("/tf", [transform("a", 0.0, at(10 * i))], 10 * i))
            if i < 50 or i >= 300:
                messages.append(("/tf", [transform("b", 2.0, at(10 * i))], 10 * i))
        self.write("run.bag", messages)
        self.run_boxes("--bag run.bag")
        without = [row for row in self.rows() if not row["distance"]]
        self.assertEqual([(row["status"], row["stamp"], row["time"]) for row in without],
                         [("stale_transform", text_of(490), text_of(1500))], "the first stamp of a more than a second later")
        self.assertIn("--stale-after is 1 s", without[0]["message"])
        self.assertEqual(len(self.stamps()), 50 + 100, "so long a gap is not interpolated")

    def test_changes_static_transforms_at_their_time(self):
        messages = self.motion()
        messages.insert(61, ("/tf_static", [transform("a", -1.0, at(596))], 596))
        self.write("run.bag", messages)
        self.run_boxes("--bag run.bag")
        found = {row["stamp"]: float(row["distance"]) for row in self.answers()}
        for i in range(100):
            self.assertAlmostEqual(found[text_of(10 * i)], 1.0 + 0.001 * i + (i >= 60), delta=1e-12)

    def test_answers_a_pair_that_stands_still_once(self):
        self.write("run.bag", [("/tf_static", [transform("a", 0.0, at(0))], 0)] + [
            ("/tf_static", [transform("b", 2.0, at(ms))], ms) for ms in (1, 2)] + [
            ("/tf", [transform("elsewhere", i, at(10 * i))], 10 * i) for i in range(1, 20)] + [
            ("/tf_static", [transform("b", 1.25, at(300))], 300)])
        self.run_boxes("--bag run.bag")
        self.expect_distances([1.0, 0.25])

    def test_has_no_budget_and_takes_settings_that_the_scene_leaves_out(self):
        self.write("run.bag", self.motion())
        self.put("budget.yaml", "defaults: {time_budget: 1e-9}\n" + BOXES)
        self.run_bag("--scene budget.yaml --bag run.bag --output d.csv --cutoff 1.05")
        rows = self.rows()
        self.assertEqual([row["status"] for row in rows], 51 * ["ok"] + ["beyond_cutoff"])
        self.assertAlmostEqual(float(rows[-1]["lower_bound"]), 1.051, delta=1e-9)
        self.assertEqual(rows[-1]["distance"], "")

    def test_warns_below_a_distance(self):
        self.write("run.bag", self.motion())
        self.run_boxes("--bag run.bag --warning-distance 1.05 --warning-hysteresis 0.0105 --accuracy refined")
        self.assertEqual([row["warning"] for row in self.rows()], [str(int(i <= 60)) for i in range(100)])
        self.assertEqual({row["lower_bound"] for row in self.rows()}, {""}, "level refined proves none")

    def test_follows_the_pairs_that_are_named(self):
        self.put("three.yaml", BOXES.replace("pairs:\n", "  - {name: c, frame: world, pose: {xyz: [0, 3, 0]}, box: {size: [1, 1, "
                                             "1]}}\npairs:\n  - {between: [a, c]}\n  - {between: [b, c]}\n"))
        self.write("run.bag", self.motion(10))
        self.run_bag("--scene three.yaml --bag run.bag --output d.csv --pairs *c")
        self.assertEqual(len(self.rows()), 11, "a and c stand")
        self.run_bag("--scene three.yaml --bag run.bag --output d.csv")
        self.assertEqual(len(self.rows()), 21)

    def test_reports_overlap(self):
        self.write("run.bag", self.motion(3, 1.5 - 0.7))
        self.run_boxes("--bag run.bag")
        self.assertEqual([row["status"] for row in self.rows()], 3 * ["penetrating"])
        self.assertEqual(self.rows()[2]["distance"], "0")
        self.assertNotEqual(self.rows()[2]["triangle_a"], "")

    def test_answers_a_robot_alone(self):
        box, limit = "<collision><geometry><box size='1 1 1'/></geometry></collision>", "<limit lower='0' upper='1' " \
            "effort='1' velocity='1'/></joint>"
        self.put("robot.urdf", "<robot name='two'><link name='base'>%s</link><link name='middle'><collision><geometry><sphere "
                 "radius='0.1'/></geometry></collision></link><link name='tip'>%s</link>"
                 "<joint name='j1' type='prismatic'><parent link='base'/><child link='middle'/><axis xyz='1 0 0'/>%s"
                 "<joint name='j2' type='prismatic'><parent link='middle'/><child link='tip'/><axis xyz='1 0 0'/>"
                 "<origin xyz='2 0 0'/>%s</robot>" % (box, box, limit, limit))
        self.write("run.bag", [("/tf", [transform("middle", 0.01 * i, at(10 * i), "base"),
                                        transform("tip", 2.0, at(10 * i), "middle")], 10 * i) for i in range(10)])
        further = " --reference-frame base --bag run.bag --output d.csv"
        self.run_bag("--robot-description robot.urdf --cutoff 0.5" + further)
        self.assertEqual(self.rows(), [])
        self.assertIn("no pair comes within its cutoff", self.log)
        self.run_bag("--robot-description robot.urdf --cutoff 5" + further)
        self.expect_distances([1.0 + 0.01 * i for i in range(10)])
        self.put("scene.yaml", "robots:\n  - description: tool_description\npairs:\n  - between: [base, tip]\n")
        self.run_bag("--scene scene.yaml" + further, 1)
        self.assertIn("give its file: --description tool_description=FILE", self.log)
        self.run_bag("--scene scene.yaml --description tool_description=robot.urdf" + further)
        self.assertEqual(len(self.answers()), 10)

    def test_draws_its_rows(self):
        self.write("run.bag", self.motion())
        self.run_boxes("--bag run.bag --plot d.png")
        self.assertEqual(self.content("d.png")[1:4], b"PNG")
        self.run_boxes("--bag run.bag --plot d.nothing", 1)
        self.assertIn("the plot could not be drawn; the rows are complete", self.log)
        self.assertEqual(len(self.rows()), 100)

    def test_ends_its_rows_where_it_is_interrupted(self):
        # The pipe is full long before the end, so that it is interrupted on the way.
        count = 5000
        self.write("run.bag", self.motion(count))
        os.mkfifo(self.path("rows"))
        command = [os.environ["DISTANCE_BAG"], "--scene", "boxes.yaml", "--bag", "run.bag", "--output", "rows"]
        with subprocess.Popen(command, cwd=self.folder, stderr=subprocess.PIPE, text=True) as program:
            with open(self.path("rows"), newline="") as reader:
                header = reader.readline()
                first = reader.readline()
                program.send_signal(signal.SIGINT)
                lines = [first] + reader.readlines()
            log = program.stderr.read()
        self.assertEqual(program.returncode, 130, log)
        self.assertLess(len(lines), count)
        self.assertEqual({(line.count(","), line[-1]) for line in lines}, {(header.count(","), "\n")}, "each line is whole")
        self.assertIn("interrupted", log)

    def test_leaves_clouds_out_and_says_so(self):
        self.write("run.bag", self.motion(10))
        self.put("cloud.yaml", BOXES + "  - {between: [a, camera]}\nclouds:\n  - {name: camera, topic: /points, frame: a}\n")
        self.run_bag("--scene cloud.yaml --bag run.bag --output d.csv")
        self.assertIn("warning: cloud 'camera' is left out", self.log)
        self.assertNotIn("no answer", self.log)
        self.assertEqual(len(self.rows()), 10)

    # What is wrong

    def test_helps_and_refuses_a_wrong_command_line(self):
        self.run_bag("--help")
        for text in ("--niches-output", "time,stamp,pair,", "Exit status", "--tf-static-topic", "--warning-hysteresis"):
            self.assertIn(text, self.log)
        self.run_bag("--bag run.bag", 2)
        self.write("run.bag", self.motion(2))
        for wrong in ("--stale-after -1", "--time-budget 1", "--threads 2000", "--start -1", "--start nan", "--duration 0",
                      "--cutoff -1", "--accuracy best", "--cache off"):
            self.run_boxes("--bag run.bag " + wrong, 2)

    def test_names_a_bag_that_is_none(self):
        os.mkdir(self.path("folder.bag"))
        self.put("text.bag", "SQLite format 3 and more")
        self.put("empty.bag", "")
        for name, text in (("none", "there is no such bag"), ("folder", "it is no file"), ("text", "it is no bag of ROS 1"),
                           ("empty", "it is no bag of ROS 1")):
            self.expect_fault("--bag %s.bag" % name, "%s.bag: %s" % (name, text))

    def test_asks_to_reindex_a_bag_that_is_cut_off(self):
        self.write("run.bag", self.motion())
        whole = self.content("run.bag")
        for length in [int(share * len(whole)) for share in (0.3, 0.6, 0.95, 0.999)] + [100]:
            self.put("cut.bag", whole[:length])
            self.expect_fault("--bag cut.bag", "cut.bag: it is cut off or damaged", "rosbag reindex cut.bag")

    def test_asks_to_reindex_a_recording_that_was_not_ended(self):
        self.write("run.bag", self.motion())
        self.put("open.bag", re.sub(rb"index_pos=.{8}", b"index_pos=" + bytes(8), self.content("run.bag"), flags=re.S))
        self.expect_fault("--bag open.bag", "open.bag: it has no index: its recording was not ended", "rosbag reindex open.bag")

    def test_says_that_a_bag_is_encrypted(self):
        self.write("run.bag", self.motion())
        bag = self.content("run.bag")
        begin = bag.index(b"\n") + 1
        length, = struct.unpack_from("<I", bag, begin)
        padding, = struct.unpack_from("<I", bag, begin + 4 + length)
        field = b"encryptor=rosbag/Unheard"
        field = struct.pack("<I", len(field)) + field
        # The padding behind the fields is shorter by as much; what follows cannot be read.
        self.put("secret.bag", bag[:begin] + struct.pack("<I", length + len(field)) + bag[begin + 4:begin + 4 + length] + field
                 + struct.pack("<I", padding - len(field)) + bytes(len(bag)))
        self.expect_fault("--bag secret.bag", "secret.bag: it is encrypted and cannot be opened", "gpg")

    def test_says_where_a_bag_is_damaged(self):
        self.write("run.bag", self.motion(200), "bz2")
        bag = self.content("run.bag")
        middle = bag.index(b"BZh", len(bag) // 3)
        self.put("bad.bag", bag[:middle + 20] + 40 * b"\x55" + bag[middle + 60:])
        self.expect_fault("--bag bad.bag", "bad.bag: it is damaged", "s after the begin", "nothing was written")

    def test_survives_bytes_that_lie(self):
        # Every byte of the records' heads and of the index in turn: an answer or a refusal that names the bag.
        self.write("run.bag", self.motion(5))
        bag = self.content("run.bag")
        places = [match.start() for match in re.finditer(rb"(?:size|conn|op|time|count|pos|compression|ver)=", bag)]
        for place in places[::5]:
            end = bag.index(b"=", place) + 1
            for lie in (b"\xff\xff\xff\x7f", bytes(4)):
                self.put("bad.bag", bag[:end] + lie + bag[end + 4:])
                self.run_boxes("--bag bad.bag", 0, 1)
                self.assertIn("bad.bag", self.log)

    def test_refuses_a_bomb(self):
        self.write("run.bag", [("/tf", String(2 * 10**6 * "x"), 0)] + self.motion(5), "bz2")
        self.expect_fault("--bag run.bag", "its topic /tf has the type std_msgs/String")

    def test_names_topics_that_there_are_instead(self):
        self.write("run.bag", [("/cell/tf", [transform("b", 2.0, at(0))], 0), ("/chatter", String(), 0)])
        self.expect_fault("--bag run.bag", "run.bag: there is no message on /tf or /tf_static", "/cell/tf")
        self.expect_fault("--bag run.bag --tf-topic /robot/tf", "there is no message on /robot/tf", "/cell/tf")
        self.expect_fault("--bag run.bag --tf-topic /chatter",
                          "its topic /chatter has the type std_msgs/String, which is not tf2_msgs/TFMessage", "/cell/tf")
        self.write("empty.bag", [])
        self.expect_fault("--bag empty.bag", "there is no message on /tf or /tf_static", "TFMessage: none")

    def test_leaves_out_messages_that_are_none(self):
        message = io.BytesIO()
        TFMessage([transform("b", 2.0, at(0))]).serialize(message)
        for lie in (message.getvalue()[:-9], b"\xff\xff\xff\x7f" + bytes(60), b"\x01\x00"):
            with rosbag.Bag(self.path("run.bag"), "w") as bag:
                for topic, transforms, ms in self.motion(10):
                    bag.write(topic, TFMessage(transforms), at(ms))
                    if ms == 50:
                        bag.write("/tf", (TFMessage._type, lie, TFMessage._md5sum, TFMessage), at(55), raw=True)
            self.run_boxes("--bag run.bag")
            self.assertIn("is none of tf: ", self.log)
            self.assertEqual(len(self.answers()), 10)

    def test_leaves_out_transforms_that_the_node_refuses_and_says_why(self):
        messages = self.motion()
        turned = transform("d", 1.0, at(203))
        turned.transform.rotation.w = 2.0
        wrong = [(transform("b", math.nan, at(103)), 103), (transform("c", 1.0, at(203)), 203), (turned, 203),
                 (transform("world", 1.0, at(303), "b"), 303), (transform("e", 1.0, genpy.Time()), 403),
                 (transform("c", 1.0, genpy.Time(BEGIN - 60)), 503), (transform("f", 1.0, genpy.Time(BEGIN + 60)), 603),
                 (transform("g", 1.0, at(703), "g"), 703), (transform("", 1.0, at(803)), 803), (transform("a", 1.0, at(903)), 903)]
        self.write("run.bag", sorted(messages + [("/tf", [one], ms) for one, ms in wrong], key=lambda message: message[2]))
        self.run_boxes("--bag run.bag")
        for text in ("its translation is (nan, 0, 0) m", "the norm of its quaternion is 2", "a loop", "its stamp is zero",
                     "older than the newest one", "ahead of the clock", "--tf-future-tolerance", "the frame is its own parent",
                     "it has no frame name", "published on both /tf and /tf_static"):
            self.assertIn(text, self.log)
        self.expect_distances([1.0 + 0.001 * i for i in range(100)])

    def test_answers_stamps_that_go_back_and_same_ones_once(self):
        self.write("run.bag", [("/tf_static", [transform("a", 0.0, at(0))], 0)] + [
            ("/tf", [transform("b", 2.0, at(10 * i))], 10 * i) for i in range(300)] + [
            ("/tf", [transform("b", 4.0, at(stamp))], ms) for stamp, ms in ((10, 3000), (15, 3001), (15, 3002))])
        self.run_boxes("--bag run.bag")
        self.assertEqual([(row["stamp"], row["time"]) for row in self.answers() if float(row["distance"]) != 1.0],
                         [(text_of(15), text_of(3001))])
        self.assertEqual(len(self.answers()), 301)

    def test_names_frames_that_never_appear(self):
        self.write("run.bag", [("/tf_static", [transform("a", 0.0, at(0))], 0), ("/tf", [transform("arm", 2.0, at(10))], 10)])
        self.expect_fault("--bag run.bag", "no pair has an answer", "'b'", "record /tf_static too", "the bag's frames: a, arm")
        self.write("run.bag", self.motion(10))
        self.expect_fault("--bag run.bag --reference-frame map", "no pair has an answer", "the reference frame 'map'",
                          "--reference-frame")
        self.put("three.yaml", BOXES.replace("pairs:\n", "  - {name: 'c,d', box: {size: [1, 1, 1]}}\npairs:\n  - {between: "
                                             "[a, 'c,d']}\n"))
        self.run_bag("--scene three.yaml --bag run.bag --output d.csv")
        self.assertIn("no answer of pair a/c_d: no transform from 'c,d' to 'world'", self.log)
        self.assertEqual((len(self.answers()), len(self.rows())), (10, 11), "one says that c,d is missing")
        self.assertIn(b",a/c_d,a,\"c,d\",missing_transform,", self.content("d.csv"), "quoted as CSV has it")

    def test_refuses_a_start_behind_the_end(self):
        self.write("run.bag", self.motion(10))
        self.expect_fault("--bag run.bag --start 5", "--start: it is 5 s, behind the end", "last 0.09 s")

    def test_writes_nothing_or_says_that_it_could_not(self):
        self.write("run.bag", self.motion(10))
        self.run_bag("--scene boxes.yaml --bag run.bag --output none/d.csv", 1)
        self.assertIn("none/", self.log)
        bag = self.content("run.bag")
        for outputs in ("--output run.bag", "--output d.csv --niches-output d.csv"):
            self.run_bag("--scene boxes.yaml --bag run.bag " + outputs, 1)
            self.assertIn("one is the same file as", self.log)
        self.assertEqual(self.content("run.bag"), bag)
        for outputs in ("--output /dev/full", "--output d.csv --niches-output /dev/full"):
            self.run_bag("--scene boxes.yaml --bag run.bag " + outputs, 1)
            self.assertIn("check paths, and the space on the device", self.log)
        self.assertEqual([name for name in os.listdir(self.folder) if "d.csv" in name], [], "not one of two")

    def test_asks_for_a_scene_and_its_descriptions(self):
        self.write("run.bag", self.motion(10))
        self.run_bag("--bag run.bag --output d.csv", 1)
        self.assertIn("there is no scene file and no --robot-description", self.log)
        self.put("robot.yaml", "robots:\n  - description: robot_description\n")
        self.run_bag("--scene robot.yaml --bag run.bag --output d.csv", 1)
        self.assertIn("it takes a robot from the parameter 'robot_description' (give its file: --robot-description FILE)", self.log)
        self.run_bag("--scene robot.yaml --robot-description none.urdf --bag run.bag --output d.csv", 1)
        self.assertIn("none.urdf", self.log)
        self.run_bag("--scene none.yaml --bag run.bag --output d.csv", 1)
        self.assertIn("none.yaml", self.log)


if __name__ == "__main__":
    unittest.main()
