# SPDX-License-Identifier: Apache-2.0
"""Rows of a comparison from the numbers of runs: talus.lab.evaluation."""
import json
import math
import sys
import unittest
from pathlib import Path
from unittest import mock

PROJECT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(PROJECT / "python")]

from talus.lab import evaluation  # noqa: E402
from talus.lab.evaluation import Evaluated, counts_text, evaluate, row_values, to_json, to_text  # noqa: E402
from talus.lab.reference import Criterion, Found, Reference, Row  # noqa: E402
from talus.trouble import InputError  # noqa: E402

NAN = math.nan


def row(*variants, **more):
    return Row(1, **{"id": "plateau", "number": 1, "quantity": "discharge_rate_plateau", "case": "section", "unit": "kg/s",
                     "variants": variants, "criterion": Criterion("between", 1, 2)} | more)


class Values(unittest.TestCase):
    def test_are_statistics_over_the_members_of_each_variant(self):
        members = [[1, 2, 6], [], [5], [4, None]]
        self.assertEqual(row_values(row(), members), [3, None, 5, None])
        self.assertEqual(row_values(row(statistic="median"), members), [2, None, 5, None])
        self.assertEqual(row_values(row(statistic="standard_deviation"), members), [math.sqrt(7), None, None, None])
        self.assertEqual(row_values(row(of="curves"), [[7], []]), [7, None])
        self.assertEqual(row_values(row(of="case"), [[7, 8]]), [7])

    def test_members_without_a_number_are_left_out_while_they_are_the_fewer(self):
        self.assertEqual(row_values(row(), [[1, 2, NAN]], True), [1.5])
        self.assertEqual(row_values(row(), [[1, NAN]], True), [1], "half of them")
        for members, may_be_missing in (([1, NAN, NAN], True), ([1, 2, NAN], False)):
            self.assertTrue(math.isnan(row_values(row(), [members], may_be_missing)[0]))

    def test_of_two_variants_are_made_from_their_means(self):
        ratio, difference = row(of="variants", statistic="ratio"), row(of="variants", statistic="difference")
        self.assertEqual(row_values(ratio, [[1, 2], [3]]), [0.5])
        self.assertEqual(row_values(difference, [[1, 2], [3]]), [-1.5])
        self.assertEqual(row_values(difference, [[1, 2], []]), [None])
        self.assertEqual(row_values(ratio, [[1], [0]]), [math.inf])
        with self.assertRaises(ValueError):
            row_values(ratio, [[1]])
        self.assertEqual(row_values(row(of="variants"), [[9]]), [9], "of all of them together")
        self.assertEqual(row_values(row(of="variants"), []), [None])


class OfRuns(unittest.TestCase):
    """In place of the program: runs of which each goes on to t = 2 and has the number of its folder's name."""

    FOUND = [Found("section", "a", ["1", "2"]), Found("section", "b", ["4"])]

    def evaluated(self, *rows, note_faults=True):
        def ask(question, runs=()):
            if question == "measures":
                return [{"name": name, "may_be_missing": False} for name in ("discharge_rate_plateau", "fails")]
            return [[self.answer(run["folder"], asked) for asked in run["questions"]] for run in runs]

        with mock.patch.object(evaluation, "ask", ask):
            return evaluate(Reference(Path("r.toml"), rows=list(rows)), self.FOUND, note_faults)

    @staticmethod
    def answer(folder, asked):
        if asked["at"] is not None and asked["at"] > 2:
            return {"reaches": False}
        if asked["quantity"] == "fails":
            return {"reaches": True, "fault": "a spectrum needs four data"}
        return {"reaches": True, "value": float(folder)}

    def test_values_and_verdicts(self):
        both, late, elsewhere = self.evaluated(row("a", "b"), row("a", id="late", window=(3, 0, math.inf)),
                                               row("c", id="c"))
        self.assertEqual((both.values, both.verdict), ([1.5, 4], "not met"))
        self.assertEqual((late.values, late.verdict), ([None], "not evaluated"))
        written = json.loads(to_json(Reference(Path("r.toml")), [both, late, elsewhere], self.FOUND, "."))["rows"]
        self.assertEqual(written[0]["verdicts"], ["met", "not met"])
        self.assertIn("ends before", written[1]["missing"])
        self.assertEqual(written[2]["missing"], "", "it needs another run")

    def test_a_measure_that_fails(self):
        faulty = row("a", "b", quantity="fails")
        [noted] = self.evaluated(faulty)
        self.assertEqual((noted.values, noted.missing), ([None, None], "a spectrum needs four data"))
        self.assertIn("1 row not evaluated: a spectrum needs four data", to_text([noted]))
        with self.assertRaisesRegex(InputError, "r.toml: row plateau: a spectrum needs four data"):
            self.evaluated(faulty, note_faults=False)


class Written(unittest.TestCase):
    def test_json_names_rows_and_the_runs_they_are_of(self):
        found = [Found("section", "a", ["runs/laws/a/seed_0001", "runs/laws/a/seed_0002"])]
        one = Evaluated(row("a", "b", "c", "d"), [1.5, 2.5, None, NAN], verdict="not met")
        written = json.loads(to_json(Reference(Path("r"), "hopper", "A hopper"), [one], found, "runs/laws"))
        self.assertEqual(written["title"], "A hopper")
        [of_row] = written["rows"]
        self.assertEqual((of_row["verdict"], of_row["values"]), ("not met", [1.5, 2.5, None, None]))
        self.assertEqual(of_row["verdicts"], ["met", "not met", "not evaluated", "not met"],
                         "each variant judged by itself; what has no meaning is not met")
        self.assertEqual(written["runs"], [{"case": "section", "variant": "a", "folders": ["a/seed_0001", "a/seed_0002"]}])

    def test_verdicts_are_counted(self):
        rows = [Evaluated(row("a"), verdict=verdict) for verdict in ("met", "not met", "met")]
        self.assertEqual(counts_text(rows), "2 met, 1 not met, 0 reported, 0 not evaluated")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
