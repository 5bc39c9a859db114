# SPDX-License-Identifier: Apache-2.0
"""What the attacks share: starting the program, what a fault is, and the bits of a folder without what tells the time."""
import json
import os
import re
import subprocess
import time
import zlib
from pathlib import Path

import h5py

LIMIT = 60  # seconds of its own processor time, after which a program counts as hanging
WAIT = 1200  # seconds, after which one that waits does; on a busy machine a program may get little of a processor
TIMES = {"wall_seconds", "cpu_seconds", "peak_memory", "threads"}
CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f]")


class Fault(Exception):
    """A promise that was broken."""


def processor_seconds(process):
    """What a process has used so far; 0 if it is gone."""
    try:
        fields = Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    except OSError:
        return 0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def wait_for(process, limit=LIMIT, wait=WAIT):
    """What a process says until it ends. Raises Fault where it hangs; it is killed then."""
    start = time.monotonic()
    while True:
        try:
            return process.communicate(timeout=1)[0]
        except subprocess.TimeoutExpired:
            used, waited = processor_seconds(process), time.monotonic() - start
        if used > limit or waited > wait:
            process.kill()
            process.communicate()
            raise Fault(f"hangs: {used:.0f} s of processor time in {waited:.0f} s")


class Attack:
    """A kind of attack. `full`: how many at full scale; `trial` makes one or several and says how many."""
    name = ""
    full = 0
    note = ""  # beside its row of the table

    def __init__(self, program, folder):
        self.program = str(program)
        self.folder = Path(folder)

    def prepare(self):
        """What all trials compare with; once. May return why the attack cannot be made here."""

    def trial(self, random, folder, most):
        """In an empty folder of its own; most: how many are still wanted. Raises Fault."""
        raise NotImplementedError

    def start(self, arguments, folder, **options):
        return subprocess.Popen([self.program, *map(str, arguments)], cwd=folder, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)

    def talus(self, arguments, folder, statuses=(0,), limit=LIMIT, **options):
        """Runs the program to its end; returns its exit status and what it said."""
        process = self.start(arguments, folder, **options)
        try:
            said = wait_for(process, limit).decode(errors="replace")
        except Fault as fault:
            raise Fault(f"talus {' '.join(map(str, arguments))}: {fault}") from None
        status = process.returncode
        if status not in statuses:
            raise Fault(f"talus {' '.join(map(str, arguments))}: exit status {status}: {said[-600:]}")
        if status in (2, 3, 4) and not re.search(r"^talus: \S", said, re.MULTILINE):
            raise Fault(f"exit status {status} without a message: {said[-600:]}")
        # A carriage return belongs to the line of progress.
        if CONTROL.search(re.sub(r"\r|\x1b\[K", "", said)):
            raise Fault(f"control characters reach the terminal: {said[-600:]!r}")
        return status, said


def require(holds, what):
    if not holds:
        raise Fault(what)


def whole_checkpoint(path):
    """Its sequence number; None where it does not agree with its own first lines."""
    content = path.read_bytes()
    lines = content[:512].split(b"\n")
    if lines[0] != b"Talus checkpoint" or len(content) != 512 + int(lines[3].split()[1]):
        return None
    crc = zlib.crc32(content[512:], zlib.crc32(b"\n".join(lines[:4]) + b"\n"))
    return int(lines[2].split()[1]) if lines[4] == b"crc32 %08x" % crc else None


def state_of(path):
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return {name: value.tobytes() if hasattr(value, "tobytes") else value for name, value in found.items()
            if name.split("/")[-1] not in TIMES}


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(item) for key, item in value.items() if key not in TIMES | {"started"}}
    return [without_times(item) for item in value] if isinstance(value, list) else value


def state_of_newest(folder):
    """Of the newest checkpoint of a run; both must be whole."""
    sequences = {path: whole_checkpoint(path) for path in folder.glob("checkpoint_?.h5")}
    require(None not in sequences.values(), f"{folder}: a checkpoint is not whole")
    return state_of(max(sequences, key=sequences.get))


def bits(folder):
    """Of every file below a folder, without times (a report tells them, and else what the other files say); a run's two checkpoints as the state of the newer one."""
    folder, found = Path(folder), {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if not path.is_file() or path.name in ("log.txt", "files.txt", "report.html"):
            continue
        require(not name.endswith(".part"), f"{name} is left behind")
        if path.suffix == ".json":
            found[name] = without_times(json.loads(path.read_text()))
        elif path.name.startswith("checkpoint_"):
            found[str(path.parent.relative_to(folder) / "checkpoint")] = state_of_newest(path.parent)
        else:
            found[name] = path.read_bytes()
    return found


def require_same(folder, expected):
    found = bits(folder)
    require(found.keys() == expected.keys(), f"other files: {sorted(found.keys() ^ expected.keys())}")
    different = [name for name in found if found[name] != expected[name]]
    require(not different, f"other bits: {different}")


def require_list(folder):
    """files.txt names every file of a run, each line behind its checksum."""
    lines = (Path(folder) / "files.txt").read_text().splitlines()[1:]
    names = {line[9:] for line in lines if line[:8] == f"{zlib.crc32(line[9:].encode()):08x}"}
    there = {str(path.relative_to(folder)) for path in Path(folder).rglob("*") if path.is_file()}
    require(there - {"files.txt"} <= names, f"not in files.txt: {sorted(there - names)}")


def contents(folder):
    return {str(path.relative_to(folder)): path.read_bytes()
            for path in sorted(Path(folder).rglob("*")) if path.is_file()}
