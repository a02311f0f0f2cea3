#!/usr/bin/python3
"""scripts/report_rows.py keeps rows of another program only where this one gives the same."""
import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "scripts"))
import report_rows  # noqa: E402  (the path comes first)

HEADER = "row,scene,run,distance,microseconds\n"


class ReportRows(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.results = self.folder / "results"
        self.experiment = self.write("table.yaml", "title: t\nrows: [{name: a}]\n")
        self.program = self.folder / "evaluate"
        self.now_gives("0.5")
        for name, value in (("experiments", lambda: [self.experiment]), ("same_program", lambda commit: commit == "now")):
            self.addCleanup(setattr, report_rows, name, getattr(report_rows, name))
            setattr(report_rows, name, value)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def now_gives(self, distance):
        """A program that writes one run to the folder after --output, its last argument."""
        self.program.write_text(f'#!/bin/sh\nfor folder; do :; done\nprintf "{HEADER}a,s,0,{distance},9\\n" >"$folder/table.csv"\n'
                                .replace(HEADER, HEADER.replace("\n", "\\n")), encoding="utf-8")
        self.program.chmod(0o755)

    def rows_of(self, commit):
        report_rows.prepare(self.results, str(self.program))
        self.write("results/table.csv", HEADER + "a,s,0,0.5,7\na,s,1,0.6,7\n")
        self.write("results/table.commit", commit + "\n")

    def fault(self):
        with self.assertRaises(SystemExit) as end:
            report_rows.prepare(self.results, str(self.program))
        return str(end.exception)

    def test_rows_of_this_program_stay_and_it_is_not_run(self):
        self.rows_of("now")
        self.now_gives("0.7")
        report_rows.prepare(self.results, str(self.program))

    def test_rows_of_another_program_that_gives_the_same_keep_their_commit(self):
        self.rows_of("before")
        report_rows.prepare(self.results, str(self.program))
        self.assertEqual((self.results / "table.commit").read_text(encoding="utf-8"), "before\n")

    def test_rows_that_another_program_gave_otherwise_are_named(self):
        self.rows_of("before")
        self.now_gives("0.7")
        self.assertIn("table: a, s", self.fault())

    def test_rows_of_an_experiment_that_has_changed_are_named(self):
        self.rows_of("now")
        self.write("table.yaml", "title: t\nrows: [{name: a, parameters: {elite_count: 1}}]\n")
        self.assertIn("table: its experiment has changed", self.fault())

    def test_words_that_have_changed_leave_rows_as_they_are(self):
        self.rows_of("now")
        self.write("table.yaml", "title: other\nremark: why\nrows: [{name: a}]\n")
        report_rows.prepare(self.results, str(self.program))


if __name__ == "__main__":
    with contextlib.redirect_stdout(io.StringIO()):
        unittest.main()
