#!/usr/bin/python3
"""Records what results were made with: doc/results/provenance.csv.

    scripts/provenance.py record doc/results/front.csv            a line that is there, after its command was run again
    scripts/provenance.py record doc/results/new.csv --defaults tracker --command new_benchmark [--inputs PATTERN,...]
    scripts/provenance.py unchanged --commit BEFORE               after declarations changed and no answer did
    scripts/provenance.py commit                                  with +changes where sources are not committed

A line has the file (or a pattern) and its digest; the commit of the program; the groups of parameter defaults that it
used, with their fingerprint; the files that it was made from, with their digest. `test/scripts/check_results.py`
compares them with what there is now. `unchanged` is for members that are new, gone or renamed while
`scripts/compare_answers.py` finds the same bytes: lines that were up to date at the commit before get the fingerprints of now. Groups: tracker, thesis, contact, simulation.
"""
import argparse
import csv
import fnmatch
import hashlib
import json
import pathlib
import re
import subprocess

import yaml

ROOT = pathlib.Path(__file__).resolve().parent.parent
MANIFEST = "doc/results/provenance.csv"
COLUMNS = ["file", "digest", "commit", "defaults", "fingerprint", "inputs", "inputs_digest", "state", "command"]
INCLUDE = "include/concave_distance/"
GROUPS = {
    "tracker": [INCLUDE + "search/genetic_parameters.h", INCLUDE + "tracking/tracker_parameters.h",
                "src/tracking/tracker_parameters.cpp"],
    "thesis": [INCLUDE + "search/genetic_parameters.h", "thesis/src/annealing/annealing_parameters.h",
               "thesis/src/continuous/continuous_parameters.h", "thesis/src/genetic/comb_ga_parameters.h"],
    "contact": [INCLUDE + "contact/material.h", INCLUDE + "contact/normal_force.h", INCLUDE + "contact/friction.h",
                INCLUDE + "contact/effect_settings.h"],
    "simulation": [INCLUDE + "scene/simulation_settings.h"],
}
# What programs are made of: a change that is not committed makes the commit say less than it seems to.
SOURCES = ["include", "src", "test/benchmark", "thesis", "config", "meshes"]

# Keys of an experiment and of its rows that only the report reads.
WORDS = {"title", "table", "figure", "columns", "layout", "remark", "note", "thesis", "variant_of", "reasons", "better"}


class Tree:
    """The files of a working tree, or those of a commit."""

    def __init__(self, root=ROOT, commit=None):
        self.root = pathlib.Path(root)
        self.commit = commit

    def git(self, *arguments):
        return subprocess.run(["git", *arguments], cwd=self.root, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                              check=True).stdout

    def matching(self, patterns):
        """The files of one of the patterns, between which commas stand."""
        return [name for pattern in patterns.split(",") if pattern for name in self.matching_one(pattern)]

    def matching_one(self, pattern):
        if self.commit is None:
            return sorted(path.relative_to(self.root).as_posix() for path in self.root.glob(pattern) if path.is_file())
        names = self.git("ls-tree", "-r", "--name-only", self.commit).decode().splitlines()
        return sorted(name for name in names if fnmatch.fnmatch(name, pattern))

    def read(self, name):
        return (self.root / name).read_bytes() if self.commit is None else self.git("show", f"{self.commit}:{name}")


def what_runs(experiment):
    """What an experiment file says of its runs, as bytes: without its words and the thesis's figures."""
    read = {key: value for key, value in yaml.safe_load(experiment).items() if key not in WORDS}
    rows = [{key: value for key, value in row.items() if key not in WORDS} for row in read.pop("rows", [])]
    return json.dumps({**read, "rows": rows}, sort_keys=True).encode()


def digest(tree, patterns):
    """Of the files that match, with their names when there are several; empty when there is none."""
    names = tree.matching(patterns)
    hashed = hashlib.sha256()
    for name in names:
        content = tree.read(name)
        if fnmatch.fnmatch(name, "thesis/experiments/*.yaml"):
            content = what_runs(content)
        hashed.update((name if len(names) > 1 else "").encode() + content)
    return hashed.hexdigest()[:16] if names else ""


