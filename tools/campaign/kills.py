# SPDX-License-Identifier: Apache-2.0
"""Kills at random moments: a chain is killed and resumed until it is done, and must then have the bits of a run that
nobody disturbed."""
import os
import signal
import subprocess
import time

from attack import WAIT, Attack, Fault, bits, require, require_list, require_same
from small_cases import CLOUD, FIGURES, HOPPER, LEVELS, REFERENCE

LONGEST_CHAIN = 12  # kills; then it may end
MINE = ("notes.txt", "snapshots/mine.vtkhdf", "analysis/mine.csv")


class Kills(Attack):
    arguments = ()  # without --resume
    statuses = (0,)

    def lay_out(self, folder):
        """The files that the command reads."""
        raise NotImplementedError

    def prepare(self):
        self.lay_out(self.folder)
        start = time.monotonic()
        self.talus(self.arguments, self.folder, self.statuses)
        self.seconds = time.monotonic() - start
        self.expected = bits(self.folder / "r")

    def kill_once(self, random, folder, resume):
        """Returns whether the program was still there to be killed."""
        process = self.start([*self.arguments, *resume], folder, start_new_session=True)
        try:
            said, _ = process.communicate(timeout=self.seconds * random.random())
        except subprocess.TimeoutExpired:
            # The command alone, or all that it started.
            (os.killpg if random.random() < 0.7 else os.kill)(process.pid, signal.SIGKILL)
            try:
                process.communicate(timeout=WAIT)
            except subprocess.TimeoutExpired:
                raise Fault("what it started goes on without it") from None
            return True
        require(process.returncode in self.statuses, f"exit status {process.returncode}: {said[-600:]}")
        return False

    def trial(self, random, folder, most):
        self.lay_out(folder)
        kills, resume, mine = 0, (), random.random() < 0.3
        length = min(most, random.randint(1, LONGEST_CHAIN))
        while kills < length:
            if not self.kill_once(random, folder, resume):
                break
            kills += 1
            if (folder / "r").exists():
                resume = ("--resume",)
            if mine and (folder / "r/manifest.json").exists():
                for name in MINE:
                    (folder / "r" / name).parent.mkdir(exist_ok=True)
                    (folder / "r" / name).write_text("mine")
        self.talus([*self.arguments, *(("--resume",) if (folder / "r").exists() else ())], folder, self.statuses)
        for name in MINE:
            if (folder / "r" / name).exists():
                require((folder / "r" / name).read_text() == "mine", f"{name}, the user's, is changed")
                (folder / "r" / name).unlink()
        require_same(folder / "r", self.expected)
        for path in (folder / "r").rglob("files.txt"):
            if (path.parent / "series.csv").exists():
                require_list(path.parent)
        return kills


class CloudKills(Kills):
    name, full = "kills: a cloud", 350
    arguments = ("run", "case.toml", "--out", "r", "--threads", 1)
    text = CLOUD

    def lay_out(self, folder):
        (folder / "case.toml").write_text(self.text)


class HopperKills(CloudKills):
    name, full = "kills: a hopper in air", 350
    text = HOPPER


class LevelsKills(CloudKills):
    name, full = "kills: particles of levels", 100
    text = LEVELS


class EnsembleKills(CloudKills):
    name, full = "kills: an ensemble", 200
    arguments = ("ensemble", "case.toml", "--out", "r", "--members", 2, "--vary", "slope.angle=30 deg,50 deg",
                 "--jobs", 2)


class ReproductionKills(Kills):
    name, full = "kills: a reproduction", 100
    arguments = ("reproduce", "niiya2020", "--out", "r", "--jobs", 2)

    def lay_out(self, folder):
        (folder / "cases").mkdir()
        (folder / "validation/niiya2020").mkdir(parents=True)
        (folder / "cases/cloud.toml").write_text(CLOUD)
        (folder / "validation/niiya2020/reference.toml").write_text(REFERENCE)
        (folder / "validation/niiya2020/figures.py").write_text(FIGURES)
