# SPDX-License-Identifier: Apache-2.0
"""Bad input: every problem at once, exit status 2, and nothing written."""
import os
import re
import shlex
import subprocess
import unittest

from program import CASE, HOPPER, PROGRAM, PROJECT, InputTest, ProgramTest, bits, tree

ELEVEN_FAULTS = """model = "cloud"
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

POINTS = CASE.replace("seed = 3\n", "").replace(
    'shape = "circle"\ncount = 60\nsize = "60 mm"', 'shape = "file"\nfile = "points.csv"')


class BadCase(InputTest):
    def test_eleven_faults_are_eleven_messages_by_line(self):
        (self.folder / "case.toml").write_text(ELEVEN_FAULTS)
        expected = [
            (2, "seed", "-1", "from 0"),
            (3, "motoin", "unknown key", "did you mean 'motion'?"),
            (5, "particles.shape", "circel", "did you mean 'circle'?"),
            (6, "particles.count", "2.5", "a whole number"),
            (7, "particles.size", "0.135", "a length, above 0 mm, such as \"5 mm\""),
            (8, "particles.radius", "mn", "a length, above 0 mm"),
            (9, "particles.radius_spread", "2", "from 0 to 0.9"),
            (10, "particles.density", "20 kg/m", "a density, above 0 kg/m3"),
            (12, "fluid.viscosity", "0 Pa s", "from 1e-07 Pa s to 1000000000 Pa s"),
            (13, "slop", "unknown table", "did you mean 'slope'?"),
            (0, "run.end", "missing", "a time, above 0"),
        ]
        for command in ("run", "check", "ensemble"):
            problems = self.problems(command, "case.toml")
            self.assertEqual(len(problems), 11, problems)
            for problem, (line, key, what, allowed) in zip(problems, expected):
                place = f"case.toml:{line}: {key}: " if line else f"case.toml: {key}: "
                self.assertTrue(problem.startswith(place), problem)
                self.assertIn(what, problem)
                self.assertIn(allowed, problem)
        self.assert_nothing_written()

    def test_an_unknown_model_is_told_before_its_keys_are_read(self):
        for model, what in (('"clowd"', "there is no model \"clowd\"; allowed: cloud, continuum, air; did you mean 'cloud'?"),
                            ('"dem"', 'there is no model "dem"; allowed: cloud, continuum, air'),
                            ("3", "is not a model's name in quotes; allowed: cloud, continuum, air")):
            (self.folder / "case.toml").write_text(ELEVEN_FAULTS.replace('"cloud"', model))
            for command in ("run", "check", "ensemble"):
                self.assertEqual(self.problems(command, "case.toml"), [f"case.toml:1: model: {what}"])
        (self.folder / "case.toml").write_text(HOPPER.replace('model = "continuum"\n', ""))
        self.assertEqual(self.problems("check", "case.toml"),
                         ["case.toml: model: missing; allowed: cloud, continuum, air"])
        self.assertEqual(self.problems("check", "case.toml", "--set", "model=contiuum")[0].split("; did")[1],
                         " you mean 'continuum'?")
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
        [problem] = self.problems("run", "case.toml")
        self.assertTrue(problem.startswith("case.toml:5: particles.file: points.csv: cannot open: No such file"), problem)
        for text, message in (("x [mm],y [mm]\n1,2\n3,four\n", r"^case\.toml:5: particles\.file: points\.csv:3: y: "),
                              ("x [m],y [m]\n0,0\n1e9,0\n", r"^case\.toml:5: particles\.file: .*more than a million"),
                              ("x [m],y [m],z [m]\n0,0,0\n1,0,1\n", r"^case\.toml:5: particles\.file: .*plane of mot"),
                              ("x [m],radius [m]\n0,-1\n", r"^case\.toml:5: particles\.file: 1 radii"),
                              ("x [m],y [m]\n0.1,0\n0.3,0.25\n0.3,0.25\n",
                               r"^case\.toml:5: particles\.file: 1 pair overlap too much; points 2 and 3 by 2 radii"),
                              ("x [mm],y [mm]\n0,0\n4,0\n6,0\n",
                               r"^case\.toml:5: particles\.file: 3 pairs overlap too much; points 2 and 3 by 1\.6 ")):
            (self.folder / "points.csv").write_text(text)
            self.assertRegex(self.problems("run", "case.toml")[0], message)
        self.assertEqual(sorted(tree(self.folder)), ["case.toml", "points.csv"])

    def test_a_file_that_is_not_there_is_told_with_the_rest(self):
        case = (PROJECT / "cases/silo-square.toml").read_text()
        (self.folder / "case.toml").write_text(case.replace('title = "', 'titel = "'))
        for command in ("run", "check", "ensemble"):
            problems = self.problems(command, "case.toml")
            self.assertEqual(len(problems), 2, problems)
            self.assertRegex(problems[0], r"^case\.toml:\d+: titel: unknown key")
            self.assertRegex(problems[1], r"^case\.toml:\d+: vessel\.1\.file: silo-square\.stl: cannot open: No such file")
        self.assert_nothing_written()

    def test_no_consequences_of_an_unreadable_value(self):
        hopper = PROJECT / "cases/wedge-hopper.toml"
        for case, setting in ((hopper, "box.width=2.7 inches"), (hopper, "bed.height=0.1"), (hopper, "box.heigth=1 m"),
                              (hopper, "wedge.half_angle=20"), (PROJECT / "cases/silo-cone.toml", "vessel.1.radius=2 quux"),
                              (PROJECT / "cases/silo-cone.toml", "bed.mass=80 stone"),
                              (PROJECT / "cases/chute-bend.toml", "bed.spacing=1"),
                              ("case.toml", "particles.radius=5 furlong"), ("case.toml", "particles.shape=circel")):
            problems = self.problems("check", case, "--set", setting)
            self.assertEqual(len(problems), 1, problems)
            self.assertTrue(problems[0].startswith(f"--set {setting}: {setting.split('=')[0]}: "), problems)

    def test_check_warns_of_what_the_end_would_tell(self):
        slide = HOPPER
        said = self.warnings(slide, "integration.method=leapfrog", "integration.courant=3")
        self.assertIn("Courant number = 3: ", said)
        self.assertIn("Courant number = 0.6: ", self.warnings(slide, "integration.method=runge-kutta", "integration.courant=0.6"))
        self.assertNotIn("Courant", self.warnings(slide, "integration.method=leapfrog", "integration.courant=1.2"))
        self.assertIn("! disk = ", self.warnings(slide, "output.snapshots=1e-12 s"))
        self.assertNotIn("disk", self.warnings(slide))

    def warnings(self, case, *settings):
        (self.folder / "case.toml").write_text(case)
        options = [word for setting in settings for word in ("--set", setting)]
        said = self.talus("check", "case.toml", *options).stdout
        return said[said.find("Warnings"):said.find("Forecast")] if "Warnings" in said else ""

    def test_what_cannot_be_computed_is_told_from_counts(self):
        hopper, slot = PROJECT / "cases/yuu2011-hopper-vacuum.toml", PROJECT / "cases/slot.toml"
        for case, setting, message in (
                (hopper, "bed.spacing=0.02 mm", r"bed\.spacing: 0\.02 mm makes \S+ particles(;|, which need \S+ GB of memory)"),
                (slot, "box.width=1e6 m", r"box\.width: 1e\+06 m is 4e\+08 spacings: the bed would hold \S+ particles; "),
                (PROJECT / "cases/yuu2011-section-printed.toml", "integration.step=1 s", r"integration\.step: in 1 s pressure waves pass \S+ smoothing lengths; "),
                (slot, "run.end=1e9 s", r"run\.end: .* take \S+ steps"),
                ("case.toml", "fluid.viscosity=1e-300 Pa s", r"fluid\.viscosity: .*; allowed: a dynamic viscosity, from "),
                ("case.toml", "particles.size=1e6 m", r"particles\.size: 1e\+06 m is 2e\+08 times particles\.radius; "),
                ("case.toml", "run.end=1e9 s", r"run\.end: 1e\+09 s takes \S+ steps of at most ")):
            for command in ("check", "run"):
                problems = "\n".join(self.problems(command, case, "--set", setting))
                self.assertRegex(problems, message, setting)
        self.assert_nothing_written()

    def test_memory_beyond_what_there_is_is_refused(self):
        limit = ("bash", "-c", 'ulimit -v 3000000; exec "$0" "$@"', PROGRAM)
        for case, setting, message in (
                (PROJECT / "cases/slot.toml", "bed.spacing=0.1 mm", r"bed\.spacing: 0\.1 mm makes 1\.92e\+06 particles, "),
                ("case.toml", "particles.count=10000000", r"particles\.count: 10000000 grains, which need 15 GB of mem")):
            more = ("--set", "box.depth=0.1 mm") if case != "case.toml" else ("--set", "particles.size=30 m")
            for command in ("check", "run", "ensemble"):
                done = subprocess.run([*limit, command, case, "--set", setting, *more], cwd=self.folder,
                                      capture_output=True, text=True, check=False, timeout=60)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertRegex(done.stderr, message)
                self.assertRegex(done.stderr, r"GB of memory; \S+ GB are free here; allowed: at (least|most) ")
        self.assert_nothing_written()

    def test_check_of_many_particles_places_none(self):
        million = self.talus("check", "case.toml", "--set", "particles.count=1000000", "--set", "particles.size=7.5 m",
                             "--set", "run.end=1 s", "--set", "fluid.sum=direct")
        self.assertRegex(million.stdout, r"\n! This run would take [0-9]+ (months|years)\. Options:\n    --set \"?run\.end=0\.5 s")
        said = self.talus("check", PROJECT / "cases/wedge-hopper.toml", "--set", "bed.spacing=0.1 mm", "--set",
                          "box.depth=0.1 mm").stdout
        self.assertRegex(said, r"\n  particles +7\d{5}\n")

    def test_check_keeps_to_the_width_of_a_page(self):
        for case in (PROJECT / "cases/slot.toml", PROJECT / "cases/niiya2020-circle.toml"):
            for options in ((), ("--all",)):
                lines = self.talus("check", case, "--threads", 1, *options).stdout.splitlines()
                self.assertLessEqual(max(map(len, lines)), 100)
                self.assertRegex("\n".join(lines), r"\n  settling +about|\n  run +about")

    def test_check_is_short_and_all_is_all(self):
        case = PROJECT / "cases/silo-square.toml"
        short = self.talus("check", case, "--threads", 1, "--set", "bed.spacing=3 mm").stdout
        self.assertLess(len(short.splitlines()), 56)
        for part in (r"\nGiven:\n", r"\n  vessel\.1 +name silo, shape stl, file silo-square\.stl, unit mm\n",
                     r"\n  bed +mass 150 g, spacing 3 mm\n", r"\nFollows:\n", r"\n  from the material +.*grains\.density 2500 kg/m3",
                     r"\n  from the bed +law\.critical-state\.bulk_modulus \d+", r"\n  from the method +integration\.courant 1\.2\n",
                     r"\n  particles +\d+\n", r"\n  time_step +\S+ s\n", r"\n  sound_speed +\S+ m/s\n", r"\n  outlet_width +0\.03 m\n",
                     r"\nForecast"):
            self.assertRegex(short, part)
        self.assertNotIn("smoothing_ratio", short)
        every = self.talus("check", case, "--threads", 1, "--all").stdout
        self.assertRegex(every, r"\n  sph\.smoothing_ratio +1 +default ")
        self.assertRegex(every, r"\n  integration\.courant +1\.2 +method ")
        self.assertGreater(len(every.splitlines()), 100)

    def test_a_long_run_says_what_would_shorten_it(self):
        self.talus("new", "silo", "--gate", "from-the-start", "-o", "silo.toml")
        said = self.talus("check", "silo.toml", "--threads", 1, "--set", "bed.spacing=0.7 mm", "--set",
                          "run.end=1000 s", "--set", "law.critical-state.bulk_modulus=200 MPa").stdout
        took = re.search(r"\n! This run would take (\d+) (h .*|days|months|years)\. Options:\n", said)
        self.assertTrue(took, said)
        options = said[took.end():]
        # Single precision is not among them everywhere: it takes less time on some processors only.
        for change, text in ((r'--set "box\.sector=\d+ deg"', "sector"),
                             (r'--set "law\.critical-state\.bulk_modulus=1\.\d+ MPa" \\\n    --set "law\.critical-state\.shear_modulus=.*',
                              "soft"),
                             (r'--set "bed\.spacing=2\.5 mm"', "particles across the outlet")):
            self.assertRegex(options, change + rf"\n      \d+ \S+.*: .*{text}")
        # That one is empty long before the half of its time; half of a run that ends before takes less time.
        early = self.talus("check", "silo.toml", "--threads", 1, "--set", "bed.spacing=0.7 mm", "--set", "run.end=0.4 s",
                           "--set", "law.critical-state.bulk_modulus=200 MPa").stdout
        self.assertRegex(early, r'--set "run\.end=0\.2 s"\n      \d+ \S+.*: half of the simulated time')
        self.assertLessEqual(max(map(len, said.splitlines())), 100)
        if len(os.sched_getaffinity(0)) > 1:
            self.assertRegex(options, r"\n    --threads \d+\n      \d")
        # Each makes a case, with no warning that this one has not.
        options = options.replace("\\\n", "")
        for settings in re.findall(r"^    (--set .*)$", options, re.M):
            self.talus("check", "silo.toml", "--threads", 1, *shlex.split(settings))
        short = self.talus("check", "silo.toml", "--threads", 1, "--set", "run.end=1 ms").stdout
        self.assertNotIn("Options", short)

    def test_when_an_undamped_bed_rests_is_not_known(self):
        (self.folder / "case.toml").write_text(HOPPER)  # without settle.damping_time, under its whole weight at once
        said = self.talus("check", "case.toml", "--set", "settle.loading_time=0 s").stdout
        self.assertRegex(said, r"\n  settling +\S+ to \S+ steps of .*: .* to .*\n +\(without settle.damping_time, when a "
                               r"bed comes to rest is not known\)")
        self.assertRegex(said, r"\n  time +.* to .*\n")
        damped = self.talus("check", "case.toml", "--set", "settle.damping_time=5 ms").stdout
        self.assertRegex(damped, r"\n  settling +about \S+ steps")

    def test_air_alone_is_told_where_it_leaves_its_range(self):
        said = self.talus("check", PROJECT / "cases/cavity.toml", "--set",
                          'air.top_velocity=["150 m/s", "0 m/s", "0 m/s"]').stdout
        self.assertIn("! Mach number of the case = 0.437", said)
        self.assertIn("! Reynolds number of a cell", said)

    def test_a_seed_without_anything_random_is_an_error(self):
        (self.folder / "points.csv").write_text("x [m],y [m],z [m]\n0,0,0\n0.1,0,0\n")
        (self.folder / "case.toml").write_text(POINTS.replace("motion", "seed = 3\nmotion"))
        said = self.talus("check", "case.toml", status=2).stderr
        self.assertIn('case.toml:2: seed: ', said)
        self.assertIn("particles.shape", said)
        (self.folder / "case.toml").write_text(POINTS)
        self.assertNotIn("seed", self.talus("check", "case.toml").stdout)
        # There is one member of an ensemble in which nothing is random.
        self.talus("ensemble", "case.toml", "--out", "e", "--members", 3, "--set", "run.end=0.1 ms")
        self.assertEqual(len(list((self.folder / "e").rglob("series.csv"))), 1)

    def test_control_characters_are_not_passed_on(self):
        hostile = "\\u001b[31m\\u009b\\u202e"
        (self.folder / "case.toml").write_text(f'"k{hostile}" = 1\ntitle = "t{hostile}"\n' + CASE.replace(
            'shape = "circle"', f'shape = "{hostile}"'))
        said = self.talus("check", "case.toml", status=2).stderr
        said += self.talus("check", "case.toml", "--set", "run.end=\x1b[2J", "--set", "\x1b=1", status=2).stderr
        said += self.talus("check", "\x1b[2J.toml", status=4).stderr
        said += self.talus("check", "case.toml", "--\x1b[2J", status=2).stderr + self.talus("\x1b", status=2).stderr
        (self.folder / "case.toml").write_text(f'title = "t{hostile}"\n' + CASE)
        said += self.talus("check", "case.toml").stdout + self.talus("run", "case.toml", "--out", "\x1b[2Jr").stdout
        (self.folder / "points.csv").write_text("x [m],y [m],\x1b[2J [m]\n0,0,\x1b\n")
        said += self.talus("analyze", "points.csv", "--as", "front", status=2).stderr
        self.assertEqual([c for c in said if c != "\n" and (ord(c) < 32 or 0x7f <= ord(c) < 0xa0 or ord(c) == 0x202e)],
                         [], repr(said))
        self.assertIn("title", said)
        self.assertIn("t\\u001b[31m\\u009b\\u202e", said)

    def test_usage(self):
        for arguments in (["rnu"], [], ["run"], ["run", "case.toml", "--thread", "2"],
                          ["run", "case.toml", "--threads", "0"], ["run", "case.toml", "--resume", "--overwrite"],
                          ["schema", "clowd"], ["run", "case.toml", "--walltime", "-1"]):
            self.assertTrue(self.talus(*arguments, status=2).stderr, arguments)
        self.assert_nothing_written()
        for arguments in (["runn"], ["plot", "--help"], ["--help", "plot"], ["--version", "chekc", "case.toml"]):
            self.assertRegex(self.talus(*arguments, status=2).stderr,
                             r"^talus: there is no command '\w+'; allowed: new, run, check, ")
        self.assertIn("did you mean 'run'?", self.talus("runn", status=2).stderr)
        self.assertIn("did you mean 'check'?", self.talus("chekc", "case.toml", status=2).stderr)
        self.assertRegex(self.talus(status=2).stderr, r"^talus: no command; allowed: new, run, check, ")
        for arguments in (["--help"], ["--version"], ["run", "--help"]):
            self.assertTrue(self.talus(*arguments).stdout)


class ExistingFolder(ProgramTest):
    def test_is_refused_without_resume_or_overwrite(self):
        self.talus("run", "case.toml", "--out", "r")
        before = tree(self.folder)
        said = self.talus("run", "case.toml", "--out", "r", status=2).stderr
        self.assertIn("r: holds a run already; allowed: --resume to go on with it, --overwrite to replace it", said)
        self.assertEqual(tree(self.folder), before)

    def test_resume_begins_where_there_is_none(self):
        self.talus("run", "case.toml", "--out", "new", "--resume")
        self.talus("run", "case.toml", "--out", "r")
        self.assertEqual((self.folder / "new/series.csv").read_bytes(), (self.folder / "r/series.csv").read_bytes())

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
        for name in ("analysis/front_speed.csv", "pictures/frames.png", "pictures/front.png",
                     "snapshots/particles_0010.vtkhdf"):
            self.assertTrue((self.folder / "r" / name).exists(), name)
        (self.folder / "r/snapshots/particles_0077.vtkhdf.part").touch()
        for name in ("notes.txt", "analysis/mine.txt", "pictures/mine.svg"):
            (self.folder / "r" / name).write_text("mine")
        # Without a slope there is no front.
        other = ("--set", "slope.enabled=false", "--set", "gravity.direction=[1, 0, 0]", "--set",
                 "output.snapshots=0.5 ms")
        self.talus("run", "case.toml", "--out", "r", "--overwrite", *other)
        self.talus("run", "case.toml", "--out", "fresh", *other)
        self.assertEqual(set(tree(self.folder / "r")) - set(tree(self.folder / "fresh")),
                         {"notes.txt", "analysis/mine.txt", "pictures/mine.svg",
                          "snapshots/particles_0077.vtkhdf.part"})
        (self.folder / "r/snapshots/particles_0077.vtkhdf.part").unlink()
        self.assertEqual(bits(self.folder / "r"), bits(self.folder / "fresh"))


if __name__ == "__main__":
    unittest.main()
