#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The campaign in short: the program withstands it, and a program that breaks a promise is found out."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop()
CAMPAIGN = pathlib.Path(__file__).resolve().parents[2] / "tools/campaign/run"


def attack(program, *arguments):
    return subprocess.run([sys.executable, CAMPAIGN, "--program", program, "--scale", "0.002", *arguments],
                          capture_output=True, text=True, timeout=280, check=False)


class Campaign(unittest.TestCase):
    def test_the_program_withstands_it(self):
        done = attack(PROGRAM, "--only", "kills", "disk", "damage", "hostile")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        rows = done.stdout.splitlines()[1:]
        self.assertEqual(len(rows), 10, done.stdout)
        for row in rows:
            count, passed = row[34:].split()[:2]
            self.assertGreater(int(count), 0, row)
            self.assertEqual(count, passed, row)

    def test_a_program_that_breaks_its_promise_is_found_out(self):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder) / "talus"
            program.write_text(f'#!/bin/sh\n"{PROGRAM}" "$@" || exit $?\n'
                               'case "$*" in *--resume*) echo >> r/series.csv;; esac\n')
            program.chmod(0o755)
            done = attack(program, "--only", "kills")
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn("FAULT", done.stderr)
            program.write_text("#!/bin/sh\nexit 139\n")
            done = attack(program, "--only", "hostile")
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn("exit status 139", done.stderr)


if __name__ == "__main__":
    unittest.main()
