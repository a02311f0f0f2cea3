#!/usr/bin/env python3
"""Distances of a scene's pairs at every transform of a bag, as the node would give them (doc/bags.md)."""
import argparse
import itertools
import os
import resource
import signal
import subprocess
import sys
import time

import numpy as np

from bag_transforms import NANOSECONDS, BagFrames, BagReader, Fault

# Where no setup file was sourced, the package stands beside the program.
sys.path.append(os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), "..", "python3", "dist-packages"))
import concave_distance as library  # noqa: E402

COLUMNS = ("time,stamp,pair,body_a,body_b,status,distance,lower_bound,ax,ay,az,bx,by,bz,nx,ny,nz,closing_speed,"
           "signed_distance,niche_count,niche,warning,triangle_a,triangle_b,message")
NICHE_COLUMNS = ("time,stamp,pair,niche,distance,ax,ay,az,bx,by,bz,nx,ny,nz,closing_speed,kind,extent,outward,visible,"
                 "prominence,origin,signed_distance")
WORDS = ((library.NicheKind, "kind"), (library.Outwardness, "outward"), (library.NicheOrigin, "origin"))
STATUS = ("ok", "penetrating", "invalid_pose", "budget", "tolerance", "memory")  # in the order of Status
HELP = """Status: ok, tolerance, memory, penetrating, beyond_cutoff, missing_transform, stale_transform, invalid_pose, not_found.
Exit status: 0 done, 1 a file is at fault, 2 the command line is, 130 interrupted: the files end there."""
LOST = "record /tf_static too, from the robot's start, play further bags, check the scene, or name a root with --reference-frame"
PLOT_PROGRAMS = [os.path.join(sys.path[0], folder, "plot_distances.py") for folder in (".", "../../../scripts")]
OPTIONS = (  # name, value, what it is
    ("bag", "FILE", "bag; several are played as one, as by rosbag play"),
    ("output", "FILE", COLUMNS),
    ("niches-output", "FILE", NICHE_COLUMNS + "; without it no niches are computed"),
    ("plot", "FILE", "picture of the distances over time (.png, .pdf, .svg; matplotlib)"),
    ("tf-topic", "NAME", "topic of transforms that move; once for each (/tf)"),
    ("tf-static-topic", "NAME", "topic of transforms that stand; once for each (/tf_static)"),
    ("scene", "FILE", "scene file; without one, the robot alone"),
    ("robot-description", "FILE", "URDF of the parameter robot_description: of the scene's robot, or of the robot alone"),
    ("description", "NAME=FILE", "URDF or SRDF of another parameter; once for each"),
    ("mesh-search-path", "DIR", "folder to search for meshes that are not found; once for each"),
    ("pairs", "PATTERN", "only pairs of this name or pattern, as 'gripper/*'; once for each"))
LISTS = ("bag", "tf-topic", "tf-static-topic", "description", "mesh-search-path", "pairs")
NUMBERS = (  # name, default, lowest and highest value, what it is
    ("start", 0.0, 0.0, 1e10, "seconds after the begin of the bags"),
    ("duration", 1e10, 1e-9, 1e10, "seconds from there (to the end)"),
    ("stale-after", 1.0, 1e-3, 1e6, "age at which transforms are too old (s)"),
    ("tf-cache", 10.0, 0.1, 3600.0, "time for which transforms are kept (s)"),
    ("tf-future-tolerance", 1.0, 0.0, 60.0, "seconds that a stamp may be ahead of the clock; later ones are refused"),
    ("threads", 0, 0, 1024, "that solve pairs; 0: one per core"))
PARAMETERS = [one for one in library.parameters(of_scene=True) if not one["is_expert"] and one["name"] != "time_budget"]


