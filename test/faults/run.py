#!/usr/bin/python3
"""Attacks the built programs from outside and counts passed attacks; scripts/faults.sh builds and calls this.

One line an attack, `PASS/FAIL group/name seconds memory reason`, and at the end `N passed, N failed`.
"""

import argparse
import csv
import fnmatch
import importlib
import os
import shutil
import signal
import sys
import tempfile
import threading
import time
import traceback

from arena import Arena
from attacks import Failed, expect, groups, shortened

MODULES = ("hostile_queries", "hostile_bodies", "hostile_services", "hostile_operations", "hostile_wire", "races", "tf_faults",
           "clock_faults")
GRACE = 60.0  # s after its deadline when a hanging attack is abandoned


class Runner:
    def __init__(self, arena):
        self.arena = arena
        self.results = []
        self.fresh = {}  # group -> answers of a fresh node
        self.starts = 0

    def report(self, name, seconds, memory_mb, failure):
        self.results.append((name, seconds, memory_mb, failure))
        print("%s %-52s %6.1f s %6.0f MB%s" % ("FAIL" if failure else "PASS", name, seconds, memory_mb,
                                               "  " + shortened(failure, 400) if failure else ""), flush=True)

    # One attack

    def act(self, attack):
        """The failure, or None. The attack runs in a thread, so that the run continues if it hangs."""
        outcome = []

        def body():
            try:
                attack.act(self.arena)
                outcome.append(None)
            except Failed as failure:
                outcome.append(str(failure))
            except Exception:
                outcome.append("the attack itself broke: " + " | ".join(traceback.format_exc().splitlines()[-3:]))
        thread = threading.Thread(target=body, daemon=True)
        began = time.monotonic()
        deadline = attack.deadline * self.arena.patience
        thread.start()
        thread.join(deadline + GRACE)
        if thread.is_alive():
            return "it hangs: no end after %.0f s" % (deadline + GRACE)
        if outcome[0] is None and time.monotonic() - began > deadline:
            return "it took %.1f s, longer than %.0f s" % (time.monotonic() - began, deadline)
        return outcome[0]

    def attack_node(self, attack):
        from node_under_test import Pulse
        node = self.arena.node
        before_mb = node.resident_mb()
        node.memory.peak_mb = before_mb
        pulse = Pulse(node)
        failure = self.act(attack)
        pulse.stop(5.0)
        growth_mb = node.memory.peak_mb - before_mb
        if not attack.dies and not node.alive():
            return "the node died: " + node.why_dead()
        if failure is None and not attack.dies:
            if pulse.longest > attack.silence * self.arena.patience:
                failure = "list_bodies waited %.1f s for an answer" % pulse.longest
            elif growth_mb > attack.growth_mb * self.arena.memory_factor:
                failure = "the node grew by %.0f MB (allowed %.0f)" % (growth_mb, attack.growth_mb)
            else:
                try:
                    node.list_bodies(timeout=attack.silence)
                except Failed as problem:
                    failure = "afterwards: %s" % problem
        return failure

    # A group

    def fresh_node(self, group):
        self.arena.stop_node()
        self.starts += 1
        node = self.arena.start_node("%s_%d" % (group.name, self.starts), **group.setting)
        node.wait_until_ready()
        self.arena.listen()
        return node

    def prepare(self, group):
        """The group's node, alive and following the motion."""
        import reference
        if self.arena.running_node is None or not self.arena.node.alive():
            self.fresh_node(group)
            self.arena.require_tracking(30.0)
        if group.name not in self.fresh:
            self.fresh[group.name] = reference.answers(self.arena.node)
            self.fresh_node(group)
            self.arena.require_tracking(30.0)

    def compare(self, group):
        """After the attacks: the node follows the motion again and answers as a fresh one."""
        import reference
        began = time.monotonic()
        failure = None
        try:
            self.arena.require_tracking(30.0)
            reference.require_equal(self.arena.node, self.fresh[group.name])
        except Failed as problem:
            failure = str(problem)
        self.report(group.name + "/answers_like_a_fresh_node", time.monotonic() - began,
                    self.arena.node.resident_mb(), failure)

    def run(self, group, chosen):
        """Attacks on a node that they share."""
        attacked_since_start = False
        for attack in chosen:
            memory_mb = 0.0
            began = time.monotonic()
            try:
                self.prepare(group)
                began = time.monotonic()
                failure = self.attack_node(attack)
                memory_mb = self.arena.node.memory.peak_mb
                attacked_since_start = True
            except Failed as problem:
                failure = "before the attack: %s" % problem
            self.report("%s/%s" % (group.name, attack.name), time.monotonic() - began, memory_mb, failure)
            if failure or attack.dies:
                self.arena.stop_node()  # the next attack gets a new node
                attacked_since_start = False
        if attacked_since_start and self.arena.running_node is not None:
            self.compare(group)
        self.arena.stop_node()

    def run_alone(self, group, chosen):
        """Attacks that start what they need."""
        for attack in chosen:
            began = time.monotonic()
            failure = self.act(attack)
            self.report("%s/%s" % (group.name, attack.name), time.monotonic() - began, 0.0, failure)

    def run_all(self, chosen):
        for group, attacks in chosen:
            if group.setting is not None and attacks:
                self.run(group, attacks)
            else:
                self.run_alone(group, attacks)

    def finish(self, path):
        if path:
            with open(path, "w", newline="") as file:
                writer = csv.writer(file)
                writer.writerow(["attack", "passed", "seconds", "memory_mb", "failure"])
                for name, seconds, memory_mb, failure in self.results:
                    writer.writerow([name, int(not failure), "%.2f" % seconds, "%.0f" % memory_mb, failure or ""])
        if self.arena.repeated_calls:
            print("%d calls were repeated: the node had closed their connection without an answer"
                  % self.arena.repeated_calls)
        failed = [result for result in self.results if result[3]]
        if failed:
            print("failed: " + " ".join(result[0] for result in failed))
        print("%d passed, %d failed" % (len(self.results) - len(failed), len(failed)), flush=True)
        return 1 if failed else 0


