"""Simulated clocks that jump, stand still or never come."""

import threading
import time

import genpy
import rospy
from attacks import Group, expect
from request_checks import ask, require_sound
from rosgraph_msgs.msg import Clock
from tf2_msgs.msg import TFMessage

group = Group("clock")
LAST = 4294967295  # s, the end of ROS's time


class Simulation:
    """A node in simulated time, a clock, and frames of the scene with its stamps."""

    def __init__(self, arena):
        self.arena = arena
        self.now = None
        self.running = True
        self.rate = 1.0  # simulated seconds per real second
        self.moving = True
        self.clock = rospy.Publisher("/clock", Clock, queue_size=100)
        self.tf = rospy.Publisher("/tf", TFMessage, queue_size=100)
        arena.player.playing = False
        self.codes = []
        self.distances = []

    def __enter__(self):
        self.node = self.arena.start_node("clock_%d" % time.monotonic_ns(), use_sim_time=True)
        self.subscriber = rospy.Subscriber(self.node.name + "/distances", self.arena.messages.Distances, self.receive)
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.running = False
        self.thread.join(5.0)
        self.subscriber.unregister()
        self.arena.stop_node()
        self.arena.player.playing = True
        self.arena.set_parameter("/use_sim_time", False)

    def receive(self, message):
        for pair in message.pairs:
            if pair.pair == "boxes":
                self.codes.append(pair.status.code)
                self.distances.append((pair.header.stamp.to_sec(), pair.status.code, pair.distance))

    def run(self):
        last = time.monotonic()
        while self.running:
            time.sleep(0.02)
            elapsed, last = time.monotonic() - last, time.monotonic()
            if self.now is None:
                continue
            if self.moving:
                self.now += elapsed * self.rate
            self.publish()

    def publish(self):
        stamp = genpy.Time.from_sec(min(max(self.now, 0.0), LAST))
        self.clock.publish(Clock(stamp))
        if self.moving:
            self.tf.publish(self.arena.player.message(stamp))

    def expect_right(self, timeout=20.0):
        """Waits for a right distance, stamped with simulated time."""
        self.distances = []

        def right():
            seen = list(self.distances)
            self.distances = self.distances[len(seen):]
            return any(code == self.arena.messages.PairStatus.OK
                       and abs(distance - self.arena.frames.gap_at(stamp)) < 0.05 and abs(stamp - self.now) < 5.0
                       for stamp, code, distance in seen)
        self.arena.wait_until(right, timeout, "no right distance at the simulated time %r; last status %s" % (
            self.now, self.codes[-1:]))

    def expect_served(self):
        self.node.list_bodies(timeout=10.0)
        require_sound(ask(self.arena))


@group.attack(deadline=90.0)
def no_clock_at_all(arena):
    """The node logs why nothing moves, answers services, and ends on SIGINT."""
    with Simulation(arena) as simulation:
        simulation.node.wait_until_ready(30.0)
        simulation.expect_served()
        arena.wait_until(lambda: "/clock" in simulation.node.log() or "use_sim_time" in simulation.node.log(), 30.0,
                         "the log does not say that nobody publishes /clock")
        seconds = simulation.node.stop()
        expect(seconds is not None, "it had to be killed after SIGINT")


def jumps(arena, *times, right_after=True):
    """The clock runs, jumps to each of the times in turn, and continues from there."""
    with Simulation(arena) as simulation:
        simulation.now = 1000.0
        simulation.node.wait_until_ready(30.0)
        simulation.expect_right()
        for moment in times:
            simulation.now = moment
            time.sleep(2.0)
            simulation.expect_served()
            expect(simulation.node.alive(), "the node died: " + simulation.node.why_dead())
        simulation.now = times[-1]
        if right_after:
            simulation.expect_right()
        before = simulation.node.processor_seconds()
        time.sleep(1.0)
        busy = simulation.node.processor_seconds() - before
        expect(busy < 0.9, "the node burns %.2f s of processor time in a second" % busy)


JUMPS = {"forward_an_hour": (4600.0,), "back_an_hour": (5000.0, 1400.0), "to_zero": (0.0,), "back_by_a_millisecond":
         (1001.999, 1001.998), "forward_4e9": (4e9,), "forward_4e9_and_back": (4e9, 1000.0), "to_the_end_and_back":
         (LAST - 30.0, 2.0), "past_2e31": (2.0**31 - 1.0,), "to_2e31_and_back": (2.0**31 + 10.0, 500.0),
         "to_and_fro": (2000.0, 1.0, 3e9, 5.0, 2e9, 7.0)}
for label, moments in JUMPS.items():
    group.add("jumps_" + label, lambda arena, moments=moments: jumps(arena, *moments), deadline=120.0)


@group.attack(deadline=90.0)
def at_its_end(arena):
    """4294967295 s is the largest time in ROS."""
    jumps(arena, LAST - 1.0, LAST, 10.0)


@group.attack(deadline=90.0)
def stands_still(arena):
    """Services answer; when the clock goes on, so does the motion."""
    with Simulation(arena) as simulation:
        simulation.now = 1000.0
        simulation.node.wait_until_ready(30.0)
        simulation.expect_right()
        simulation.moving = False
        time.sleep(3.0)
        simulation.expect_served()
        simulation.moving = True
        simulation.expect_right()


@group.attack(deadline=90.0)
def steps_of_a_nanosecond(arena):
    with Simulation(arena) as simulation:
        simulation.now = 1000.0
        simulation.node.wait_until_ready(30.0)
        simulation.moving = False
        stamp = genpy.Time(1000, 0)
        ends = time.monotonic() + 5.0
        while time.monotonic() < ends:
            stamp = stamp + genpy.Duration(0, 1)
            simulation.clock.publish(Clock(stamp))
            time.sleep(0.0005)
        simulation.expect_served()
        simulation.moving = True
        simulation.expect_right()


@group.attack(deadline=90.0)
def runs_a_thousand_times_too_fast(arena):
    with Simulation(arena) as simulation:
        simulation.now = 1000.0
        simulation.node.wait_until_ready(30.0)
        simulation.rate = 1000.0
        time.sleep(4.0)
        simulation.expect_served()
        simulation.rate = 1.0
        simulation.expect_right()


@group.attack(deadline=90.0)
def two_clocks_that_disagree(arena):
    with Simulation(arena) as simulation:
        simulation.now = 1000.0
        simulation.node.wait_until_ready(30.0)
        ends = time.monotonic() + 4.0
        while time.monotonic() < ends:
            simulation.clock.publish(Clock(genpy.Time(5, 0)))
            time.sleep(0.03)
        simulation.expect_served()
        simulation.expect_right()
