"""Attacks of every group that shares a node, several at once, at random, for a given time."""

import collections
import random
import statistics
import threading
import time

import processes
import reference
import rospy
from attacks import Failed
from diagnostic_msgs.msg import DiagnosticArray
from node_under_test import Pulse

WORKERS = 4
SAMPLE = 1.0            # s between two samples of the memory
REPORT = 60.0           # s between two lines of progress
GROWTH_MB = 100.0       # largest growth of the node's own memory from the second quarter to the last
LONGEST_SILENCE = 60.0  # s without an answer to list_bodies; the machine is busy with attackers too
# Small limits make memory without a limit visible. LARGEST_MB is for the node and the processes it starts.
LIMITS = {"limits/largest_niche_count": 100000, "limits/import_memory_mb": 256, "limits/largest_node_count": 50000,
          "limits/largest_triangle_count": 200000}
LARGEST_MB = 1500.0
OVERHANG = 120.0        # s that attacks may take to end after the storm


class Cycles:
    """Cycles and late cycles as the node counts them in /diagnostics."""

    def __init__(self):
        self.all = 0
        self.late = 0
        self.subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, self.receive, queue_size=100)

    def receive(self, message):
        for status in message.status:
            values = {value.key: value.value for value in status.values}
            if "late cycles" in values:
                self.all += int(values["cycles"])
                self.late += int(values["late cycles"])


