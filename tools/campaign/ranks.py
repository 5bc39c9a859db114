# SPDX-License-Identifier: Apache-2.0
"""Runs on several processes, of which one is killed, or whose disk fills: each goes on with another number of processes, or
by itself, and must then have the bits of a run on one process that nobody disturbed."""
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from attack import WAIT, require, require_list, require_same
from disk import PAGE, RUN, HopperOnFullDisk, mount
from kills import HopperKills
from small_cases import CLOUD, HOPPER, LEVELS

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from hash_ranks import ENVIRONMENT, MPIRUN  # noqa: E402

LONGEST_CHAIN, MOST = 6, 5  # kills, processes
LONG_HOPPER = HOPPER.replace('end = "4 ms"', 'end = "60 ms"').replace('snapshots = "0.5 ms"', 'snapshots = "5 ms"')

# Some tasks to share.
LONG_CLOUD = CLOUD.replace("count = 60", "count = 400").replace('"60 mm"', '"150 mm"').replace('"0.6 ms"', '"0.4 ms"')


def another(random, ranks):
    """A number of processes, 1 for talus itself."""
    return random.choice([n for n in range(1, MOST + 1) if n != ranks])


def is_zombie(process):
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except FileNotFoundError:
        return True


class OnRanks:
    """The program by mpirun where a number of processes is given."""

    def prepare(self):
        if not Path(f"{self.program}-mpi").exists():
            return "there is no talus-mpi beside the program"
        return super().prepare()

    def start(self, arguments, folder, ranks=1, **options):
        if ranks == 1:
            return super().start(arguments, folder, **options)
        words = [*MPIRUN, "-n", ranks, f"{self.program}-mpi", *arguments]
        return subprocess.Popen(list(map(str, words)), cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, env=ENVIRONMENT, **options)


class OneOfSeveralKilled(OnRanks, HopperKills):
    name, full = "kills: one process of several", 100
    text = LONG_HOPPER

    @staticmethod
    def processes_of(mpirun):
        found = subprocess.run(["pgrep", "-P", str(mpirun.pid), "talus"], capture_output=True, text=True, check=False)
        return list(map(int, found.stdout.split()))

    def kill_one(self, random, folder, ranks, resume):
        """Returns whether the processes were still there."""
        mpirun = self.start([*self.arguments, *resume], folder, ranks)
        while mpirun.poll() is None and len(self.processes_of(mpirun)) < ranks:
            time.sleep(0.02)
        time.sleep((1 + 3 * self.seconds) * random.random())
        there = self.processes_of(mpirun)
        if there:
            try:
                os.kill(random.choice(there), signal.SIGKILL)
            except ProcessLookupError:
                there = []
        try:
            said, _ = mpirun.communicate(timeout=WAIT)
        except subprocess.TimeoutExpired:
            # Open MPI 4.1 may wait for ever where all that it started has ended, one while it initialised.
            require(all(is_zombie(process) for process in self.processes_of(mpirun)), "processes go on without one of them")
            mpirun.kill()
            mpirun.communicate()
            return True
        require(mpirun.returncode in (0, 137), f"exit status {mpirun.returncode}: {said[-600:]}")
        return bool(there) and mpirun.returncode == 137

    def trial(self, random, folder, most):
        self.lay_out(folder)
        kills, resume, ranks = 0, (), random.randint(2, MOST)
        for _ in range(min(most, random.randint(1, LONGEST_CHAIN))):
            if not self.kill_one(random, folder, ranks, resume):
                break
            kills += 1
            resume = ("--resume",) if (folder / "r").exists() else ()
            ranks = max(2, another(random, ranks))
        self.talus([*self.arguments, *(("--resume",) if (folder / "r").exists() else ())], folder,
                   ranks=another(random, ranks))
        require_same(folder / "r", self.expected)
        require_list(folder / "r")
        return kills


class OneOfACloudsKilled(OneOfSeveralKilled):
    name, full = "kills: one process of a cloud's", 50
    text = LONG_CLOUD


class OneOfLevelsKilled(OneOfSeveralKilled):
    name, full = "kills: one process of levels", 50
    text = LEVELS


class SeveralOnFullDisk(OnRanks, HopperOnFullDisk):
    name, full = "full disk: several processes", 50

    def prepare(self):
        return super().prepare() or (None if self.mounts else "no file system can be mounted")

    def trial(self, random, folder, most):
        self.lay_out(folder)
        disk, ranks = folder / "disk", random.randint(2, MOST)
        try:
            require(mount(disk, f"size={PAGE * random.randint(2, self.pages + 4)}"), "a file system is mounted")
            status, said = self.talus(RUN, folder, (0, 4), ranks=ranks)
            if status == 4:
                require("No space left" in said or "too large" in said, f"the reason is not told: {said[-300:]}")
                self.require_unharmed(disk / "r") if (disk / "r").exists() else None
            subprocess.run(["mount", "-o", "remount,size=200m", disk], check=True, capture_output=True)
            self.talus([*RUN, "--resume"] if (disk / "r").exists() else RUN, folder, ranks=another(random, ranks))
            require_same(disk / "r", self.expected)
            require_list(disk / "r")
        finally:
            subprocess.run(["umount", "-l", disk], check=False, capture_output=True)
        return 1
