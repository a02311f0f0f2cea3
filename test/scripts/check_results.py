#!/usr/bin/env python3
"""Fails where doc/results and what the documents quote of it cannot be relied on.

    test/scripts/check_results.py [package folder]

- a file of doc/results without a line in doc/results/provenance.csv, a line without a file, a file that is not the
  recorded one (edited by hand), or one made by a program that was not committed;
- a file made with other parameter defaults, or from other files, than those of now, unless its state is `older`; more
  of those than MOST_OLDER, or one that is not older;
- a figure of a document that is not what its file says. A mark behind a paragraph or table of PAGE.md names a section
  of PAGE.figures, which lies beside it:

    The middle of 15 pairs is 49, the worst 217.        [speed]
    <!-- figures: speed -->                             results/tracking.csv:
                                                          49 = median("fcl_over_alone")
                                                          217 = max("fcl_over_alone")
                                                          15 = count("1")

A section names its results, compressed (.csv.xz) or not, from the page's folder. Every number on the left stands in the
paragraph or table before the mark and is the rounded value of the Python expression on the right: value, min, max,
median, mean, total and count of an expression of columns, over the rows with the given cells (`pair="peg_in_hole"`, or a
list of them); found("regex") is the number that matches the group in a text file. `table` instead of a figure: the
numbers of each row of the table before the mark stand, rounded, in one line of the file.
"""
import csv
import io
import lzma
import pathlib
import re
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "scripts"))
import provenance  # noqa: E402  (the path comes first)

MOST_OLDER = 0  # results made with other defaults than those of now: lower it as they are made again, never raise it
MARK = re.compile(r"(?<!`)<!-- figures: (\S+) -->")  # one in backticks is an example
RESULT_IN_PAGE = re.compile(r"(?<!`)<!-- \S+\.(?:csv|csv\.xz|txt): ")
FIGURES_LINE = re.compile(r"\[(?P<section>[^\]\s]+)\]|(?P<source>\S+\.(?:csv|csv\.xz|txt)):|\s+(?P<figure>\S.*)")
NUMBER = r"(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?(?:e[-+]?\d+)?"
PLAIN_NUMBER = r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?"  # of a CSV file, in which commas part cells


def documents(root, ending):
    """The files with an ending in the package's folder and below its folders of documents."""
    return [*sorted(root.glob("*" + ending)), *sorted((root / "doc").rglob("*" + ending)),
            *sorted((root / "thesis" / "doc").rglob("*" + ending))]


def pages(root):
    return documents(root, ".md")


def check_files(root, rows):
    tree = provenance.Tree(root)
    faults = []
    recorded = {name for pattern in rows for name in tree.matching(pattern)}
    for name in tree.matching("doc/results/**/*"):
        if name not in recorded and not name.endswith((".md", ".figures")) and name != provenance.MANIFEST:
            faults.append(f"{name}: no line in {provenance.MANIFEST} says what it was made with (scripts/provenance.py record)")
    for name, row in rows.items():
        if not tree.matching(name):
            faults.append(f"{name}: {provenance.MANIFEST} lists it, but there is no such file")
        elif provenance.digest(tree, name) != row["digest"]:
            faults.append(f"{name}: not the file that {row['command']} wrote: run it again and record it")
        if row["commit"].endswith("+changes"):
            faults.append(f"{name}: made by a program that is in no commit: commit, then run {row['command']} again")
    return faults


def why_older(tree, row):
    reasons = []
    if provenance.fingerprint(tree, row["defaults"]) != row["fingerprint"]:
        changed = provenance.changed_defaults(tree, row["defaults"], row["commit"].split("+")[0])
        reasons.append("defaults have changed: " + ("; ".join(changed[:3]) or row["defaults"])
                       + (f" and {len(changed) - 3} more" if len(changed) > 3 else ""))
    if provenance.digest(tree, row["inputs"]) != row["inputs_digest"]:
        reasons.append(f"{row['inputs']} has changed")
    return ", ".join(reasons)


def check_age(root, rows, most_older):
    """Faults and warnings; what is kept as history may be as old as it is."""
    tree = provenance.Tree(root)
    faults, warnings = [], []
    for name, row in rows.items():
        reason = "" if row["state"] == "history" else why_older(tree, row)
        if reason and row["state"] != "older":
            faults.append(f"{name} ({row['commit']}): {reason}; run {row['command']} again")
        elif reason:
            warnings.append(f"{name} ({row['commit']}): {reason}")
        elif row["state"] == "older":
            faults.append(f"{name} is not older than the defaults: take `older` out of {provenance.MANIFEST}")
    if len(warnings) > most_older:
        faults.append(f"{len(warnings)} results are older than the defaults, {most_older} may be: make them again")
    elif len(warnings) < most_older:
        faults.append(f"only {len(warnings)} results are older than the defaults: lower MOST_OLDER")
    return faults, warnings


class Quoted:
    """What an expression of a quote may use."""

    def __init__(self, text, is_table):
        self.text = text
        self.rows = list(csv.DictReader(io.StringIO(text))) if is_table else []

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

    def names(self):
        def over(summary):
            return lambda expression, **cells: summary(self.values(expression, cells))
        return {"value": self.value, "found": self.found, "min": over(min), "max": over(max), "total": over(sum),
                "median": over(statistics.median), "mean": over(statistics.fmean), "count": over(lambda all: sum(map(bool, all)))}


