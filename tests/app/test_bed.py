# SPDX-License-Identifier: Apache-2.0
"""Where the bed lies, as `talus check` says and draws it; particles of a file; runs without any particle."""
import json
import re
import unittest

import h5py

from program import PROJECT, InputTest, bits, rows, state

BIN = """model = "continuum"
[box]
width = "120 mm"
depth = "60 mm"
height = "120 mm"
floor = "open"
[[vessel]]
name = "bin"
shape = "cylinder"
centre = ["30 mm", "30 mm"]
radius = "16 mm"
bottom = "40 mm"
top = "100 mm"
[[vessel]]
name = "gate"
shape = "disc"
centre = ["30 mm", "30 mm"]
radius = "16 mm"
height = "40 mm"
gate = true
[[vessel]]
name = "belt"
shape = "plate"
corner = ["10 mm", "10 mm", "20 mm"]
first_edge = ["100 mm", "0 mm", "0 mm"]
second_edge = ["0 mm", "40 mm", "0 mm"]
[gate]
opens = "at-time"
time = "40 ms"
[grains]
material = "sand"
[bed]
spacing = "4 mm"
bottom = "40 mm"
height = "12 mm"
[removal]
below = "24 mm"
[integration]
method = "leapfrog"
courant = 0.6
[collisions]
form = "none"
[run]
end = "0.3 s"
[output]
snapshots = "20 ms"
series = "2 ms"
report = false
"""

INLET = """
[[inlet]]
shape = "disc"
centre = ["30 mm", "30 mm", "60 mm"]
radius = "8 mm"
velocity = ["0 m/s", "0 m/s", "-0.5 m/s"]
rate = "40 g/s"
to = "30 ms"
"""
HEIGHT = 'height = "12 mm"\n'


class BedTest(InputTest):
    def setUp(self):
        super().setUp()
        self.write(BIN)

    def write(self, text):
        (self.folder / "case.toml").write_text(text)

    def start_of(self, *arguments):
        """Names and texts under "At the start"."""
        said = self.talus("check", "case.toml", *arguments).stdout
        lines = said[said.index("At the start:"):].split("\n\n")[0].splitlines()[1:]
        start = {}
        for line in lines:
            if line[2] != " ":
                name, text = line[2:].split("  ", 1)
                start[name] = text.strip()
            else:
                start[name] += " " + line.strip()
        return start


