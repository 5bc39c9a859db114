# SPDX-License-Identifier: Apache-2.0
"""References of studies, and the runs that are sorted to their cases: talus.lab.reference."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(PROJECT / "python")]
os.environ["TALUS"] = os.path.abspath(sys.argv.pop())

from talus.ask import find_program  # noqa: E402
from talus.lab.reference import Case, Criterion, Reference, Variant, find_runs, read_reference, toml_text  # noqa: E402
from talus.trouble import InputError, RunError  # noqa: E402

HEAD = """study = "s"
title = "t"
source = "u"
members = 2
quick = { variants = ["fine"], settings = { "run.end" = "1 s" } }
[case.hopper]
file = "hopper.toml"
where = { "model" = "continuum" }
told_by = ["a"]
[case.hopper.variant]
coarse = {}
fine = { "a" = 2, "b" = "3 mm" }
[[row]]
"""
ROW = """id = "one"
number = 1
quantity = "packing_max"
case = "hopper"
variant = ["coarse", "fine"]
estimator = "e"
from = "each"
window = { from = 0.1, to = "end" }
printed = "about 1"
unit = "1"
criterion = { value = 1, within = 0.1 }
source = "p"
"""


class InFolder(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="talus-reference-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def read(self, text):
        (self.folder / "reference.toml").write_text(text)
        return read_reference(self.folder / "reference.toml")

    def faults(self, text):
        with self.assertRaises(InputError) as raised:
            self.read(text)
        return raised.exception.problems


class OfTheStudies(unittest.TestCase):
    STUDIES = ("niiya2020", "yuu2011", "yuu2011/laws", "dem-hopper")

    def test_can_be_read(self):
        for study in self.STUDIES:
            reference = read_reference(PROJECT / "validation" / study / "reference.toml")
            labels = {variant.label for case in reference.cases for variant in case.variants}
            self.assertLessEqual(set(reference.quick.get("variants", [])), labels)
            self.assertGreater(len(reference.rows), 50 if "/" not in study and study != "dem-hopper" else 5)

    def test_every_run_is_a_valid_case(self):
        for study in self.STUDIES:
            for case in read_reference(PROJECT / "validation" / study / "reference.toml", with_rows=False).cases:
                groups = [{"folder": "none", "settings": [f"{key}={toml_text(value)}" for key, value in v.settings.items()]}
                          for v in case.variants]
                question = {"question": "plan", "case": str(PROJECT / "cases" / case.file), "settings": [], "members": 1,
                            "resume": False, "groups": groups}
                said = subprocess.run([find_program(), "answer"], input=json.dumps(question), capture_output=True, text=True,
                                      check=True).stdout
                self.assertEqual(json.loads(said)["answer"]["problems"], [], f"{study} {case.name}")


class Reading(InFolder):
    def test_variants_are_told_by_their_own_keys(self):
        reference = self.read(HEAD + ROW)
        self.assertEqual((reference.study, reference.members), ("s", 2))
        self.assertEqual(reference.quick["settings"], {"run.end": "1 s"})
        [case] = reference.cases
        self.assertEqual(case.where, {"model": "continuum"})
        self.assertEqual(case.variants[1], Variant("fine", {"a": 2, "b": "3 mm"}, {"a": 2}))
        [row] = reference.rows
        self.assertEqual((row.variants, row.window), (("coarse", "fine"), (None, 0.1, float("inf"))))
        self.assertEqual(str(row.criterion), "1 ± 0.1")

    def test_every_fault_is_told_at_once_with_its_line(self):
        text = HEAD + ROW
        for old, new in (("packing_max", "packing_mix"), ('["coarse", "fine"]', '["course"]'),
                         ("value = 1, within = 0.1", "about = 1"), ('source = "p"', 'sorce = "p"')):
            text = text.replace(old, new)
        faults = "\n".join(self.faults(text))
        line = {key: text[:text.index(key)].count("\n") + 1 for key in ("quantity =", "criterion =", "sorce =", "[[row]]")}
        self.assertIn(f"reference.toml:{line['quantity =']}: quantity: there is no quantity \"packing_mix\"", faults)
        self.assertIn("did you mean 'packing_max'?", faults)
        self.assertIn('has no variant "course"', faults)
        self.assertIn(f":{line['criterion =']}: criterion: is none that can be evaluated", faults)
        self.assertIn(f":{line['sorce =']}: sorce: unknown key; did you mean 'source'?", faults)
        self.assertIn(f":{line['[[row]]']}: source: missing", faults)

    def test_what_is_no_toml_has_its_line(self):
        self.assertRegex(self.faults(HEAD + "id = = 2\n")[0], r"reference\.toml:14: Invalid value")

    def test_a_place_is_of_the_measures_of_a_study(self):
        def with_place(quantity, place):
            return HEAD + ROW.replace("packing_max", quantity) + f"place = {{ {place} }}\n"

        (self.folder / "measures.py").write_text("")
        [row] = self.read(with_place("packing_at_a_height", 'height = "20 mm"')).rows
        self.assertTrue(row.of_study)
        self.assertEqual(row.place, {"height": 0.02})
        (self.folder / "measures.py").unlink()
        for quantity, place, told in (("packing_max", "distance = 20", "is not a length (unit missing?)"),
                                      ("packing_max", 'distance = "20 mm"', "takes no distance"),
                                      ("fed_mass", 'distance = "20 mm"', "kg")):
            self.assertIn(told, "\n".join(self.faults(with_place(quantity, place))))


class Criteria(unittest.TestCase):
    def test_ends_belong_to_ranges_and_not_to_bounds(self):
        nan = float("nan")
        for criterion, met, not_met, text in (
                (Criterion("between", 30, 70), (30, 50, 70), (29.999, 70.001, nan), "30 to 70"),
                (Criterion("between", 1, 1), (1,), (0, 1.05, 2), "1"),
                (Criterion("within", 17.25, 2), (15.25, 17, 19.25), (15.2, 19.3, nan), "17.25 ± 2"),
                (Criterion("above", 0.9), (0.91, float("inf")), (0.9, -1, nan), "> 0.9"),
                (Criterion("below", 8), (7.9, -3), (8, 9, nan), "< 8"),
                (Criterion("positive"), (1e-9,), (0, -1, nan), "positive"),
                (Criterion("negative"), (-1e-9,), (0, 1, nan), "negative")):
            self.assertEqual({criterion.verdict(value) for value in met}, {"met"}, text)
            self.assertEqual({criterion.verdict(value) for value in not_met}, {"not met"}, text)
            self.assertEqual(criterion.verdict(None), "not evaluated")
            self.assertEqual(str(criterion), text)
        self.assertEqual((Criterion().verdict(3), Criterion().verdict(None)), ("reported", "reported"))

    def test_has_to_hold_at_each_variant_that_is_there(self):
        for values, verdict in (((2, 3, 4), "met"), ((2, 1, 4), "not met"), ((2, None, 4), "met"),
                                ((None, float("nan")), "not met"), ((None, None), "not evaluated"), ((), "not evaluated")):
            self.assertEqual(Criterion("above", 1).verdict_of_all(values), verdict, values)


HOPPER = 'model = "continuum"\nbox.depth = "0.005 m"\n'


class FoundRuns(InFolder):
    REFERENCE = Reference(Path("reference.toml"), cases=[
        Case("hopper", "", {"model": "continuum", "box.depth": "5 mm"}, [
            Variant("coarse", {}, {}), Variant("fine", {}, {"bed.spacing": "1.25 mm"}),
            Variant("fine-stiff", {}, {"bed.spacing": "1.25 mm", "law.yuu-umekage.scale": 39.2}),
            Variant("air", {}, {"air.enabled": True})]),
        Case("hopper-without-walls", "", {"model": "continuum", "box.depth": "5 mm", "walls": "none"},
             [Variant("coarse", {}, {})])])

    def put(self, name, case, seed=0, status="done"):
        folder = self.folder / name
        folder.mkdir(parents=True)
        (folder / "manifest.json").write_text(json.dumps({"case": case, "seed": seed}))
        (folder / "summary.json").write_text(json.dumps({"status": status}))

    def found(self):
        return sorted(f"{one.case} {one.variant}: {' '.join(path.name for path in one.folders)}"
                      for one in find_runs(self.folder, self.REFERENCE))

    def test_are_sorted_to_the_variant_with_most_of_their_settings(self):
        self.put("a", HOPPER + 'bed.spacing = "0.0016666667 m"\nlaw.yuu-umekage.scale = 9.8')
        self.put("b", HOPPER + 'bed.spacing = "0.00125 m"\nlaw.yuu-umekage.scale = 9.8')
        self.put("c", HOPPER + 'bed.spacing = "0.00125 m"\nlaw.yuu-umekage.scale = 39.2')
        self.put("d", HOPPER + "air.enabled = true")
        self.put("e", HOPPER + "air.enabled = false")
        self.put("f", HOPPER + 'walls = "none"')
        self.assertEqual(self.found(), ["hopper air: d", "hopper coarse: a e", "hopper fine-stiff: c", "hopper fine: b",
                                        "hopper-without-walls coarse: f"])

    def test_stand_in_the_order_of_their_seeds_however_deep_they_lie(self):
        self.put("deep/er/x", HOPPER, 1)
        self.put("a", HOPPER, 3)
        self.put("b", HOPPER, 2)
        self.assertEqual(self.found(), ["hopper coarse: x b a"])

    def test_of_no_case_or_not_done_are_passed_over(self):
        self.put("a", HOPPER)
        self.put("unfinished", HOPPER, 1, "interrupted")
        self.put("deeper-box", 'model = "continuum"\nbox.depth = "6 mm"')
        self.put("cloud", 'model = "cloud"')
        self.assertEqual(self.found(), ["hopper coarse: a"])
        with self.assertRaisesRegex(RunError, "no such folder"):
            find_runs(self.folder / "nowhere", self.REFERENCE)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