def defaults_of(tree, groups):
    """{struct.member: value} of every member with an initial value, and of those that a constructor sets."""
    found = {}
    for path in sorted({path for group in groups.split(",") if group for path in GROUPS[group]}):
        if not tree.matching(path):
            continue
        text = re.sub(r"//[^\n]*", "", tree.read(path).decode())
        for name, value in re.findall(r"\b((?:cold|warm)\.\w+) = ([^;]+);", text) if path.endswith(".cpp") else []:
            found["TrackerParameters." + name] = value
        for struct, body in re.findall(r"\nstruct (\w*(?:Parameters|Settings|Material))(?: : \w+)? \{(.*?)\n\};", text, re.DOTALL):
            for name, value in re.findall(r"[\w>*&]\s+(\w+)\s*=\s*([^;]+);", body):
                found[f"{struct}.{name}"] = " ".join(value.split())
    return found


def fingerprint(tree, groups):
    if not groups:
        return ""
    text = "\n".join(f"{name}={value}" for name, value in sorted(defaults_of(tree, groups).items()))
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def changed_defaults(tree, groups, commit):
    """What has changed since a commit, in words; nothing where the clone does not have it."""
    try:
        before = defaults_of(Tree(tree.root, commit), groups)
    except (OSError, subprocess.CalledProcessError):
        return []
    now = defaults_of(tree, groups)
    return [f"{name}: {before.get(name, 'not there')} -> {now.get(name, 'not there')}"
            for name in sorted({*before, *now}) if before.get(name) != now.get(name)]


def read_manifest(root=ROOT):
    with open(pathlib.Path(root) / MANIFEST, newline="", encoding="utf-8") as file:
        return {row["file"]: row for row in csv.DictReader(file)}


def write_manifest(rows, root=ROOT):
    with open(pathlib.Path(root) / MANIFEST, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows[name] for name in sorted(rows))


def entry(tree, old, now_in=None):
    """A manifest's line for the files of `tree`; the digest of the files themselves is that of `now_in`."""
    return {**old, "digest": digest(now_in or tree, old["file"]),
            "fingerprint": fingerprint(tree, old["defaults"]), "inputs_digest": digest(tree, old["inputs"])}


def head_commit(tree):
    commit = tree.git("rev-parse", "--short=9", "HEAD").decode().strip()
    return commit + ("+changes" if tree.git("status", "--porcelain", "--", *SOURCES).strip() else "")


def record(names, commit=None, **given):
    """Renews lines of the manifest; `given` (defaults, inputs, command) replaces what a line says, and makes a new one."""
    tree = Tree()
    rows = read_manifest()
    for name in names:
        name = ",".join(pathlib.Path(part).absolute().relative_to(ROOT).as_posix() for part in str(name).split(","))
        row = dict(rows.get(name) or dict.fromkeys(COLUMNS, ""), file=name)
        row.update({key: value for key, value in given.items() if value is not None})
        if not row["command"]:
            raise SystemExit(f"{name} has no line in {MANIFEST} yet: name its --command and --defaults")
        row.update(commit=commit or head_commit(tree), state="")
        rows[name] = entry(tree, row)
        if not rows[name]["digest"]:
            raise SystemExit(f"{name}: there is no such file")
    write_manifest(rows)


def keep_unchanged(commit):
    """Renews the fingerprints of lines that agree with the defaults of a commit."""
    before, now = Tree(commit=commit), Tree()
    rows = read_manifest()
    for row in rows.values():
        if row["defaults"] and row["fingerprint"] == fingerprint(before, row["defaults"]):
            row["fingerprint"] = fingerprint(now, row["defaults"])
    write_manifest(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("action", choices=["record", "unchanged", "commit"])
    parser.add_argument("names", nargs="*")
    for option in ("--defaults", "--inputs", "--command", "--commit"):
        parser.add_argument(option)
    options = parser.parse_args()
    if options.action == "record":
        record(options.names, options.commit, defaults=options.defaults, inputs=options.inputs, command=options.command)
    elif options.action == "unchanged":
        if not options.commit:
            raise SystemExit("name the commit before the change: unchanged --commit BEFORE")
        keep_unchanged(options.commit)
    else:
        print(head_commit(Tree()))


if __name__ == "__main__":
    main()
