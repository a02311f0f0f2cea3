#!/usr/bin/env python3
"""Turns check_results.py red on purpose, once for each thing that it is to find, in a copy of the documents; and has
refresh_quotes.py mend what it can."""
import lzma
import pathlib
import shutil
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import check_results  # noqa: E402  (the path comes first)
import refresh_quotes  # noqa: E402  (check_results adds its folder)
from check_results import provenance  # noqa: E402

RESULT = "doc/results/tracking.csv"
PAGE = "doc/results/page.md"
FIGURES = "doc/results/page.figures"


class Documents(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name in ("doc/results", "thesis/experiments"):
            (self.root / name).mkdir(parents=True)
        for name in {path for paths in provenance.GROUPS.values() for path in paths}:
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(provenance.ROOT / name, self.root / name)
        self.write("README.md", "")
        self.write("CONTRIBUTING.md", "")
        self.write("thesis/experiments/table.yaml", "rows: [{name: a}]\n")
        self.write(RESULT, "pair,us,level\npeg,31.4,nodes\nhooks,52.6,nodes\nhooks,7,refined\n")
        self.write("doc/results/log.txt", "worst case: 1,234 us\n")
        rows = {}
        for name in (RESULT, "doc/results/log.txt"):
            row = dict.fromkeys(provenance.COLUMNS, "")
            row.update(file=name, commit="0123abc", defaults="tracker,contact", inputs="thesis/experiments/*.yaml", command="run")
            rows[name] = provenance.entry(provenance.Tree(self.root), row)
        provenance.write_manifest(rows, self.root)
        self.quote('The peg takes 31 us, 30 in the middle.', 'tracking.csv: 31 = value("us", pair="peg"); 30 = mean("us"); '
                   '31 = median("us")')

    def write(self, name, text):
        (self.root / name).write_text(text, encoding="utf-8")

    def quote(self, text, *sections):
        """A page with a mark of each section: `RESULT: FIGURE; FIGURE`; one mark is put behind the text."""
        marks = "" if "<!--" in text else "".join(f"\n<!-- figures: s{index} -->" for index in range(len(sections)))
        self.write(PAGE, "# Page\n\n" + text + marks + "\n\nMore 31.\n")
        self.write(FIGURES, self.figures_text(sections))

    @staticmethod
    def figures_text(sections):
        text = ""
        for index, section in enumerate(sections):
            source, _, figures = section.partition(": ")
            text += f"[s{index}]\n{source}:\n" + "".join(f"  {figure}\n" for figure in figures.split("; "))
        return text

    def change(self, name, before, after):
        text = (self.root / name).read_text(encoding="utf-8")
        self.assertIn(before, text)
        self.write(name, text.replace(before, after))

    def mark(self, name, **cells):
        rows = provenance.read_manifest(self.root)
        rows[name].update(cells)
        provenance.write_manifest(rows, self.root)

    def faults(self, most_older=0):
        return "\n".join(check_results.check(self.root, most_older)[0])

    def expect(self, *texts, most_older=0):
        faults = self.faults(most_older)
        for text in texts:
            self.assertIn(text, faults)


class CheckResults(Documents):
    def test_good_results_have_no_fault(self):
        self.assertEqual(self.faults(), "")

    def test_a_file_without_a_line(self):
        self.write("doc/results/new.csv", "a\n1\n")
        self.expect("doc/results/new.csv: no line")

    def test_a_line_without_a_file(self):
        (self.root / "doc/results/log.txt").unlink()
        self.expect("there is no such file")

    def test_a_file_edited_by_hand(self):
        self.change(RESULT, "52.6", "52.5")
        self.expect(f"{RESULT}: not the file that run wrote")

    def test_a_program_that_is_in_no_commit(self):
        self.mark(RESULT, commit="0123abc+changes")
        self.expect("in no commit")

    def test_defaults_that_changed(self):
        self.change("src/tracking/tracker_parameters.cpp", "cold.population_size = 300", "cold.population_size = 200")
        self.expect(f"{RESULT} (0123abc): defaults have changed")

    def test_defaults_of_another_group_that_changed(self):
        self.change("include/concave_distance/scene/simulation_settings.h", "step_fraction = 0.1", "step_fraction = 0.2")
        self.assertEqual(self.faults(), "")

    def test_a_default_that_came(self):
        self.change("include/concave_distance/contact/material.h", "struct Material {",
                    "struct Material {\n  double stickiness = 1.0;")
        self.expect("defaults have changed")

    def test_a_comment_in_a_header_is_no_default(self):
        self.change("include/concave_distance/contact/material.h", "struct Material {", "struct Material {\n  // x = 1;")
        self.assertEqual(self.faults(), "")

    def test_inputs_that_changed(self):
        self.write("thesis/experiments/table.yaml", "rows: [{name: b}]\n")
        self.expect("thesis/experiments/*.yaml has changed")

    def test_words_of_an_experiment_are_no_inputs(self):
        self.write("thesis/experiments/table.yaml", 'remark: "why"\nrows: [{name: a, thesis: {scene: {exact: 1/2}}}]\n')
        self.assertEqual(self.faults(), "")

    def test_a_parameter_of_an_experiment_is_an_input(self):
        self.write("thesis/experiments/table.yaml", "rows: [{name: a, parameters: {population_size: 20}}]\n")
        self.expect("thesis/experiments/*.yaml has changed")

    def test_a_line_of_several_files(self):
        rows = provenance.read_manifest(self.root)
        row = dict(rows.pop("doc/results/log.txt"), file="doc/results/log.txt,doc/results/more.txt")
        self.write("doc/results/more.txt", "x\n")
        rows[row["file"]] = provenance.entry(provenance.Tree(self.root), row)
        provenance.write_manifest(rows, self.root)
        self.assertEqual(self.faults(), "")
        self.write("doc/results/more.txt", "y\n")
        self.expect("not the file that run wrote")

    def test_older_files_are_warned_of_up_to_their_number(self):
        self.write("thesis/experiments/table.yaml", "rows: [{name: b}]\n")
        self.mark(RESULT, state="older")
        self.mark("doc/results/log.txt", state="older")
        self.assertEqual(self.faults(most_older=2), "")
        self.expect("2 results are older than the defaults, 1 may be", most_older=1)
        self.expect("lower MOST_OLDER", most_older=3)

    def test_a_file_that_is_older_no_more(self):
        self.mark(RESULT, state="older")
        self.expect("is not older", most_older=9)

    def test_a_figure_that_differs(self):
        self.quote('The peg takes 32 us.', 'tracking.csv: 32 = value("us", pair="peg")')
        self.expect("32 is 31.4 there")

    def test_a_figure_that_is_not_in_the_text(self):
        self.quote('The peg takes 3.1 us.', 'tracking.csv: 31 = value("us", pair="peg")')
        self.expect("31 is not in the paragraph")

    def test_a_figure_of_another_paragraph_does_not_count(self):
        self.quote('At 31 us.\n\nThe peg.', 'tracking.csv: 31 = value("us", pair="peg")')
        self.expect("31 is not in the paragraph")

    def test_an_expression_that_matches_several_rows(self):
        self.quote('Hooks take 53 us.', 'tracking.csv: 53 = value("us", pair="hooks")')
        self.expect("2 rows match")

    def test_an_expression_that_names_no_column(self):
        self.quote('Hooks take 53 us.', 'tracking.csv: 53 = max("ms")')
        self.expect("NameError")

    def test_a_number_from_a_text_file(self):
        self.quote('At most 1.23 ms.', 'log.txt: 1.23 = found(r"worst case: ([\\d,]+)") / 1000')
        self.assertEqual(self.faults(), "")
        self.quote('At most 1.24 ms.', 'log.txt: 1.24 = found(r"worst case: ([\\d,]+)") / 1000')
        self.expect("1.24 is 1.234 there")

    def test_a_figure_of_compressed_rows(self):
        folder = self.root / "doc/results/evaluation"
        folder.mkdir()
        (folder / "table.csv.xz").write_bytes(lzma.compress(b"row,us\npeg,31.4\nhooks,52.6\n"))
        figure = 'evaluation/table.csv.xz: %s = value("us", row="peg")'
        self.quote("31 us", figure % 31)
        self.expect("evaluation/table.csv.xz is no recorded result")
        rows = provenance.read_manifest(self.root)
        row = dict(rows["doc/results/log.txt"], file="doc/results/evaluation/*.csv.xz")
        rows[row["file"]] = provenance.entry(provenance.Tree(self.root), row)
        provenance.write_manifest(rows, self.root)
        self.assertEqual(self.faults(), "")
        self.quote("32 us", figure % 32)
        self.expect("32 is 31.4 there")

    def test_a_table(self):
        self.quote("| pair | us |\n|---|---|\n| `peg` | 31.4 |\n| hooks | 53 |", "tracking.csv: table")
        self.assertEqual(self.faults(), "")
        for row in ("| `peg` | 31.5 |", "| `peg` | 52.6 |", "| pegs | 31.4 |"):
            self.quote(f"| pair | us |\n|---|---|\n{row}", "tracking.csv: table")
            self.expect("no line has the figures of " + row)

    def test_a_quoted_file_that_is_not_there_or_not_recorded(self):
        self.quote("31 us", 'trucking.csv: 31 = max("us")')
        self.expect("trucking.csv is no recorded result")

    def test_marks_and_sections_that_do_not_fit(self):
        figure = 'tracking.csv: 31 = value("us", pair="peg")'
        self.quote("31 us\n<!-- figures: s1 -->", figure)
        self.expect("mark s1 has no section", "no mark names section [s0]")
        self.quote("31 us\n<!-- figures: s0 -->\n\n31 us\n<!-- figures: s0 -->", figure)
        self.expect("mark s0 stands 2 times")
        self.quote("31 us", figure)
        self.write(FIGURES, self.figures_text([figure]) * 2)
        self.expect("two sections [s0]")
        self.write(FIGURES, "[s0]\ntracking.csv:\n")
        self.expect("section [s0] is empty")
        self.write(FIGURES, "[s0]\n  31 = value(1)\n")
        self.expect("'31 = value(1)' is no [section]")
        (self.root / FIGURES).rename(self.root / "doc/results/pages.figures")
        self.expect("mark s0 has no section", "doc/results/pages.figures: there is no such page")

    def test_figures_within_a_page(self):
        self.quote('31 us\n<!-- tracking.csv: 31 = value("us", pair="peg") -->')
        self.expect("belong into the file beside the page")

    def test_how_exactly_a_number_is_meant(self):
        for token, expected in (("49", 0.5), ("2,120", 5), ("1000", 5), ("100", 0.5), ("0.58", 0.005), ("2.1e-14", 5e-16)):
            self.assertAlmostEqual(check_results.rounding(token) / expected, 1, places=6)


class RefreshQuotes(Documents):
    def refresh(self, list_only=False):
        _, left = refresh_quotes.refresh(self.root, [self.root / PAGE], list_only)
        return "\n".join(left)

    def expect_page(self, text, *sections):
        self.assertEqual(self.refresh(), "")
        page, figures = [(self.root / name).read_text(encoding="utf-8") for name in (PAGE, FIGURES)]
        self.quote(text, *sections)
        self.assertEqual(page, (self.root / PAGE).read_text(encoding="utf-8"))
        self.assertEqual(figures, self.figures_text(sections))
        self.assertEqual(check_results.check_quotes(self.root, provenance.read_manifest(self.root))[0], [])

    def test_figures_that_hold_stay(self):
        self.expect_page('The peg takes 31 us, 30 in the middle.', 'tracking.csv: 31 = value("us", pair="peg"); 30 = '
                         'mean("us"); 31 = median("us")')

    def test_a_figure_is_replaced_in_text_and_beside_it(self):
        self.quote('The peg (31.4 mm) takes 32 us.', 'tracking.csv: 32 = value("us", pair="peg")')
        self.expect_page('The peg (31.4 mm) takes 31 us.', 'tracking.csv: 31 = value("us", pair="peg")')

    def test_nothing_is_written_where_a_list_is_asked_for(self):
        self.quote('The peg takes 32 us.', 'tracking.csv: 32 = value("us", pair="peg")')
        self.assertEqual(self.refresh(list_only=True), "")
        self.expect("32 is 31.4 there")

    def test_a_number_quoted_once_and_written_twice_is_left(self):
        self.quote('In 32 runs the peg takes 32 us.', 'tracking.csv: 32 = value("us", pair="peg")')
        self.assertIn("page.md:4: 32 stands 2 times in the text and is quoted 1 times: 31 =", self.refresh())
        self.expect("32 is 31.4 there")

    def test_equal_numbers_that_become_different_are_left(self):
        self.quote('From 32 to 32 us.', 'tracking.csv: 32 = value("us", pair="peg"); 32 = max("us")')
        self.assertIn("32 stands for several figures: 31 = value", self.refresh())

    def test_equal_numbers_in_the_order_of_their_section(self):
        self.quote('| 8 | 32 | 31 | 32 |', 'tracking.csv: 8 = min("us"); 32 = value("us", pair="peg"); '
                   '31 = median("us"); 32 = max("us")')
        self.expect_page('| 7 | 31 | 31 | 53 |', 'tracking.csv: 7 = min("us"); 31 = value("us", pair="peg"); '
                         '31 = median("us"); 53 = max("us")')

    def test_equal_numbers_in_another_order_are_left(self):
        self.quote('| 8 | 32 | 32 | 30 |', 'tracking.csv: 30 = mean("us"); 32 = value("us", pair="peg"); '
                   '32 = max("us"); 8 = min("us")')
        self.assertIn("32 stands for several figures", self.refresh())

    def test_each_mark_has_the_text_after_the_one_before(self):
        text = "- %s us\n  <!-- figures: s0 -->\n- %s us\n  <!-- figures: s1 -->"
        figures = ['tracking.csv: %s = value("us", pair="peg")', 'tracking.csv: %s = max("us")']
        self.quote(text % (32, 32), figures[0] % 32, figures[1] % 32)
        self.expect_page(text % (31, 53), figures[0] % 31, figures[1] % 53)

    def test_expressions_and_tables_that_fail_are_left(self):
        self.quote('9 us', 'tracking.csv: 9 = value("us", pair="pegs")')
        self.assertIn("0 rows match", self.refresh())
        self.quote("| pair | us |\n|---|---|\n| peg | 32 |", "tracking.csv: table")
        self.assertIn("no line has the figures of | peg | 32 |", self.refresh())

    def test_numbers_keep_their_form_and_mean_what_the_check_reads(self):
        for token, value, expected in (
                ("49", 31.44, "31"), ("49", 104.4, "104"), ("9", 11.77, "12"), ("7", 0.634, "0.6"), ("98", 1234, "1230"),
                ("2,120", 3456.7, "3,460"), ("2120", 3456.7, "3460"), ("170,000", 98765, "98,800"), ("944", 12345, "12,300"),
                ("203,910", 203914, "203,910"), ("1,234", 987, "987"), ("0.58", 0.0521, "0.052"), ("9.9", 9.96, "10"),
                ("1.000", 0.9951, "0.995"), ("0.995", 0.9999, "1.000"), ("0.00", 0.031, "0.03"), ("0.2", 0, "0.0"),
                ("2.1e-14", 3.456e-15, "3.5e-15"), ("5e-3", 0, "0"), ("-12", -13.7, "-14")):
            written = refresh_quotes.rewritten(value, token)
            self.assertEqual(written, expected, f"{value} as {token}")
            self.assertTrue(check_results.is_rounded(value, written), written)


if __name__ == "__main__":
    unittest.main()
