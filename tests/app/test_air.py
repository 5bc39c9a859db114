# SPDX-License-Identifier: Apache-2.0
"""Air alone by case file, and sections in air, from outside."""
import json
import unittest

from program import PROJECT, ProgramTest


class Air(ProgramTest):
    def quantities(self, folder):
        summary = json.loads((self.folder / folder / "summary.json").read_text())
        return {name: entry["value"] for name, entry in summary["quantities"].items()}

    def test_vortices_decay_as_the_exact_ones(self):
        self.talus("run", PROJECT / "cases/taylor-green.toml", "--out", "r", "--set", "run.end=0.1 s",
                   "--set", "output.snapshots=50 ms")
        found = self.quantities("r")
        self.assertAlmostEqual(found["taylor_green_energy"], 1, delta=2e-3)
        self.assertLess(found["taylor_green_error"], 5e-3)
        snapshots = sorted(path.name for path in (self.folder / "r/snapshots").iterdir())
        self.assertEqual(snapshots, ["air.hdf.series", "air_0000.vtkhdf", "air_0001.vtkhdf", "air_0002.vtkhdf"])
        again = self.talus("analyze", "r")
        self.assertEqual(again.returncode, 0, again.stderr)

    def test_a_run_goes_on_to_the_same_rows(self):
        case = [PROJECT / "cases/cavity.toml", "--set", "air.cell=100 mm", "--set", "box.depth=100 mm",
                "--set", "output.snapshots=0.5 s"]
        self.talus("run", *case, "--out", "whole", "--set", "run.end=1 s")
        self.talus("run", *case, "--out", "parts", "--set", "run.end=0.5 s")
        self.talus("run", *case, "--out", "parts", "--set", "run.end=1 s", "--resume")
        self.assertEqual((self.folder / "whole/series.csv").read_text(), (self.folder / "parts/series.csv").read_text())


if __name__ == "__main__":
    unittest.main()
