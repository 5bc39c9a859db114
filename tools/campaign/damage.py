# SPDX-License-Identifier: Apache-2.0
"""Files of a run that a broken disk or a careless hand has changed: --resume goes on bitwise identically, or refuses with
exit status 2 or 4 and a message; with the folder as it was, it goes on bitwise identically. A refusal with exit status 2
leaves every file as it found it. Results of a run that has ended, changed, are found by `talus check`."""
import shutil

from attack import Attack, bits, contents, require
from small_cases import CLOUD, HOPPER

RUN = ("run", "case.toml", "--out", "r", "--threads", 1)


def change(random, content):
    """One mutation; never the same bytes."""
    kind = random.choice(("flip", "flip", "cut", "tear", "zero", "text", "double"))
    if not content or kind == "text":
        place = random.randrange(len(content) + 1)
        return content[:place] + random.randbytes(random.randint(1, 40)) + content[place:], kind
    place = random.randrange(len(content))
    if kind == "flip":
        return content[:place] + bytes([content[place] ^ 1 << random.randrange(8)]) + content[place + 1:], kind
    if kind == "cut":
        return content[:place], kind
    if kind == "tear":  # a block that never reached the disk
        end = min(len(content), place + random.choice((16, 512, 4096)))
        return content[:place] + bytes(byte ^ 0xA5 for byte in content[place:end]) + content[end:], kind
    if kind == "zero":
        return b"\0" * (len(content) + 1), kind
    return content + content, kind


def is_result(name, damaged, before):
    """Whether `talus check` has to find the change: in a snapshot, or in the rows of the series. What stands behind the
    last row belongs to no checkpoint, and counts for nothing."""
    return name.endswith(".vtkhdf") or name == "series.csv" and not damaged.startswith(before)


class Damage(Attack):
    text = CLOUD

    def prepare(self):
        (self.folder / "case.toml").write_text(self.text)
        self.talus(RUN, self.folder)
        self.expected = bits(self.folder / "r")
        # The same stopped on its way, as a kill leaves it, and stopped at its end.
        status, limit = 0, 0.02  # s
        while status == 0:
            half = (*RUN[:3], "half", *RUN[4:], "--overwrite", "--walltime", limit)
            status, _ = self.talus(half, self.folder, (0, 130))
            limit /= 2

    def trial(self, random, folder, most):
        (folder / "case.toml").write_text(self.text)
        start = random.choice(("half", "half", "r"))
        shutil.copytree(self.folder / start, folder / "r")
        (folder / "r/mine.txt").write_text("mine")
        before = contents(folder / "r")
        groups = sorted({name.split("_")[0] for name in before if name != "mine.txt"})
        group = random.choice(groups)
        name = random.choice([name for name in before if name.split("_")[0] == group])
        damaged, kind = change(random, before[name])
        (folder / "r" / name).write_bytes(damaged)
        what = f"{name} ({kind})"
        if start == "r":
            self.talus(("check", "r"), folder, (4,) if is_result(name, damaged, before[name]) else (0, 4))
        status, said = self.talus([*RUN, "--resume"], folder, (0, 2, 4))
        require((folder / "r/mine.txt").read_text() == "mine", f"{what}: the user's file is changed")
        if status == 2:
            after, expected = contents(folder / "r"), {**before, name: damaged}
            touched = [key for key in after.keys() | expected.keys() if after.get(key) != expected.get(key)]
            require(not touched, f"{what}: a refusal has changed {touched}: {said[-300:]}")
        if status != 0:  # as it was before the disk broke
            shutil.rmtree(folder / "r")
            for key, content in before.items():
                (folder / "r" / key).parent.mkdir(parents=True, exist_ok=True)
                (folder / "r" / key).write_bytes(content)
            self.talus([*RUN, "--resume"], folder)
        (folder / "r/mine.txt").unlink()
        found = bits(folder / "r")
        wrong = [key for key in found.keys() | self.expected.keys() if found.get(key) != self.expected.get(key)]
        require(not wrong, f"{what}: exit status {status}: other bits: {wrong}")
        return 1


class DamagedCloud(Damage):
    name, full = "damaged files: a cloud", 1000


class DamagedHopper(Damage):
    name, full = "damaged files: a hopper in air", 1000
    text = HOPPER
