# SPDX-License-Identifier: Apache-2.0
"""Air alone by case file, and sections in air, from outside."""
import json
import unittest

from program import PROJECT, ProgramTest

BED = """
model = "continuum"
[box]
width = "20 mm"
depth = "20 mm"
height = "30 mm"
left = "symmetry"
right = "symmetry"
[grains]
density = "2500 kg/m3"
diameter = "0.5 mm"
[bed]
spacing = "2.5 mm"
height = "20 mm"
packing = 0.6
[air]
enabled = true
drag = "ergun-wen-yu"
left = "symmetry"
right = "symmetry"
floor = "inflow"
floor_velocity = ["0 m/s", "0 m/s", "0.1 m/s"]
[run]
end = "0.03 s"
[output]
series = "5 ms"
report = false
pictures = false
"""


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

    def test_the_air_bears_what_walls_do_not(self):
        """Air blown through a bed of 20 mm at 0.1 m/s: Ergun 6.54 kPa/m, 0.44 of the weight, less near its surface; in both models."""
        (self.folder / "case.toml").write_text(BED)
        for formulation in ("model-a", "model-b"):
            said = self.talus("run", "case.toml", "--out", formulation, "--set", f"air.formulation={formulation}").stdout
            found = self.quantities(formulation)
            self.assertAlmostEqual(found["air_lift"], 0.42, delta=0.03)
            self.assertAlmostEqual(found["air_pressure_difference"], 6538 * 0.02, delta=0.15 * 6538 * 0.02)
            self.assertAlmostEqual(found["weight_balance_error"] + found["air_lift"], 0, delta=0.05)
            self.assertRegex(said, r"Air bears at the end +4\d\.\d % of the weight")

    def test_what_the_cells_do_not_resolve_is_told(self):
        (self.folder / "case.toml").write_text(BED)
        said = self.talus("check", "case.toml", "--set", "air.cell=10 mm", "--set", "air.pressure=25 bar").stdout
        self.assertIn("! cells of the air over the bed's height = 2", said)
        self.assertIn("! density of the air over the grains' = 0.0119", said)
        self.assertIn("air.courant: 2 is out of range", self.talus("check", "case.toml", "--set", "air.courant=2", status=2).stderr)
        hopper = self.talus("check", PROJECT / "cases/yuu2011-section-air.toml", "--set", "air.cell=25 mm", "--set", "air.cell_depth=2.5 mm")
        self.assertRegex(hopper.stdout, r"! width of the slit for the air = \d+ mm")


if __name__ == "__main__":
    unittest.main()
