# SPDX-License-Identifier: Apache-2.0
"""The grains that validation/niiya2020's figures mark, against the numbers that the program computes of the same runs.

Usage: test_niiya2020.py TALUS
"""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(sys.argv.pop()).resolve()
PROJECT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(PROJECT / "python"), str(PROJECT / "validation" / "niiya2020")]

import numpy as np  # noqa: E402
import talus  # noqa: E402
from curves import mean_and_deviation, nearest_gaussian, gaussian  # noqa: E402

from talus import grains  # noqa: E402


class Grains(unittest.TestCase):
    def run_of(self, case, size):
        folder = Path(tempfile.mkdtemp(prefix="talus-grains-"))
        self.addCleanup(shutil.rmtree, folder)
        settings = (f"particles.{size}", "particles.count=400", 'run.end="2 ms"', "output.pictures=false")
        options = [text for setting in settings for text in ("--set", setting)]
        subprocess.run([PROGRAM, "run", PROJECT / f"cases/niiya2020-{case}.toml", "--out", folder / "run", *options],
                       check=True, capture_output=True)
        return talus.Run(folder / "run")

    def test_heads_and_their_sizes_are_the_programs(self):
        for case, size in (("circle", 'size="0.15 m"'), ("rectangle", 'width="0.68 m"')):
            run = self.run_of(case, size)
            a, table = float(run.case["particles"]["radius"]), run.table("snapshots")
            self.assertGreater(table["head_particles"][-1], 10)
            for n, snapshot in enumerate(run.snapshots):
                heads = grains.find_heads(snapshot.positions, a)
                self.assertEqual(len(heads), table["head_count"][n])
                self.assertEqual(len(heads[0]), table["head_particles"][n])
                head = grains.head_size(snapshot.positions, snapshot["radius"], heads[0], a)
                self.assertAlmostEqual(head.width, table["head_width"][n], delta=1e-12)
                self.assertAlmostEqual(head.thickness, table["head_thickness"][n], delta=1e-12)
                self.assertTrue(set(head.grains) <= set(heads[0]))

    def test_the_front_is_the_programs(self):
        run = self.run_of("triangle", 'size="0.27 m"')
        a, angle = float(run.case["particles"]["radius"]), run.table("snapshots")["frontal_angle"]
        there = np.flatnonzero(np.isfinite(angle))
        self.assertGreater(len(there), 4)
        for n in there:
            positions = run.snapshots[int(n)].positions
            walk = grains.surface_walk(positions, a)
            self.assertTrue((np.diff(positions[walk, 2]) >= 0).all())
            self.assertAlmostEqual(np.degrees(grains.angle_of_line(positions, walk)), angle[n], delta=1e-9)


class Numbers(unittest.TestCase):
    def test_members_that_lack_a_number_are_left_out(self):
        mean, deviation = mean_and_deviation(np.array([[1, 2, np.nan], [3, np.nan, np.nan]]))
        np.testing.assert_array_equal(mean, [2, 2, np.nan])
        np.testing.assert_allclose(deviation, [np.sqrt(2), 0, 0])

    def test_the_nearest_gaussian(self):
        x = np.arange(1, 31, 2.0)
        np.testing.assert_allclose(nearest_gaussian(x, gaussian(x, 12.3, 2.7)), (12.3, 2.7), rtol=1e-8)
        self.assertIsNone(nearest_gaussian(x, np.where(x == 7, 0.5, 0)), "all in one bin")


if __name__ == "__main__":
    unittest.main()
