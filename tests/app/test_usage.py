# SPDX-License-Identifier: Apache-2.0
"""Completion and man page, both made from the command line's own description."""
import re
import shutil
import subprocess
import unittest

from program import PROGRAM, ProgramTest

COMMANDS = ("new", "run", "check", "ensemble", "compare", "analyze", "law", "shear-cell", "calibrate",
            "hopper-design", "reproduce", "report", "picture", "movie", "schema", "materials", "completion", "man")
COMPLETE = """source ./talus.bash
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
compopt() { echo "asks for: $*"; }
_talus
printf '%s\\n' "${COMPREPLY[@]}"
"""


class Usage(ProgramTest):
    def complete(self, *words):
        """What bash offers for the last word."""
        done = subprocess.run(["bash", "-c", COMPLETE, "bash", *words], cwd=self.folder, capture_output=True, text=True,
                              check=True)
        self.assertEqual(done.stderr, "")
        return done.stdout.split("\n")[:-1]

    def test_bash_completes_commands_options_and_choices(self):
        (self.folder / "talus.bash").write_text(self.talus("completion", "bash").stdout)
        self.assertEqual(set(self.complete("talus", "")), set(COMMANDS))
        self.assertEqual(self.complete("talus", "pi"), ["picture"])
        self.assertEqual(self.complete("talus", "run", "case.toml", "--over"), ["--overwrite"])
        self.assertEqual(self.complete("talus", "picture", "r", "--view", ""), ["xz", "xy", "yz", "oblique"])
        self.assertEqual(self.complete("talus", "ensemble", "c.toml", "--launch", "s"), ["slurm"])
        self.assertEqual(self.complete("talus", "new", "h"), ["hopper"])
        self.assertEqual(self.complete("talus", "new", "silo", "--wall"), ["--wall", "--wall-friction"])
        self.assertEqual(self.complete("talus", "completion", ""), ["bash", "zsh", "fish"])
        self.assertEqual(self.complete("talus", "report", "")[0], "asks for: -o dirnames")
        self.assertEqual(self.complete("talus", "run", "")[0], "asks for: -o default")
        self.assertEqual(self.complete("talus", "run", "case.toml", "--out", "")[0], "asks for: -o default")

    def test_every_option_of_the_help_is_completed_and_in_the_man_page(self):
        (self.folder / "talus.bash").write_text(self.talus("completion", "bash").stdout)
        page = self.talus("man").stdout.replace("\\-", "-")
        for command in COMMANDS:
            options = set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", self.talus(command, "--help").stdout, re.M))
            self.assertIn("--help", options)
            self.assertLessEqual(options, set(self.complete("talus", command, "--")), command)
            section = re.search(rf"^\.SS talus {command}$(.*?)(?=^\.SS|^\.SH)", page, re.M | re.S)[1]
            for option in options - {"--help"}:
                self.assertIn(f"\\fB{option}\\fR", section, command)

    def test_other_shells_can_read_theirs(self):
        for shell in ("zsh", "fish"):
            script = self.folder / f"talus.{shell}"
            script.write_text(self.talus("completion", shell).stdout)
            for word in ("--overwrite", "wall-friction", "slurm") if shell == "zsh" else ("overwrite", "slurm"):
                self.assertIn(word, script.read_text())
            if shutil.which(shell):
                subprocess.run([shell, "-n", script], check=True, capture_output=True)
        self.assertIn("bash", self.talus("completion", "csh", status=2).stderr)

    @unittest.skipUnless(shutil.which("groff"), "there is no groff")
    def test_the_man_page_is_roff_without_a_warning(self):
        (self.folder / "talus.1").write_text(self.talus("man").stdout)
        done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z", "talus.1"], cwd=self.folder, capture_output=True,
                              text=True, check=True)
        self.assertEqual([line for line in done.stderr.splitlines() if "can't break line" not in line
                          and "cannot adjust line" not in line], [])


if __name__ == "__main__":
    unittest.main()
