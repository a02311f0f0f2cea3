#!/usr/bin/env python3
"""Compares the numbers of README and the results pages with the files in doc/results that they are quoted from.

    test/scripts/check_results.py                    files, numbers, and that every recorded commit exists
    test/scripts/check_results.py --record FILE ...  writes the commit of now into the lines of files that were made again

doc/results/runs.csv says which command made each file, and at which commit of the package. A shallow clone cannot know and
fails; a copy without history says that it has not looked. doc/results/numbers.csv says where
a page's numbers come from: `text` stands once in the page, with the quoted numbers in braces; `formulas` has a Python
expression for each of them (`;;` between two), over the rows of `file`. A number agrees when it is the rounded value. Expressions are value, min,
max, median, mean, total and count of an expression of columns, over the rows with the given cells (`pair='peg_in_hole'`, or a
list of them), and found('regex'), the number that the group matches in a text file. The formula `table` stands for a whole
table, whose first line is the text: the numbers of each of its rows are, rounded, in one line of the file.
"""
import argparse
import csv
import io
import lzma
import pathlib
import re
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
NUMBER = r"-?(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?(?:e[-+]?\d+)?"
PLAIN_NUMBER = r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?"  # of a CSV file, in which commas part cells


def read_csv(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def squeezed(text):
    return re.sub(r"\s+", " ", text)


class Result:
    """What a formula may use of a file."""

    def __init__(self, path):
        data = lzma.decompress(path.read_bytes()) if path.suffix == ".xz" else path.read_bytes()
        self.text = data.decode()
        self.rows = list(csv.DictReader(io.StringIO(self.text))) if ".csv" in path.suffixes else []

    def values(self, expression, cells):
        found = []
        for row in self.rows:
            if any(row[key] not in (cell if isinstance(cell, list) else [cell]) for key, cell in cells.items()):
                continue
            columns = {}
            for name, cell in row.items():
                try:
                    columns[name] = float(cell)
                except ValueError:
                    columns[name] = cell
            found.append(eval(expression, {"__builtins__": {}}, columns))
        return found

    def value(self, expression, **cells):
        found = self.values(expression, cells)
        if len(found) != 1:
            raise ValueError(f"{len(found)} rows match")
        return found[0]

    def found(self, pattern):
        matches = re.findall(pattern, self.text)
        if len(matches) != 1:
            raise ValueError(f"{len(matches)} places match")
        return float(matches[0].replace(",", ""))

    def evaluate(self, formula):
        def over(summary):
            return lambda expression, **cells: summary(self.values(expression, cells))
        names = {"value": self.value, "found": self.found, "min": over(min), "max": over(max), "total": over(sum),
                 "median": over(statistics.median), "mean": over(statistics.fmean),
                 "count": over(lambda values: sum(map(bool, values)))}
        return float(eval(formula, {"__builtins__": {}}, names))


def rounding(token):
    """How far a value may be from the number that it is rounded to; three digits of a large number count."""
    digits, _, exponent = token.replace(",", "").lstrip("-").partition("e")
    whole, _, decimals = digits.partition(".")
    zeros = 0 if decimals else min(len(whole) - len(whole.rstrip("0")), max(len(whole) - 3, 0))
    return 0.5 * 10.0 ** (zeros - len(decimals) + int(exponent or 0)) * (1 + 1e-9)


def is_rounded(value, token):
    return abs(value - float(token.replace(",", ""))) <= rounding(token)


def table_faults(page, header, result):
    """Every row of a table stands, rounded, in one line of the file that names one of the row's other cells."""
    faults = []
    rows = page[page.index(header):].split("\n\n")[0].strip().splitlines()[2:]
    for row in rows:
        cells = [cell.strip(" `") for cell in row.strip("|").split("|")]
        numbers = [cell for cell in cells if re.fullmatch(NUMBER, cell)]
        names = [cell for cell in cells if cell and cell not in numbers]
        lines = [line for line in result.text.splitlines() if any(name in line for name in names)]
        if not any(all(any(is_rounded(float(found), number) for found in re.findall(PLAIN_NUMBER, line))
                       for number in numbers) for line in lines):
            faults.append(f"no line has the numbers of {row}")
    return faults if rows else [f"no rows below {header}"]


def quote_faults(page, quote, result):
    """The faults of a line of numbers.csv; page is the page's text."""
    text = quote["text"]
    plain = re.sub(r"\{(" + NUMBER + r")\}", r"\1", text)
    if squeezed(page).count(squeezed(plain)) != 1:
        return [f"'{plain}' stands {squeezed(page).count(squeezed(plain))} times in the page, not once"]
    if quote["formulas"] == "table":
        return table_faults(page, plain, result)
    tokens = re.findall(r"\{(" + NUMBER + r")\}", text)
    formulas = [formula.strip() for formula in quote["formulas"].split(";;")]
    if not tokens or len(tokens) != len(formulas):
        return [f"'{text}' has {len(tokens)} numbers in braces and {len(formulas)} formulas"]
    faults = []
    for token, formula in zip(tokens, formulas):
        try:
            value = result.evaluate(formula)
        except Exception as error:  # any fault of a formula is a fault of its line
            faults.append(f"{formula}: {type(error).__name__}: {error}")
            continue
        if not is_rounded(value, token):
            faults.append(f"{token} of '{plain}' is {value:.6g}: {formula}")
    return faults


def check_numbers(root):
    """The faults, and how many numbers were compared."""
    faults, count, pages, results = [], 0, {}, {}
    for quote in read_csv(root / "doc/results/numbers.csv"):
        page, file = quote["page"], quote["file"]
        if page != "README.md" and not page.startswith(("doc/results/", "thesis/doc/")):
            faults.append(f"{page}: measured numbers stand on README, in doc/results and thesis/doc only")
        try:
            pages.setdefault(page, (root / page).read_text(encoding="utf-8"))
            if file not in results:
                results[file] = Result(root / "doc/results" / file)
        except OSError as error:
            faults.append(f"{page}: {error}")
            continue
        count += 1 if quote["formulas"] == "table" else quote["text"].count("{")
        faults += [f"{page}: {file}: {fault}" for fault in quote_faults(pages[page], quote, results[file])]
    return faults, count


def check_files(root):
    """Every result has a line in runs.csv, and every line has its file."""
    folder = root / "doc/results"
    recorded = {name for run in read_csv(folder / "runs.csv") for name in run["files"].split()}
    there = {path.relative_to(folder).as_posix() for path in folder.rglob("*")
             if path.suffix in (".csv", ".txt", ".xz")} - {"runs.csv", "numbers.csv"}
    return ([f"{name}: no line of doc/results/runs.csv says which command made it" for name in sorted(there - recorded)]
            + [f"{name}: doc/results/runs.csv lists it, but there is no such file" for name in sorted(recorded - there)])


def git(root, *arguments):
    return subprocess.run(["git", "-c", "safe.directory=*", *arguments], cwd=root, capture_output=True, text=True)


def check_commits(root):
    """The faults, and what was looked at."""
    commits = sorted({run["commit"] for run in read_csv(root / "doc/results/runs.csv")})
    if not (root / ".git").exists():
        return [], f"{len(commits)} commits not looked for, because this copy has no history"
    missing = [commit for commit in commits if git(root, "cat-file", "-e", commit + "^{commit}").returncode != 0]
    shallow = git(root, "rev-parse", "--is-shallow-repository").stdout.strip() == "true"
    if missing and shallow:
        return [f"this clone is shallow and lacks {len(missing)} of {len(commits)} commits: git fetch --unshallow"], "a shallow clone"
    return [f"{commit}: a commit of doc/results/runs.csv that this repository does not have" for commit in missing], \
        f"{len(commits)} commits looked for"


def record(root, names):
    """Writes the commit of now into the lines of these files; a changed file of sources makes it one that does not exist."""
    path = root / "doc/results/runs.csv"
    runs = read_csv(path)
    commit = git(root, "rev-parse", "--short=9", "HEAD").stdout.strip()
    if git(root, "status", "--porcelain", "--untracked-files=no", "--", "src", "include", "test", "thesis", "scripts").stdout:
        commit += "+changes"
    wanted = {pathlib.Path(name).name for name in names}
    known = set()
    for run in runs:
        made = {pathlib.PurePath(name).name for name in run["files"].split()} & wanted
        known |= made
        if made:
            run["commit"] = commit
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, ["files", "commit", "command"], lineterminator="\n")
        writer.writeheader()
        writer.writerows(runs)
    return [f"{name}: add a line to doc/results/runs.csv, with the command that made it" for name in sorted(wanted - known)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, default=ROOT)
    parser.add_argument("--record", nargs="+", metavar="FILE")
    options = parser.parse_args()
    if options.record:
        faults = record(options.root, options.record)
    else:
        faults, count = check_numbers(options.root)
        missing, looked = check_commits(options.root)
        faults += check_files(options.root) + missing
        print(f"{count} numbers compared, {looked}, {len(faults)} faults")
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
