# SPDX-License-Identifier: Apache-2.0
"""A disk that fills at some point of a run: exit status 4 with a message, what was there stays, and with room the run
goes on bitwise identically. A file system in memory of so many bytes where one may be mounted; a limit on the length of
files where not."""
import resource
import signal
import subprocess

from attack import Attack, bits, contents, require, require_list, require_same, whole_checkpoint
from small_cases import CLOUD, HOPPER

PAGE = 4096
RUN = ("run", "case.toml", "--out", "disk/r", "--threads", 1)


def mount(folder, options):
    return subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", str(folder)], capture_output=True,
                          check=False).returncode == 0


class FullDisk(Attack):
    text = CLOUD

    def lay_out(self, folder):
        (folder / "case.toml").write_text(self.text)
        (folder / "disk").mkdir()

    def prepare(self):
        self.lay_out(self.folder)
        disk = self.folder / "disk"
        self.mounts = mount(disk, "size=1m")
        if self.mounts:
            subprocess.run(["umount", disk], check=True)
        else:
            self.name += ", by the length of files"
        self.talus(RUN, self.folder)
        self.expected = bits(disk / "r")
        self.whole = contents(disk / "r")
        self.pages = sum(-(-len(content) // PAGE) for content in self.whole.values())

    def require_unharmed(self, folder):
        """What is there is whole, and the beginning of the undisturbed run."""
        for name, content in contents(folder).items():
            require(not name.endswith(".part"), f"{name} is left behind")
            if name.endswith(".vtkhdf"):
                require(content == self.whole[name], f"{name} is harmed")
            if name == "series.csv":
                require(self.whole[name].startswith(content), "series.csv is harmed")
            if name.startswith("checkpoint_"):
                require(whole_checkpoint(folder / name) is not None, f"{name} is harmed")

    def fill(self, random, folder):
        """A run without room; returns its exit status and what it said."""
        if self.mounts:
            size = PAGE * random.randint(2, self.pages + 4)
            require(mount(folder / "disk", f"size={size}"), "a file system is mounted")
            (folder / "disk/mine.txt").write_text("mine")
            return self.talus(RUN, folder, (0, 4))
        length = random.randint(1, max(map(len, self.whole.values())) + 100)

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (length, length))

        (folder / "disk/mine.txt").write_text("mine")
        return self.talus(RUN, folder, (0, 4), preexec_fn=limit)

    def trial(self, random, folder, most):
        self.lay_out(folder)
        disk = folder / "disk"
        try:
            status, said = self.fill(random, folder)
            if status == 4:
                require("No space left" in said or "too large" in said, f"the reason is not told: {said[-300:]}")
                self.require_unharmed(disk / "r") if (disk / "r").exists() else None
            if self.mounts:
                subprocess.run(["mount", "-o", "remount,size=200m", disk], check=True, capture_output=True)
            self.talus([*RUN, "--resume"] if (disk / "r").exists() else RUN, folder)
            require_same(disk / "r", self.expected)
            require_list(disk / "r")
            require((disk / "mine.txt").read_text() == "mine", "the user's file is changed")
        finally:
            if self.mounts:
                subprocess.run(["umount", "-l", disk], check=False, capture_output=True)
        return 1


class CloudOnFullDisk(FullDisk):
    name, full = "full disk: a cloud", 100


class HopperOnFullDisk(FullDisk):
    name, full = "full disk: a hopper in air", 100
    text = HOPPER
