# SPDX-License-Identifier: Apache-2.0
"""The cases of vessels, coarse and short: every particle is there, has come in or has been taken away, and stays within its
walls."""
import json
import math
import unittest

import h5py

from program import PROJECT, ProgramTest, rows

COARSE = ("output.pictures=false", "output.report=false", "bed.spacing=5 mm", "output.series=2 ms")


class VesselCases(ProgramTest):
    def run_case(self, name, *settings):
        """Summary, rows of the series, and positions and numbers of the last snapshot."""
        options = [word for setting in (*COARSE, *settings) for word in ("--set", setting)]
        self.run_of_case = self.talus("run", PROJECT / "cases" / f"{name}.toml", "--out", name, "--threads", 1, *options)
        quantities = json.loads((self.folder / name / "summary.json").read_text())["quantities"]
        summary = {key: entry["value"] for key, entry in quantities.items()}
        last = sorted((self.folder / name / "snapshots").glob("particles_*.vtkhdf"))[-1]
        with h5py.File(last, "r") as file:
            places = file["VTKHDF/Points"][()]
            numbers = file["VTKHDF/PointData/identity"][()]
        self.assertEqual(len(set(numbers)), len(places), "each is itself")
        self.assertLess(summary["mass_error"], 1e-12, "none is lost")
        return summary, rows(self.folder / name / "series.csv"), places, numbers

    def test_square_silo(self):
        summary, series, places, _ = self.run_case("silo-square", "gate.opens=at-time", "gate.time=10 ms", "run.end=0.2 s",
                                                   "removal.below=40 mm")
        self.assertIn("estimate: 0.508 kg/s", self.run_of_case.stdout.split("Key results:")[1])
        self.assertGreater(summary["removed_mass"], 0)
        self.assertGreater(float(series[-1]["removed_mass [kg]"]), 0)
        self.assertGreater(min(p[2] for p in places), 0.03)
        for x, y, z in places:
            side = 15 if z < 0.05 else min(30, 15 + (z * 1e3 - 50) * 15 / 40)
            if z > 0.05:
                self.assertLessEqual(max(abs(x - 0.045), abs(y - 0.045)) * 1e3, side + 0.1)

    def test_hourglass(self):
        _, _, places, numbers = self.run_case("hourglass", "gate.opens=at-time", "gate.time=10 ms", "run.end=0.15 s")
        self.assertEqual(sorted(numbers), list(range(len(places))), "all of them")
        for x, y, z in places:
            self.assertTrue(0.01 <= z <= 0.12)
            self.assertLessEqual(math.hypot(x - 0.05, y - 0.05), 0.015 + 0.03 * abs(z - 0.065) / 0.055 + 2e-4)
        self.assertTrue(any(p[2] < 0.06 for p in places))

    def test_drum(self):
        _, _, places, numbers = self.run_case("drum", "gate.opens=at-time", "gate.time=10 ms", "run.end=0.15 s")
        self.assertEqual(sorted(numbers), list(range(len(places))))
        for x, y, z in places:
            self.assertLessEqual(math.hypot(x - 0.055, z - 0.055), 0.0502)
            self.assertTrue(0.005 <= y <= 0.029)
        self.assertLess(sum(p[0] for p in places) / len(places), 0.0545, "carried towards the side that rises")

    def test_chute(self):
        summary, series, places, numbers = self.run_case("chute-bend", "run.end=0.45 s")
        self.assertGreater(summary["fed_mass"], 0.06)
        self.assertAlmostEqual(float(series[-1]["fed_mass [kg]"]), summary["fed_mass"], 12)
        self.assertGreater(max(p[0] for p in places), 0.2, "around the bend")
        for x, _, z in places:
            self.assertTrue(x > 0.28 or z > (0.26 - x if x < 0.14 else 0.12 - (x - 0.14) * 65 / 140) - 1e-4, (x, z))


if __name__ == "__main__":
    unittest.main()
