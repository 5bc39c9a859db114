# SPDX-License-Identifier: Apache-2.0
"""Inputs as users bring them (docs/field-trials.md), each with its right value."""
import json
import math
import shutil
import unittest
from pathlib import Path

import h5py
import numpy as np

from program import InputTest

FIELD = Path(__file__).parent / "field"
G = 9.81


def settings(*texts):
    return [word for text in texts for word in ("--set", text)]


class FieldTest(InputTest):
    def setUp(self):
        super().setUp()
        shutil.copytree(FIELD, self.folder, dirs_exist_ok=True)

    def check(self, case, *changes):
        return " ".join(self.talus("check", case, *settings(*changes)).stdout.split())

    def run_case(self, case, *changes, out="r"):
        options = settings(*changes, "output.pictures=false", "output.report=false")
        self.talus("run", case, *options, "--out", out)
        return [Frame(path) for path in sorted((self.folder / out).glob("snapshots/particles_*.vtkhdf"))]


class Frame:
    """Positions, m, velocities, m/s, and the pressure, Pa, of a snapshot."""

    def __init__(self, path):
        with h5py.File(path) as file:
            self.position = file["VTKHDF/Points"][()]
            data = file["VTKHDF/PointData"]
            self.velocity = data["velocity"][()]
            self.vertical_stress = data["stress_zz"][()]

    def speed(self):
        return np.linalg.norm(self.velocity, axis=1)


class Walls(FieldTest):
    def test_what_lies_behind_a_sheet_does_not_act_through_it(self):
        """A tray of 5 mm sheet, closed, at a spacing of 50 mm, and its inner face alone; two shells, and one."""
        shells = (self.folder / "shells.toml").read_text()
        start, end = shells.index('[[vessel]]\nname = "outer"'), shells.index("[gate]")
        (self.folder / "shell.toml").write_text(shells[:start] + shells[end:])
        bearing = {}
        within = ["bed.left=0.3 m", "bed.right=1.3 m", "bed.front=0.3 m", "bed.rear=0.9 m", "run.end=0.25 s"]
        for name, case, *changes in (("closed sheet", "sheet.toml"),
                                     ("inner face", "sheet.toml", "vessel.1.file=tray_inner.stl"),
                                     ("two shells", "shells.toml"), ("one shell", "shell.toml")):
            last = self.run_case(case, *changes, *within, out=name)[-1]
            self.assertLess(last.speed().max(), 2e-3, name)
            # Two spacings from where walls meet: the layer on the floor, under 0.4 m of grains.
            x, y, z = last.position.T
            floor = z < z.min() + 0.025
            inner = floor & (x > 0.4) & (x < 1.2) & (y > 0.4) & (y < 0.8)
            bearing[name] = last.vertical_stress[inner].mean()
            self.assertLess(last.vertical_stress.max(), 1.05 * 0.55 * 2650 * G * 0.4, name)
        self.assertAlmostEqual(bearing["closed sheet"] / bearing["inner face"], 1, delta=0.02)
        self.assertAlmostEqual(bearing["two shells"] / bearing["one shell"], 1, delta=0.02)

    def test_four_particles_stop_on_a_floor(self):
        first, *_, last = self.run_case("row-on-floor.toml", "run.end=0.25 s")
        way = last.position[:, 0].mean() - first.position[:, 0].mean()
        self.assertAlmostEqual(way / (1 / (2 * 0.5 * G)), 1, delta=0.02)
        self.assertLess(last.speed().max(), 1e-6)
        self.assertGreater(last.position[:, 2].min(), 0.45 * 2.5e-3)

    def test_a_bend_gives_no_particle_more_head_than_any_had(self):
        heads = [(frame.position[:, 2] + frame.speed() ** 2 / (2 * G)).max()
                 for frame in self.run_case("bend.toml", "bed.spacing=5 mm")]
        self.assertGreater(len(heads), 20)
        self.assertLess(max(heads), heads[0] + 0.5 * 5e-3)

    def test_an_empty_bin_is_filled_from_its_top(self):
        last = self.run_case("filled-bin.toml", "bed.spacing=5 mm", "bed.height=5 mm", "run.end=0.65 s")[-1]
        summary = json.loads((self.folder / "r/summary.json").read_text())["quantities"]
        self.assertAlmostEqual(summary["fed_mass"]["value"], 0.05 * 0.65, delta=0.003)
        fall = math.sqrt(0.5 ** 2 + 2 * G * 1.45)
        self.assertLess(last.speed().max(), 1.02 * fall)
        self.assertGreater(last.position[:, 2].min(), 0.4 * 5e-3)


class Beds(FieldTest):
    def test_the_bed_is_in_the_silo_and_not_beside_it(self):
        said = self.check("silo-over-conveyor.toml")
        self.assertIn("lies against silo, gate", said)
        start = self.run_case("silo-over-conveyor.toml", "gate.opens=from-the-start")[0]
        x, y, z = start.position.T
        self.assertLess(np.hypot(x - 0.04, y - 0.04).max(), 0.025)
        self.assertGreater(z.min(), 0.08)
        self.assertAlmostEqual(len(x) / 1739, 1, delta=0.001)

    def test_a_bed_left_of_a_sluice_is_told_what_its_left_is(self):
        problem, = self.problems("check", "sluice.toml")
        self.assertRegex(problem, r"^sluice\.toml:23: bed\.right: .* 120 mm \(bed\.left by default, the least x of the vessel\)")
        self.assertIn("particles 5760", self.check("sluice.toml", "bed.left=0 mm"))

    def test_radii_of_a_table_are_read(self):
        said = self.check("two-spheres.toml")
        self.assertIn("2 grains; radii from 2 to 3 mm", said)
        self.assertIn("the column id is not used", said)


