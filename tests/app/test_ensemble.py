# SPDX-License-Identifier: Apache-2.0
"""Ensembles: members do not depend on each other, nor on how many run at a time; killed ones go on; failures are told."""
import csv
import json
import signal
import unittest

from program import SLOW, ProgramTest, bits, rows, state, tree

VARIED = ("--members", 3, "--vary", "slope.angle=30 deg,50 deg")
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

    def test_more_members_leave_the_first_ones_alone(self):
        self.talus("ensemble", "case.toml", "--out", "e", "--members", 2)
        before = {path.name: (path / "log.txt").read_bytes() for path in self.members("e")}
        said = self.talus("ensemble", "case.toml", "--out", "e", "--members", 3, "--resume").stdout
        self.assertIn("3 of 3 runs done", said)
        for path in self.members("e")[:2]:
            self.assertEqual((path / "log.txt").read_bytes(), before[path.name])
        self.talus("ensemble", "case.toml", "--out", "at-once", "--members", 3)
        self.assert_same("e", "at-once")

    def stopped_amid(self, number):
        """An ensemble that gets a signal while a member runs; returns its exit status."""
        process = self.start("ensemble", "case.toml", "--out", "e", "--jobs", 2, "--members", 4, *SLOW)
        self.wait_until(lambda: len(self.members("e")) >= 3, process)
        process.send_signal(number)
        status = process.wait()
        done = [path for path in self.members("e") if (path / "summary.json").exists()
                and json.loads((path / "summary.json").read_text())["status"] == "done"]
        self.assertLess(len(done), 4)
        return status

    def test_killed_and_resumed(self):
        self.talus("ensemble", "case.toml", "--out", "whole", "--members", 4, *SLOW)
        self.assertEqual(self.stopped_amid(signal.SIGKILL), -signal.SIGKILL)
        self.talus("ensemble", "case.toml", "--out", "e", "--members", 4, "--resume", *SLOW)
        self.assert_same("e", "whole")

    def test_interrupted_and_resumed(self):
        self.talus("ensemble", "case.toml", "--out", "whole", "--members", 4, *SLOW)
        self.assertEqual(self.stopped_amid(signal.SIGTERM), 130)
        self.talus("ensemble", "case.toml", "--out", "e", "--members", 4, "--resume", *SLOW)
        self.assert_same("e", "whole")

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
