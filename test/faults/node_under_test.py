"""A node under attack: started, watched, called and ended from outside."""

import os
import signal
import threading
import time

import processes
import ros_wire
from attacks import Failed, shortened

NODE = "/concave_distance"
LITTLE_MB = 200.0  # less is not worth a closer look


class MemoryWatch(threading.Thread):
    """Samples the memory of a node and its children; ends the node before it uses up the machine's memory."""
    PERIOD = 0.05

    def __init__(self, process, largest_mb):
        super().__init__(daemon=True)
        self.process = process
        self.largest_mb = largest_mb
        self.peak_mb = 0.0
        self.ended_for = None
        self.start()

    def run(self):
        while self.process.poll() is None:
            now_mb = processes.resident_mb(self.process.pid)
            if now_mb > max(self.peak_mb, LITTLE_MB):
                now_mb = processes.shared_out_mb(self.process.pid)
            self.peak_mb = max(self.peak_mb, now_mb)
            if now_mb > self.largest_mb:
                self.ended_for = "%.0f MiB of memory (the attacks allow %.0f)" % (now_mb, self.largest_mb)
                processes.end_group(self.process)
            time.sleep(self.PERIOD)


class Node:
    """A distance node with parameters, started by the constructor. It is ready when wait_until_ready returns."""

    def __init__(self, arena, parameters, log_name, use_sim_time=False, name=NODE, arguments=()):
        self.arena = arena
        self.name = name
        self.log_path = os.path.join(arena.folder, "logs", log_name + ".log")
        os.makedirs(os.path.dirname(self.log_path), exist_ok=True)
        arena.set_parameters(name, parameters)
        arena.set_parameter("/use_sim_time", use_sim_time)
        command = [arena.program("distance_node"), "__name:=" + name.strip("/"), *arguments]
        with open(self.log_path, "wb") as log:
            self.process = processes.start(command, arena.environment, log, arena.address_space_gb)
        self.memory = MemoryWatch(self.process, arena.largest_mb)

    # State

    def alive(self):
        return self.process.poll() is None

    def resident_mb(self):
        return processes.resident_mb(self.process.pid)

    def processor_seconds(self):
        return processes.processor_seconds(self.process.pid)

    def log_length(self):
        return os.path.getsize(self.log_path)

    def log(self, since=0):
        with open(self.log_path, errors="replace") as log:
            log.seek(since)
            return log.read()

    def why_dead(self):
        text = self.memory.ended_for or processes.ended_as(self.process)
        lines = [line for line in self.log().splitlines() if line.strip()]
        telling = [line for line in lines if "terminate" in line or "what()" in line or "Sanitizer" in line
                   or "runtime error" in line or "FATAL" in line]
        return text + ": " + shortened((telling or lines or [""])[-1], 200)

    def require_alive(self):
        if not self.alive():
            raise Failed("the node died: " + self.why_dead())

    # Services

    def service_uri(self, service):
        deadline = time.monotonic() + 5.0
        while True:
            code, text, uri = self.arena.master().lookupService("/faults", self.name + "/" + service)
            if code == 1:
                return uri
            self.require_alive()
            if time.monotonic() > deadline:
                raise ros_wire.CallFailed("the service is not offered: " + text)
            time.sleep(0.02)

    def call(self, service, service_class, request=None, timeout=20.0, replace=()):
        """The response; Failed when none comes."""
        if request is None:
            request = service_class._request_class()
        for is_last in (False, True):
            try:
                return ros_wire.call(self.service_uri(service), self.name + "/" + service, service_class, request,
                                     timeout * self.arena.patience, replace)
            except ros_wire.CallFailed as problem:
                closed = "closed the connection" in str(problem) or "reset by peer" in str(problem)
                if closed:
                    self.wait_for_end(0.5)  # a node that died of the request
                self.require_alive()
                # roscpp drops a connection unanswered once in many thousand calls under load (ros_comm issue 1976).
                if is_last or not closed:
                    raise Failed("%s: %s" % (service, shortened(problem, 300))) from None
                self.arena.repeated_calls += 1

    def slave_uri(self):
        code, text, uri = self.arena.master().lookupNode("/faults", self.name)
        if code != 1:
            raise Failed("the node is not registered: " + text)
        return uri

    def list_bodies(self, timeout=20.0):
        return self.call("list_bodies", self.arena.services.ListBodies, timeout=timeout)

    def wait_until_ready(self, timeout=30.0):
        deadline = time.monotonic() + timeout * self.arena.patience
        message = "no answer"
        while time.monotonic() < deadline:
            self.require_alive()
            try:
                listed = self.list_bodies()
                if listed.ready:
                    return listed
                message = listed.message
            except Failed as problem:
                message = str(problem)
            time.sleep(0.05)
        raise Failed("the node is not ready after %.0f s: %s" % (timeout, message))

    def stop(self):
        """Seconds until the node had ended after SIGINT; None when it had to be killed."""
        seconds = processes.end_group(self.process, signal.SIGINT, 15.0 * self.arena.patience)
        self.arena.forget(self.name)
        return seconds


class Pulse(threading.Thread):
    """Calls list_bodies repeatedly during an attack, and keeps the longest wait."""
    PERIOD = 0.2

    def __init__(self, node):
        super().__init__(daemon=True)
        self.node = node
        self.longest = 0.0
        self.failure = None
        self.stopped = threading.Event()
        self.start()

    def run(self):
        while not self.stopped.is_set() and self.node.alive():
            began = time.monotonic()
            try:
                self.node.list_bodies(timeout=60.0)
            except Exception as problem:  # any answer of a node under attack
                if not self.stopped.is_set():
                    self.failure = shortened(problem)
            self.longest = max(self.longest, time.monotonic() - began)
            self.stopped.wait(self.PERIOD)

    def stop(self, timeout):
        self.stopped.set()
        self.join(timeout)
