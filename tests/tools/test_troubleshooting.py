#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The messages of docs/troubleshooting.md are messages of the program: each stands in a text of its source."""
import os
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def texts():
    """What stands in quotes in src/, neighbouring pieces joined, and what the system says of its errors."""
    joined = []
    for path in sorted((ROOT / "src").rglob("*.?pp")):
        source = re.sub(r'"\s*\n\s*"', "", path.read_text(encoding="utf-8"))
        joined += re.findall(r'"((?:[^"\\\n]|\\.)*)"', source)
    return "\n".join([*joined, *(os.strerror(number) for number in range(1, 132))])


class Messages(unittest.TestCase):
    def test_each_is_one_of_the_program(self):
        page = (ROOT / "docs/troubleshooting.md").read_text(encoding="utf-8")
        messages = [message for line in re.findall(r"^### (.*)", page, re.M) for message in re.findall(r"`([^`]+)`", line)]
        self.assertGreater(len(messages), 15)
        known = texts()
        self.assertEqual([message for message in messages if message not in known], [])

    def test_each_exit_status_has_its_section(self):
        page = (ROOT / "docs/troubleshooting.md").read_text(encoding="utf-8")
        self.assertEqual(re.findall(r"exit status (\d)\)", page), ["2", "3", "4"])


if __name__ == "__main__":
    unittest.main()
