# SPDX-License-Identifier: Apache-2.0
"""Runs the members of ensembles as processes, each an ordinary run (or a job of lammps.py), and looks at what is done. The
results are in the folders of the members, so that what was killed continues where it was."""
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

from talus.ask import ask, find_program
from talus.lab.command import INTERRUPTED
from talus.program import ends_with_this_process
from talus.run import Run
from talus.trouble import InputError, problem

FAULTS = ("talus: ", "ERROR")  # how the program's and LAMMPS' errors begin


class Member(NamedTuple):
    """A run that is to be done; `settings` as --set, `end` its run.end, s. All members cost the same."""

    case: str
    seed: int
    settings: list
    folder: Path
    fingerprint: str
    end: float

    @property
    def output(self):
        """What the run says, until it has ended well."""
        return self.folder.with_name(self.folder.name + ".out")

    cost, working_folder = 1, None

    def begin_command(self):
        """A run that is there goes on."""
        return self.command() + (["--resume"] if self.folder.exists() else [])

    def finish(self):
        self.output.unlink(missing_ok=True)

    def command(self):
        """Without --resume."""
        return [str(find_program()), "run", self.case, "--out", str(self.folder), "--threads", "1", "--set",
                "output.pictures=false", "--set", "output.report=false",
                *(word for setting in self.settings for word in ("--set", setting))]

    def is_done(self):
        """Whether the folder holds the whole run. Raises InputError if it holds another case's, or a later end's."""
        if not (self.folder / "summary.json").is_file():
            return False
        run = Run(self.folder)
        if run.status != "done":
            return False
        if run.manifest["fingerprint"] != self.fingerprint:
            raise InputError([problem(self.folder, "holds a run of another case",
                                      allowed="the same case to resume, or another --out")])
        end = float(run.case["run"]["end"])
        if end > self.end:
            raise InputError([problem(self.folder, f"{self.end:.6g} s, before the end of the run there, {end:.6g} s",
                                      key="run.end", allowed="the same end or a later one, or another --out")])
        return end == self.end


class Failed(NamedTuple):
    folder: Path
    status: int | None  #: exit status, where this process has seen it
    reason: str         #: the last line of its errors, or of what it wrote


class Result(NamedTuple):
    done: list
    failed: list
    interrupted: bool = False


def has_begun(members):
    return any((member.folder / "manifest.json").is_file() for member in members)


def _split(members):
    """Those that are done, whose output goes, and the others."""
    done, others = [], []
    for member in members:
        (done if member.is_done() else others).append(member)
    for member in done:
        member.output.unlink(missing_ok=True)
    return done, others


def _last_line(path):
    """Of the errors where there are any: errors and the rest come in either order."""
    last = ""
    if path.is_file():
        for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
            if line and (line.startswith(FAULTS) or not last.startswith(FAULTS)):
                last = line
    return last


def gather(members):
    """What is done, without running anything; members that are not done count as failed."""
    done, others = _split(members)
    return Result(done, [Failed(one.folder, None, _last_line(one.output) or "has not ended") for one in others])


def run(members, jobs, interruption, later=0):
    """Runs what is not done yet, `jobs` at a time; a run that was interrupted begins again as its begin_command() says. A signal is
    passed on. \\param later cost of what follows these members, which counts for the ETA"""
    done, others = _split(members)
    failed, running, ended = [], {}, 0
    if others:
        ask("claim", folders=[*{one.folder.parent: 0 for one in others}], files=[one.output for one in others])
    progress = Progress(sum(one.cost for one in others) + later)
    waiting = list(reversed(others))
    while (waiting and not interruption) or running:
        while waiting and len(running) < jobs and not interruption:
            member = waiting.pop()
            running[_start(member)] = member
        for process in [process for process in running if process.poll() is not None]:
            member, status = running.pop(process), process.returncode
            ended += member.cost
            if status == 0:
                done.append(member)
                member.finish()
            elif status != INTERRUPTED:
                failed.append(Failed(member.folder, status if status > 0 else 128 - status, _last_line(member.output)))
        if interruption and not progress.stopped:
            for process in running:
                process.send_signal(signal.SIGTERM)
            progress.stopped = True
        progress.update(ended, f"{len(done)} of {len(members)} runs done" + (f", {len(failed)} failed" if failed else ""))
        if running:
            time.sleep(0.02)
    progress.finish()
    return Result(done, failed, len(done) + len(failed) < len(members))


def _start(member):
    command = member.begin_command()
    # A process group of its own keeps Ctrl-C for this process, which passes it on.
    flags = os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_NOFOLLOW
    with open(os.open(member.output, flags, 0o666), "wb") as output:
        return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output, stderr=output, process_group=0,
                                cwd=member.working_folder, preexec_fn=ends_with_this_process())


class Progress:
    """On a terminal one line, rewritten in place; elsewhere one line per tenth."""

    def __init__(self, count):
        self.count, self.began, self.stopped = count, time.monotonic(), False
        self._terminal, self._tenths, self._told, self._last = sys.stderr.isatty(), 0, False, -60.0
        self._live = self.began + 0.2

    def update(self, ended, text):
        now = time.monotonic()
        if self.count == 0:
            return
        share = ended / self.count
        due = now - self._last >= 1 and (int(10 * share) > self._tenths or (not self._told and now - self.began >= 5))
        if not due and not (self._terminal and now >= self._live):
            return
        left = f"  ETA {duration((now - self.began) * (self.count - ended) / ended)}" if ended else ""
        line = f"{text}  {100 * share:3.0f} %{left}"
        if due:
            self._tenths, self._told, self._last = int(10 * share), True, now
        if self._terminal:
            width = os.get_terminal_size(sys.stderr.fileno()).columns or 80
            print(f"\r\033[K{line[:width - 1]}", end="", file=sys.stderr, flush=True)
            self._live = now + 0.2
        else:
            print(line, file=sys.stderr, flush=True)

    def finish(self):
        if self._terminal:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def duration(seconds):
    """75 -> "1 min 15 s"."""
    s = round(seconds)
    if s < 60:
        return f"{s} s"
    if s < 3600:
        return f"{s // 60} min {s % 60} s"
    return f"{s // 3600} h {s // 60 % 60} min" if s < 2 * 86400 else f"{round(s / 86400)} days"
