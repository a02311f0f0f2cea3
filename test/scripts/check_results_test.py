#!/usr/bin/env python3
"""Makes check_results.py fail on purpose, once for each thing that it is to find, in a small package of its own."""
import contextlib
import csv
import io
import lzma
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import check_results  # noqa: E402  (the path comes first)

RESULTS = "doc/results/"


class Results(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / RESULTS).mkdir(parents=True)
        self.write(RESULTS + "tracking.csv", "pair,us,level\npeg,31.4,nodes\nhooks,52.6,nodes\nhooks,-7,refined\n")
        self.write(RESULTS + "log.txt", "worst case: 1,234 us\n")
        self.write("README.md", "The peg takes 31 us, all of them\n77 us.\n\n| pair | us |\n|---|---|\n| `peg` | 31.4 |\n| `hooks` | 53 |\n\nMore.\n")
        self.runs(("tracking.csv log.txt", "0123abc", "run"))
        self.quote("takes {31} us", "tracking.csv", "value('us', pair='peg')")

    def write(self, name, text):
        (self.root / name).write_text(text, encoding="utf-8")

    def write_csv(self, name, header, rows):
        with open(self.root / RESULTS / name, "w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows([header, *rows])

    def runs(self, *rows):
        self.write_csv("runs.csv", ["files", "commit", "command"], rows)

    def quote(self, text, file, formulas, page="README.md"):
        self.write_csv("numbers.csv", ["page", "text", "file", "formulas"], [[page, text, file, formulas]])

    def fault(self):
        return "\n".join(check_results.check_numbers(self.root)[0] + check_results.check_files(self.root))

    def test_right_numbers_pass(self):
        self.assertEqual(self.fault(), "")
        for text, file, formulas in (("takes {31} us, all of them {77} us", "tracking.csv", "min('us', pair='peg');; total('us')"),
                                     ("{77} us", "tracking.csv", "max('us') + 24.4"), ("| pair | us |", "tracking.csv", "table"),
                                     ("{31} us", "log.txt", "found(r'worst case: ([0-9,]+)') - 1203"),
                                     ("{31} us", "tracking.csv", "median('us', pair=['peg', 'hooks'])"),
                                     ("{31} us", "tracking.csv", "29 + count('us > 30')"), ("{31} us", "tracking.csv", "5.3 + mean('us')")):
            self.quote(text, file, formulas)
            self.assertEqual(self.fault(), "", formulas)

    def test_a_number_that_its_file_does_not_give(self):
        self.quote("takes {31} us", "tracking.csv", "value('us', pair='hooks', level='nodes')")
        self.assertIn("31 of 'takes 31 us' is 52.6", self.fault())

    def test_a_text_that_does_not_stand_once_in_its_page(self):
        self.quote("takes {32} us", "tracking.csv", "value('us', pair='peg')")
        self.assertIn("stands 0 times", self.fault())
        self.quote("{31}", "tracking.csv", "value('us', pair='peg')")
        self.assertIn("stands 2 times", self.fault())

    def test_formulas_that_mean_nothing(self):
        for formulas, fault in (("value('us', pair='hooks')", "2 rows match"), ("value('ms')", "NameError"), ("open('x')", "NameError"),
                                ("31;; 31", "1 numbers in braces and 2 formulas"), ("found('no such')", "0 places match")):
            self.quote("takes {31} us", "tracking.csv", formulas)
            self.assertIn(fault, self.fault())

    def test_a_table_with_a_row_that_no_line_has(self):
        self.write("README.md", "| pair | us |\n|---|---|\n| `peg` | 31.5 |\n| `hooks` | 53 |\n")
        self.quote("| pair | us |", "tracking.csv", "table")
        self.assertIn("| `peg` | 31.5 |", self.fault())
        self.assertNotIn("hooks", self.fault())

    def test_pages_and_files_that_are_not_there(self):
        self.quote("takes {31} us", "tracking.csv", "1", page="NO.md")
        self.assertIn("NO.md", self.fault())
        self.quote("takes {31} us", "no.csv", "1")
        self.assertIn("no.csv", self.fault())
        self.write("doc/page.md", "takes 31 us")
        self.quote("takes {31} us", "tracking.csv", "value('us', pair='peg')", page="doc/page.md")
        self.assertIn("stand on README", self.fault())

    def test_results_without_a_line_and_lines_without_a_file(self):
        (self.root / RESULTS / "new.csv.xz").write_bytes(lzma.compress(b"a\n1\n"))
        self.runs(("tracking.csv log.txt gone.csv", "0123abc", "run"))
        self.assertIn("new.csv.xz: no line", self.fault())
        self.assertIn("gone.csv: doc/results/runs.csv lists it", self.fault())

    def test_rounding_counts_the_digits_that_stand_there(self):
        for token, half in (("31", 0.5), ("31.0", 0.05), ("1,230", 5), ("1000", 5), ("100", 0.5), ("2e-3", 5e-4), ("-0.31", 0.005)):
            self.assertAlmostEqual(check_results.rounding(token) / half, 1, places=6, msg=token)

    def git(self, *arguments, root=None):
        return subprocess.run(["git", "-c", "user.name=n", "-c", "user.email=e", *arguments], cwd=root or self.root, check=True,
                              capture_output=True, text=True).stdout.strip()

    def repository(self):
        self.git("init", "-q")
        for text in ("first", "second"):
            self.write("text", text)
            self.git("add", "-A")
            self.git("commit", "-q", "-m", text)

    def test_commits_that_the_repository_has_not(self):
        self.assertIn("no history", check_results.check_commits(self.root)[1])
        self.repository()
        self.assertIn("0123abc", check_results.check_commits(self.root)[0][0])
        self.runs(("tracking.csv log.txt", self.git("rev-parse", "HEAD~1"), "run"))
        self.assertEqual(check_results.check_commits(self.root)[0], [])

    def test_a_shallow_clone_fails_with_the_remedy(self):
        self.repository()
        self.runs(("tracking.csv log.txt", self.git("rev-parse", "HEAD~1"), "run"))
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "third")
        with tempfile.TemporaryDirectory() as clone:
            self.git("clone", "-q", "--depth", "1", f"file://{self.root}", clone)
            self.assertIn("git fetch --unshallow", check_results.check_commits(pathlib.Path(clone))[0][0])

    def test_recording_writes_the_commit_of_now(self):
        (self.root / "src").mkdir()
        self.write("src/a.cpp", "")
        self.repository()
        self.assertEqual(check_results.record(self.root, ["doc/results/log.txt"]), [])
        self.assertEqual(check_results.check_commits(self.root)[0], [])
        self.write("src/a.cpp", "changed")
        self.assertIn("no.txt", check_results.record(self.root, ["log.txt", "no.txt"])[0])
        self.assertIn("+changes", check_results.check_commits(self.root)[0][0])


if __name__ == "__main__":
    with contextlib.redirect_stdout(io.StringIO()):
        unittest.main()
