# SPDX-License-Identifier: Apache-2.0
"""Answers to the questions of a comparison: talus.measures, on folders that hold no more than a manifest."""
import math
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(PROJECT / "python")]

from talus import Run, measures  # noqa: E402
from talus.measures import Measures, NotEvaluated, Window  # noqa: E402

STUDY = """
import math
from helper import number_of
from talus.measures import NotEvaluated, Quantity
def at(run, window):
    return number_of(run) + (0 if window.at is None else window.at)
def members(groups, window):
    return sum(number_of(run) for group in groups for run in group)
def missing(run, window):
    if number_of(run) == 2:
        raise NotEvaluated("the second has none")
    return math.nan
class Mean:
    def __init__(self, runs):
        self.number = sum(number_of(run) for run in runs) / len(runs)
def mean(runs):
    return Mean(runs)
QUANTITIES = {"number": Quantity("1", "of the folder", at), "sum": Quantity("1", "of all", members, together=True),
              "missing": Quantity("1", "is not there", missing, may_be_missing=True),
              "length": Quantity("m", "a | b", lambda run, window, height: 2 * height, place=("height",))}
"""
HELPER = """
def number_of(run):
    return run.number if hasattr(run, "number") else float(run.folder.name)
"""


class Answers(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="talus-measures-"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "study").mkdir()
        (self.folder / "study/measures.py").write_text(STUDY)
        (self.folder / "study/helper.py").write_text(HELPER)
        for number in range(1, 5):
            (self.folder / str(number)).mkdir()
            (self.folder / str(number) / "manifest.json").write_text("{}")
        self.addCleanup(sys.modules.pop, "helper", None)
        self.measures = Measures(self.folder / "study")

    def question(self, quantity, of="each", groups=((1, 2), (3,)), at=None, unit="1", place=None):
        return {"quantity": quantity, "of": of, "unit": unit, "place": place or {},
                "window": {"at": at, "from": 0.0, "to": math.inf},
                "groups": [[str(self.folder / str(run)) for run in group] for group in groups]}

    def ask(self, *questions, jobs=1):
        return measures.answers(self.measures, questions, jobs)

    def values(self, *arguments, **options):
        [answer] = self.ask(self.question(*arguments, **options))
        return answer["values"]

    def test_each_member_the_mean_and_all_together(self):
        self.assertEqual(self.values("number"), [[1, 2], [3]])
        self.assertEqual(self.values("number", at=0.5), [[1.5, 2.5], [3.5]])
        self.assertEqual(self.values("number", at=math.inf), [[math.inf] * 2, [math.inf]])
        self.assertEqual(self.values("number", "curves"), [[1.5], [3]])
        self.assertEqual(self.values("sum", "values"), [[3], [3]])
        self.assertEqual(self.values("sum", "curves"), [[3], [3]])
        self.assertEqual(self.values("sum", "together"), [[6]])
        self.assertEqual(self.values("sum", "together", groups=()), [[]], "the runs are not there")
        self.assertEqual(self.values("number", groups=((), (4,))), [[], [4]])
        self.assertEqual(self.values("length", unit="m", place={"height": 0.25}, groups=((1,),)), [[0.5]])

    def test_what_cannot_be_evaluated_has_a_reason(self):
        [answer] = self.ask(self.question("missing"))
        self.assertEqual([[value is None or math.isnan(value) for value in values] for values in answer["values"]],
                         [[True, True], [True]])
        self.assertEqual((answer["values"][0][1], answer["missing"]), (None, ["the second has none", ""]))
        [answer] = self.ask(self.question("number", "together"))
        self.assertEqual((answer["values"], answer["missing"]), ([[None]], ["number is of one run"]))

    def test_faults_of_questions(self):
        questions = [self.question("numbr"), self.question("number", unit="m"), self.question("length", unit="m"),
                     self.question("number", unit=None, place={"height": 1.0})]
        self.assertEqual([(fault["question"], fault["key"]) for fault in measures.faults(self.measures, questions)],
                         [(0, "quantity"), (1, "unit"), (2, "place"), (3, "place")])

    def test_several_processes_give_the_same(self):
        questions = [self.question("number", groups=((1, 2), (3, 4))), self.question("sum", "together"),
                     self.question("number", "curves", groups=((4, 3),))]
        self.assertEqual(self.ask(*questions, jobs=3), self.ask(*questions))

    def test_a_run_remembers_what_was_made_once(self):
        calls = []

        @measures.once
        def made(run, argument):
            calls.append(argument)
            return argument * 2

        first, second = (Run(self.folder / name) for name in "12")
        self.assertEqual([made(run, n) for run in (first, second) for n in (1, 1, 2)], [2, 2, 4] * 2)
        self.assertEqual(calls, [1, 2, 1, 2])

    def test_without_a_mean_of_its_own_a_study_has_that_of_one_run(self):
        del self.measures.module.mean
        self.assertEqual(self.measures.mean([1]), 1)
        with self.assertRaises(NotEvaluated):
            self.measures.mean([1, 2])

    def test_table_and_window(self):
        self.assertIn("| `length` | m | a \\| b | height |", measures.table(self.measures.quantities))
        self.assertEqual(Window(), (None, 0, math.inf))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
