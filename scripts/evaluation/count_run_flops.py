#!/usr/bin/python3
"""Counts every floating-point operation of runs of the experiments, for the report: a line a row and scene.

    scripts/evaluation/count_run_flops.py [thesis/experiments/table_3_4.yaml ...] [--program build/devel/lib/concave_distance/run_flops]
                               [--runs 3] [--output build/evaluation_full/run_flops.csv]

Without files: the experiments that show the thesis's flops. What the output already has is not counted again.
callgrind (scripts/install_dependencies.sh plot) says how often each instruction was executed, objdump what it is. Counted are additions, subtractions, multiplications, divisions
and square roots, each lane of a vector and both halves of a fused one; those of the C library, too. Comparisons, moves
and conversions are none. Instructions are all there are. Before anything else the count of known work is checked.
"""
import argparse
import bisect
import collections
import csv
import functools
import io
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

import yaml

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
ARITHMETIC = re.compile(r"v?(add|sub|mul|div|sqrt|hadd|hsub|addsub)([sp])([sd])$")
FUSED = re.compile(r"vf(?:n?m)(?:add|sub|addsub|subadd)(?:\d{3})?([sp])([sd])$")
X87 = re.compile(r"f(?:add|sub|subr|mul|div|divr|sqrt)p?[sl]?$|fi(?:add|sub|mul|div)")
WIDTHS = {"xmm": 16, "ymm": 32, "zmm": 64}
INSTRUCTION = re.compile(r"\s*([0-9a-f]+):\t(?:[a-z0-9_.]+ (?=v?[a-z]))??([a-z0-9]+)\s*(.*)")


def lanes(kind, size, operands):
    if kind == "s":
        return 1
    widest = max((width for name, width in WIDTHS.items() if name in operands), default=16)
    return widest // (8 if size == "d" else 4)


def flops_of(name, operands):
    """Of one execution of an instruction."""
    match = ARITHMETIC.match(name)
    if match:
        return lanes(match[2], match[3], operands)
    match = FUSED.match(name)
    if match:
        return 2 * lanes(match[1], match[2], operands)
    return 1 if X87.match(name) else 0


@functools.lru_cache(maxsize=None)
def arithmetic_of(program):
    """{address: flops of the instruction there} of a program or library, and all addresses with an instruction."""
    if not pathlib.Path(program).is_file():
        return {}, ()
    text = subprocess.run(["objdump", "-d", "--no-show-raw-insn", program], check=True, capture_output=True,
                          text=True).stdout
    flops = {}
    addresses = []
    for line in text.splitlines():
        match = INSTRUCTION.match(line)
        if match:
            addresses.append(int(match[1], 16))
            count = flops_of(match[2], match[3])
            if count:
                flops[addresses[-1]] = count
    return flops, tuple(addresses)


def count_dump(path):
    """(flops, instructions) of a callgrind dump with costs by instruction and nothing compressed."""
    flops = instructions = 0
    program = ""
    skip = False
    unknown = 0
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        if line.startswith("ob="):
            program = line[3:]
        elif line.startswith("calls="):
            skip = True  # the next line is what the callee took
        elif line.startswith("0x"):
            if skip:
                skip = False
                continue
            cells = line.split()
            count = int(cells[-1])
            address = int(cells[0], 16)
            instructions += count
            by_address, known = arithmetic_of(program)
            place = bisect.bisect_left(known, address)
            if place == len(known) or known[place] != address:
                unknown += count
            flops += count * by_address.get(address, 0)
    if unknown > 0.01 * instructions:
        sys.exit(f"{path}: {unknown} of {instructions} instructions are in no program that objdump can read")
    return flops, instructions


def count_experiment(file, program, run_count):
    """{(experiment, row, scene): [(kflop by the thesis's rule, kflop, thousand instructions) of each run]}, means over
    the instants of a motion."""
    counts = collections.defaultdict(list)
    with tempfile.TemporaryDirectory() as folder:
        lines = subprocess.run(
            ["valgrind", "--tool=callgrind", "--instr-atstart=no", "--dump-instr=yes", "--dump-line=no",
             "--compress-strings=no", "--compress-pos=no", f"--callgrind-out-file={folder}/dump", program, file,
             "--runs", str(run_count), "--meshes", str(ROOT / "meshes/thesis")],
            check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout
        for number, cells in enumerate(csv.reader(io.StringIO(lines)), 1):
            flops, instructions = count_dump(pathlib.Path(folder) / f"dump.{number}")
            instants, rule = int(cells[3]), float(cells[5])
            if number > 1:
                counts[tuple(cells[:3])].append((rule, flops / 1000 / instants, instructions / 1000 / instants))
            elif flops != round(1000 * rule):
                sys.exit(f"the known work is {1000 * rule:.0f} flops, counted are {flops}")
    return counts


def shows_flops(path):
    experiment = yaml.safe_load(path.read_text(encoding="utf-8"))
    return any("kflop" in scene or "mflop" in scene for row in experiment["rows"] for scene in row.get("thesis", {}).values()
               if row["algorithm"] != "enumeration")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("experiments", nargs="*")
    parser.add_argument("--program", default=str(ROOT / "build/devel/lib/concave_distance/run_flops"))
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--output", default=str(ROOT / "build/evaluation_full/run_flops.csv"))
    options = parser.parse_args()
    files = options.experiments or [str(path) for path in sorted((ROOT / "thesis" / "experiments").glob("*.yaml")) if shows_flops(path)]

    output = pathlib.Path(options.output)
    output.parent.mkdir(parents=True, exist_ok=True)
    if not output.exists():
        output.write_text("experiment,row,scene,runs,rule_kflop,kflop,kinstructions\n", encoding="utf-8")
    with open(output, newline="", encoding="utf-8") as file:
        done = {row["experiment"] for row in csv.DictReader(file)}
    for file in files:
        if pathlib.Path(file).stem in done:
            continue
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        for key, runs in count_experiment(file, options.program, options.runs).items():
            writer.writerow([*key, len(runs), *(f"{statistics.median(values):.1f}" for values in zip(*runs))])
        with open(output, "a", newline="", encoding="utf-8") as results:
            results.write(text.getvalue())  # an experiment in one go
        print(file, flush=True)


if __name__ == "__main__":
    main()
