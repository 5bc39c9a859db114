# SPDX-License-Identifier: Apache-2.0
"""talus new: every kind's case is one that talus check accepts and that runs; what makes no sense is refused."""
import itertools
import os
import pty
import re
import select
import subprocess
import tomllib
import unittest

from program import PROGRAM, InputTest, ProgramTest

KINDS = {
    "hopper": {"width": "100 mm", "fill": "83.333 mm", "outlet": "40 mm", "drop": "100 mm", "half-angle": None,
               "material": "glass-beads", "diameter": None, "density": None, "friction": None, "wall": "steel",
               "wall-friction": None, "gate": "when-settled", "removal": "no"},
    "silo": {"width": "65 mm", "fill": "80 mm", "outlet": "30 mm", "half-angle": "30 deg", "material": "glass-beads",
             "diameter": None, "density": None, "friction": None, "wall": "steel", "wall-friction": None, "sector": None,
             "gate": "when-settled", "removal": "yes"},
    "column": {"width": "50 mm", "height": "50 mm", "floor-friction": "0.5", "diameter": "200 um", "density": "2500 kg/m3",
               "friction": "0.5"},
    "avalanche": {"grains": "2000", "radius": "5 mm", "density": "20 kg/m3", "angle": "45 deg", "fluid-density": "1.2 kg/m3",
                  "viscosity": "1.82e-5 Pa s"},
}


def unit_of(text):
    return text.split(" ", 1)[1] if " " in text else ""