def rounding(token):
    """How far a value may be from the number that it is rounded to; three digits of a large number count."""
    digits, _, exponent = token.replace(",", "").partition("e")
    whole, _, decimals = digits.partition(".")
    zeros = 0 if decimals else min(len(whole) - len(whole.rstrip("0")), max(len(whole) - 3, 0))
    return 0.5 * 10.0 ** (zeros - len(decimals) + int(exponent or 0)) * (1 + 1e-9)


def is_rounded(value, token):
    return abs(value - float(token.replace(",", ""))) <= rounding(token)


def paragraph_before(text, position):
    """The paragraph, list item or table that a comment belongs to, without other comments."""
    before = re.sub(r"<!--.*?-->", "", text[:position], flags=re.DOTALL).rstrip()
    return before[before.rfind("\n\n") + 1:]


def check_table(table, quoted):
    """Every row of a table stands, rounded, in one line of the file that names one of the row's other cells."""
    faults = []
    for row in [line for line in table.strip().splitlines() if line.startswith("|")][2:]:
        cells = [cell.strip(" `") for cell in row.strip("|").split("|")]
        numbers = [cell for cell in cells if re.fullmatch("-?" + NUMBER, cell)]
        names = [cell for cell in cells if cell and cell not in numbers]
        lines = [line for line in quoted.text.splitlines() if any(name in line for name in names)]
        if not any(all(any(is_rounded(float(found), number) for found in re.findall(PLAIN_NUMBER, line))
                       for number in numbers) for line in lines):
            faults.append("no line has the figures of " + row)
    return faults


def check_figure(figure, paragraph, quoted):
    token, _, expression = (part.strip() for part in figure.partition("="))
    if not re.fullmatch("-?" + NUMBER, token) or not expression:
        return [f"'{figure.strip()}' is not of the form NUMBER = EXPRESSION"]
    if token.lstrip("-") not in re.findall(NUMBER, paragraph):
        return [f"{token} is not in the paragraph before it"]
    try:
        value = float(eval(expression, {"__builtins__": {}}, quoted.names()))
    except Exception as error:  # any fault of an expression is a fault of the page
        return [f"{expression}: {type(error).__name__}: {error}"]
    if is_rounded(value, token):
        return []
    return [f"{token} is {value:.6g} there: {expression}"]


def read_result(path):
    return (lzma.decompress(path.read_bytes()) if path.suffix == ".xz" else path.read_bytes()).decode()


def figures_file(page):
    return page.with_suffix(".figures")


def read_figures(page):
    """The sections of the file beside a page: {name: [(result's name, figure, its place in the file)]}, and the faults."""
    sections, faults = {}, []
    section = source = None
    begin = 0
    for line in figures_file(page).read_text(encoding="utf-8").splitlines(True) if figures_file(page).exists() else []:
        match = FIGURES_LINE.fullmatch(line.rstrip())
        if match and match["section"]:
            section, source = match["section"], None
            if section in sections:
                faults.append(f"two sections [{section}]")
            sections[section] = []
        elif match and match["source"] and section:
            source = match["source"]
        elif match and match["figure"] and source:
            sections[section].append((source, match["figure"], begin + match.start("figure")))
        elif line.strip():
            faults.append(f"'{line.strip()}' is no [section], no RESULT: and no figure of a result")
        begin += len(line)
    return sections, faults


def check_marks(text, sections):
    marks = [match[1] for match in MARK.finditer(text)]
    faults = [f"mark {name} stands {marks.count(name)} times" for name in set(marks) if marks.count(name) > 1]
    faults += [f"mark {name} has no section" for name in marks if name not in sections]
    faults += [f"no mark names section [{name}]" for name in sections if name not in marks]
    faults += [f"section [{name}] is empty" for name, figures in sections.items() if not figures]
    if RESULT_IN_PAGE.search(text):
        faults.append("a comment names a result: its figures belong into the file beside the page")
    return faults


def check_page(root, page, recorded):
    text = page.read_text(encoding="utf-8")
    sections, faults = read_figures(page)
    faults += check_marks(text, sections)
    count = 0
    for mark in MARK.finditer(text):
        paragraph = paragraph_before(text, mark.start())
        for source, figure, _ in sections.get(mark[1], []):
            count += 1
            path = (page.parent / source).resolve()
            if path.relative_to(root.resolve()).as_posix() not in recorded:
                faults.append(f"{source} is no recorded result")
                continue
            quoted = Quoted(read_result(path), ".csv" in path.suffixes)
            found = check_table(paragraph, quoted) if figure == "table" else check_figure(figure, paragraph, quoted)
            faults += [f"{source}: {fault}" for fault in found]
    return faults, count


def check_quotes(root, rows):
    faults, count = [], 0
    tree = provenance.Tree(root)
    recorded = {name for patterns in rows for pattern in patterns.split(",") for name in tree.matching(pattern)}
    for page in pages(root):
        found, compared = check_page(root, page, recorded)
        faults += [f"{page.relative_to(root).as_posix()}: {fault}" for fault in found]
        count += compared
    for path in documents(root, ".figures"):
        if not path.with_suffix(".md").exists():
            faults.append(f"{path.relative_to(root).as_posix()}: there is no such page")
    return faults, count


def check(root, most_older=MOST_OLDER):
    rows = provenance.read_manifest(root)
    aged, warnings = check_age(root, rows, most_older)
    misquoted, count = check_quotes(root, rows)
    return check_files(root, rows) + aged + misquoted, warnings, count


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else provenance.ROOT)
    faults, warnings, count = check(root)
    for warning in warnings:
        print("older:", warning)
    for fault in faults:
        print(fault)
    print(f"{count} figures of documents compared, {len(warnings)} results older than the defaults, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
