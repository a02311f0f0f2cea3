#!/usr/bin/python3
"""The rows of a report: whether those that are there may stay, and what they were made with.

    scripts/report_rows.py prepare RESULTS --program EVALUATE    before `evaluate` goes on in that folder
    scripts/report_rows.py record RESULTS KEPT                   after keep_rows.py has kept them: doc/results/provenance.csv

Each experiment has a file NAME.commit beside its rows: the commit of the program that began them. Rows of another
program stay where that program, run once more on every row and scene, gives the same first line; what has changed is
named, to be removed.
"""
import argparse
import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile

import provenance

TIMES = {"microseconds"}  # the columns that no second run repeats


def experiments():
    return sorted((provenance.ROOT / "thesis" / "experiments").glob("*.yaml"))


def first_runs(path):
    """{(row, scene): its first run, without times}."""
    if not path.exists():
        return {}
    with open(path, newline="", encoding="utf-8") as file:
        return {(row["row"], row["scene"]): {key: value for key, value in row.items() if key not in TIMES}
                for row in csv.DictReader(file) if row["run"] == "0"}


def same_program(commit):
    return subprocess.run(["git", "diff", "--quiet", commit.split("+")[0], "HEAD", "--", "include", "src"], cwd=provenance.ROOT,
                          stderr=subprocess.DEVNULL, check=False).returncode == 0 and "+" not in commit


def differing_rows(results, files, program):
    """'NAME: row, scene' of every first run that the program gives otherwise now."""
    if not files:
        return []
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, *map(str, files), "--runs", "1", "--output", folder], cwd=provenance.ROOT, check=True)
        return [f"{file.stem}: {row}, {scene}" for file in files
                for (row, scene), run in first_runs(results / f"{file.stem}.csv").items()
                if first_runs(pathlib.Path(folder) / f"{file.stem}.csv").get((row, scene)) != run]


def prepare(results, program):
    results.mkdir(parents=True, exist_ok=True)
    commit = provenance.head_commit(provenance.Tree())
    changed, repeated = [], []
    for file in experiments():
        kept, made_by = results / file.name, results / f"{file.stem}.commit"
        if not first_runs(results / f"{file.stem}.csv"):
            made_by.write_text(commit + "\n", encoding="utf-8")
        elif not kept.exists() or provenance.what_runs(kept.read_bytes()) != provenance.what_runs(file.read_bytes()):
            changed.append(f"{file.stem}: its experiment has changed")
        elif not same_program(made_by.read_text(encoding="utf-8").strip()):
            repeated.append(file)
        if not changed or not changed[-1].startswith(file.stem + ":"):
            shutil.copy(file, kept)
    changed += differing_rows(results, repeated, program)
    if changed:
        sys.exit("\n".join(changed) + f"\nthese rows in {results} are not what this program gives: remove NAME*.csv of each")


def record(results, kept):
    for file in experiments():
        files = [kept / f"{file.stem}{end}.csv.xz" for end in ("", "_scenes", "_curves", "_points", "_rows")]
        names = ",".join(str(path) for path in files if path.exists())
        provenance.record([names], (results / f"{file.stem}.commit").read_text(encoding="utf-8").strip(),
                          defaults="tracker,thesis", inputs=f"thesis/experiments/{file.name}", command="scripts/report.sh full")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    actions = parser.add_subparsers(dest="action", required=True)
    for name in ("prepare", "record"):
        action = actions.add_parser(name)
        action.add_argument("results", type=pathlib.Path)
        if name == "prepare":
            action.add_argument("--program", required=True)
        else:
            action.add_argument("kept", type=pathlib.Path)
    options = parser.parse_args()
    if options.action == "prepare":
        prepare(options.results, str(pathlib.Path(options.program).absolute()))
    else:
        record(options.results, options.kept)


if __name__ == "__main__":
    main()
