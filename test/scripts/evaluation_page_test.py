#!/usr/bin/env python3
"""The page of the evaluation: its losses are the worse figures and no others, its quoted figures are those of the rows."""
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
from evaluation import gains, losses, texts  # noqa: E402  (the path comes first)
from evaluation.figures import their_number, values_of  # noqa: E402
from evaluation.rows import Results  # noqa: E402

EXPERIMENT = {
    "name": "table", "table": "9.9", "scenes": {"boxes": 0.1},
    "rows": [
        {"name": "search; N_pop 20", "algorithm": "comb-GA-wl",
         "thesis": {"boxes": {"exact": "19/20", "region": "20/20", "niches": "3.0 [1-7] 1.2", "distance": 0.3}},
         "reasons": {"exact": {"text": "{total('search; N_pop 20', 'exact'):.0f} of {runs('search; N_pop 20', 'exact')}.",
                               "tested": ["elite 1"]}},
         "better": {"niches": {"unknown": True, "text": "Tried: {mean('elite 1', 'niches'):.0f}."}}},
        {"name": "elite 1", "algorithm": "comb-GA-wl", "variant_of": "search; N_pop 20",
         "thesis": {"boxes": {"exact": "19/20"}}},
    ],
}
HEADER = "row,scene,run,exact,region,niches,distance,flops,microseconds\n"


def rows_of(name, exact, niches, distance):
    return "".join(f"{name},boxes,{i},{int(i < exact)},1,{niches},{distance},26000,100\n" for i in range(20))


class EvaluationPage(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "table_scenes.csv").write_text("scene,instants,node_distance\nboxes,1,0.2985\n")

    def results(self, exact=5, niches=2, distance=0.29):
        (self.folder / "table.csv").write_text(
            HEADER + rows_of("search; N_pop 20", exact, niches, distance) + rows_of("elite 1", 20, 3, 0.29))
        return Results([EXPERIMENT], [self.folder])

    def losses(self, **figures):
        results = self.results(**figures)
        quoter = texts.Quoter(results, their_number, values_of)
        return [line.split(" | ") for line in losses.losses_of(EXPERIMENT, results.runs["table"], quoter.fill)]

    def test_each_worse_figure_is_listed_and_no_other(self):
        self.assertEqual([line[3] for line in self.losses()], ["Phi*", "N_Gamma"])
        self.assertEqual([line[3] for line in self.losses(exact=19, niches=3, distance=0.31)], ["distance"])
        self.assertEqual(self.losses(exact=20, niches=4), [])

    def gains(self, **figures):
        results = self.results(**figures)
        quoter = texts.Quoter(results, their_number, values_of)
        return [line.split(" | ") for line in gains.gains_of(EXPERIMENT, results.runs["table"], quoter.fill)]

    def test_each_better_figure_is_listed_and_no_other(self):
        self.assertEqual([line[3] for line in self.gains(niches=4)], ["N_Gamma", "distance"])
        self.assertEqual(self.gains(niches=3, distance=0.3), [])

    def test_a_gain_without_a_known_reason_says_what_was_tried(self):
        self.assertIn(f"**{gains.NO_REASON}**. Tried: 3.", self.gains(niches=4)[0][6])

    def test_rates_that_chance_makes_differ_have_chance_as_their_reason(self):
        self.assertAlmostEqual(losses.chance_of_counts(3, 4, 1, 4), 17 / 70)  # Fisher's tea
        self.assertEqual(losses.rate_words("exact", {"exact": "19/20"}, [{"exact": "1"}] * 5 + [{"exact": "0"}] * 15), (False, ""))
        is_chance, words = losses.rate_words("exact", {"exact": "20/20"}, [{"exact": "1"}] * 18 + [{"exact": "0"}] * 2)
        self.assertTrue(is_chance)
        self.assertIn("in 24% of all cases", words)

    def test_a_rate_within_the_interval_of_our_runs_is_not_worse(self):
        self.assertEqual(self.losses(exact=18, niches=3), [])
        self.assertEqual(len(self.losses(exact=17, niches=3)), 1)

    def test_a_loss_names_its_reason_and_what_was_tried(self):
        self.assertIn("5 of 20. Tried: elite 1: 20/20.", self.losses()[0][6])

    def test_a_loss_without_a_reason_says_so(self):
        self.assertIn(losses.NO_REASON, self.losses()[1][6])

    def test_a_placeholder_without_a_value_fails(self):
        quoter = texts.Quoter(self.results(), their_number, values_of)
        for text in ("{mean('no such row', 'exact')}", "{mean('elite 1', 'no_such_column')}", "{thesis('elite 1', 'niches')}"):
            with self.assertRaises(SystemExit):
                quoter.fill(text + ("{None:.1f}" if "thesis" in text else ""), "table")

    def test_placeholders_quote_rows_thesis_and_scene(self):
        quoter = texts.Quoter(self.results(), their_number, values_of)
        self.assertEqual(quoter.fill("{mean('search; N_pop 20', 'exact'):.0%}, {thesis('search; N_pop 20', 'exact'):.0%}, "
                                     "{truth('node_distance'):.4f}, {share('elite 1', 'niches', 3):.0%}, {mean_root('elite 1', 'exact'):.1f}", "table"),
                         "25%, 95%, 0.2985, 100%, 1.0")

    def test_a_figure_typed_by_hand_is_found(self):
        for text in ("in 39 % of the runs", "a chance of 0.08", "7.95 niches", "N_pop 20 loses 3 runs"):
            self.assertTrue(texts.fault_of(text), text)
        for text in ("See Table 5.4, sec. 3.3.2.b and (6.7): N_pop 20 and 50 lose {total('a', 'exact'):.0f}.", "p_m = 1/N_pop"):
            self.assertEqual(texts.fault_of(text), "", text)


if __name__ == "__main__":
    unittest.main()