class Storm:
    def __init__(self, arena, attacks, seed):
        self.arena = arena
        self.seed = seed
        self.groups = [storming for storming in (
            [attack for attack in chosen if attack.storms] for group, chosen in attacks
            if group.setting is not None) if storming]
        self.running = True
        self.done = collections.Counter()
        self.failed = collections.Counter()
        self.going_on = {}
        self.deaths = []
        self.own_mb = []
        self.silence = 0.0
        self.cycles = Cycles()

    def work(self, index):
        engine = random.Random("%d %d" % (self.seed, index))
        while self.running:
            attack = engine.choice(engine.choice(self.groups))
            self.going_on[index] = "%s/%s" % (attack.group, attack.name)
            try:
                attack.act(self.arena)
            except Exception:  # attacks disturb each other, so their own checks do not apply
                self.failed[self.going_on[index]] += 1
            self.done[self.going_on[index]] += 1

    def visit(self, index):
        """Subscribers come and go."""
        engine = random.Random("%d visitor %d" % (self.seed, index))
        name = self.arena.node.name
        topics = {"distances": self.arena.messages.Distances, "niches": self.arena.messages.Niches,
                  "alerts": self.arena.messages.Alert, "contacts": self.arena.messages.Contacts}
        while self.running:
            topic = engine.choice(sorted(topics))
            subscriber = rospy.Subscriber("%s/%s" % (name, topic), topics[topic], lambda message: None, queue_size=1)
            time.sleep(engine.uniform(0.01, 3.0))
            subscriber.unregister()
            time.sleep(engine.uniform(0.0, 1.0))

    def restart(self):
        self.deaths.append("%s, during %s" % (self.arena.node.why_dead(), ", ".join(sorted(self.going_on.values()))))
        print("the node died: " + self.deaths[-1], flush=True)
        self.start_node()

    def start_node(self):
        self.arena.stop_node()
        node = self.arena.start_node("storm_%d" % len(self.deaths), storm_setting())
        node.wait_until_ready(60.0)
        self.arena.listen()
        self.pulse = Pulse(node)

    def blow(self, seconds):
        threads = [threading.Thread(target=self.work, args=(index,), daemon=True) for index in range(WORKERS)]
        threads += [threading.Thread(target=self.visit, args=(index,), daemon=True) for index in range(3)]
        for thread in threads:
            thread.start()
        began = reported = time.monotonic()
        while time.monotonic() - began < seconds:
            time.sleep(SAMPLE)
            if not self.arena.node.alive():
                self.restart()
            self.own_mb.append(processes.own_mb(self.arena.node.process.pid))
            self.silence = max(self.silence, self.pulse.longest)
            if time.monotonic() - reported >= REPORT:
                reported = time.monotonic()
                print(self.line(time.monotonic() - began), flush=True)
        self.running = False
        ends = time.monotonic() + OVERHANG * self.arena.patience
        for thread in threads:
            thread.join(max(0.0, ends - time.monotonic()))
        self.silence = max(self.silence, self.pulse.longest)
        self.pulse.stop(5.0)

    def line(self, elapsed):
        return "storm %6.0f s: %d attacks, %d of them without what they show alone; %.0f MB (peak with children %.0f), " \
            "%d cycles, %d late, list_bodies waited %.1f s at most, %d deaths" % (
                elapsed, sum(self.done.values()), sum(self.failed.values()), self.own_mb[-1],
                self.arena.node.memory.peak_mb, self.cycles.all, self.cycles.late, self.silence, len(self.deaths))

    def clean_up(self):
        """Undoes the changes of attacks that were cut short."""
        from request_checks import call
        self.arena.player.dropped = set()
        listed = self.arena.node.list_bodies(60.0)
        for body in listed.bodies:
            if body.name not in self.bodies:
                call(self.arena, "remove_body", 60.0, name=body.name)
        for pair in self.pairs:
            call(self.arena, "set_pair_enabled", 60.0, pair=pair, enabled=True)
        call(self.arena, "set_effects", 60.0, pair="*", effects="none")

    def growth_mb(self):
        """Growth from the second quarter, when everything has been used once, to the last."""
        quarter = max(1, len(self.own_mb) // 4)
        return statistics.median(self.own_mb[-quarter:]) - statistics.median(self.own_mb[quarter:2 * quarter] or [0.0])


def storm_setting():
    return {"diagnostic_period": 1.0, **LIMITS}


def check(runner, name, act):
    """One line of the report."""
    began = time.monotonic()
    try:
        failure = act()
    except Failed as problem:
        failure = str(problem)
    node = runner.arena.running_node
    runner.report("storm/" + name, time.monotonic() - began, node.memory.peak_mb if node else 0.0, failure)


def run(runner, attacks, seconds, seed):
    """attacks: pairs of a group and those of its attacks that take part."""
    arena = runner.arena
    arena.largest_mb = LARGEST_MB * arena.memory_factor
    storm = Storm(arena, attacks, seed)
    storm.start_node()
    fresh = reference.answers(arena.node)
    listed = arena.node.list_bodies()
    storm.bodies = {body.name for body in listed.bodies}
    storm.pairs = [pair.name for pair in listed.pairs]
    arena.stop_node()
    storm.start_node()
    arena.require_tracking(60.0)
    print("storm of %.0f s, seed %d, %d attacks" % (seconds, seed, sum(len(group) for group in storm.groups)), flush=True)
    storm.blow(seconds)
    print(storm.line(seconds), flush=True)
    for name, count in storm.failed.most_common(12):
        print("  %4d of %4d: %s" % (count, storm.done[name], name))
    if not arena.node.alive():
        storm.restart()
    check(runner, "lives", lambda: "%d deaths; the first: %s" % (len(storm.deaths), storm.deaths[0])
          if storm.deaths else None)
    check(runner, "answers_all_the_time", lambda: "list_bodies waited %.1f s" % storm.silence
          if storm.silence > LONGEST_SILENCE * arena.patience else None)
    check(runner, "counts_its_cycles", lambda: None if storm.cycles.all > seconds else "%d cycles" % storm.cycles.all)
    check(runner, "memory_is_flat", lambda: "it grew by %.0f MB: %s" % (storm.growth_mb(), [
        round(mb) for mb in storm.own_mb[::max(1, len(storm.own_mb) // 40)]])
        if storm.growth_mb() > GROWTH_MB * arena.memory_factor else None)
    check(runner, "cleans_up", storm.clean_up)
    check(runner, "follows_the_motion", lambda: arena.require_tracking(60.0))
    check(runner, "answers_like_a_fresh_node", lambda: reference.require_equal(arena.node, fresh))
    check(runner, "ends_on_sigint", lambda: None if arena.stop_node() is not None else "it had to be killed")
