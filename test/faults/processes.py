"""Processes seen from outside: memory and processor time with children, start with limits, end of a group."""

import os
import resource
import signal
import subprocess
import time

PAGE_BYTES = os.sysconf("SC_PAGE_SIZE")
TICKS = os.sysconf("SC_CLK_TCK")


def children_of(pid):
    found = []
    try:
        for task in os.listdir("/proc/%d/task" % pid):
            with open("/proc/%d/task/%s/children" % (pid, task)) as listing:
                found += [int(child) for child in listing.read().split()]
    except OSError:
        pass
    return found


def family_of(pid):
    """The process and its present descendants."""
    family = [pid]
    for member in family:
        family += children_of(member)
    return family


def own_mb(pid):
    """Resident memory of one process, MiB; 0 when there is none."""
    try:
        with open("/proc/%d/statm" % pid) as statm:
            return int(statm.read().split()[1]) * PAGE_BYTES / 2.0**20
    except (OSError, IndexError):
        return 0.0


def resident_mb(pid):
    """The same with its children."""
    return sum(own_mb(member) for member in family_of(pid))


def shared_out_mb(pid):
    """The same with each page counted once: a process just forked has its parent's pages until it executes its program."""
    total = 0.0
    for member in family_of(pid):
        try:
            with open("/proc/%d/smaps_rollup" % member) as rollup:
                total += sum(int(line.split()[1]) for line in rollup if line.startswith("Pss:")) / 1024.0
        except (OSError, IndexError, ValueError):
            pass
    return total


def processor_seconds(pid):
    """User and system time of the process itself."""
    try:
        with open("/proc/%d/stat" % pid) as stat:
            fields = stat.read().rpartition(")")[2].split()
    except OSError:
        return 0.0
    return (int(fields[11]) + int(fields[12])) / TICKS


def start(command, environment=None, output=subprocess.DEVNULL, address_space_gb=None):
    """Starts a program in a process group of its own, with a limit on its memory and without core files."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if address_space_gb:
            bytes_allowed = int(address_space_gb * 2**30)
            resource.setrlimit(resource.RLIMIT_AS, (bytes_allowed, bytes_allowed))
    return subprocess.Popen(command, env=environment, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                            start_new_session=True, preexec_fn=limit)


def end_group(process, gently=None, timeout=15.0):
    """Ends a process and its group, first with the signal `gently`. Returns the seconds until it ended, or None when
    it had to be killed."""
    seconds = None
    if process.poll() is None and gently is not None:
        began = time.monotonic()
        process.send_signal(gently)
        try:
            process.wait(timeout)
            seconds = time.monotonic() - began
        except subprocess.TimeoutExpired:
            pass
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    process.wait()
    return seconds


def ended_as(process):
    """How a process ended, in words."""
    code = process.poll()
    if code is None:
        return "running"
    if code < 0:
        try:
            return "ended by " + signal.Signals(-code).name
        except ValueError:
            return "ended by signal %d" % -code
    return "exited with status %d" % code
