# SPDX-License-Identifier: Apache-2.0
"""Bad input: every problem at once, exit status 2, and nothing written."""
import unittest

from program import CASE, ProgramTest, bits, tree

TWELVE_FAULTS = """model = "clowd"
seed = -1
motoin = "xy"
[particles]
shape = "circel"
count = 2.5
size = 0.135
radius = "5 mn"
radius_spread = 2
density = "20 kg/m"
[fluid]
viscosity = "0 Pa s"
[slop]
angle = "45 deg"
enabled = true
[output]
snapshots = "0.1 ms"
"""

POINTS = CASE.replace('shape = "circle"\ncount = 60\nsize = "60 mm"', 'shape = "file"\nfile = "points.csv"')


class BadCase(ProgramTest):
    def problems(self, *arguments, status=2):
        """The messages, without the last line, which counts them."""
        lines = self.talus(*arguments, status=status).stderr.splitlines()
        count = len(lines) - 1
        self.assertEqual(lines[-1], f"talus: {count} problem{'s' * (count != 1)} in the input")
        return lines[:-1]

    def assert_nothing_written(self):
        self.assertEqual([path.name for path in self.folder.iterdir()], ["case.toml"])

    def test_twelve_faults_are_twelve_messages_by_line(self):
        (self.folder / "case.toml").write_text(TWELVE_FAULTS)
        expected = [
            (1, "model", "there is no model \"clowd\"", "did you mean 'cloud'?"),
            (2, "seed", "-1", "from 0"),
            (3, "motoin", "unknown key", "did you mean 'motion'?"),
            (5, "particles.shape", "circel", "did you mean 'circle'?"),
            (6, "particles.count", "2.5", "a whole number"),
            (7, "particles.size", "0.135", "a length, above 0 mm, such as \"5 mm\""),
            (8, "particles.radius", "mn", "a length, above 0 mm"),
            (9, "particles.radius_spread", "2", "from 0 to 0.9"),
            (10, "particles.density", "20 kg/m", "a density, above 0 kg/m3"),
            (12, "fluid.viscosity", "0 Pa s", "above 0 Pa s"),
            (13, "slop", "unknown table", "did you mean 'slope'?"),
            (0, "run.end", "missing", "a time, above 0"),
        ]
        for command in ("run", "check", "ensemble"):
            problems = self.problems(command, "case.toml")
            self.assertEqual(len(problems), 12, problems)
            for problem, (line, key, what, allowed) in zip(problems, expected):
                place = f"case.toml:{line}: {key}: " if line else f"case.toml: {key}: "
                self.assertTrue(problem.startswith(place), problem)
                self.assertIn(what, problem)
                self.assertIn(allowed, problem)
        self.assert_nothing_written()

    def test_faults_of_options_name_the_option(self):
        (self.folder / "case.toml").write_text(CASE.replace('"45 deg"', "45"))
        problems = self.problems("run", "case.toml", "--set", "particles.raduis=5 mm", "--set", "run.end=3", "--set",
                                 "nonsense")
        self.assertEqual(len(problems), 4, problems)
        self.assertTrue(problems[0].startswith("case.toml:11: slope.angle: "), problems[0])
        self.assertEqual({problem.split(": ")[0] for problem in problems[1:]},
                         {"--set particles.raduis=5 mm", "--set run.end=3", "--set nonsense"})
        self.assertIn("did you mean 'particles.radius'?", "\n".join(problems))
        self.assert_nothing_written()

    def test_faults_of_varied_keys_name_the_option(self):
        problems = self.problems("ensemble", "case.toml", "--vary", "particles.raduis=5 mm,6 mm", "--vary", "nothing",
                                 "--vary", "seed=1,2", "--vary", "slope.angle=40 deg,40 deg", "--set", "run.end=3")
        for start in ("--vary nothing: no values", "--vary seed=1,2: each member has a seed of its own",
                      "--vary particles.raduis=5 mm: particles.raduis: unknown key",
                      "--vary particles.raduis=6 mm: particles.raduis: unknown key",
                      "--vary: two groups would be ", "--set run.end=3: run.end: "):
            self.assertTrue(any(p.startswith(start) for p in problems), f"{start}\n" + "\n".join(problems))
        self.assertEqual(len(problems), len(set(problems)))
        self.assert_nothing_written()

    def test_contradictions_have_their_lines_too(self):
        (self.folder / "case.toml").write_text(CASE.replace('motion = "xy"', 'motion = "xyz"'))
        [problem] = self.problems("run", "case.toml")
        self.assertTrue(problem.startswith("case.toml:3: motion: "), problem)

    def test_syntax_error_has_line_and_column(self):
        (self.folder / "case.toml").write_text(CASE.replace('"5 mm"', "5 mm"))
        [problem] = self.problems("run", "case.toml")
        self.assertRegex(problem, r'^case\.toml:8:\d+: not valid TOML: .*radius = "5 mm"')
        self.assert_nothing_written()

    def test_missing_file(self):
        for command in ("run", "check", "ensemble"):
            self.assertIn("none.toml: cannot open: No such file", self.talus(command, "none.toml", status=4).stderr)
        self.assert_nothing_written()

    def test_points_of_a_file(self):
        (self.folder / "case.toml").write_text(POINTS)
        self.assertIn("points.csv: cannot open", self.talus("run", "case.toml", status=4).stderr)
        for text, message in (("x [mm],y [mm]\n1,2\n3,four\n", r"^points\.csv:3: y: "),
                              ("x [m],y [m]\n0,0\n1e9,0\n", r"^case\.toml:6: particles\.file: .*more than a million"),
                              ("x [m],y [m],z [m]\n0,0,0\n1,0,1\n", r"^case\.toml:6: particles\.file: .*plane of mot"),
                              ("x [m],radius [m]\n0,-1\n", r"^case\.toml:6: particles\.file: 1 radii")):
            (self.folder / "points.csv").write_text(text)
            self.assertRegex(self.problems("run", "case.toml")[0], message)
        self.assertEqual(sorted(tree(self.folder)), ["case.toml", "points.csv"])

    def test_usage(self):
        for arguments in (["rnu"], [], ["run"], ["run", "case.toml", "--thread", "2"],
                          ["run", "case.toml", "--threads", "0"], ["run", "case.toml", "--resume", "--overwrite"],
                          ["schema", "clowd"], ["run", "case.toml", "--walltime", "-1"]):
            self.assertTrue(self.talus(*arguments, status=2).stderr, arguments)
        self.assert_nothing_written()
        for arguments in (["--help"], ["--version"], ["run", "--help"]):
            self.assertTrue(self.talus(*arguments).stdout)