def chosen_of(group, patterns, fast):
    return [attack for attack in group.attacks
            if (attack.fast or not fast)
            and (not patterns or any(fnmatch.fnmatch("%s/%s" % (group.name, attack.name), pattern)
                                     for pattern in patterns))]


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("patterns", nargs="*", help="attacks to run, e.g. 'tf/*'; default: all")
    parser.add_argument("--build", default="build", help="folder in which the programs were built")
    parser.add_argument("--sanitized", action="store_true", help="the programs were built with sanitizers")
    parser.add_argument("--fast", action="store_true", help="only the subset of every test run, about a minute")
    parser.add_argument("--storm", type=float, metavar="SECONDS", help="everything at once, at random, for this long")
    parser.add_argument("--seed", type=int, default=1, help="seed of the storm")
    parser.add_argument("--port", type=int, help="port of the master; default: a free one")
    parser.add_argument("--folder", help="scratch folder with logs, kept; default: a temporary one")
    parser.add_argument("--results", help="CSV file with a line per attack")
    parser.add_argument("--list", action="store_true", help="print the attacks and end")
    return parser.parse_args(arguments)


def load_attacks():
    for module in MODULES:
        importlib.import_module(module)


def main(arguments):
    options = parse(arguments)
    if options.list:
        load_attacks()
        for group in groups.values():
            for attack in group.attacks:
                print("%s/%s" % (group.name, attack.name))
        print("%d attacks" % sum(len(group.attacks) for group in groups.values()))
        return 0
    threading.excepthook = lambda problem: None  # from clients of a node that was ended
    # A shell starts its background jobs with SIGINT ignored, and programs started here would inherit that.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # so that the node and the master end too
    folder = options.folder or tempfile.mkdtemp(prefix="faults_")
    began = time.monotonic()
    arena = Arena(options.build, folder, options.port, options.sanitized)
    runner = Runner(arena)
    try:
        arena.join_ros()
        load_attacks()
        chosen = [(group, chosen_of(group, options.patterns, options.fast)) for group in groups.values()]
        expect(any(attacks for _, attacks in chosen), "no attack has such a name (--list prints all names)")
        if options.storm is None:
            runner.run_all(chosen)
        else:
            import storm
            storm.run(runner, chosen, options.storm, options.seed)
    finally:
        arena.close()
        if not options.folder:
            shutil.rmtree(folder, ignore_errors=True)
    print("%.0f s" % (time.monotonic() - began))
    return runner.finish(options.results)


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    try:
        status = main(sys.argv[1:])
    except SystemExit as ended:
        status = ended.code
    sys.stdout.flush()
    os._exit(status)  # threads of hanging attacks would keep the process alive
