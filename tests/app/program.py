# SPDX-License-Identifier: Apache-2.0
"""What the tests of the program share: starting it, small cases, and reading what it leaves without its own readers."""
import csv
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import zlib
from pathlib import Path

import h5py

PROGRAM = os.path.abspath(sys.argv.pop())
PROJECT = Path(__file__).resolve().parents[2]

CASE = """model = "cloud"
seed = 3
motion = "xy"
[particles]
shape = "circle"
count = 60
size = "60 mm"
radius = "5 mm"
density = "20 kg/m3"
[slope]
angle = "45 deg"
[run]
end = "1 ms"
[output]
snapshots = "0.1 ms"
pictures = false
"""

HOPPER = """model = "continuum"
[box]
width = "100 mm"
depth = "5 mm"
height = "100 mm"
[plate]
height = "40 mm"
slit_left = "20 mm"
slit_right = "80 mm"
[bed]
spacing = "5 mm"
height = "40 mm"
[run]
end = "1 ms"
"""



def checkpoints(folder):
    """Steps of the whole checkpoints of a run, by name; each is verified against its own first lines."""
    steps = {}
    for path in Path(folder).glob("checkpoint_?.h5"):
        content = path.read_bytes()
        lines = content[:512].split(b"\n")
        assert lines[0] == b"Talus checkpoint", path
        assert len(content) == 512 + int(lines[3].split()[1]), path
        head = b"\n".join(lines[:4]) + b"\n"
        crc = zlib.crc32(content[512:], zlib.crc32(head))
        assert lines[4] == b"crc32 %08x" % crc, path
        with h5py.File(path, "r") as file:
            assert file["state/position"].shape[1] == 3
            steps[path.name] = int(file["state/step"][()])
    return steps


def bits(folder):
    """Everything of a run that is not about the machine: the series and the snapshots, byte by byte."""
    folder = Path(folder)
    found = {"series.csv": (folder / "series.csv").read_bytes()}
    for path in sorted((folder / "snapshots").glob("*.vtkhdf")):
        found[path.name] = path.read_bytes()
    return found


def state(folder):
    """All that the newest checkpoint of a run holds, byte by byte, apart from timings."""
    steps = checkpoints(folder)
    found = {}
    with h5py.File(Path(folder) / max(steps, key=steps.get), "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return {name: value.tobytes() if hasattr(value, "tobytes") else value for name, value in found.items()
            if name not in ("run/wall_seconds", "run/cpu_seconds")}


def tree(folder):
    """Content of every file below a folder."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(Path(folder).rglob("*")) if p.is_file()}


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def scratch_folder():
    memory = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None  # flushing to a disk takes its time
    return Path(tempfile.mkdtemp(prefix="talus-test-", dir=memory))


class ProgramTest(unittest.TestCase):
    """Works in an empty folder that is removed again; `case.toml` is in it."""

    def setUp(self):
        self.folder = scratch_folder()
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        (self.folder / "case.toml").write_text(CASE)

    def talus(self, *arguments, status=0, **options):
        """Runs the program; returns what it said. Fails on another exit status."""
        done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=120, check=False, **options)
        self.assertEqual(done.returncode, status, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done

    def run_talus(self, *arguments):
        """Runs the program; returns how it ended, whatever its exit status."""
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=120, check=False)

    def start(self, *arguments, **options):
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, **options)
        self.addCleanup(self._end, process)
        return process

    @staticmethod
    def _end(process):
        if process.poll() is None:
            process.kill()
        process.wait()

    def wait_until(self, condition, process=None):
        """Until the condition holds; fails if the process ends before."""
        limit = time.monotonic() + 60
        while not condition():
            self.assertLess(time.monotonic(), limit, "waited in vain")
            if process is not None and process.poll() is not None:
                self.fail(f"ended with {process.returncode} before it was time")
            time.sleep(0.001)

    def wait_for_rows(self, process, folder, count):
        series = self.folder / folder / "series.csv"
        self.wait_until(lambda: series.exists() and series.read_bytes().count(b"\n") > count, process)

    def kill(self, process):
        process.send_signal(signal.SIGKILL)
        process.wait()


class InputTest(ProgramTest):
    """What bad input is told."""

    def problems(self, *arguments, status=2):
        """The messages, without the last line, which counts them."""
        lines = self.talus(*arguments, status=status).stderr.splitlines()
        count = len(lines) - 1
        self.assertEqual(lines[-1], f"talus: {count} problem{'s' * (count != 1)} in the input")
        return lines[:-1]

    def assert_nothing_written(self):
        self.assertEqual([path.name for path in self.folder.iterdir()], ["case.toml"])
