# SPDX-License-Identifier: Apache-2.0
"""talus calibrate --grains and --repose, as a user meets them: refusals, a material that a case takes, and calibrations that are
killed. LAMMPS is a stand-in whose beads follow a law that is known."""
import math
import os
import random
import re
import signal
import subprocess
import sys
import time
import tomllib

import numpy as np
from program import PROGRAM, PROJECT, ProgramTest

BEADS = """[beads]
diameter = "1.25 mm"
density = "2500 kg/m3"
stiffness = "1000 N/m"
spread = 0.1
friction = 0.5
rolling_friction = 0.2
restitution = 0.8

[walls.acrylic]
friction = 0.3
"""
CASE = """model = "continuum"
[box]
width = "20 mm"
depth = "2 mm"
height = "30 mm"
[gate]
opens = "from-the-start"
[grains]
material = "my-grains.toml"
[walls]
material = "acrylic"
friction_from = "start"
[bed]
spacing = "2 mm"
height = "20 mm"
[collisions]
form = "none"
[run]
end = "0.2 ms"
[output]
pictures = false
report = false
"""
# What the stand-in's beads have, by key of the law; the smallest angle at which layers start is 33 degrees.
LAW = {"static_friction": 0.45, "dynamic_friction": 0.7, "inertial_number": 0.3, "critical_packing": 0.56, "packing_slope": 0.1,
       "dilatancy": 8}
START, WALL = 33, 0.25
# Of those that stick: a/sigma = KAPPA + ALPHA C in steady shear, and the weight of a bead, N.
ALPHA, KAPPA = 0.2, 0.05
WEIGHT = 2500 * math.pi / 6 * 1.25e-3**3 * 9.8
LMP = f"""#!{sys.executable} -S
import math, os, sys, time
words = sys.argv[1:]
have = {{words[n + 1]: float(words[n + 2]) for n, word in enumerate(words) if word == "-var"}}
script = os.path.basename(words[words.index("-in") + 1])
slow, fast, scale, critical, fall, rate = {list(LAW.values())}

def write(name, rows):
    with open(name, "w") as out:
        out.write("# one\\n")
        for n, row in enumerate(rows):
            out.write(" ".join(str(value) for value in (n, *row)) + "\\n")
            if n == len(rows) // 2:
                out.flush()
                time.sleep(0.04)

def shear():
    excess = have["packing"] - critical
    if excess < 0:
        inertial = -excess / fall
        pressure = (2e-4 / inertial) ** 2
    else:
        pressure = 0.24 * math.log(have["packing"] / critical)
        inertial = 2e-4 / pressure ** 0.5
    friction = slow + (fast - slow) / (1 + scale / inertial)
    write("shear.txt", [(0.1 * n, pressure, pressure, pressure, friction * pressure) for n in range(21)])

def dilate():
    rows = []
    for n in range(200):
        packing = critical / (1 + (critical / have["packing"] - 1) * math.exp(-rate * critical * 0.005 * n))
        rows.append((0.005 * n, packing, 1, 1, 1, min(1, n / 10) * (slow + 0.4 * rate * (packing - critical))))
    write("dilate.txt", rows)

def incline():
    rows, velocity, count = [], 0.2, 1000
    for n in range(count + 1):
        slope = math.radians(have["from"] + (have["to"] - have["from"]) * n / count)
        friction = {WALL} if have.get("smooth") else slow
        velocity = max(0, velocity + 9.8 * (math.sin(slope) - friction * math.cos(slope)) / 0.099 * have["time"] / count)
        rows.append((math.degrees(slope), velocity, 10, 6))
    write("stop.txt", rows)
    if have["up"]:
        write("start.txt", [(slope, float(slope >= {START}), 10, 6) for slope in range(10, 40)])

def cohesive():
    over, pressure = 1 + {KAPPA} + {ALPHA} * have["bond"], 2e-4
    friction = over * (slow + (fast - slow) / (1 + scale * (over * pressure) ** 0.5 / 2e-4))
    steady = [pressure, pressure, pressure, friction * pressure]
    write("cohesive.txt", [(0.05 * n, critical - 0.02 * have["bond"], *(steady if n > 19 else [1, 1, 1, 9])) for n in range(31)])

{{"shear.in": shear, "dilate.in": dilate, "incline.in": incline, "cohesive.in": cohesive}}[script]()
with open(os.environ["JOBS_LOG"], "a") as log:
    log.write(os.getcwd() + "\\n")
"""
# Heaps that are over in a tenth of a second, and an angle that they are said to have, by the bits of their grains.
HEAP = """import math
import numpy as np
from talus import heap
from talus.lab import calibrate
heap.angle_of = lambda run: (0.8 * math.degrees(math.atan(float(run.case["law"]["critical-state"]["static_friction"]))) + 5
                             + float(np.asarray(run.snapshots[-1].positions).mean()))
calibrate.run_command(calibrate.main)
"""
SHORT = f"""#!{sys.executable} -S
import os, sys
words = [{{"run.end=6.5 s": "run.end=0.06 s", "inlet.1.to=6 s": "inlet.1.to=50 ms"}}.get(word, word) for word in sys.argv[1:]]
if words[0] == "run":
    words += ["--set", "settle.speed=1 m/s", "--set", "output.snapshots=10 ms", "--threads", "1"]
os.execv({PROGRAM!r}, [{PROGRAM!r}, *words])
"""