def read_options():
    parser = argparse.ArgumentParser("distance_bag", description=__doc__ + " Metres, seconds; points in the reference frame.",
                                     epilog=HELP, allow_abbrev=False)
    add = parser.add_argument
    add("--version", action="version", version="concave_distance " + library.__version__)
    add("--reference-frame", default="world", metavar="FRAME", help="frame of every output")
    add("--geometry", choices=("collision", "visual"), default="collision", help="which of the URDF's geometry")
    add("--skip-overlapping-pairs", action="store_true", help="of the robot alone: leave out links that always overlap")
    for name, value, text in OPTIONS:
        several = {"action": "extend", "nargs": "+", "default": []} if name in LISTS else {}
        add("--" + name, metavar=value, help=text, required=name in ("bag", "output"), **several)
    for name, default, _, _, text in NUMBERS:
        add("--" + name, type=type(default), default=default, metavar="NUMBER", help=text)
    for one in PARAMETERS:
        kind = {"action": "store_true"} if isinstance(one["default"], bool) else {"metavar": "VALUE", "type": lambda text: (
            text if text[:1].isalpha() else int(text) if text.isdigit() else float(text))}
        add("--" + one["name"].replace("_", "-"), default=None, help="allowed: " + one["allowed"].replace("%", "%%"), **kind)
    options = parser.parse_args()
    for name, _, lowest, highest, _ in NUMBERS:
        if not lowest <= getattr(options, name.replace("-", "_")) <= highest:
            parser.error("--%s: it is not from %g to %g" % (name, lowest, highest))
    options.files = {"robot_description": options.robot_description} if options.robot_description else {}
    options.files.update(text.partition("=")[::2] for text in options.description)
    inputs = {os.path.realpath(path) for path in [*options.bag, options.scene, *options.files.values()] if path}
    outputs = [os.path.realpath(path) for path in (options.output, options.niches_output, options.plot) if path]
    if len(inputs.union(outputs)) < len(inputs) + len(outputs):
        raise Fault(", ".join(outputs), "one is the same file as another output or an input", "name other files")
    return options


def load(options):
    settings = {one["name"]: getattr(options, one["name"]) for one in PARAMETERS if getattr(options, one["name"]) is not None}
    settings.update(mesh_folders=options.mesh_search_path + list(options.files.values()), geometry=options.geometry)
    if options.scene:
        for name in library.descriptions_of_scene(options.scene):
            if name not in options.files:
                raise Fault(options.scene, "it takes a robot from the parameter '%s'" % name, "give its file: " + (
                    "--robot-description FILE" if name == "robot_description" else "--description %s=FILE" % name))
        texts = {name: open(path, encoding="utf-8", errors="replace").read() for name, path in options.files.items()}
        return library.load_scene(options.scene, descriptions=texts, **settings)
    if not options.robot_description:
        raise Fault("--scene", "there is no scene file and no --robot-description", "give one of them")
    return library.load_robot(
        options.robot_description, options.files.get("robot_description_semantic"), automatic_cutoff="cutoff" not in settings,
        skip_overlapping_pairs=options.skip_overlapping_pairs, **settings)


def number(value):
    """17 digits; what was not computed is empty."""
    return "" if value != value else "%.17g" % value


def time_text(nanoseconds):
    return "%d.%09d" % divmod(nanoseconds, NANOSECONDS)


def quoted(text):
    """As RFC 4180 has it."""
    return '"%s"' % text.replace('"', '""') if any(c in text for c in ',"\r\n') else text


class OutputFile:
    """A file that is complete or missing; a device or pipe is written directly."""

    def __init__(self, path, header):
        self._target = os.path.realpath(path)
        self._is_direct = os.path.exists(path) and not os.path.isfile(path)
        self._path = path if self._is_direct else "%s/.%s.%d" % (*os.path.split(self._target), os.getpid())
        self.stream = open(self._path, "w", encoding="utf-8", newline="")
        self.stream.write(header + "\n")

    def finish(self, is_whole):
        if not self._is_direct and os.path.exists(self._path):
            os.replace(self._path, self._target) if is_whole else os.unlink(self._path)


