# SPDX-License-Identifier: Apache-2.0
"""The quantities of the air of validation/yuu2011/measures.py on fields with known numbers.

Usage: test_hopper_air.py TALUS
"""
import sys
import unittest
from pathlib import Path

sys.argv.pop()
sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[2] / "python")]

import numpy as np  # noqa: E402
from paper_hopper import GATE, MEASURES, PLATE, measure, paper_case  # noqa: E402
from runs_in_memory import Air, Frame, RunInMemory  # noqa: E402

M, PI = MEASURES.module.air, np.pi


class OfTheAir(unittest.TestCase):
    def setUp(self):
        self.air = Air((80, 2, 200), (1.25e-3, 2.5e-3, 1.25e-3), GATE + 0.2)
        self.x, self.z = self.air.centres
        self.run_ = RunInMemory(paper_case(), [Frame(np.zeros((1, 3)), GATE + 0.2)], gate_time=GATE, air=[self.air])

    def of(self, name, **place):
        return measure(name, self.run_, **place)

    def test_without_air_there_are_no_numbers(self):
        run = RunInMemory(paper_case(), [Frame(np.zeros((1, 3)), GATE + 0.2)], gate_time=GATE)
        self.assertTrue(np.isnan(measure("air_pressure_outside_inside", run, height=0.05)))
        self.assertTrue(np.isnan(measure("air_vortex_product_bin", run)))

    def test_drag_over_the_weight_of_the_same_cells(self):
        counts = (self.x > 20e-3) & (self.x < 80e-3)
        self.air["solid_fraction"][:] = np.where(counts, 0.6, 0.1)
        self.air["drag"][..., 2] = np.where(counts, 0.5 * 1500 * 9.8, 1e6)
        self.assertAlmostEqual(self.of("drag_to_weight", height=0.12, left=0.02, right=0.08), 0.5, places=12)

    def test_where_the_pressure_drops_and_where_it_is_higher(self):
        stream = abs(self.x - 0.05) < 0.015
        self.air["pressure"][:] = -10 * np.tanh((self.z - 103e-3) / 5e-3) - np.where(stream, 3, 0)
        self.air["solid_fraction"][:] = np.where(stream, 0.4, 0)
        place = {"x": 0.031, "from": 0.02, "to": 0.19}
        self.assertAlmostEqual(self.of("air_pressure_drop_height", **place), 103e-3, delta=1.25e-3)
        self.assertAlmostEqual(self.of("air_pressure_gradient_at_drop", **place), -10 / 5e-3, delta=0.03 * 10 / 5e-3)
        self.assertAlmostEqual(self.of("air_pressure_outside_inside", height=0.05), 3, places=12)

    def test_the_plug_and_what_is_beside_it(self):
        plug, creeps = abs(self.x - 0.05) < 0.02, abs(self.x - 0.05) < 0.03
        self.air["solid_fraction"][:] = 0.6
        self.air["grain_velocity"][..., 2] = np.where(plug, -0.2, np.where(creeps, -0.05, 0))
        self.air["velocity"][..., 2] = np.where(plug, -0.08, np.where(creeps, 0.01, 0.02))
        self.assertAlmostEqual(self.of("air_velocity_within_plug", height=0.12), -0.08, places=12)
        self.assertAlmostEqual(self.of("air_velocity_beside_plug", height=0.12), 0.02, places=12)
        self.assertAlmostEqual(self.of("air_velocity_slowness", height=0.12), 0.4, places=12)

    def test_where_nothing_falls_there_is_no_plug(self):
        self.air["grain_velocity"][..., 2] = 0.1
        for name in ("air_velocity_within_plug", "air_velocity_beside_plug", "air_velocity_slowness"):
            self.assertTrue(np.isnan(self.of(name, height=0.12)), name)

    def vortices(self, bottom=0.0, sign=1.0):
        """One in each half of a vessel 100 mm high, without flow through their rims; their circulation."""
        width, height, u = 0.05, 0.1, 0.3 * sign
        a, b = PI * self.x / width, PI * (self.z - bottom) / height
        inside = (self.z > bottom) & (self.z < bottom + height)
        self.air["velocity"][..., 0] += np.where(inside, u * np.sin(a) * np.cos(b), 0)
        self.air["velocity"][..., 2] += np.where(inside, -u * height / width * np.cos(a) * np.sin(b), 0)
        # du_x/dz - du_z/dx = -u pi (1/h + h/w^2) sin a sin b; the integral of sin a sin b is 4 w h/pi^2.
        return -u * PI * (1 / height + height / width**2) * 4 * width * height / PI**2

    def test_the_circulation_of_a_vortex_is_the_line_integral_around_it(self):
        exact, layer = self.vortices(), M.AirLayer(self.air)
        for left, sign in ((0, 1), (0.05, -1)):
            self.assertAlmostEqual(M.circulation(layer, left, left + 0.05, 0, 0.1), sign * exact, delta=0.01 * abs(exact))
        self.assertEqual(M.circulation(layer, 0, 0.05, 0, 0.1, filled=True), 0)
        self.air["solid_fraction"][:] = 0.5
        self.assertEqual(M.circulation(layer, 0, 0.05, 0, 0.1), 0)
        self.assertAlmostEqual(M.circulation(layer, 0, 0.05, 0, 0.1, filled=True), exact, delta=0.01 * abs(exact))

    def test_products_of_pairs_and_their_reversal(self):
        self.vortices(), self.vortices(bottom=PLATE)
        for name in ("air_vortex_product_bin", "air_vortex_product_hopper"):
            self.assertAlmostEqual(self.of(name), -0.5, delta=1e-3)
        later = Air((80, 2, 200), (1.25e-3, 2.5e-3, 1.25e-3), GATE + 0.6)
        first, self.air = self.air, later
        self.vortices(bottom=PLATE, sign=-1)
        run = RunInMemory(paper_case(), [Frame(np.zeros((1, 3)), GATE + t) for t in (0.2, 0.6)], gate_time=GATE,
                          air=[first, later])
        self.assertEqual(measure("air_vortex_reversal_hopper", run, 0.2, 0.6), -1)
        first["solid_fraction"][:] = 0.5
        self.assertAlmostEqual(measure("air_vortex_product_bed", run, at=0.2), -0.5, delta=1e-3)
        self.assertEqual(measure("air_vortex_reversal_bed", run, 0.2, 0.6), -1)


if __name__ == "__main__":
    unittest.main()
