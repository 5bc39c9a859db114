# SPDX-License-Identifier: Apache-2.0
"""Ensembles: members do not depend on each other, nor on how many run at a time; killed ones go on; failures are told."""
import csv
import json
import shutil
import signal
import unittest

from program import PROJECT, ProgramTest, bits, rows, state, tree

VARIED = ("--members", 3, "--vary", "slope.angle=30 deg,50 deg")
# A member takes a few tenths of a second.
UNHURRIED = ("--members", 3, "--set", "integration.max_step=0.001", "--set", "output.checkpoint_interval=20 ms")
GROUPS = ("angle=30deg", "angle=50deg")


class Ensemble(ProgramTest):
    def members(self, out):
        return sorted((self.folder / out).glob("*/seed_????"))

    def bits_of_members(self, out):
        return {f"{path.parent.name}/{path.name}": (bits(path), state(path)) for path in self.members(out)}

    def tables(self, out):
        """The statistics, byte by byte."""
        return {str(path.relative_to(self.folder / out)): path.read_bytes()
                for path in sorted((self.folder / out).glob("*/*.csv"))}

    def assert_same(self, out, other):
        self.assertEqual(self.bits_of_members(out), self.bits_of_members(other))
        self.assertEqual(self.tables(out), self.tables(other))

    def test_members_depend_on_neither_jobs_nor_company(self):
        self.talus("ensemble", "case.toml", "--out", "e1", "--jobs", 1, *VARIED)
        self.talus("ensemble", "case.toml", "--out", "e2", "--jobs", 3, *VARIED)
        self.assertEqual([f"{p.parent.name}/{p.name}" for p in self.members("e1")],
                         [f"{group}/seed_{seed:04}" for group in GROUPS for seed in (3, 4, 5)])
        self.assert_same("e1", "e2")
        self.talus("run", "case.toml", "--out", "alone", "--set", "slope.angle=50 deg", "--set", "seed=5")
        self.assertEqual(bits(self.folder / "alone"), bits(self.folder / "e1/angle=50deg/seed_0005"))
        self.assertNotEqual(bits(self.folder / "alone"), bits(self.folder / "e1/angle=50deg/seed_0004"))
        # The statistics are those of the members' own summaries.
        values = [json.loads((path / "summary.json").read_text())["quantities"]["front_speed_max"]["value"]
                  for path in self.members("e1") if path.parent.name == GROUPS[0]]
        [row] = [row for row in rows(self.folder / "e1" / GROUPS[0] / "quantities.csv")
                 if row["quantity"] == "front_speed_max"]
        mean = sum(values) / 3
        self.assertAlmostEqual(float(row["mean"]), mean, delta=1e-12 * mean)
        self.assertAlmostEqual(float(row["standard_deviation"]),
                               (sum((value - mean) ** 2 for value in values) / 2) ** 0.5, delta=1e-9 * mean)
        self.assertEqual((float(row["least"]), float(row["largest"])), (min(values), max(values)))

    def test_members_need_not_have_the_same_tables(self):
        """One member has a table that the other lacks."""
        case = ("ensemble", "case.toml", "--members", 2, "--out", "e", "--set", "run.end=2 ms")
        self.talus(*case)
        [both, *_] = rows(self.folder / "e/all/bands_front_speed.csv")
        shutil.rmtree(self.members("e")[0] / "analysis")
        self.talus(*case, "--gather")
        [band, *_] = rows(self.folder / "e/all/bands_front_speed.csv")
        [own, *_] = rows(self.members("e")[1] / "analysis/front_speed.csv")
        self.assertEqual(band["front_speed_mean [v_s]"], own["front_speed [v_s]"])
        self.assertNotEqual(band["front_speed_mean [v_s]"], both["front_speed_mean [v_s]"])

    def test_a_mean_says_of_how_many_members_where_some_lack_the_quantity(self):
        case = ("ensemble", "case.toml", "--members", 2, "--out", "e", "--set", "run.end=2 ms")
        self.assertNotIn(" of 2)", self.talus(*case).stdout)
        summary = self.members("e")[0] / "summary.json"
        said = json.loads(summary.read_text())
        del said["quantities"]["front_speed_max"]
        summary.write_text(json.dumps(said))
        lines = self.talus(*case, "--gather").stdout.splitlines()
        [line] = [line for line in lines if line.startswith("front_speed_max ")]
        [other] = [line for line in lines if line.startswith("front_speed_min ")]
        self.assertTrue(line.endswith(" (1 of 2)"), line)
        self.assertNotIn("of 2", other)

    def test_members_of_a_bed_differ_by_its_disorder(self):
        few = ("--set", "gate.opens=from-the-start", "--set", "run.end=1 ms")
        case = PROJECT / "cases/yuu2011-section-vacuum.toml"
        self.talus("ensemble", case, "--out", "e", "--members", 3, *few, "--set", "bed.disorder=1e-6")
        members = self.members("e")
        self.assertEqual(len({bits(path)["series.csv"] for path in members}), 3)
        self.talus("run", case, "--out", "alone", *few, "--set", "bed.disorder=1e-6", "--set", "seed=2")
        self.assertEqual(bits(self.folder / "alone"), bits(members[1]))
        self.talus("ensemble", case, "--out", "lattice", "--members", 3, *few)
        self.assertEqual(self.members("lattice"), [], "nothing is random: one run, in the folder itself")

    def test_a_sweep_is_a_table_of_values_against_quantities(self):
        said = self.talus("ensemble", "case.toml", "--out", "e", "--members", 1, "--vary",
                          "slope.angle=30 deg,50 deg", "--vary", "motion=xy").stdout
        self.assertNotIn("nan", said, "one member has no deviation")
        self.assertNotIn("±", said)
        names = ["angle=30deg_motion=xy", "angle=50deg_motion=xy"]
        values = [json.loads((path / "summary.json").read_text())["quantities"]["front_speed_max"]["value"]
                  for path in self.members("e")]
        [head] = [line.split() for line in said.splitlines() if line.startswith(" ") and "angle=30deg" in line]
        [line] = [line.split() for line in said.splitlines() if line.startswith("front_speed_max")]
        self.assertEqual(head, names)
        self.assertEqual(line[-2:], [f"{value:.6g}" for value in values])
        with open(self.folder / "e/sweep.csv", encoding="utf-8") as file:
            table = list(csv.DictReader(file))
        for row, angle, value in zip(table, (30, 50), values, strict=True):
            self.assertAlmostEqual(float(row["slope.angle [deg]"]), angle, delta=1e-13)
            self.assertEqual((row["motion"], row["members"]), ("xy", "1"))
            self.assertEqual(float(row["front_speed_max [1]"]), value)
            self.assertNotIn("front_speed_max_deviation [1]", row)
        groups = json.loads((self.folder / "e/sweep.json").read_text())
        self.assertEqual([group["group"] for group in groups], names)
        self.assertEqual(groups[1]["settings"]["slope.angle"]["text"], "50 deg")
        self.assertEqual(groups[1]["quantities"]["front_speed_max"],
                         {"mean": values[1], "members": 1, "unit": "1"})
        for text in said.splitlines():
            self.assertLessEqual(len(text), 100)

    def test_more_members_leave_the_first_ones_alone(self):
        self.talus("ensemble", "case.toml", "--out", "e", "--members", 2)
        before = {path.name: (path / "log.txt").read_bytes() for path in self.members("e")}
        said = self.talus("ensemble", "case.toml", "--out", "e", "--members", 3, "--resume").stdout
        self.assertIn("3 of 3 runs done", said)
        for path in self.members("e")[:2]:
            self.assertEqual((path / "log.txt").read_bytes(), before[path.name])
        self.talus("ensemble", "case.toml", "--out", "at-once", "--members", 3)
        self.assert_same("e", "at-once")

    def test_stopped_and_resumed(self):
        self.talus("ensemble", "case.toml", "--out", "whole", "--jobs", 2, *UNHURRIED)
        for number, status in ((signal.SIGKILL, -signal.SIGKILL), (signal.SIGTERM, 130)):
            with self.subTest(number.name):
                process = self.start("ensemble", "case.toml", "--out", "e", "--jobs", 1, *UNHURRIED)
                # The first member is done, the second has begun.
                self.wait_until((self.folder / "e/all/seed_0004/series.csv").exists, process)
                process.send_signal(number)
                self.assertEqual(process.wait(), status)
                self.assertFalse((self.folder / "e/all/seed_0005").exists())
                self.talus("ensemble", "case.toml", "--out", "e", "--jobs", 2, "--resume", *UNHURRIED)
                self.assert_same("e", "whole")
            shutil.rmtree(self.folder / "e")

    def test_failed_members_are_listed_and_the_others_counted(self):
        said = self.talus("ensemble", "case.toml", "--out", "e", "--members", 2, "--vary",
                          "contact.stiffness=10 N/m,1 mN/m", status=3).stdout
        failed = [line for line in said.splitlines() if line.startswith("Failed")]
        self.assertEqual(len(failed), 2)
        for line, seed in zip(sorted(failed), (3, 4)):
            self.assertTrue(line.startswith(f"Failed (exit status 3): e/stiffness=1mNm/seed_{seed:04}: talus: the largest "
                                            "overlap is 0.5"), line)
        self.assertIn("2 of 4 runs done", said)
        with open(self.folder / "e/stiffness=1mNm/members.csv", encoding="utf-8") as file:
            self.assertEqual([row[:2] for row in csv.reader(file)],
                             [["seed", "status"], ["3", "not done"], ["4", "not done"]])
        with open(self.folder / "e/stiffness=10Nm/members.csv", encoding="utf-8") as file:
            self.assertEqual([row[1] for row in csv.reader(file)], ["status", "done", "done"])

    def test_what_a_kill_left_of_a_member_that_had_ended_goes(self):
        arguments = ("ensemble", "case.toml", "--out", "e", "--members", 1)
        self.talus(*arguments)
        (self.folder / "e/all/seed_0003.out").write_text("said before the kill")
        self.talus(*arguments, "--resume")
        self.assertFalse((self.folder / "e/all/seed_0003.out").exists())

    def test_where_there_is_nothing_to_gather(self):
        (self.folder / "empty").mkdir()
        for folder in ("none", "empty"):
            said = self.talus("ensemble", "case.toml", "--out", folder, "--gather", status=2).stderr
            self.assertIn(f"{folder}: holds no ensemble", said)
            self.assertIn("--out", said)
        self.assertFalse((self.folder / "none").exists())
        self.assertEqual(list((self.folder / "empty").iterdir()), [])

    def test_existing_folder_and_changed_case(self):
        self.talus("ensemble", "case.toml", "--out", "e", "--members", 1)
        before = tree(self.folder)
        self.talus("ensemble", "case.toml", "--out", "e", "--members", 1, status=2)
        said = self.talus("ensemble", "case.toml", "--out", "e", "--members", 1, "--resume", "--set",
                          "slope.angle=40 deg", status=2).stderr
        self.assertIn("e/all/seed_0003: holds a run of another case", said)
        self.assertEqual(tree(self.folder), before)


if __name__ == "__main__":
    unittest.main()