class Replay:
    """Answers each moment of a bag. A pair without a distance has a row when that begins and no more."""

    def __init__(self, options, scene, streams):
        self._reference, self._limit, self._streams = options.reference_frame.lstrip("/"), options.stale_after, streams
        self._names, self._frames, self._poses = scene.body_names, scene.body_frames, scene.poses_in_frames
        self._tracker = library.SceneTracker(scene, options.threads, pairs=options.pairs, time_budgets=False)
        self._states = [None] * len(self._poses)
        self._first, self._last = None, {}  # stamp; status of the last row of each pair
        self.answered, self.problems = set(), {}  # pairs; message of the last row without an answer
        self.stamps = self.rows = self.distances = self.beyond = 0

    def answer(self, moment, frames):
        self.stamps += 1
        self._first = self._first or moment.stamp
        places = list(map(frames.places(self._reference, self._frames, moment).get, self._frames))
        world, moved = np.full(self._poses.shape, np.nan), np.zeros(len(places), bool)
        for body, place in enumerate(places):
            state = "there" if place.pose is not None else "lost" if place.newest == 0 else (
                "stale" if moment.stamp - place.newest > frames.stale_after else "waits")
            if state == "there":
                world[body] = place.pose @ self._poses[body]
            if state != "waits":
                moved[body] = state != self._states[body] or (place.moved and state == "there")
                self._states[body] = state
        if moment.is_late:
            self._tracker.restart()
        answers = self._tracker.update(world, (moment.stamp - self._first) / NANOSECONDS, len(self._streams) > 1, moved)
        if moment.is_late:
            self._tracker.restart()
        self.beyond = max(self.beyond, answers.beyond)
        self._write(moment, places, world, answers)

    def lost(self, frames):
        """Says which frames of bodies have no place, with a remedy; else empty."""
        names = {frame for frame, state in zip(self._frames, self._states) if state == "lost"}
        return "tf does not connect the reference frame '%s' with %s, below %s; %s" % (self._reference, *(
            str(sorted(some))[1:-1] for some in (names, set(map(frames.root_of, names)))), LOST) if names else ""

    def _write(self, moment, places, world, answers):
        a_of_rows, offsets, niches = answers.bodies[:, 0], answers.niche_offsets.tolist(), answers.niches
        numbers_of_rows, numbers_of_niches, texts = self._numbers(answers.rows, world[a_of_rows]), None, ["", ""]
        for index, (name, (a, b)) in enumerate(zip(answers.pairs, answers.bodies.tolist())):
            row, (distance, *numbers) = answers.rows[index], numbers_of_rows[index]
            status, stamp, message = self._status_of(answers.states[index], row, (a, b), places, moment)
            if status is None or (not distance and self._last.get(name) == status):
                continue
            self._last[name] = status
            self.rows, self.distances = self.rows + 1, self.distances + bool(distance)
            is_beyond = status == "beyond_cutoff"
            self.answered.update([name] if distance or is_beyond else [])
            self.problems[name] = "no answer of pair %s: %s" % (name, message)
            first, last = offsets[index:index + 2]
            is_listed = distance and len(self._streams) > 1
            is_nearest = last > first and niches[first]["distance"] == row["distance"]
            head = [time_text(moment.recorded), time_text(stamp), quoted(name)]
            texts[0] += ",".join([
                *head, quoted(self._names[a]), quoted(self._names[b]), status, distance,
                number(answers.bounds[index] if is_beyond else row["lower_bound"]), *numbers,
                str(last - first) if is_listed else "", str(niches[first]["id"]) if is_nearest else "",
                str(answers.warnings[index]), *("" if row[name] < 0 else str(row[name]) for name in ("triangle_a", "triangle_b")),
                quoted(message)]) + "\n"
            if is_listed and last > first:
                numbers_of_niches = numbers_of_niches or self._numbers(
                    niches, np.repeat(world[a_of_rows], np.diff(offsets), axis=0))
                for niche, numbers in zip(niches[first:last], numbers_of_niches[first:last]):
                    kind, outward, origin = (enum(niche[column]).name.lower() for enum, column in WORDS)
                    words = [kind, number(niche["extent"]), outward, str(int(niche["visible"])), number(niche["prominence"]),
                             origin] if row["accuracy"] > 0 else [""] * 6
                    texts[1] += ",".join([*head, str(niche["id"]), *numbers[:-1], *words, numbers[-1]]) + "\n"
        for stream, text in zip(self._streams, texts):
            stream.write(text)

    @staticmethod
    def _numbers(table, poses):
        """distance, points, normal, closing_speed and signed_distance of each row as texts, in the reference frame."""
        turn = poses[:, :3, :3]
        points = [np.einsum("nij,nj->ni", turn, table[name]) + poses[:, :3, 3] for name in ("point_a", "point_b")]
        between = table["point_b"] - table["point_a"]
        with np.errstate(invalid="ignore", divide="ignore"):
            between /= np.linalg.norm(between, axis=1)[:, None]
        normal = np.where(np.isnan(table["normal"]), between, table["normal"])
        columns = [table["distance"], *points, np.einsum("nij,nj->ni", turn, normal), table["closing_speed"],
                   table["signed_distance"]]
        return [[number(value) for value in row] for row in np.column_stack(columns).tolist()]

    def _status_of(self, state, row, bodies, places, moment):
        """Word, stamp and message; the word is None for what is no row."""
        if state == library.PairState.SOLVED:
            word = STATUS[row["status"]]
            if word == "ok" and row["distance"] != row["distance"]:
                return "not_found", moment.stamp, "the search met no minimum that leaves the bodies outwards"
            return word, moment.stamp, "" if word == "ok" else word
        if state != library.PairState.NOT_LOCATED:
            return "beyond_cutoff" if state == library.PairState.BEYOND_CUTOFF else None, moment.stamp, ""
        (stamp, frame), (_, other) = sorted((places[body].newest, self._frames[body]) for body in bodies)
        if stamp == 0:
            return "missing_transform", moment.stamp, "no transform from '%s' to '%s'" % (frame, self._reference)
        return "stale_transform", stamp, "the newest transform between '%s', '%s' and '%s' is %.3f s old; --stale-after is " \
            "%g s" % (frame, other, self._reference, (moment.stamp - stamp) / NANOSECONDS, self._limit)


