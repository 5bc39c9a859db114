# SPDX-License-Identifier: Apache-2.0
"""The readers under libFuzzer (docs/fuzzing.md): the preset `fuzz` is built, and each of its programs is run."""
import re
import shutil
import subprocess

from attack import Attack, Fault
from hostile import PROJECT

TARGETS = {"case": "cases", "setting": "", "unit": "", "points": "", "series": "", "path": "cases/law",
           "reference": "validation", "stl": "", "bed": ""}


class Fuzzing(Attack):
    name, full = "inputs by libFuzzer", 1_000_000

    def prepare(self):
        if not shutil.which("clang++"):
            return "needs clang: tools/install_packages fuzzing"
        for command in (("cmake", "--preset", "fuzz"), ("cmake", "--build", "--preset", "fuzz")):
            done = subprocess.run(command, cwd=PROJECT, capture_output=True, text=True, check=False)
            if done.returncode != 0:
                raise Fault(f"{' '.join(command)}: {(done.stdout + done.stderr)[-600:]}")
        self.share = 0
        self.left = list(TARGETS)
        return None

    def trial(self, random, folder, most):
        """One target for its share of the inputs."""
        if not self.left:
            raise Fault("every target has had its share, and inputs are wanted still")
        self.share = self.share or -(-most // len(TARGETS))
        target = self.left.pop()
        corpus = [PROJECT / "tests/fuzz/corpus" / target] + ([PROJECT / TARGETS[target]] if TARGETS[target] else [])
        (folder / "found").mkdir()
        done = subprocess.run([PROJECT / f"build-fuzz/fuzz_{target}", f"-runs={self.share}", "-timeout=60",
                               "-max_len=4096", f"-seed={random.randrange(1, 2**31)}", f"-artifact_prefix={folder}/",
                               folder / "found", *corpus], capture_output=True, text=True, errors="replace", check=False)
        if done.returncode != 0:
            raise Fault(f"fuzz_{target}: {done.stderr[-1500:]}")
        ran = re.findall(r"Done (\d+) runs", done.stderr)
        if not ran:
            raise Fault(f"fuzz_{target} does not say what it did: {done.stderr[-300:]}")
        return int(ran[-1])
