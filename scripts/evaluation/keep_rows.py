#!/usr/bin/python3
"""Keeps the rows that `evaluate` wrote, compressed.

    scripts/evaluation/keep_rows.py RESULTS [MORE_RESULTS ...] [--output doc/results/evaluation]

The files of several folders, one for each shard, are joined. Of experiments that have no rows in any of the folders, what
is kept is removed: all rows are of one run.
"""
import argparse
import lzma
import pathlib


def joined(paths):
    """The first file's header, then every line once."""
    lines = [path.read_text(encoding="utf-8").splitlines() for path in paths]
    if any(file[:1] != lines[0][:1] for file in lines):
        raise SystemExit(f"{', '.join(map(str, paths))}: the columns differ")
    return "\n".join(lines[0][:1] + list(dict.fromkeys(line for file in lines for line in file[1:]))) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="+", type=pathlib.Path)
    parser.add_argument("--output", default="doc/results/evaluation", type=pathlib.Path)
    options = parser.parse_args()
    experiments = [path.stem for path in sorted(pathlib.Path("thesis/experiments").glob("*.yaml"))]
    options.output.mkdir(parents=True, exist_ok=True)
    for path in options.output.glob("*.csv.xz"):
        path.unlink()
    for name in [experiment + end for experiment in experiments for end in ("", "_scenes", "_curves", "_points", "_rows")] + ["run_flops"]:
        paths = [folder / f"{name}.csv" for folder in options.results if (folder / f"{name}.csv").exists()]
        if paths:
            (options.output / f"{name}.csv.xz").write_bytes(lzma.compress(joined(paths).encode(), preset=9))
    print(options.output, sum(path.stat().st_size for path in options.output.glob("*.csv.xz")), "bytes")


if __name__ == "__main__":
    main()