def play(reader, frames, replay):
    """Returns whether it was played to its end: Ctrl-C ends it after a whole moment, a second one at once."""
    signals = []
    for each in (signal.SIGINT, signal.SIGTERM):
        signal.signal(each, lambda number, _: (signals.append(number), signal.signal(number, signal.SIG_DFL)))
    start = shown = time.monotonic()
    now, length = reader.begin, max(reader.end - reader.begin, 1)
    for message in itertools.chain(reader.messages(), [None]):
        now = frames.take(message) if message else now
        for moment in itertools.takewhile(lambda moment: not signals, frames.moments(is_end=message is None)):
            replay.answer(moment, frames)
        if sys.stderr.isatty() and time.monotonic() - shown > 0.5:
            shown = time.monotonic()
            print("\r%.1f %% " % (100.0 * (now - reader.begin) / length), end="", file=sys.stderr, flush=True)
        if signals:
            break
    played, spent = (now - reader.begin) / NANOSECONDS, time.monotonic() - start
    print("%s: %.1f s in %.1f s, real-time factor %.2f; %d stamps, %d rows, %d distances%s" % (
        reader.where, played, spent, played / max(spent, 1e-9), replay.stamps, replay.rows, replay.distances,
        "; interrupted: the files end there" if signals else ""), file=sys.stderr)
    return not signals


def run(options):
    reader = BagReader(options.bag, options.tf_topic, options.tf_static_topic, options.start, options.duration)
    scene = load(options)
    warnings = scene.warnings + ["not in the scene: %s: %s" % problem for problem in scene.problems]
    frames = BagFrames(options.tf_cache, options.tf_future_tolerance, options.stale_after)
    files, is_done = [], False
    try:
        for path, columns in ((options.output, COLUMNS), (options.niches_output, NICHE_COLUMNS)):
            files += [OutputFile(path, columns)] if path else []
        replay = Replay(options, scene, [file.stream for file in files])
        is_whole = play(reader, frames, replay)
        lost = replay.lost(frames)
        problems = [text for name, text in sorted(replay.problems.items()) if name not in replay.answered]
        if is_whole and not replay.answered and not (replay.beyond and not options.pairs):
            raise Fault(reader.where, ": ".join(["no pair has an answer"] + ([lost] if lost else problems[:1])),
                        "check --pairs, --start, --duration and the scene; the bag's frames: " + ", ".join(
                            sorted(frames.parents)[:100]))
        for file in files:
            file.stream.close()
        is_done = True
    finally:
        for file in files:
            file.finish(is_done)
    warnings += [*list(frames.reasons.values())[:10], *problems[:10]] + ["at the end " + lost] * bool(lost)
    warnings += ["%d transforms were refused in all" % frames.refusals] * bool(frames.refusals)
    for warning in warnings + ["no pair comes within its cutoff"] * (replay.rows == 0):
        print("warning: " + warning, file=sys.stderr)
    command = [next(path for path in PLOT_PROGRAMS if os.path.exists(path)), options.output, "--output", options.plot]
    if is_whole and options.plot and subprocess.call([sys.executable] + command) != 0:
        raise Fault(options.plot, "the plot could not be drawn; the rows are complete", "see above, then: " + " ".join(command))
    return 0 if is_whole else 130  # as a shell has it for Ctrl-C


def main():
    # What lies about its size in a bag then raises MemoryError, before it takes all memory. Threads reserve some GB.
    most = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2 + 4 * 10**9
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    resource.setrlimit(resource.RLIMIT_AS, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))
    try:
        return run(read_options())
    except (Fault, library.Error) as problem:
        print("distance_bag: %s" % problem, file=sys.stderr)
        return 2 if getattr(problem, "where", "").startswith(("load_scene", "load_robot")) else 1
    except (OSError, MemoryError) as problem:
        print("distance_bag: %s (check paths, and the space on the device)" % (problem or "no memory"), file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
