# SPDX-License-Identifier: Apache-2.0
"""The line of progress: in a pipe a tenth a line, on a terminal one line no wider than it, and what the log keeps."""
import fcntl
import os
import pty
import re
import struct
import subprocess
import termios
import unittest

from program import HOPPER, PROGRAM, ProgramTest

# A second or two.
LONG = ("--set", "integration.max_step=0.0001", "--set", "output.pictures=false")


class Progress(ProgramTest):
    def logged(self):
        return re.findall(r"  (t = .* of 0\.001 s .*)", (self.folder / "r/log.txt").read_text())

    def test_in_a_pipe(self):
        said = self.talus("run", "case.toml", "--out", "r", *LONG).stderr
        # A slow machine is told what it waits for, too.
        lines = [line for line in said.splitlines() if not re.search(r" \.\.\. \d+ s$", line)]
        self.assertTrue(1 <= len(lines) <= 10, said)
        for line in lines:
            self.assertRegex(line, r"^t = \S+ s of 0\.001 s  step \d+.*  +\d+ %  ETA \d+ s$")
        self.assertEqual(self.logged(), lines)

    def test_a_vessel_without_an_outlet_shows_its_largest_speed(self):
        (self.folder / "box.toml").write_text(HOPPER.replace(HOPPER[HOPPER.index("[plate]"):HOPPER.index("[bed]")],
                                                             '[gate]\nopens = "from-the-start"\n'))
        said = self.talus("run", "box.toml", "--out", "r", "--set", "output.pictures=false").stderr
        self.assertRegex(said.splitlines()[0], r"^t = .* fastest \S+ m/s .*ETA")

    def test_on_a_terminal_of_40_columns(self):
        ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 40, 0, 0))
        process = subprocess.Popen([PROGRAM, "run", "case.toml", "--out", "r", *LONG], cwd=self.folder, stderr=theirs,
                                   stdout=subprocess.DEVNULL)
        os.close(theirs)
        said = b""
        try:
            while part := os.read(ours, 4096):
                said += part
        except OSError:  # the other end is closed
            pass
        self.assertEqual(process.wait(), 0)
        lines = [line for line in said.decode().split("\r\x1b[K") if line]
        self.assertGreater(len(lines), 1)
        for line in lines:
            self.assertLess(len(line), 40, line)
            self.assertNotIn("\n", line)
        self.assertTrue(self.logged())


if __name__ == "__main__":
    unittest.main()