class Check(BedTest):
    def test_it_says_where_the_bed_lies(self):
        start = self.start_of()
        self.assertRegex(start["bed"], r"^\d+ particles, 0\.0\d+ kg$")
        low, high, z = re.match(r"x (\S+) to (\S+) mm, y \S+ to \S+ mm, z (\S+ to \S+) mm$", start["lies at"]).groups()
        self.assertAlmostEqual(float(low), 14, delta=2.5)
        self.assertAlmostEqual(float(high), 46, delta=2.5)
        self.assertEqual(z, "40 to 52")
        self.assertEqual(start["lies against"], "bin, gate")

    def test_it_draws_walls_and_bed(self):
        self.talus("check", "case.toml", "--picture", "bed.png")
        self.assertEqual((self.folder / "bed.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        said = self.talus("check", "case.toml", "--picture", "bed.jpg", status=2).stderr
        self.assertIn("a file that ends in .png", said)

    def test_it_warns_of_a_missing_gate_and_names_the_place(self):
        self.write(BIN.replace("gate = true\n", "hole = \"10 mm\"\n"))
        said = " ".join(self.talus("check", "case.toml").stdout.split())
        place = re.search(r"! way out of the vessel = \((\S+), (\S+), (\S+)\) mm: the region of the bed goes on", said)
        self.assertTrue(place, said[-2000:])
        x, y, z = map(float, place.groups())
        self.assertLess((x - 30) ** 2 + (y - 30) ** 2, 10 ** 2, "in the hole")
        self.assertAlmostEqual(z, 40, delta=4)

    def test_it_warns_of_grains_that_are_taken_away_at_once_or_fall_for_ever(self):
        said = " ".join(self.talus("check", "case.toml", "--set", "removal.below=44 mm").stdout.split())
        self.assertRegex(said, r"! grains taken away at once = 4\d(\.\d+)? mm: the bed reaches below removal\.below, 44 mm")
        terrain = (BIN[:BIN.index("[[vessel]]")] + """[[vessel]]
name = "slope"
shape = "plate"
corner = ["0 mm", "0 mm", "80 mm"]
first_edge = ["120 mm", "0 mm", "-40 mm"]
second_edge = ["0 mm", "60 mm", "0 mm"]
""" + BIN[BIN.index("[gate]\n"):]).replace('opens = "at-time"\ntime = "40 ms"', 'opens = "from-the-start"')
        self.write(terrain.replace('below = "24 mm"', 'below = "1 mm"'))
        for bottom, falls in (("4 mm", True), ("84 mm", False)):
            said = self.talus("check", "case.toml", "--set", f"bed.bottom={bottom}").stdout
            self.assertEqual("nothing below the bed" in said, falls, said[-1500:])

    def test_the_bed_of_no_case_leaves_its_vessel(self):
        for case in ("silo-cone", "silo-square", "hourglass", "drum", "chute-bend"):
            with self.subTest(case):
                said = self.talus("check", PROJECT / f"cases/{case}.toml").stdout
                for warning in ("way out of the vessel", "bed outside the vessel", "gate without grains",
                                "taken away at once", "nothing below the bed"):
                    self.assertNotIn(warning, said)


class File(BedTest):
    def lay(self, text):
        (self.folder / "bed.csv").write_text(text)
        self.write(BIN.replace('bottom = "40 mm"\nheight = "12 mm"\n', 'file = "bed.csv"\n'))

    def test_particles_of_a_table_fall_as_it_says(self):
        self.lay("x [mm],y [mm],z [mm],velocity_x [m/s],velocity_y [m/s],velocity_z [m/s]\n"
                 "28,30,60,0,0,-0.1\n32,30,60,0,0,-0.1\n")
        self.assertEqual(self.start_of()["bed"].split(",")[0], "2 particles")
        self.talus("run", "case.toml", "--set", "run.end=1 us", "--set", "gate.opens=from-the-start", "--out", "run")
        with h5py.File(self.folder / "run/snapshots/particles_0000.vtkhdf") as file:
            self.assertEqual(file["VTKHDF/Points"][()].tolist(), [[0.028, 0.03, 0.06], [0.032, 0.03, 0.06]])
            self.assertEqual(file["VTKHDF/PointData/velocity"][()].tolist(), [[0, 0, -0.1]] * 2)

    def test_faults_name_line_and_column(self):
        self.lay("x [mm],y [mm],z [mm],radius [mm]\n28,30,60,2\n")
        self.assertRegex(self.problems("check", "case.toml")[0], r"bed\.csv:1: .*radius")
        self.lay("x [mm],y [mm],z [mm]\n28,30,60\n28,thirty,60\n28,nan,60\n")
        said = self.problems("check", "case.toml")
        self.assertRegex(said[0], r"bed\.csv:3: .*y")
        self.assertRegex(said[1], r"bed\.csv:4: .*y")
        self.lay("x [mm],y [mm],z [mm]\n28,30,60\n28,130,60\n28.1,30,60\n28,30,60.3\n")
        said = self.problems("check", "case.toml")
        self.assertRegex(said[0], r"case\.toml:\d+: bed\.file: .*bed\.csv: line 3: y = 130 mm is outside the box; "
                                  r"allowed: 0 to 60 mm")
        self.lay("x [mm],y [mm],z [mm]\n28,30,60\n28.1,30,60\n")
        self.assertRegex(self.problems("check", "case.toml")[0], r"line 2: is 0\.1 mm from line 3")
        self.lay("x [mm],y [mm],z [mm],density [kg/m3]\n28,30,60,2000\n")
        self.assertRegex(self.problems("check", "case.toml")[0], r"line 2: density = 2000 kg/m3; allowed: above 0 and up to "
                                                                 r"1961 kg/m3")
        self.lay("x [mm],y [mm],z [mm]\n28,30,60\n30,30,60\n32,30,60\n")
        self.assertRegex(self.problems("check", "case.toml")[0], r"bed\.spacing: 4 mm, but most particles of .*bed\.csv have "
                                                                 r"another within 2\.4 mm")
        self.lay("x [mm],y [mm],z [mm]\n28,30,0.5\n")
        self.assertRegex(self.problems("check", "case.toml", "--set", "box.floor=wall")[0],
                         r"line 2: is 0\.5 mm from the floor; allowed: at least 1\.2 mm")
        self.lay("x [mm],y [mm],z [mm],velocity_z [m/s]\n28,30,60,1\n")
        self.assertRegex(self.problems("check", "case.toml")[0], "has no column velocity_x")
        self.lay("x [mm],y [mm],z [mm]\n")
        self.assertRegex(self.problems("check", "case.toml")[0], "has no particles")

    def test_a_file_that_is_not_there_is_a_fault_of_the_case(self):
        self.write(BIN.replace('bottom = "40 mm"\nheight = "12 mm"\n', 'file = "none.csv"\n'))
        self.assertRegex(self.problems("check", "case.toml")[0], r"case\.toml:\d+: bed\.file: .*none\.csv")

    def test_faults_of_case_and_file_are_told_together(self):
        self.lay("x [mm],y [mm]\n28,30\n")
        said = self.problems("check", "case.toml", "--set", "box.left=periodic", "--set", "walls.coefficient=-1")
        self.assertEqual(len(said), 3)
        self.assertRegex(said[0], r"^case\.toml:\d+: bed\.file: .*bed\.csv:1: z: missing column$")

    def test_a_snapshot_of_several_sizes_is_refused(self):
        fine = ("--set", "levels.count=1", "--set", "levels.distance=4 mm", "--set", "walls.friction=none", "--set",
                'levels.low=["14 mm", "14 mm", "40 mm"]', "--set", 'levels.high=["20 mm", "46 mm", "44 mm"]')
        self.talus("run", "case.toml", *fine, "--set", "run.end=1 us", "--out", "first")
        last = sorted((self.folder / "first/snapshots").glob("particles_*.vtkhdf"))[-1]
        self.lay("")
        said = self.problems("check", "case.toml", "--set", f"bed.file={last.relative_to(self.folder)}")
        self.assertRegex(said[0], "column mass_ratio: particles of several sizes")

    def test_a_snapshot_begins_another_run(self):
        self.talus("run", "case.toml", "--set", "run.end=1 ms", "--out", "first")
        last = sorted((self.folder / "first/snapshots").glob("particles_*.vtkhdf"))[-1]
        self.lay("")
        name = last.relative_to(self.folder)
        self.assertIn("stress_zz", self.start_of("--set", f"bed.file={name}")["not read"])
        self.talus("run", "case.toml", "--set", f"bed.file={name}", "--set", "run.end=1 us", "--set",
                   "gate.opens=from-the-start", "--out", "second")
        with h5py.File(last) as old, h5py.File(self.folder / "second/snapshots/particles_0000.vtkhdf") as new:
            a = sorted(map(tuple, old["VTKHDF/Points"][()]))
            b = sorted(map(tuple, new["VTKHDF/Points"][()]))
            self.assertEqual(a, b)
            self.assertEqual(sorted(old["VTKHDF/PointData/density"][()]), sorted(new["VTKHDF/PointData/density"][()]))
        self.talus("run", "case.toml", "--set", f"bed.file={name}", "--set", "run.end=1 us", "--set",
                   "gate.opens=from-the-start", "--out", "second", "--resume")


class Beds(BedTest):
    def test_layers_have_tags(self):
        self.write(BIN.replace('[removal]', '[[beds]]\nbottom = "52 mm"\nheight = "8 mm"\n[removal]'))
        start = self.start_of()
        self.assertRegex(start["beds.1, tag 1"], r"^\d+ particles")
        self.talus("run", "case.toml", "--set", "run.end=1 ms", "--set", "gate.time=1 ms", "--out", "run")
        with h5py.File(self.folder / "run/snapshots/particles_0000.vtkhdf") as file:
            tags, z = file["VTKHDF/PointData/tag"][()], file["VTKHDF/Points"][()][:, 2]
            self.assertTrue(((tags == 1) == (z > 0.052)).all())
            self.assertEqual(set(tags), {0, 1})
        self.talus("picture", "run", "--color", "tag", "-o", "tags.png")

    def test_walls_of_the_box_bear_all_beds_or_are_not_told(self):
        box = """model = "continuum"
[box]
width = "80 mm"
depth = "80 mm"
height = "120 mm"
front = "wall"
rear = "wall"
[grains]
density = "2500 kg/m3"
diameter = "1 mm"
[bed]
packing = 0.6
spacing = "10 mm"
height = "80 mm"
[settle]
damping_time = "5 ms"
[run]
end = "30 ms"
[output]
pictures = false
report = false
"""
        two = box.replace('height = "80 mm"', 'height = "20 mm"') + '[[beds]]\nbottom = "20 mm"\nheight = "60 mm"\n'
        side = []
        for name, text in (("one", box), ("two", two)):
            self.write(text)
            self.talus("run", "case.toml", "--out", name)
            walls = rows(self.folder / name / "analysis/box_walls.csv")
            self.assertAlmostEqual(float(walls[0]["area [m2]"]), 0.08 * 0.08, delta=1e-9)
            side.append(float(walls[0]["pressure_at_rest [Pa]"]))
        self.assertAlmostEqual(side[0], side[1], delta=1e-3 * side[0])
        self.write(box.replace('height = "80 mm"\n[settle]', 'height = "80 mm"\nrear = "40 mm"\n[settle]'))
        self.talus("run", "case.toml", "--set", "gate.opens=from-the-start", "--set", "run.end=1 ms", "--out", "half")
        self.assertFalse((self.folder / "half/analysis/box_walls.csv").exists())

    def test_faults_name_the_bed(self):
        self.write(BIN.replace('[removal]', '[[beds]]\nbottom = "44 mm"\nheight = "8 mm"\nheigth = "3 mm"\n[removal]'))
        said = "\n".join(self.problems("check", "case.toml"))
        self.assertRegex(said, r"beds\.1\.heigth: unknown key.*beds\.1\.height")
        self.write(BIN.replace('[removal]', '[[beds]]\nbottom = "44 mm"\nheight = "8 mm"\n[removal]'))
        self.assertRegex(self.problems("check", "case.toml")[0], r"beds\.1\.bottom: \[\[beds\]\] 1 overlaps \[bed\] at")


class NoParticles(BedTest):
    def test_a_drained_vessel_ends_the_run(self):
        said = self.talus("run", "case.toml", "--set", "run.end=2 s", "--out", "run").stdout
        self.assertRegex(said, r"Ended at t = 0\.\d+ s: all grains have left: the vessel has emptied\.")
        last = rows(self.folder / "run/series.csv")[-1]
        summary = json.loads((self.folder / "run/summary.json").read_text())
        self.assertEqual(summary["status"], "done")
        self.assertAlmostEqual(float(last["removed_mass [kg]"]), 0.6 * 2650 * 1.2e-2 * 3.1416 * 0.016**2, delta=2e-3)
        self.assertLess(summary["quantities"]["mass_error"]["value"], 1e-12)
        newest = sorted((self.folder / "run/snapshots").glob("particles_*.vtkhdf"))[-1]
        with h5py.File(newest) as file:
            self.assertEqual(file["VTKHDF/Points"].shape, (0, 3))
        self.talus("analyze", "run")
        self.talus("picture", "run", "--color", "packing", "-o", "end.png")
        self.talus("picture", "run", "--times", "0,0.05", "--color", "velocity", "-o", "strip.png")
        self.talus("report", "run")
        self.talus("run", "case.toml", "--set", "run.end=2 s", "--out", "run", "--resume")

    def test_a_later_end_leaves_what_followed_from_the_first(self):
        self.write(BIN + INLET.replace('to = "30 ms"\n', "").replace("40 g/s", "10 g/s"))
        self.talus("run", "case.toml", "--set", "run.end=20 ms", "--out", "run")
        modulus = r'bulk_modulus = "(\S+) Pa"'
        case_text = json.loads((self.folder / "run/manifest.json").read_text())["case"]
        first = re.search(modulus, case_text).group(1)
        self.talus("run", "case.toml", "--set", "run.end=60 ms", "--out", "run", "--resume")
        case_text = json.loads((self.folder / "run/manifest.json").read_text())["case"]
        self.assertEqual(re.search(modulus, case_text).group(1), first)
        self.talus("run", "case.toml", "--set", "run.end=60 ms", "--out", "whole")
        case_text = json.loads((self.folder / "whole/manifest.json").read_text())["case"]
        self.assertNotEqual(re.search(modulus, case_text).group(1), first)
        self.problems("run", "case.toml", "--set", "run.end=70 ms", "--set", "bed.packing=0.59", "--out", "run", "--resume")

    def test_an_empty_bin_is_filled_and_goes_on_with_the_same_bits(self):
        self.write(BIN.replace('bottom = "40 mm"\n' + HEIGHT, "") + INLET)
        self.assertEqual(self.start_of()["bed"], "none: grains come in through inlets only")
        self.talus("run", "case.toml", "--out", "run")
        series = rows(self.folder / "run/series.csv")
        self.assertEqual(float(series[0]["mass_near_floor [kg]"]), 0)
        self.assertGreater(max(float(row["fed_mass [kg]"]) for row in series), 1e-3)
        # Interrupted before the first step, and taken up again in three parts.
        parts = [("--set", "run.end=10 ms"), ("--set", "run.end=0.1 s"), ()]
        self.talus("run", "case.toml", "--out", "cut", "--walltime", "1e-9", *parts[0], status=130)
        for part in parts:
            self.talus("run", "case.toml", "--out", "cut", "--resume", *part)
        self.assertEqual(bits(self.folder / "run"), bits(self.folder / "cut"))
        self.assertEqual(state(self.folder / "run"), state(self.folder / "cut"))

    def test_an_inlet_that_begins_after_the_end_is_told(self):
        self.write(BIN + INLET)
        self.assertNotIn("inlet.1.from", self.talus("check", "case.toml").stdout)
        said = self.talus("check", "case.toml", "--set", "inlet.1.from=2 s", "--set", "inlet.1.to=3 s", "--set", "run.end=1 s").stdout
        self.assertIn("! inlet.1.from = 2 s: nothing comes in before run.end, 1 s", " ".join(said.split()))

    def test_without_an_inlet_a_bed_is_missing(self):
        self.write(BIN.replace(HEIGHT, ""))
        self.assertRegex(self.problems("check", "case.toml")[0], "bed.height: missing")


if __name__ == "__main__":
    unittest.main()
