# SPDX-License-Identifier: Apache-2.0
"""What the program answers to the package python/talus."""
import json
import unittest

from program import CASE, ProgramTest, tree


class Answer(ProgramTest):
    def ask(self, question, status=0, **details):
        said = self.talus("answer", input=json.dumps({"question": question, **details}), status=status)
        return json.loads(said.stdout) if status == 0 else said.stderr

    def plan(self, *groups, resume=False):
        return self.ask("plan", case="case.toml", settings=["run.end=2 ms"], members=2, resume=resume, groups=[
            {"folder": f"e/{n}", "settings": list(settings)} for n, settings in enumerate(groups)])["answer"]

    def test_a_plan_has_the_fingerprints_of_the_runs(self):
        [members] = self.plan(["slope.angle=30 deg"])["groups"]
        self.assertEqual([(one["seed"], one["folder"], one["end"]) for one in members],
                         [(3, "e/0/seed_0003", 0.002), (4, "e/0/seed_0004", 0.002)])
        self.assertEqual(members[1]["settings"], ["run.end=2 ms", "slope.angle=30 deg", "seed=4"])
        self.talus("run", "case.toml", "--out", "r", "--set", "slope.angle=30 deg", "--set", "seed=4")
        fingerprint = json.loads((self.folder / "r/manifest.json").read_text())["fingerprint"]
        self.assertEqual(members[1]["fingerprint"], fingerprint)
        self.assertNotEqual(members[0]["fingerprint"], fingerprint)

    def test_a_plan_tells_each_problem_once(self):
        (self.folder / "case.toml").write_text(CASE.replace("count = 60", "count = -1"))
        problems = self.plan(["slope.angle=30 deg"], ["slope.angle=4 kg"])["problems"]
        self.assertEqual(len(problems), 2)
        self.assertIn("case.toml:6: particles.count", problems[0])
        self.assertIn("--vary slope.angle=4 kg: slope.angle", problems[1])

    def test_quantities_in_their_units(self):
        five, angle, none = self.ask("quantities", texts=["5 mm", "90 deg", "five"])["answer"]
        self.assertEqual(five, {"value": 0.005, "unit": "m", "si": 0.005})
        self.assertEqual((angle["value"], angle["unit"]), (90, "deg"))
        self.assertAlmostEqual(angle["si"], 1.5707963267948966)
        self.assertEqual(list(none), ["why"])

    def test_numbers_of_a_run_over_a_window(self):
        self.talus("run", "case.toml", "--out", "r")
        asked = [{"quantity": name, "at": None, "from": begin, "to": end}
                 for name, begin, end in (("front_speed_max", 0, "inf"), (None, 0, 1e9), ("discharge_rate_max", 0, "inf"))]
        [[speed, late, fault]] = self.ask("numbers", runs=[{"folder": "r", "questions": asked}])["answer"]
        summary = json.loads((self.folder / "r/summary.json").read_text())["quantities"]
        self.assertEqual(speed, {"reaches": True, "value": summary["front_speed_max"]["value"]})
        self.assertEqual(late, {"reaches": False})
        self.assertIn("no measure of such a run", fault["fault"])

    def test_folders_and_files_of_the_user_are_left_alone(self):
        (self.folder / "mine").mkdir()
        (self.folder / "mine/notes.txt").write_text("mine")
        before = tree(self.folder)
        [problem] = self.ask("begin", folder="mine", resume=True, known=False)["problems"]
        self.assertIn("mine: is not empty", problem)
        self.assertEqual(tree(self.folder), before)
        self.assertEqual(self.ask("begin", folder="new", resume=False, known=False), {"answer": None})
        (self.folder / "new/members.csv").write_text("mine")
        self.assertIn("new/members.csv", self.ask("claim", folders=[], files=["new/members.csv"], status=4))

    def test_what_is_no_question(self):
        self.assertIn("no such question", self.ask("weather", status=4))
        self.assertIn("talus answer", self.talus("answer", input="{", status=4).stderr)
        self.assertNotIn("answer ", self.talus("--help").stdout, "for the package alone")


if __name__ == "__main__":
    unittest.main()