class ExistingFolder(ProgramTest):
    def test_is_refused_without_resume_or_overwrite(self):
        self.talus("run", "case.toml", "--out", "r")
        before = tree(self.folder)
        said = self.talus("run", "case.toml", "--out", "r", status=2).stderr
        self.assertIn("r: holds a run already; allowed: --resume to go on with it, --overwrite to replace it", said)
        self.assertEqual(tree(self.folder), before)
        self.talus("run", "case.toml", "--out", "none", "--resume", status=2)
        self.assertEqual(tree(self.folder), before)

    def test_changed_case_is_not_resumed(self):
        self.talus("run", "case.toml", "--out", "r")
        before = tree(self.folder)
        said = self.talus("run", "case.toml", "--out", "r", "--resume", "--set", "slope.angle=40 deg", "--set",
                          "seed=4", "--set", "run.end=0.5 ms", "--set", "gravity.direction=[1, 0, -1]", "--set",
                          "output.snapshots=0.2 ms", status=2).stderr
        for text in ('slope.angle: "45 deg" in the run there, "40 deg" now', "seed: 3 in the run there, 4 now",
                     "gravity.direction: not given in the run there, [1.0, 0.0, -1.0] now",
                     'output.snapshots: "0.0001 s" in the run there, "0.0002 s" now',
                     "run.end: 0.0005 s, before the end of the run there, 0.001 s"):
            self.assertIn(text, said)
        self.assertEqual(len(said.splitlines()), 6, said)
        self.assertEqual(tree(self.folder), before)

    def test_other_instruction_set_is_not_resumed(self):
        portable = ("--set", "integration.instruction_set=portable")
        self.talus("run", "case.toml", "--out", "r", *portable)
        self.talus("run", "case.toml", "--out", "r", "--resume", *portable)
        self.talus("run", "case.toml", "--out", "automatic")
        if '"instruction_set": "portable"' in (self.folder / "automatic/manifest.json").read_text():
            self.skipTest("this processor has no other instruction set")
        before = tree(self.folder)
        said = self.talus("run", "case.toml", "--out", "r", "--resume", status=2).stderr
        self.assertRegex(said, r"integration\.instruction_set: portable in the run there, \w+ now")
        self.assertEqual(tree(self.folder), before)

    def test_a_cloud_takes_no_velocities(self):
        (self.folder / "case.toml").write_text(POINTS)
        (self.folder / "points.csv").write_text("x [m],y [m],vx [m/s],velocity_y [m/s]\n0,0,1,0\n0.02,0,1,0\n")
        before = tree(self.folder)
        said = self.talus("run", "case.toml", "--out", "r", status=2).stderr
        self.assertIn("has a column vx: a cloud has no inertia", said)
        self.assertIn("has a column velocity_y: a cloud has no inertia", said)
        self.assertEqual(tree(self.folder), before)

    def test_changed_points_are_not_resumed(self):
        (self.folder / "case.toml").write_text(POINTS)
        (self.folder / "points.csv").write_text("x [m],y [m]\n0,0\n0.02,0\n0,0.03\n")
        self.talus("run", "case.toml", "--out", "r")
        self.talus("run", "case.toml", "--out", "r", "--resume")
        (self.folder / "points.csv").write_text("x [m],y [m]\n0,0\n0.02,0\n0,0.04\n")
        before = tree(self.folder)
        self.assertIn("particles.file: its points are not those",
                      self.talus("run", "case.toml", "--out", "r", "--resume", status=2).stderr)
        self.assertEqual(tree(self.folder), before)

    def test_later_end_gives_the_bits_of_the_later_end_at_once(self):
        self.talus("run", "case.toml", "--out", "at-once", "--set", "run.end=1.5 ms")
        self.talus("run", "case.toml", "--out", "r", "--set", "run.end=0.77 ms")
        self.talus("run", "case.toml", "--out", "r", "--set", "run.end=1.5 ms", "--resume")
        self.assertEqual(bits(self.folder / "r"), bits(self.folder / "at-once"))
        self.assertIn(r'end = \"0.0015 s\"', (self.folder / "r/manifest.json").read_text())

    def test_overwriting_leaves_nothing_of_the_old_run_but_what_others_put_there(self):
        self.talus("run", "case.toml", "--out", "r", "--set", "output.pictures=true")
        for name in ("analysis/head_widths.csv", "pictures/frames.png", "pictures/front.png",
                     "pictures/front_speed.png", "snapshots/particles_0010.vtkhdf"):
            self.assertTrue((self.folder / "r" / name).exists(), name)
        (self.folder / "r/snapshots/particles_0077.vtkhdf.part").touch()
        for name in ("notes.txt", "analysis/mine.txt", "pictures/mine.svg"):
            (self.folder / "r" / name).write_text("mine")
        # Without a slope there is neither a head nor a front.
        other = ("--set", "slope.enabled=false", "--set", "gravity.direction=[1, 0, 0]", "--set",
                 "output.snapshots=0.5 ms")
        self.talus("run", "case.toml", "--out", "r", "--overwrite", *other)
        self.talus("run", "case.toml", "--out", "fresh", *other)
        self.assertEqual(set(tree(self.folder / "r")) - set(tree(self.folder / "fresh")),
                         {"notes.txt", "analysis/mine.txt", "pictures/mine.svg"})
        self.assertEqual(bits(self.folder / "r"), bits(self.folder / "fresh"))


if __name__ == "__main__":
    unittest.main()