class Cases(ProgramTest):
    def new(self, kind, *options, status=0, out="new.toml"):
        return self.talus("new", kind, *options, "--overwrite", "-o", out, status=status, stdin=subprocess.DEVNULL)

    def test_what_is_not_given_takes_the_value_in_brackets(self):
        for kind, questions in KINDS.items():
            self.new(kind)
            given = (self.folder / "new.toml").read_text()
            self.talus("check", "new.toml", "--threads", 1)
            self.assertIn("\n#", given, "it is commented")
            said = self.talus("new", kind, "--help").stdout
            for name, standard in questions.items():
                self.assertIn(f"--{name}", said)
                if standard:
                    self.assertIn(f"[{standard}]", re.sub(r"\s+", " ", said))
            options = [word for name, value in questions.items() if value for word in (f"--{name}", value)]
            self.new(kind, *options)
            self.assertEqual((self.folder / "new.toml").read_text(), given)

    def test_an_answer_is_in_the_case(self):
        self.new("hopper", "--width", "0.2 m", "--outlet", "30 mm", "--density", "1.5 g/cm3", "--air")
        case = tomllib.loads((self.folder / "new.toml").read_text())
        self.assertEqual(case["box"]["width"], "200 mm")
        self.assertEqual((case["plate"]["slit_left"], case["plate"]["slit_right"]), ("85 mm", "115 mm"))
        self.assertEqual(case["grains"]["density"], "1500 kg/m3")
        self.assertTrue(case["air"]["enabled"])
        self.new("hopper", "--half-angle", "30 deg")
        case = tomllib.loads((self.folder / "new.toml").read_text())
        self.assertEqual(case["wedge"]["half_angle"], "30 deg")
        self.assertNotIn("plate", case)
        self.assertNotIn("air", case)
        self.assertNotIn("removal", case)
        self.new("hopper", "--removal", "yes", "--gate", "0.2 s", "--material", "sand", "--wall", "acrylic")
        case = tomllib.loads((self.folder / "new.toml").read_text())
        self.assertEqual((case["gate"]["opens"], case["gate"]["time"]), ("at-time", "0.2 s"))
        self.assertEqual((case["grains"]["material"], case["walls"]["material"]), ("sand", "acrylic"))
        self.assertEqual((case["box"]["floor"], case["removal"]["below"]), ("open", "25 mm"))
        self.new("silo", "--sector", "20 deg", "--gate", "from-the-start", "--removal", "no", "--material", "wheat",
                 "--density", "1300 kg/m3", "--friction", "0.5", "--diameter", "3 mm")
        case = tomllib.loads((self.folder / "new.toml").read_text())
        self.assertEqual(case["box"]["sector"], "20 deg")
        self.assertNotIn("floor", case["box"])
        self.assertNotIn("removal", case)
        self.assertEqual(case["gate"], {"opens": "from-the-start"})
        self.assertEqual(case["grains"], {"material": "wheat", "density": "1300 kg/m3", "diameter": "3 mm"})
        self.assertEqual(case["law"]["critical-state"], {"static_friction": 0.5, "dynamic_friction": 0.76})
        self.new("silo", "--wall-friction", "0.6")
        case = tomllib.loads((self.folder / "new.toml").read_text())
        self.assertEqual(case["walls"]["coefficient"], 0.6)
        self.assertEqual(case["grains"]["material"], "glass-beads")
        self.assertEqual([wall["shape"] for wall in case["vessel"]], ["cylinder", "cone", "disc"])
        self.new("column", "--height", "0.2 m")
        self.assertEqual(tomllib.loads((self.folder / "new.toml").read_text())["bed"]["height"], "200 mm")
        self.new("avalanche", "--grains", "300", "--angle", "30 deg")
        case = tomllib.loads((self.folder / "new.toml").read_text())
        self.assertEqual((case["particles"]["count"], case["slope"]["angle"]), (300, "30 deg"))

    def test_rows_of_the_series_are_no_farther_apart_than_peaks_are_averaged_over(self):
        for outlet, width, fill in (("30 mm", "65 mm", "80 mm"), ("0.5 m", "4 m", "8 m")):
            self.new("silo", "--outlet", outlet, "--width", width, "--fill", fill)
            series = tomllib.loads((self.folder / "new.toml").read_text())["output"]["series"]
            metres = float(outlet.split()[0]) * (1e-3 if outlet.endswith("mm") else 1)
            self.assertLessEqual(float(series.split()[0]), 1.01e3 * 0.15 * (metres / 9.81) ** 0.5)

    def test_small_and_large_answers_are_a_case_or_are_refused(self):
        """Each number alone, a thousand times smaller and larger, and two of them together."""
        ends = {0: 0, 2: 0}
        for kind, questions in KINDS.items():
            numbers = {name: standard for name, standard in questions.items() if standard and standard[0].isdigit()}
            singles = [((name, factor),) for name in numbers for factor in (1e-3, 1e3)]
            pairs = [((a, 1e3), (b, 1e-3)) for a, b in itertools.islice(itertools.permutations(numbers, 2), 4)]
            for changes in singles + pairs:
                options = []
                for name, factor in changes:
                    value, unit = float(numbers[name].split()[0]) * factor, unit_of(numbers[name])
                    options += [f"--{name}", f"{value:g} {unit}".strip()]
                ended = self.run_talus("new", kind, *options, "--overwrite", "-o", "new.toml")
                self.assertIn(ended.returncode, ends, f"{kind} {options}: {ended.stderr}")
                ends[ended.returncode] += 1
                if ended.returncode == 0:
                    self.assertNotRegex((self.folder / "new.toml").read_text(), r"\b(nan|inf)\b")
        self.assertGreater(ends[0], 20)
        self.assertGreater(ends[2], 5)

    def test_a_case_says_no_more_than_it_needs(self):
        for kind in ("hopper", "silo", "column"):
            self.new(kind)
            case = tomllib.loads((self.folder / "new.toml").read_text())
            for table in ("integration", "collisions", "sph"):
                self.assertNotIn(table, case, "what it takes are the defaults")
            said = self.talus("check", "new.toml", "--all", "--threads", 1).stdout
            for key, value in (("integration.method", "leapfrog"), ("integration.courant", "1.2"),
                               ("law.name", "critical-state"), ("collisions.form", "none"), ("sph.viscosity_alpha", r"0\.\d+")):
                self.assertRegex(said, rf"\n  {key} +{value} ")

    def test_a_silo_has_no_warning(self):
        for options in ((), ("--sector", "20 deg"), ("--sector", "45 deg", "--outlet", "40 mm")):
            self.new("silo", *options)
            self.assertNotIn("Warnings", self.talus("check", "new.toml", "--threads", 1).stdout)

    def test_help_says_which_length_is_which(self):
        for kind, words in (("silo", ("width (diameter)", "fill: ", "half-angle, between", "outlet (diameter)")),
                            ("hopper", ("width", "fill: ", "half-angle, between", "drop: ", "a slit"))):
            said = self.talus("new", kind, "--help").stdout
            for word in words:
                self.assertIn(word, said)
            self.assertLessEqual(max(map(len, said[said.index("|<"):].splitlines())), 100)

    def test_cases_run_with_every_choice(self):
        for n, options in enumerate((("--sector", "20 deg", "--gate", "1 ms"), ("--gate", "from-the-start"),
                                     ("--material", "sand", "--wall", "concrete", "--removal", "no", "--gate", "1 ms"))):
            self.new("silo", "--fill", "30 mm", *options)
            self.talus("run", "new.toml", "--out", f"s{n}", "--set", "output.pictures=false", "--set",
                       "output.report=false", "--set", "run.end=2 ms", "--set", "bed.spacing=4 mm")
        self.new("hopper", "--fill", "20 mm", "--width", "40 mm", "--outlet", "20 mm", "--half-angle", "40 deg", "--removal",
                 "yes", "--gate", "from-the-start")
        self.talus("run", "new.toml", "--out", "h", "--set", "output.pictures=false", "--set", "output.report=false",
                   "--set", "run.end=2 ms")

    def test_cases_run(self):
        for kind, options in {"hopper": ("--fill", "20 mm", "--width", "40 mm", "--outlet", "20 mm", "--drop", "20 mm"),
                              "silo": ("--fill", "30 mm"), "column": ("--height", "20 mm", "--width", "20 mm"),
                              "avalanche": ("--grains", "100")}.items():
            self.new(kind, *options)
            self.talus("run", "new.toml", "--out", kind, "--set", "output.pictures=false", "--set", "output.report=false",
                       "--set", "run.end=1 ms" if kind != "avalanche" else "run.end=0.1 ms")


