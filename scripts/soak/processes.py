"""Memory, processor time and process ids of the programs of the soak, as the kernel and the master say."""

import os
import threading
import xmlrpc.client

import rosgraph

PERIOD = 2.0  # s between two looks at each program
TICKS = os.sysconf("SC_CLK_TCK")


def resident_mb(pid):
    """VmRSS in MiB; None: the process is gone."""
    try:
        with open("/proc/%d/status" % pid, encoding="ascii", errors="replace") as stream:
            for line in stream:
                if line.startswith("VmRSS:"):
                    return int(line.split()[1]) / 1024.0
    except OSError:
        pass
    return None


def stat_of(pid):
    """Parent and processor seconds of a process; None: it is gone."""
    try:
        with open("/proc/%d/stat" % pid, encoding="ascii", errors="replace") as stream:
            fields = stream.read().rpartition(")")[2].split()
    except OSError:
        return None
    return int(fields[1]), (int(fields[11]) + int(fields[12])) / TICKS


def processor_seconds_below(root):
    """Of a process and all that descend from it, by their ids."""
    stats = {int(name): stat_of(int(name)) for name in os.listdir("/proc") if name.isdigit()}
    stats = {pid: stat for pid, stat in stats.items() if stat}
    found = {}
    for pid in stats:
        line = [pid]
        while line[-1] != root and line[-1] in stats:
            line.append(stats[line[-1]][0])
        if line[-1] == root:
            found[pid] = stats[pid][1]
    return found


def pid_of(node):
    """As the node itself says; None: it does not answer."""
    try:
        code, _, pid = xmlrpc.client.ServerProxy(rosgraph.Master("/soak").lookupNode(node)).getPid("/soak")
        return pid if code == 1 else None
    except (OSError, rosgraph.MasterException, xmlrpc.client.Error):
        return None


class Program:
    """A node that is watched."""

    def __init__(self, node):
        self.node = node
        self.pid = None
        self.restarts = 0
        self.largest_mb = 0.0
        self.seconds = 0.0


class Processes(threading.Thread):
    """Looks at the nodes again and again: memory, restarts, and the processor time of the whole cell."""

    def __init__(self, nodes, launch_pid):
        super().__init__(daemon=True)
        self.lock = threading.Lock()
        self.programs = {label: Program(node) for label, node in nodes.items()}
        self.launch_pid = launch_pid
        self.all_seconds = 0.0
        self._before = {}
        self._ends = threading.Event()
        self.start()

    def run(self):
        while not self._ends.wait(PERIOD):
            self._look()

    def end(self):
        self._ends.set()
        self.join()

    def _look(self):
        pids = {label: pid_of(program.node) for label, program in self.programs.items()}
        seconds = processor_seconds_below(self.launch_pid)
        seconds.update(processor_seconds_below(os.getpid()))
        with self.lock:
            for pid, used in seconds.items():
                self.all_seconds += max(0.0, used - self._before.get(pid, used))
            for label, pid in pids.items():
                program = self.programs[label]
                if pid is None:
                    continue
                if program.pid is not None and pid != program.pid:
                    program.restarts += 1
                program.pid = pid
                program.largest_mb = max(program.largest_mb, resident_mb(pid) or 0.0)
                program.seconds += max(0.0, seconds.get(pid, 0.0) - self._before.get(pid, seconds.get(pid, 0.0)))
            self._before = seconds

    def take(self):
        """Since the last call: the largest VmRSS of each program (MiB), processor seconds of each and of all; restarts
        since the beginning."""
        with self.lock:
            memory = {label: program.largest_mb for label, program in self.programs.items()}
            seconds = {label: program.seconds for label, program in self.programs.items()}
            everything, self.all_seconds = self.all_seconds, 0.0
            for program in self.programs.values():
                program.largest_mb, program.seconds = 0.0, 0.0
            return memory, seconds, everything, sum(program.restarts for program in self.programs.values())
