#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What cmake --install leaves: it is moved elsewhere, and the program finds its cases, references and Python package.

Usage: test_install.py TALUS, the program in its build folder
"""
import gzip
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(sys.argv.pop()).resolve()
SHORT = ("--set", "particles.count=40", "--set", "run.end=200 us", "--set", "output.snapshots=50 us")


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="talus-install-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        subprocess.run(["cmake", "--install", PROGRAM.parent, "--prefix", cls.folder / "first"], check=True,
                       capture_output=True)
        cls.prefix = cls.folder / "moved"
        (cls.folder / "first").rename(cls.prefix)
        (cls.folder / "empty").mkdir()

    def run_in_empty_folder(self, *words, status=0, path="/usr/bin:/bin", **variables):
        done = subprocess.run(words, cwd=self.folder / "empty", env={"PATH": path, "HOME": str(self.folder), **variables},
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout

    def talus(self, *words, status=0):
        return self.run_in_empty_folder(self.prefix / "bin/talus", *words, status=status)

    def test_cases_references_and_the_package_are_found(self):
        self.talus("run", "cases/niiya2020-circle.toml", *SHORT, "--out", "run")
        self.assertIn("silo-square", self.talus("check", "cases/silo-square.toml"))  # its walls are in a file beside it
        self.talus("law", "cases/law/yuu2011.toml", "--path", "cases/law/shear.csv", "--out", "law")
        rows = self.talus("compare", "run", "validation/niiya2020/reference.toml", status=1)
        self.assertRegex(rows, r"front_speed_max_time +< 8 +-, -, 1\.\d+ +met", "a quantity of the study's measures.py")
        self.talus("check", "cases/gone.toml", status=4)

    def test_the_package_finds_the_program(self):
        found = self.run_in_empty_folder(sys.executable, "-B", "-c", "import talus; print(talus.find_program())",
                                         PYTHONPATH=str(self.prefix / "share/talus/python"))
        self.assertEqual(found.strip(), str(self.prefix / "bin/talus"))

    def test_man_page_and_completion(self):
        page = gzip.decompress((self.prefix / "share/man/man1/talus.1.gz").read_bytes()).decode()
        self.assertTrue(page.startswith(".TH"), page[:40])
        share = self.prefix / "share"
        for script in ("bash-completion/completions/talus", "fish/vendor_completions.d/talus.fish",
                       "zsh/site-functions/_talus"):
            self.assertIn("reproduce", (share / script).read_text())

if __name__ == "__main__":
    unittest.main()
