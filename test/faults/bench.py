"""A folder with good inputs, in which attacks run the tools."""

import os
import resource
import signal
import subprocess
import tempfile

import processes
from attacks import expect, shortened

SECONDS = 20.0
HEADER = "t,x,y,z,qx,qy,qz,qw\n"
GOOD = HEADER + "0,2,0,0,0,0,0,1\n1,2,0.5,0,0,0,0,1\n"
PAIR = """bodies:
  - {name: plate, frame: world, box: {size: [1, 1, 0.1]}}
  - {name: ball, frame: ball, sphere: {radius: 0.25}}
"""
MOTION = HEADER + "0,2,0,1,0,0,0,1\n1,-2,0,1,0,0,0,1\n"
CUBE = "".join("v %d %d %d\n" % (i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)) + \
    "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"


class Bench:
    """A folder with good inputs for one attack."""

    def __init__(self, arena):
        self.arena = arena
        os.makedirs(arena.path("tools"), exist_ok=True)
        self.folder = tempfile.mkdtemp(dir=arena.path("tools"))
        self.write("cube.obj", CUBE)
        self.write("poses.csv", GOOD)
        self.write("pair.yaml", PAIR)
        self.write("motion.csv", MOTION)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        return self.arena.write(self.path(name), content)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def run(self, tool, *arguments, stdout=None, file_bytes=None, seconds=SECONDS, stdin=subprocess.DEVNULL):
        """Status (None: it did not end) and what it printed."""
        def limit():
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            if self.arena.address_space_gb:
                resource.setrlimit(resource.RLIMIT_AS, (4 * 2**30, 4 * 2**30))
            if file_bytes is not None:
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (file_bytes, file_bytes))
        output = stdout or subprocess.PIPE
        process = subprocess.Popen([self.arena.program(tool), *arguments], cwd=self.folder, env=self.arena.environment,
                                   stdin=stdin, stdout=output, stderr=subprocess.PIPE, preexec_fn=limit,
                                   start_new_session=True)
        try:
            printed, complained = process.communicate(timeout=seconds * self.arena.patience)
        except subprocess.TimeoutExpired:
            processes.end_group(process)
            return None, ""
        return process.returncode, ((printed or b"") + complained).decode(errors="replace")

    def refused(self, *command, words=(), left_behind=(), **options):
        """The tool ends with status 1 or 2 and a message, and leaves no incomplete file."""
        status, text = self.run(*command, **options)
        expect(status is not None, "it does not end within %.0f s" % options.get("seconds", SECONDS))
        expect(status in (1, 2), "it ended with %d: %s" % (status, shortened(text[-200:])))
        expect(text.strip(), "it says nothing")
        expect(len(text) < 20000, "it says %d characters" % len(text))
        missing = [word for word in words if word not in text]
        expect(not missing, "the message does not name %s: %s" % (", ".join(missing), shortened(text[-200:])))
        left = [name for name in left_behind if os.path.exists(self.path(name))]
        expect(not left, "left behind: " + ", ".join(left))

    def works(self, *command, **options):
        status, text = self.run(*command, **options)
        expect(status == 0, "it ended with %s: %s" % (status, shortened(text[-200:])))
        return text