class Slopes(FieldTest):
    def values(self, out="r"):
        return {name: q["value"] for name, q in json.loads((self.folder / out / "summary.json").read_text())["quantities"].items()}

    def test_a_layer_that_passes_periodic_faces_has_its_own_speed(self):
        """Without friction on a level floor it goes on at what it began with."""
        self.run_case("slide.toml", "gravity.tilt=0 deg", "walls.coefficient=0", "box.left=periodic", "box.right=periodic",
                      "bed.height=20 mm", 'bed.velocity=["0.5 m/s", "0 m/s", "0 m/s"]')
        self.assertAlmostEqual(self.values()["quiescent_speed"], 0.5, delta=0.005)

    def test_what_rises_beyond_an_open_top_is_told(self):
        """Onto the lower wall of a box as high as the bed: no pressure by the area that it covered at the start."""
        said = self.talus("run", "slide.toml", "--out", "r").stdout
        self.assertRegex(said, r"Beyond the box +\d+ % of the bed; its walls and floor have no end there")
        self.assertGreater(self.values()["outside_fraction"], 0.2)
        self.assertNotIn("Peak pressure", said)
        self.assertFalse((self.folder / "r/analysis/box_walls.csv").exists())


class Surfaces(FieldTest):
    def test_one_outside_the_box_is_told_with_the_move_that_cures_it(self):
        problem, = self.problems("check", "centred.toml")
        self.assertIn("tray spans -30..30 x -30..30 x -10..-10 mm, the box 0..80 x 0..80 x 0..80 mm", problem)
        move = problem[problem.index("move = ") + 7:problem.index("]") + 1]
        self.assertIn("lies at", self.check("centred.toml", f"vessel.1.move={move}"))

    def test_a_body_half_outside_the_box_is_filled_within_it(self):
        """A closed cube of 40 mm about a place on the left face: no particle where there is no box."""
        corners = [(x, y, z) for z in (20, 60) for y in (20, 60) for x in (-20, 20)]
        sides = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
        facets = [[corners[n] for n in three] for a, b, c, d in sides for three in ((a, b, c), (a, c, d))]
        lines = ["solid cube"]
        for facet in facets:
            lines += ["facet normal 0 0 0", "outer loop", *("vertex %g %g %g" % corner for corner in facet), "endloop", "endfacet"]
        (self.folder / "cube.stl").write_text("\n".join([*lines, "endsolid cube", ""]))
        bed = ("vessel.1.file=cube.stl", "bed.bottom=20 mm", "bed.height=20 mm")
        start = self.run_case("centred.toml", *bed)[0].position
        self.assertEqual(len(start), 5 * 10 * 5)
        self.assertTrue((start > [0, 0.02, 0.02]).all() and (start < [0.02, 0.06, 0.04]).all())
        moved = self.problems("check", "centred.toml", *settings(*bed, 'vessel.1.move=["-30 mm", "0 mm", "0 mm"]'))
        self.assertIn("tray spans -50..-10 x 20..60 x 20..60 mm, the box 0..80 x 0..80 x 0..80 mm", moved[0])

    def test_a_wrong_unit_is_told_with_the_right_one(self):
        problem, = self.problems("check", "funnel.toml", *settings("vessel.1.unit=m"))
        self.assertIn("funnel spans 15..55 x 15..55 x 30..90 m, the box 0..70 x 0..70 x 0..100 mm", problem)
        self.assertIn('allowed: unit = "mm"', problem)

    def test_a_missing_triangle_is_found_before_the_run(self):
        self.assertNotIn("rim of", self.check("funnel.toml"))
        said = self.check("funnel.toml", "vessel.1.file=funnel_hole.stl")
        self.assertIn("! rim of funnel below the top of the bed = 38.6 x 18 mm at (35.69, 15, 59) mm", said)
        self.assertIn("! way out of the vessel = (", said)


class Forecasts(FieldTest):
    def test_the_narrower_side_of_an_outlet_counts(self):
        turned = ["vessel.1.width=8 mm", "vessel.1.depth=30 mm", 'vessel.2.corner=["81 mm", "5 mm", "20 mm"]',
                  'vessel.2.first_edge=["8 mm", "0 mm", "0 mm"]', 'vessel.2.second_edge=["0 mm", "30 mm", "0 mm"]']
        for changes in ([], turned):
            said = self.check("slot.toml", *changes)
            for text in ("slit_over_spacing 4 ", "! particles across the outlet = 4:", "discharge_by_hand 0.0860977 kg/s"):
                self.assertIn(text, said)

    def test_disk_and_courant_number_are_among_the_warnings(self):
        self.assertNotIn("disk =", self.check("funnel.toml"))
        self.assertIn("! disk = ", self.check("funnel.toml", "output.snapshots=1 ns"))
        row = ("row-on-floor.toml", "integration.method=leapfrog")
        self.assertIn("! Courant number = 3:", self.check(*row, "integration.courant=3"))
        self.assertNotIn("Courant number", self.check(*row, "integration.courant=1.2"))


if __name__ == "__main__":
    unittest.main()