class FromBeads(ProgramTest):
    def setUp(self):
        super().setUp()
        self.place("lmp", LMP)
        (self.folder / "beads.toml").write_text(BEADS)
        self.log = self.folder / "jobs.log"
        self.environment = {**os.environ, "PATH": f"{self.folder}/bin:/usr/bin:/bin", "JOBS_LOG": str(self.log)}

    def place(self, name, text):
        (self.folder / "bin").mkdir(exist_ok=True)
        path = self.folder / "bin" / name
        path.write_text(text)
        path.chmod(0o755)
        return path

    def start(self, *words):
        return subprocess.Popen([PROGRAM, "calibrate", *words], cwd=self.folder, env=self.environment, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def calibrate(self, *words, status=0):
        process = self.start("--grains", "beads.toml", "--quick", *words)
        said = process.communicate(timeout=60)[0]
        self.assertEqual(process.returncode, status, said)
        return said

    def jobs(self):
        return self.log.read_text().splitlines() if self.log.exists() else []

    def test_beads_of_a_known_law_have_its_parameters_and_a_case_takes_them(self):
        self.calibrate("--out", "my-grains.toml")
        material = tomllib.loads((self.folder / "my-grains.toml").read_text())
        law = material["law"]["critical-state"]
        for key, value in LAW.items():
            self.assertAlmostEqual(law[key]["value"] / value, 1, delta=0.08 if key == "dilatancy" else 0.05, msg=key)
            low, high = law[key]["range"]
            self.assertLessEqual(low, law[key]["value"])
            self.assertGreaterEqual(high, law[key]["value"])
            self.assertIn("LAMMPS", law[key]["source"])
        self.assertAlmostEqual(law["ageing_strength"]["value"], 0.649 - 0.45, delta=0.01)
        self.assertAlmostEqual(law["random_loose_packing"]["value"], 0.53, delta=0.003)
        self.assertAlmostEqual(material["walls"]["acrylic"]["value"], WALL, delta=0.005)
        (self.folder / "case.toml").write_text(CASE)
        self.talus("run", "case.toml", "--out", "run")
        manifest = (self.folder / "run" / "manifest.json").read_text()
        for word in ("ageing_adds = false", f"static_friction = {law['static_friction']['value']}", "diameter = \\\"0.00125 m\\\""):
            self.assertIn(word, manifest)

    def stick(self, line):
        (self.folder / "beads.toml").write_text(BEADS.replace("restitution = 0.8", f"restitution = 0.8\n{line}"))

    def test_beads_that_stick_have_the_strength_of_their_cells_and_a_case_takes_it(self):
        self.stick("bond_number = 10")
        self.calibrate("--out", "my-grains.toml")
        material = tomllib.loads((self.folder / "my-grains.toml").read_text())
        law, stress = material["law"]["critical-state"], 10 * WEIGHT / 1.25e-3**2
        strength, low, high, *ends = (float(text.removesuffix(" Pa")) for text in (
            law["tensile_strength"]["value"], *law["tensile_strength"]["range"], *material["pressure"]["range"]))
        self.assertAlmostEqual(strength / (ALPHA * stress), 1, delta=0.05)
        self.assertTrue(low < strength < high)
        self.assertAlmostEqual(law["consolidation_strength"]["value"], KAPPA, delta=0.02)
        self.assertAlmostEqual(law["critical_packing"]["value"], 0.54)  # of C = 1
        np.testing.assert_allclose(law["critical_packing"]["range"], [0.46, 0.554])
        np.testing.assert_allclose(ends, [stress / 5, stress / 0.3], 1e-3)
        self.assertAlmostEqual(law["static_friction"]["value"], 0.45, delta=0.02)  # as without
        for source in (law["dilatancy"]["source"], law["random_loose_packing"]["source"], material["walls"]["acrylic"]["source"]):
            self.assertIn("without cohesion", source)
        (self.folder / "case.toml").write_text(CASE)
        self.talus("run", "case.toml", "--out", "run")
        manifest = (self.folder / "run" / "manifest.json").read_text()
        for key in ("tensile_strength", "consolidation_strength"):
            self.assertIn(str(law[key]["value"]), manifest)

    def test_cohesion_adds_cells_to_those_without_whatever_its_key_and_size(self):
        counts, strengths = [], []
        energy = 20 * WEIGHT / (3 * math.pi / 8 * 1.25e-3)
        for line in ("", "bond_number = 0", "bond_number = 20", f'surface_energy = "{energy} J/m2"', "bond_number = 40"):
            self.stick(line)
            self.calibrate("--out", "my-grains.toml")
            material = tomllib.loads((self.folder / "my-grains.toml").read_text())
            law = material["law"]["critical-state"]
            self.assertEqual(material["pressure"]["range"][1], "800 Pa")  # overlaps, before the attraction is less than was computed
            strengths.append(float(law.get("tensile_strength", {"value": "0 Pa"})["value"].removesuffix(" Pa")))
            counts.append(len(self.jobs()))
        self.assertEqual(counts, [12, 12, 16, 16, 16])
        np.testing.assert_allclose(np.array(strengths) / strengths[2], [0, 0, 1, 1, 2], 1e-4)

    def test_a_calibration_that_is_killed_ends_with_the_same_file(self):
        self.stick("bond_number = 20")
        self.calibrate("--jobs", "2", "--out", "whole.toml")
        count = len(self.jobs())
        self.log.unlink()
        process, after = self.start("--grains", "beads.toml", "--quick", "--jobs", "2", "--out", "killed.toml"), random.uniform(0.1, 0.9)
        time.sleep(after)
        process.kill()
        process.communicate()
        time.sleep(0.1)  # what it started goes too
        self.calibrate("--jobs", "1", "--out", "killed.toml")
        self.assertEqual((self.folder / "killed.toml").read_text().replace("killed", "whole"), (self.folder / "whole.toml").read_text(),
                         f"killed after {after} s")
        self.assertLess(len(self.jobs()), count + 3)  # nothing that was done is done again
        before = len(self.jobs())
        self.calibrate("--out", "killed.toml")
        self.assertEqual(len(self.jobs()), before)

    def test_other_beads_are_computed_anew(self):
        self.calibrate("--out", "my-grains.toml")
        count = len(self.jobs())
        (self.folder / "beads.toml").write_text(BEADS.replace("friction = 0.3", "friction = 0.35"))  # of the wall
        self.calibrate("--out", "my-grains.toml")
        self.assertEqual(len(self.jobs()), count + 1)

    def test_an_interrupted_calibration_says_how_it_goes_on(self):
        process = self.start("--grains", "beads.toml", "--quick", "--jobs", "1", "--out", "my-grains.toml")
        while not self.jobs():
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        self.assertIn("the same command goes on", process.communicate(timeout=10)[0])
        self.assertEqual(process.returncode, 130)
        self.assertFalse((self.folder / "my-grains.toml").exists())

    def test_two_calibrations_into_one_folder_are_refused(self):
        process = self.start("--grains", "beads.toml", "--quick", "--jobs", "1", "--out", "my-grains.toml")
        while not self.jobs():
            time.sleep(0.01)
        self.assertRegex(self.calibrate("--out", "my-grains.toml", status=2), "my-grains: another command computes in this folder")
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=10)
        self.calibrate("--out", "my-grains.toml")

    def test_lammps_that_fails_or_is_missing_is_named(self):
        self.place("lmp", "#!/bin/sh\necho 'ERROR: Lost atoms'\necho 'Last command: run'\nexit 1\n")
        self.assertRegex(self.calibrate("--out", "my-grains.toml", status=3), r"dilate-\w+: LAMMPS failed: ERROR: Lost atoms")
        (self.folder / "bin" / "lmp").unlink()
        for name in ("python3", "env", "sh"):
            (self.folder / "bin" / name).symlink_to(f"/usr/bin/{name}")
        self.environment["PATH"] = f"{self.folder}/bin"
        self.assertIn("Debian: lammps", self.calibrate("--out", "my-grains.toml", status=1))

    def test_everything_that_is_wrong_is_said_at_once_and_nothing_is_written(self):
        (self.folder / "beads.toml").write_text("""[beads]
diameter = "1.25 kg"
densty = "2500 kg/m3"
stiffness = "1000 N/m"
spread = 0.7
friction = "high"
cohesion = 3
surface_energy = "0.05 J"
bond_number = -1
restitution = 0.8
[walls.stel]
friction = 0.3
""")
        said = self.calibrate("--diameter", "1 mm", "--out", "my-grains.txt", status=2)
        for words in (r"beads.toml:2: diameter: .*allowed: a quantity above 0 m", r"beads.toml:3: densty: is no key.*'density'",
                      r"beads.toml:5: spread: 0.7 will not do; allowed: a number from 0.05 to 0.2", r"beads.toml:6: friction: ",
                      r"beads.toml:7: cohesion: is no key.*'bond_number'",
                      r"beads.toml:8: surface_energy: .*allowed: the work of adhesion of two beads, from 0 on J/m2",
                      r"beads.toml:9: bond_number: -1 will not do", r"beads.toml:9: bond_number: is given besides surface_energy",
                      r"beads.toml:1: rolling_friction: missing", r"beads.toml:1: density: missing",
                      r"beads.toml:11: walls.stel: .*'steel'", r"--diameter: takes --shear-cell or --repose", r"--out my-grains.txt",
                      "13 problems"):
            self.assertTrue(re.search(words, said), f"{words}\n{said}")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["beads.toml", "bin", "case.toml"])
        for line, words in (("bond_number = 300", r"bond_number: 300 will not do: overlaps .*; allowed: a number from 0 to 249: "),
                            ("bond_number = 'large'", r"bond_number: is of another type"),
                            ('surface_energy = "5 J/m2"', r'surface_energy: "5 J/m2" will not do: overlaps .* from 0 to 4.24 J/m2'),
                            ('adhesion = "1 J/m2"', r"adhesion: is no key of beads.*'surface_energy'")):
            self.stick(line)
            self.assertRegex(self.calibrate("--out", "my-grains.toml", status=2), words)
        self.assertFalse(self.jobs())
        (self.folder / "beads.toml").write_text('walls = 3\n[beads]\n', encoding="utf-8")
        self.assertRegex(self.calibrate("--out", "my-grains.toml", status=2), r"beads.toml:1: walls: is of another type")
        self.assertIn("takes one of", self.calibrate("--repose", "30deg", "--out", "my-grains.toml", status=2))


class FromHeap(ProgramTest):
    def test_a_calibration_that_is_killed_ends_with_the_same_file(self):
        short = self.folder / "short"
        short.write_text(SHORT)
        short.chmod(0o755)
        environment = {**os.environ, "TALUS": str(short), "PYTHONPATH": str(PROJECT / "python")}

        def start(name):
            return subprocess.Popen([sys.executable, "-c", HEAP, "--repose=30deg", "--bulk-density=900 kg/m3",
                                     f"--out={self.folder / name}"], cwd=PROJECT, env=environment, text=True, stdout=subprocess.PIPE,
                                    stderr=subprocess.STDOUT)

        def whole(name):
            process = start(name)
            said = process.communicate(timeout=100)[0]
            self.assertEqual(process.returncode, 0, said)
            return (self.folder / name).read_text()

        first, after = whole("whole.toml"), random.uniform(0.2, 2)
        process = start("killed.toml")
        time.sleep(after)
        process.kill()
        process.communicate()
        time.sleep(0.3)
        self.assertEqual(whole("killed.toml").replace("killed", "whole"), first, f"killed after {after} s")


if __name__ == "__main__":
    import unittest
    unittest.main()