class Refused(InputTest):
    def test_every_bad_answer_is_told_at_once(self):
        problems = self.problems("new", "hopper", "--width", "3 kg", "--outlet", "0 mm", "--drop", "much", "--friction",
                                 "nan", "-o", "new.toml")
        self.assertEqual([p.split(" ")[0] for p in problems], ["--width", "--outlet", "--drop", "--friction"])
        for problem in problems:
            self.assertIn("allowed: ", problem)
        for kind, width in (("hopper", "100 mm"), ("silo", "65 mm")):
            self.assertEqual(self.problems("new", kind, "--outlet", "200 mm", "--fill", "50 mm", "-o", "new.toml"),
                             [f"--outlet 200 mm: is not narrower than the vessel; allowed: less than --width, {width}",
                              "--fill 50 mm: is a bed of fewer than four layers of particles; allowed: at least a third "
                              "of --outlet, 66.667 mm"])
        self.assertIn("did you mean 'glass-beads'?",
                      self.problems("new", "silo", "--material", "glas-beads", "-o", "new.toml")[0])
        # What only the case shows: by the option, not by a line of a file that is not there.
        for options, option in ((("--material", "sand", "--wall", "glass"), "--wall glass: "),
                                (("--sector", "25 deg"), "--sector 25 deg: "),
                                (("--fill", "1 mm"), "--fill 1 mm: ")):
            for problem in self.problems("new", "silo", *options, "-o", "new.toml"):
                self.assertNotIn("new.toml", problem)
                self.assertNotRegex(problem, r"\b(walls|bed|box|vessel)\.", "nor by a key")
                self.assertTrue(problem.startswith(option), problem)
        self.problems("new", "hopper", "--half-angle", "90 deg", "-o", "new.toml")
        self.problems("new", "avalanche", "--grains", "0", "-o", "new.toml")
        self.assertIn("is there already", self.problems("new", "silo", "-o", "case.toml")[0])
        self.assertIn("did you mean 'hopper'", self.talus("new", "hoper", status=2).stderr)
        self.assertIn("hopper, silo, column, avalanche", self.talus("new", status=2).stderr)
        self.talus("new", "silo", "-o", "nowhere/new.toml", status=4)
        self.assert_nothing_written()


class Asked(ProgramTest):
    def test_on_a_terminal_what_is_not_given_is_asked(self):
        main, other = pty.openpty()
        process = subprocess.Popen([PROGRAM, "new", "silo", "--fill", "120 mm", "-o", "new.toml"], cwd=self.folder,
                                   stdin=other, stdout=other, stderr=other, close_fds=True)
        os.close(other)
        said = ""
        for wanted, answer in ((r"outlet \(diameter\).*diameter of the silo \[65 mm\]: ", "4 kg"),
                               (r"is not a length.*diameter of the silo \[65 mm\]: ", "80 mm"),
                               (r"diameter of the outlet \[30 mm\]: ", ""), (r"half angle of the cone, .* \[30 deg\]: ", ""),
                               (r"sector .* \[none\]: ", ""), (r"taken away .* \[yes\]: ", ""),
                               (r"what the grains are: .* \[glass-beads\]: ", "gravel"),
                               (r"is not known.*what the grains are: .* \[glass-beads\]: ", "sand"),
                               (r"diameter of the grains; .* \[none\]: ", ""), (r"density of a grain; .* \[none\]: ", ""),
                               (r"angle of repose, .* \[none\]: ", ""), (r"walls are made of: .* \[steel\]: ", ""),
                               (r"wall friction; .* \[none\]: ", ""), (r"outlet opens: .* \[when-settled\]: ", "")):
            while not re.search(wanted + r"\Z", said, re.S):
                self.assertTrue(select.select([main], [], [], 30)[0], said)
                said += os.read(main, 4096).decode()
            os.write(main, (answer + "\n").encode())
        self.assertEqual(process.wait(30), 0)
        os.close(main)
        case = tomllib.loads((self.folder / "new.toml").read_text())
        self.assertEqual((case["vessel"][0]["radius"], case["bed"]["height"]), ("40 mm", "120 mm"))


if __name__ == "__main__":
    unittest.main()
